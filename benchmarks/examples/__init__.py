"""Pictures to look at: a few of every surface, environment and kind of cable."""
