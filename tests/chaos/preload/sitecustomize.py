"""Read by Python at its start where a clock may be set wrong; see `tests.chaos.clock`.

Python sleeps until a monotonic time by clock_nanosleep, which libfaketime 0.9.10 gets wrong even where it is told to
leave monotonic clocks alone: the call fails. It does no harm to select.
"""

import select
import time
from typing import SupportsIndex


def _sleep(seconds: SupportsIndex | float, /) -> None:
    select.select([], [], [], float(seconds))


time.sleep = _sleep
