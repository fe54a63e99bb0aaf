"""Separation: keep a minimum distance."""


def separation(nearest):
    """Turn away from the nearest flockmate; brake if it is ahead, hurry if it is behind."""
    away = nearest - 0.5 if nearest >= 0.5 else nearest + 0.5
    return 0.5 + 2.0 * (away - 0.5), 2.0 * abs(nearest - 0.5)
