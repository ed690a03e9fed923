"""Means in the published mix, ratios on the same scenes, growth, and the report."""

import json
from pathlib import Path

import pytest

from benchmarks.render.errors import Errors
from benchmarks.terminal import bench_console
from benchmarks.whole.rows import STAGES, Row, Shot, Way, mix, ratio
from farm.spec.category import Category
from farm.spec.job import Job


def shot(category: Category, index: int = 0, errors: Errors | None = None, **stages: float) -> Shot:
    """A picture whose stages take these seconds."""
    return Shot(Job(category=category, index=index), stages, errors)


def whole(category: Category, index: int = 0, render: float = 1.0, errors: Errors | None = None) -> Shot:
    """A picture whose other stages take a tenth of a second together."""
    others = (len(STAGES) - 1) * 10
    return shot(category, index, errors, **{stage: render if stage == "render" else 1 / others for stage in STAGES})


def test_the_mix_has_the_published_shares() -> None:
    """The shares are 2:2:1:1:2:2 of ten, without those of categories that weren't made."""
    values = dict.fromkeys(Category, 1.0) | {Category.CLOSE_DISTRIBUTED: 11.0, Category.FAR: 6.0}
    assert mix(values) == pytest.approx(3.0)
    assert mix({Category.FAR: 1.0, Category.CLOSE_DISTRIBUTED: 4.0}) == pytest.approx(2.0)
    with pytest.raises(ValueError, match="category"):
        mix({})


def test_means_are_by_category_and_of_the_stages_asked_for() -> None:
    """Stages keep their order, and one that a picture lacks counts as 0 s."""
    row = Row(
        Way.STANDARD,
        (
            shot(Category.FAR, 0, render=2.0, realize=1.0),
            shot(Category.FAR, 1, render=4.0),
            shot(Category.CLOSE_DISTRIBUTED, 0, render=9.0),
        ),
    )
    assert row.stages == ("realize", "render")
    assert row.means_s(row.stages) == {Category.CLOSE_DISTRIBUTED: 9.0, Category.FAR: 3.5}
    assert row.mix_s(["render"]) == pytest.approx((2 * 3.0 + 9.0) / 3)


def test_ratios_compare_the_same_scenes_and_the_stages_of_both() -> None:
    """Further scenes and stages of the standard don't count."""
    standard = Row(Way.STANDARD, (whole(Category.FAR, 0, 1.0), whole(Category.FAR, 1, 100.0)))
    slow = Row(Way.BLENDER, (shot(Category.FAR, 0, render=30.0),))
    found = ratio(slow, standard)
    assert (found.scenes, found.stages) == (1, ("render",))
    assert found.value == pytest.approx(30.0)
    assert found.by_category == {Category.FAR: pytest.approx(30.0)}
    published = Row(Way.PUBLISHED, (whole(Category.FAR, 0, 10.9),))
    assert ratio(published, standard).value == pytest.approx(10.0)
    with pytest.raises(ValueError, match="share no scene"):
        ratio(Row(Way.BLENDER, (shot(Category.FAR_ALIGNED, render=1.0),)), standard)


def test_the_mix_of_a_ratio_is_one_of_seconds() -> None:
    """The ratio is the quotient of the seconds' sums and not a mean of ratios."""
    standard = Row(Way.STANDARD, (shot(Category.FAR, render=1.0), shot(Category.CLOSE_DISTRIBUTED, render=7.0)))
    slow = Row(Way.BLENDER, (shot(Category.FAR, render=10.0), shot(Category.CLOSE_DISTRIBUTED, render=7.0)))
    assert ratio(slow, standard).value == pytest.approx(27 / 9)


def test_errors_are_compared_on_the_same_scenes() -> None:
    """Only scenes count of which every way with references has an error."""
    pytest.importorskip("bpy")
    from benchmarks.whole.report import same_scenes  # noqa: PLC0415  # after importorskip

    good, bad = Errors(0.02, 40.0), Errors(0.2, 20.0)
    standard = Row(Way.STANDARD, (whole(Category.FAR, 0, 1.0, good), whole(Category.FAR, 1, 1.0, bad)))
    slow = Row(Way.BLENDER, (shot(Category.FAR, 0, good, render=30.0),))
    blind = Row(Way.PUBLISHED, (shot(Category.FAR, 0, render=30.0),))
    found = same_scenes((standard, blind, slow))
    assert [row.way for row in found] == [Way.STANDARD, Way.BLENDER]
    assert all([each.job.index for each in row.shots] == [0] for row in found)
    assert same_scenes((blind,)) == ()


def test_the_report_has_ratios_first_and_errors_where_there_are_references(tmp_path: Path) -> None:
    """The JSON holds every picture; the tables can be printed with and without growth and errors."""
    pytest.importorskip("bpy")
    from benchmarks.whole.growth import Axis, Point, power  # noqa: PLC0415  # after importorskip
    from benchmarks.whole.plan import Plan  # noqa: PLC0415
    from benchmarks.whole.plot import write_plot  # noqa: PLC0415
    from benchmarks.whole.report import Findings, tables, write_json  # noqa: PLC0415

    few, many = (
        Point(Axis.CABLES, Category.FAR, count, 1, dict.fromkeys(STAGES, seconds))
        for count, seconds in ((2, 0.1), (8, 0.4))
    )
    assert power(few, many) == pytest.approx(1.0)
    standard = Row(Way.STANDARD, (whole(Category.FAR, 0, 1.0, Errors(0.02, 40.0)), whole(Category.FAR, 1)))
    slow = Row(Way.BLENDER, (shot(Category.FAR, realize=0.0, render=30.0),))
    found = Findings(Plan(), standard, (slow,), (few, many), 1.0, 0.01, 500.0)
    titles = [str(table.title) for table in tables(found)]
    assert "over those of standard" in titles[0]
    assert [title for title in titles if "references" in title]
    assert not [title for title in titles if "by resolution" in title]
    with bench_console().capture():
        bench_console().print(*tables(found))
    write_json(tmp_path / "whole.json", found)
    content = json.loads((tmp_path / "whole.json").read_text())
    assert list(content)[2] == "ratios"
    assert content["ratios"][1]["times"] == pytest.approx(30.0)
    assert content["ways"]["standard"]["errors"] == {"far": {"flip": 0.02, "psnr_db": 40.0}}
    assert len(content["ways"]["standard"]["images"]) == 2
    write_plot(tmp_path / "whole.png", found)
    assert (tmp_path / "whole.png").stat().st_size > 10_000
    bare = Findings(Plan(), Row(Way.STANDARD, (whole(Category.FAR),)), (), (), 1.0, 0.01, 500.0)
    assert len(tables(bare)) == 1
    write_plot(tmp_path / "bare.png", bare)
