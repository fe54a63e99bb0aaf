"""A society that runs under somebody's eyes, in a process of its own."""
