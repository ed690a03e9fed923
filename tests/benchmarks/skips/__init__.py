"""What is left out, and what that saves."""
