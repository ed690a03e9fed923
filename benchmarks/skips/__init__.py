"""What is left out of a picture because its scene doesn't need it, and the time that saves."""
