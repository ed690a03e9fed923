"""What lies about and is not cable: sheets, sticks and small parts, and how they are rendered."""
