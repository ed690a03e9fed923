"""The grants of Blender's cloth: it stretches more than the rods do, and its strips bend a little differently."""

from collections.abc import Mapping
from types import MappingProxyType

from worker.simulate.checks.measure import Gate

GRANTS: Mapping[Gate, float] = MappingProxyType({Gate.LENGTH: 0.005, Gate.CANTILEVER: 0.05})
"""A cable of cloth may be 0.5 % longer or shorter than it is at rest, and a cantilever's H/W off by 5 %."""
