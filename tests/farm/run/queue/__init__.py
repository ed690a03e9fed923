"""What goes on the wire, over real servers."""
