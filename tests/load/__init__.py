"""Measure the cost of the queue with a stand-in renderer: `python -m tests.load jobs|submit --out DIR`."""
