"""Alignment: head in the same direction as the group."""


def alignment(heading):
    """Turn to where the flockmates are heading, at the usual speed."""
    return 0.5 + 2.0 * (heading - 0.5), 0.5
