def forage(PAID):
    """Collect all the time; think about the role after a delivery."""
    return 1.0, PAID
