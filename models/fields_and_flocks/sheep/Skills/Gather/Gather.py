"""Gather: go where the others are."""


def gather(flock):
    """Turn to the middle of the flock, at a walk."""
    return 0.5 + 2.0 * (flock - 0.5), 0.5
