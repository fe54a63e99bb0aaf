def turn_left():
    """Set the left wheel to full backwards, the right one to full forward."""
    return 0.0, 1.0
