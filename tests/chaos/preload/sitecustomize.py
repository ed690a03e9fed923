"""Module that Python loads at its start in processes whose clock may be set wrong; `tests.chaos.clock` adds it.

Python's sleep waits for a monotonic time with clock_nanosleep. libfaketime 0.9.10 makes that call fail, even if it is
told to leave monotonic clocks alone. It does no harm to select, which replaces the call here.
"""

import select
import time
from typing import SupportsIndex


def _sleep(seconds: SupportsIndex | float, /) -> None:
    select.select([], [], [], float(seconds))


time.sleep = _sleep
