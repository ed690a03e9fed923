"""The stress test of the rod solver: many falls over the whole range of every parameter, and starts no scene has."""
