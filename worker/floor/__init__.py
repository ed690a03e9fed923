"""The visible texels of the floor's texture, and the wear that is painted on them."""
