"""The look of a cable: its pieces of geometry, and the images on their surfaces."""
