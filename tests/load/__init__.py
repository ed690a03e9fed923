"""What the queue costs, measured with a stand-in renderer: `python -m tests.load jobs|submit --out DIR`."""
