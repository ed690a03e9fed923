"""A dataset's folder: its paths, its manifests, what is done, the index, the report, and the checks."""
