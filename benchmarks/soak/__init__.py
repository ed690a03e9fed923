"""Memory of renderers over many images, with one that is replaced now and then beside one that never is."""
