"""Physics that no simulator takes part in: reference solutions, and the geometry of cables that touch."""
