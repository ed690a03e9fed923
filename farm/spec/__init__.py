"""What a dataset is to be: its description, its quotas, its jobs, and its header."""
