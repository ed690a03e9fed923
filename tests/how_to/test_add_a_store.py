"""docs/how-to/add-a-store.md, followed."""

from tests.how_to.page import Tree, steps_of

PAGE = "add-a-store.md"
OF_ITS_OWN = "One of its own kind"


def test_a_new_store_is_two_files() -> None:
    """A module and its row; one that fsspec opens is a row alone."""
    assert {step.file for step in steps_of(PAGE, OF_ITS_OWN)} == {
        "farm/storage/sqlite.py",
        "farm/storage/location.py",
    }
    assert [step.file for step in steps_of(PAGE, "One that fsspec opens")] == ["farm/storage/services.py"]


def test_a_new_store_keeps_the_contract(tree: Tree) -> None:
    """The suite of all stores passes on it."""
    tree.follow(steps_of(PAGE))
    told = tree.pytest("tests/farm/storage/test_contract.py", "-k", "sqlite")
    assert "15 passed" in told


def test_a_row_of_a_service_is_told_in_messages(tree: Tree) -> None:
    """Its variables are named where credentials were given in a URL."""
    tree.follow(steps_of(PAGE, "One that fsspec opens"))
    told = tree.python(
        "from farm.storage import open_storage\n"
        "try: open_storage('gcs://me:hush@bucket/a')\n"
        "except Exception as error: print(error)\n"
    )
    assert "for Google: GOOGLE_APPLICATION_CREDENTIALS" in told
    assert "hush" not in told
