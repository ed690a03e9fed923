"""The tree of errors."""

import os
import pickle

import pytest

from farm.errors import AssetError, FarmError, UnfitWorkerError, error_of


@pytest.mark.parametrize("error", [AssetError, lambda text: UnfitWorkerError(text, AssetError.exit_code)])
def test_a_text_can_be_kept_anywhere(error: type[FarmError]) -> None:
    """Quarantine, Redis and logs are UTF-8; a path in the text may hold other bytes, which are spelt out."""
    text = str(error(os.fsdecode(b"caf\xe9/lab.jpg: na\xc3\xafve")))
    assert text == r"caf\udce9/lab.jpg: naïve"
    again = pickle.loads(pickle.dumps(error(text)))  # noqa: S301  # our own bytes
    assert str(again) == text
    assert str(error_of(AssetError.exit_code, text)) == text
