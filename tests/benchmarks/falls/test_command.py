"""What the benchmark of falls tells. No rod falls."""

from benchmarks.falls.command import Fallen, told

SOUND = {"length": 1e-9, "cable_penetration": 0.01, "floor_penetration": 0.0, "speed_rms": 0.1, "speed_max": 1.0}


def test_falls_that_miss_a_target_are_counted_and_the_worst_is_told() -> None:
    """Those that are drawn again count apart, with their reason."""
    falls = [
        Fallen("far-000000", 200, 0.2, None, SOUND),
        Fallen("far-000001", 300, 0.3, None, {**SOUND, "cable_penetration": 0.07}),
        Fallen("far-000002", 4001, 4.0, "the cables did not come to rest", SOUND),
    ]
    lines = list(told(falls))
    assert lines[:2] == [
        "3 falls, 2 shipped, 4001 steps at most",
        "drawn again: 1 x the cables did not come to rest",
    ]
    assert "cable penetration over radius: 1 above the target of 0.02, 0.07 at most" in lines
    assert "length error: 0 above the target of 0.001, 1e-09 at most" in lines
