"""The run registry in Redis that all of a farm share: which runs there are, and which workers. Hints only."""
