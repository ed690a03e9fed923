"""`python -m benchmarks physics`: play the scenes at every setting on one core, and name the best setting."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def one_core() -> Iterator[None]:
    """Keep this process, and all threads that it starts within the context, on one core, if the system allows it.

    Blender and the libraries of linear algebra start as many threads as there are cores when they are loaded, and offer
    no other way to ask for one thread. CPU seconds are then those of one thread, and contain no waiting.
    """
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    allowed = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(allowed)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, allowed)


def run(out: Path, *, seed: int, scenes: int | None) -> int:
    """Compare all simulators; print the tables, write `physics.json` and `physics.png` into `out`.

    Args:
        out: a folder that is there.
        seed: the seed that the scenes are drawn from.
        scenes: most scenes for a setting; slow settings have fewer. None for the usual number.

    Raises:
        VerificationError: if the rod solver breaks a gate's bound at its default, or ends in places that aren't finite.
        TemplateError: if the template can't be opened.
    """
    start = time.process_time()
    with one_core():
        # These imports load Blender and linear algebra, so they must come after the process is limited to one core.
        from benchmarks.physics.compare import compare  # noqa: PLC0415
        from benchmarks.physics.settings import DEFAULT_SCENES, all_settings  # noqa: PLC0415

        return compare(out, all_settings(), seed=seed, scenes=scenes or DEFAULT_SCENES, start_s=start)
