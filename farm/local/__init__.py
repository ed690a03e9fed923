"""A whole farm on one machine: a private Redis and workers, which end with the program that started them."""
