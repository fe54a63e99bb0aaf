"""Outrun: get behind a sheep."""


def outrun(behind):
    """Run to the place behind the stray."""
    return 0.5 + 2.0 * (behind - 0.5), 1.0
