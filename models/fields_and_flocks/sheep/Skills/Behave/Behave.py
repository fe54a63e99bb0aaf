"""Behave, the complex skill of sheep: fear comes first, then company, then food."""


def behave(flock_away, danger_near, food):
    """Give influence to fleeing, gathering and grazing."""
    calm = 1.0 - danger_near
    return danger_near, calm * flock_away * flock_away, calm * (0.2 + 0.3 * food)
