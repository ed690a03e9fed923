"""The size of a picture: what is read, what is refused, and how it is written."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from farm.scene.picture_size import PictureSize, can_be_made, read_resolution

edges = st.integers(1, 10**5)


@pytest.mark.parametrize(
    ("value", "width", "height", "written"),
    [
        (512, 512, 512, 512),
        ("640x480", 640, 480, "640x480"),
        ("480x640", 480, 640, "480x640"),
        ([640, 480], 640, 480, "640x480"),
        ("512x512", 512, 512, 512),
        ([512, 512], 512, 512, 512),
        ("0640x0480", 640, 480, "640x480"),
    ],
)
def test_a_size_is_written_in_one_way(value: object, width: int, height: int, written: int | str) -> None:
    """A square is a whole number, as in files of every release; another size is WIDTHxHEIGHT."""
    size = PictureSize.model_validate_json(json.dumps(value))
    assert size == PictureSize(width=width, height=height)
    assert json.loads(size.model_dump_json()) == written
    assert str(size) == str(written)


@given(width=edges, height=edges)
def test_what_is_written_is_read_back(width: int, height: int) -> None:
    """A size survives the disk."""
    size = PictureSize(width=width, height=height)
    assert PictureSize.model_validate_json(size.model_dump_json()) == size


@pytest.mark.parametrize(
    "value",
    [
        "640x",
        "x480",
        "640X480",
        "640\N{MULTIPLICATION SIGN}480",
        "640*480",
        "640,480",
        "640 x 480",
        " 640x480",
        "640x480\n",
        "640x480x3",
        "-640x480",
        "640.0x480",
        "\N{ARABIC-INDIC DIGIT SIX}40x480",
        "9999999x480",
        "512",
        "",
        640.0,
        True,
        None,
        [],
        [640],
        [640, 480, 3],
        [640.0, 480.0],
        ["640", "480"],
        [True, 480],
        {"width": 640},
        {"width": 640, "height": 480, "depth": 3},
    ],
)
def test_anything_else_is_refused(value: object) -> None:
    """The text says what is expected and what was given."""
    with pytest.raises(ValidationError, match=r"expected pixels.* such as 512.* such as 640x480, not") as refused:
        PictureSize.model_validate_json(json.dumps(value))
    assert refused.value.error_count() == 1


def test_a_long_value_is_not_told_in_full() -> None:
    """A refusal stays a line whatever was given."""
    with pytest.raises(ValidationError) as refused:
        PictureSize.model_validate("9" * 5000)
    assert len(refused.value.errors()[0]["msg"]) < 200


@pytest.mark.parametrize("size", ["32x128", "128x32", "8192x2048", "640x480", "1920x1080", "1080x1920"])
def test_what_can_be_made(size: str) -> None:
    """Edges of 32 to 8192 pixels, the longer at most four times the shorter."""
    assert str(can_be_made(PictureSize.model_validate(size))) == size


@pytest.mark.parametrize(
    ("size", "words"),
    [
        ("0x480", "32 to 8192"),
        ("31x100", "32 to 8192"),
        ("100x31", "32 to 8192"),
        ("8193x4096", "32 to 8192"),
        ("129x32", "4 times"),
        ("480x1921", "4 times"),
        ("5120x32", "4 times"),
    ],
)
def test_what_can_not_be_made(size: str, words: str) -> None:
    """The text names the limit and the size."""
    with pytest.raises(ValueError, match=f"{words}.* not {size}"):
        can_be_made(PictureSize.model_validate(size))


@pytest.mark.parametrize(("text", "value"), [("512", 512), ("-640", -640), ("640x480", "640x480"), ("1e3", "1e3")])
def test_a_flag_is_a_number_or_a_text(text: str, value: int | str) -> None:
    """A flag's value is what a file would hold; the spec refuses what is neither."""
    assert read_resolution(text) == value


def test_the_shares_are_of_the_longer_edge() -> None:
    """The longer edge has the share 1, and an array has the height first."""
    size = PictureSize(width=480, height=640)
    assert (size.longer, size.shorter, size.shape, size.shares) == (640, 480, (640, 480), (0.75, 1.0))
    assert PictureSize.of_array((640, 480, 3)) == size
