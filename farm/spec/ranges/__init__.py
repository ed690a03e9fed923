"""The range of every random parameter, in modules by subject."""
