def stand_still():
    """Stop both wheels."""
    return 0.5, 0.5
