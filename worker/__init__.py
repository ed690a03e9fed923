"""One image from one job: randomize, simulate, check, render, label, upload."""
