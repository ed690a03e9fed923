"""What stands behind far cables: an HDRI, or a photograph, and how cables are laid over it."""
