"""The template: the code that builds it, the names both sides rely on, and the check of what it must hold."""
