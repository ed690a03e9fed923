"""Measure the memory of renderers over many images: one that is replaced now and then, and one that never is."""
