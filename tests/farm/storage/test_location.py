"""Finding a storage for a URL."""

import subprocess
import sys

import pytest

from farm.dataset.destination import parse_destination
from farm.errors import DestinationError, FarmError
from farm.storage import open_storage


@pytest.mark.parametrize("location", ["nosuch://bucket/a", "hdfs:///a"])
def test_unknown_kind(location: str) -> None:
    """A URL whose kind is unknown, or whose package is not installed, is refused by a foreseen error."""
    with pytest.raises(FarmError):
        open_storage(location).files()


@pytest.mark.parametrize(
    "location", ["s3://AKIAKEY:hush@bucket/a", "s3://AKIAKEY@bucket/a", "ftp://me:hush@host/a", "s3a://k:hush/x@b/a"]
)
def test_credentials_in_the_url(location: str) -> None:
    """A URL with a key or password is refused before it is shown anywhere, without showing it."""
    for take in (open_storage, parse_destination):
        with pytest.raises(DestinationError, match="holds credentials") as caught:
            take(location)
        assert "hush" not in str(caught.value)
        assert "AKIA" not in str(caught.value)


def test_sign_in_a_name_is_no_credential() -> None:
    """An @ behind the bucket is part of a name."""
    assert parse_destination("s3://bucket/me@home/cables").store == "s3://bucket/me@home"


def test_missing_package() -> None:
    """Without s3fs, an S3 URL is refused with the command that installs it."""
    program = (
        "import sys; sys.modules['s3fs'] = None\n"
        "from farm.errors import MachineError\n"
        "from farm.storage import open_storage\n"
        "try: open_storage('s3://bucket/a')\n"
        "except MachineError as error: print(error)\n"
    )
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "pip install 'cable-farm[s3]'" in result.stdout
