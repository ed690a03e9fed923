"""The ledger: who works on what, what failed and how fast it goes. Hints only: the dataset's folder is the truth."""
