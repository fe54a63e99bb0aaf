def move_forward():
    """Set both wheels to full forward."""
    return 1.0, 1.0
