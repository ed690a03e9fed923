"""The floor's texels in view, and the wear that is drawn on them."""
