def walk_at_random(NOISE):
    """Go straight on, and turn on the spot for a while now and then."""
    if NOISE < 0.1:
        return 0.0, 1.0
    if NOISE < 0.2:
        return 1.0, 0.0
    return 1.0, 1.0
