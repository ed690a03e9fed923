"""What is seen of a cable: pieces of geometry, and the images that lie on them."""
