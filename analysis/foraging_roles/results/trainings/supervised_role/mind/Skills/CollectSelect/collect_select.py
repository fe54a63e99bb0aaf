def collect_select(ROLE):
    """Collect what the role says: A below 0.5, else B."""
    if ROLE < 0.5:
        return 1.0, 0.0
    return 0.0, 1.0
