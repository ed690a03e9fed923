from collections import Counter

from hypothesis import given
from hypothesis import strategies as st

from tests.chaos.schedule import EARLIEST, LATEST, Fault, Recipe, draw_schedule

_LASTS_S = st.tuples(st.floats(0, 30), st.floats(0, 30)).map(lambda pair: (min(pair), max(pair)))
_RECIPES = st.lists(st.builds(Recipe, st.sampled_from(Fault), st.integers(1, 6), _LASTS_S), max_size=8)
_SEEDS = st.integers(0, 2**32)


@given(_SEEDS, st.text(max_size=20), _RECIPES)
def test_a_seed_replays_its_schedule(seed: int, name: str, recipes: list[Recipe]) -> None:
    """Seed, name and recipes decide every fault, its moment, its length and its choices."""
    assert draw_schedule(seed, name, recipes) == draw_schedule(seed, name, recipes)


@given(_SEEDS, _RECIPES)
def test_each_fault_strikes_as_often_as_asked(seed: int, recipes: list[Recipe]) -> None:
    """No fault is left out or added."""
    asked: Counter[Fault] = Counter()
    for recipe in recipes:
        asked[recipe.fault] += recipe.times
    assert Counter(event.fault for event in draw_schedule(seed, "any", recipes)) == asked


@given(_SEEDS, _RECIPES)
def test_faults_strike_in_the_middle_and_in_order(seed: int, recipes: list[Recipe]) -> None:
    """Events are sorted by their moment, none at the very start or end of the work."""
    moments = [event.after for event in draw_schedule(seed, "any", recipes)]
    assert moments == sorted(moments)
    assert all(EARLIEST <= moment <= LATEST for moment in moments)


@given(_SEEDS, st.sampled_from(Fault), _LASTS_S)
def test_faults_last_as_long_as_asked(seed: int, fault: Fault, lasts_s: tuple[float, float]) -> None:
    """Each fault lasts between the least and the most of its recipe."""
    least, most = lasts_s
    assert all(least <= event.lasts_s <= most for event in draw_schedule(seed, "any", [Recipe(fault, 5, lasts_s)]))


@given(st.integers(0, 2**31))
def test_other_seeds_and_other_scenarios_have_other_faults(seed: int) -> None:
    """Neither the next seed nor another scenario's name leads to the same moments."""
    recipes = [Recipe(Fault.CUT, 4)]
    drawn = {draw_schedule(seed, "one", recipes), draw_schedule(seed + 1, "one", recipes)}
    assert len(drawn | {draw_schedule(seed, "other", recipes)}) == 3
