def move_backwards():
    """Set both wheels to full backwards."""
    return 0.0, 0.0
