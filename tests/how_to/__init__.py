"""The pages of docs/how-to, followed to the letter in a copy of the tree."""
