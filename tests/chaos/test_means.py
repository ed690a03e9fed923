from tests.chaos.means import within_means
from tests.chaos.scenarios import Scenario
from tests.chaos.schedule import Fault, Recipe

_LACKS = {Fault.FILL_DISK: "no root"}


def test_nothing_lacks() -> None:
    """A scenario that needs nothing that the machine lacks stays as it is."""
    scenario = Scenario("any", 6, [Recipe(Fault.CUT, 1)])
    assert within_means(scenario, _LACKS) == (scenario, ())


def test_something_lacks() -> None:
    """Impossible faults are left out and reported; the rest is played, without the disk that it no longer needs."""
    scenario = Scenario("any", 6, [Recipe(Fault.CUT, 1), Recipe(Fault.FILL_DISK, 1)], with_disk=True)
    reduced, left_out = within_means(scenario, _LACKS)
    assert reduced is not None
    assert [recipe.fault for recipe in reduced.recipes] == [Fault.CUT]
    assert not reduced.with_disk
    assert left_out == ("without 'fill disk': no root",)


def test_everything_lacks() -> None:
    """A scenario all of whose faults are impossible is left out."""
    assert within_means(Scenario("any", 6, [Recipe(Fault.FILL_DISK, 3)], with_disk=True), _LACKS)[0] is None
