"""What the pictures of a style look like, in figures, beside published examples and photographs."""
