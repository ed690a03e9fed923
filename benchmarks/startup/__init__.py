"""Where the time from a worker's start to its first picture goes."""
