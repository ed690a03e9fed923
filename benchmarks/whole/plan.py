"""The plan of a run of the whole-image benchmark."""

from dataclasses import dataclass

from farm.spec.category import Category


@dataclass(frozen=True, slots=True)
class Plan:
    """The pictures and points of growth that a run measures.

    Attributes:
        seed: seed of the dataset whose scenes are used.
        images: number of standard pictures of each category.
        slow_images: number of these whose scenes are made in the slow ways, too; at most `images`.
        growth_images: number of scenes for each point of the growth with resolution and cables; 0 leaves it out.
        resolution: pixels along an edge, except where growth with resolution is measured.
        errors: whether pictures are compared with references, which take minutes each where they are not kept.
        categories: categories of the standard and the slow pictures.
        growth_categories: categories of the scenes that growth is measured on, one far and one close.
        resolutions: resolutions that growth is measured at, pixels along an edge.
        counts: numbers of cables that growth is measured at.
    """

    seed: int = 0
    images: int = 8
    slow_images: int = 1
    growth_images: int = 2
    resolution: int = 512
    errors: bool = True
    categories: tuple[Category, ...] = tuple(Category)
    growth_categories: tuple[Category, ...] = (Category.FAR, Category.CLOSE_CONCENTRATED)
    resolutions: tuple[int, ...] = (256, 512, 1024, 2048)
    counts: tuple[int, ...] = (1, 2, 4, 8, 16, 32)
