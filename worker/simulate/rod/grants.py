"""What the rod solver is granted: nothing, since the gates' own targets are set for it."""

from worker.simulate.checks.measure import NO_GRANTS

GRANTS = NO_GRANTS
