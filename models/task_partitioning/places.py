"""The arena from the nest up to the source, by rows of patches: nest, cache, slope, source."""

WIDTH = 10
NEST, CACHE, SLOPE, SOURCE = range(4)
BORDERS = (-0.5, 3.5, 9.5, 23.5, 28.5)
"""Where each place begins, in patches along the light's direction, and where the last one ends."""
LENGTH = 29


def place_of(y):
    """Return the place that a height along the arena belongs to.

    >>> place_of(0.0), place_of(3.6), place_of(23.4), place_of(24.0)
    (0, 1, 2, 3)
    """
    if y < BORDERS[CACHE]:
        return NEST
    if y < BORDERS[SLOPE]:
        return CACHE
    return SLOPE if y < BORDERS[SOURCE] else SOURCE
