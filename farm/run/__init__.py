"""A run: what is queued, who works on it, and how far it is."""
