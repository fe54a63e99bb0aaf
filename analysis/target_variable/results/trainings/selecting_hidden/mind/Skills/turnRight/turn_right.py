def turn_right():
    """Set the left wheel to full forward, the right one to full backwards."""
    return 1.0, 0.0
