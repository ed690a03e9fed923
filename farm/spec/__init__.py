"""The specification of a dataset: its description, its quotas, its jobs, and its header."""
