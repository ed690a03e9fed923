"""Categories and what they fix."""

from farm.spec.category import Category


def test_no_two_categories_share_a_code() -> None:
    """It keeps the seeds of their jobs apart."""
    assert len({category.code for category in Category}) == len(Category)


def test_the_codes_of_the_published_categories_are_those_that_seeded_every_dataset() -> None:
    """0 to 5, in the order in which they are listed."""
    assert [category.code for category in Category][:6] == [0, 1, 2, 3, 4, 5]


def test_no_two_categories_fix_the_same() -> None:
    """They differ in the background, the light or the disposition."""
    fixed = {(each.traits.background, each.traits.light, each.traits.disposition) for each in Category}
    assert len(fixed) == len(Category)
