"""What is measured on settled cables, and whether a scene may be shipped."""
