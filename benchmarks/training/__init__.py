"""What the pictures are worth: a small segmentation network, trained on each style and tested on all."""
