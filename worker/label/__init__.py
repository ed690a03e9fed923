"""Labels from the geometry itself: silhouettes, and the share of each pixel that they cover."""
