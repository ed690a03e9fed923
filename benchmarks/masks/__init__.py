"""Compare masks with white-on-black Cycles renders of many samples."""
