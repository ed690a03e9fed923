"""The published camera's lens, on which masks and pictures must agree."""

from typing import Final

FOCAL_LENGTH_MM: Final = 50.0
SENSOR_MM: Final = 36.0
"""Edge of the square sensor."""
