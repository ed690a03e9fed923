"""The falls of a dataset's scenes, measured against the gates' targets."""
