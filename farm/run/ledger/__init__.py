"""The ledger: who works on what, what failed, how fast it goes. These are hints; the dataset's folder is the truth."""
