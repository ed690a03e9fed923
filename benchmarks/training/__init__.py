"""Measure the pictures' worth for training: a small segmentation network is trained on each style and tested on all."""
