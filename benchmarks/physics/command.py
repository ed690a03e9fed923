"""`python -m benchmarks physics`: play the scenes at every setting on one core, and say which is best."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def one_core() -> Iterator[None]:
    """Keep this process, and all threads that it starts meanwhile, on one core, where the system lets it.

    Blender and the libraries of linear algebra make as many threads as there are cores when they are loaded, and offer
    no other way to ask for one. Seconds of the processor then are those of one thread, and none of waiting.
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
        VerificationError: if the rod solver breaks a gate's bound at its default, or does not end in finite places.
        TemplateError: if the template can't be opened.
    """
    start = time.process_time()
    with one_core():
        # Not before: what is loaded here must find itself on one core.
        from benchmarks.physics.compare import compare  # noqa: PLC0415
        from benchmarks.physics.settings import DEFAULT_SCENES, all_settings  # noqa: PLC0415

        return compare(out, all_settings(), seed=seed, scenes=scenes or DEFAULT_SCENES, start_s=start)
