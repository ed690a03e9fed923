"""What a whole picture costs, from the drawn scene to its files, beside the published method and other settings."""
