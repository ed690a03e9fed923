"""Example pictures: a few of every surface, environment and kind of cable."""
