"""The report as a browser shows it."""

import os
import shutil
import subprocess
from pathlib import Path

import cv2
import numpy as np
import pytest

from farm.dataset.dataset import Dataset
from farm.dataset.report import write_report
from tests.stand_in import StandInRenderer
from worker.service.upload import upload

pytestmark = pytest.mark.browser

FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking")


@pytest.fixture
def chromium() -> str:
    """The browser's program. A laptop may lack it, continuous integration may not."""
    found = shutil.which("chromium") or shutil.which("chromium-browser")
    if found is None:
        if os.environ.get("CI") == "true":
            pytest.fail("no chromium; see .ci/debian-packages.txt")
        pytest.skip("no chromium")
    return found


def test_a_browser_shows_the_pictures_and_masks(dataset: Dataset, chromium: str, tmp_path: Path) -> None:
    """Every picture and mask of the page loads: plain green and blue stand-ins fill their places in a screenshot."""
    for number, job in enumerate(dataset.header.spec.jobs()):
        made = StandInRenderer().make(job, dataset.header)
        made.files["image"][:] = (0, 200, 0) if number % 2 else (0, 0, 200)
        upload(made, job, dataset)
    write_report(dataset, pictures_per_category=4)
    shot = tmp_path / "shot.png"
    page = Path(dataset.storage.location) / "report.html"
    arguments = [*FLAGS, f"--user-data-dir={tmp_path / 'profile'}", "--window-size=1200,1400", f"--screenshot={shot}"]
    subprocess.run([chromium, *arguments, page.as_uri()], check=True, capture_output=True, timeout=120)
    pixels = cv2.imread(str(shot))[:, :, ::-1].astype(int)
    for colour in ((0, 200, 0), (0, 0, 200)):
        assert np.count_nonzero((np.abs(pixels - colour) < 8).all(axis=2)) > 5000
