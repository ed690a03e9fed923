"""The range of every random parameter, a module a subject."""
