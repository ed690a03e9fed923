"""Downloads: a registry of CC0 files, each with its checksum."""
