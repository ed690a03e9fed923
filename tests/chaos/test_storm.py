from collections import Counter
from pathlib import Path

import pytest

from tests.chaos.play import play
from tests.chaos.scenarios import SMALL_STORM, Scenario
from tests.chaos.schedule import draw_schedule

# The fixture's Redis isn't used, but its rule on where Redis may be missing is.
pytestmark = [pytest.mark.redis, pytest.mark.slow, pytest.mark.usefixtures("redis_url")]


def test_farm_outlives_a_storm(tmp_path: Path) -> None:
    """Processes die, Redis forgets all, connections break and messages go astray; still every image is made right."""
    plan, claims = SMALL_STORM.for_stand_ins(seed=0)
    # The faults strike early, so that lost messages, whose search takes its time, are looked for once.
    events = draw_schedule(0, SMALL_STORM.name, SMALL_STORM.recipes, latest=0.5)
    outcome = play(plan, claims, events, tmp_path, SMALL_STORM.patience_s)
    assert outcome.findings == ()
    assert Counter(struck.event.fault for struck in outcome.struck) == Counter(event.fault for event in events)


def test_the_judge_finds_what_is_wrong(tmp_path: Path) -> None:
    """The judge finds a worker that draws another dataset's pictures, by every wrong file."""
    scenario = Scenario("false", 6, [], delay_s=0.0)
    plan, _ = scenario.for_stand_ins(seed=0)
    _, claims_of_another = scenario.for_stand_ins(seed=1)
    outcome = play(plan, claims_of_another, (), tmp_path, scenario.patience_s)
    assert any("not their job's own" in finding for finding in outcome.findings)
