"""A whole farm on one machine: a private Redis, workers, and their end with the program that started them."""
