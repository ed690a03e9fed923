"""Splitting a total number of images over the categories."""

from collections.abc import Mapping

from farm.spec.category import Category

PUBLISHED_WEIGHTS: Mapping[Category, int] = {category: category.traits.weight for category in Category}
"""The published shares, 2:2:1:1:2:2; a category that the publication has not gets nothing of a total."""


def split_total(total: int, weights: Mapping[Category, int] = PUBLISHED_WEIGHTS) -> dict[Category, int]:
    """Split `total` images by largest remainder (Hamilton's method); ties go to the earlier category.

    Args:
        total: images in all, >= 0.
        weights: share of each category, >= 0, at least one > 0; categories left out get none.

    Returns:
        Images of every category, in the order of `Category`; they add up to `total`.

    Raises:
        ValueError: if `total` or a weight is negative, or no weight is positive.
    """
    if total < 0 or any(weight < 0 for weight in weights.values()):
        raise ValueError("the total and the weights must not be negative")
    sum_of_weights = sum(weights.values())
    if sum_of_weights == 0:
        raise ValueError("at least one weight must be positive")
    shares = {category: divmod(total * weights.get(category, 0), sum_of_weights) for category in Category}
    quotas = {category: whole for category, (whole, _) in shares.items()}
    left = total - sum(quotas.values())
    by_remainder = sorted(Category, key=lambda category: -shares[category][1])
    for category in by_remainder[:left]:
        quotas[category] += 1
    return quotas
