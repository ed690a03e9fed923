"""Tests of the skips: the things left out, and what that saves."""
