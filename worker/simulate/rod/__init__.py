"""The rod solver: inextensible elastic rods with contact and friction, compiled by numba."""
