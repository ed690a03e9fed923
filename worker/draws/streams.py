"""The job's random streams, as what draws takes them."""

from collections.abc import Callable

import numpy as np

from farm.seeds import Stage

Streams = Callable[[Stage], np.random.Generator]
"""A fresh generator of a stage: asking twice for one stage gives the same numbers twice."""
