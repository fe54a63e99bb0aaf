"""Herd, a complex skill: get behind the stray, then drive it home."""


def herd(behind_away):
    """Give influence to outrunning while the place behind is far, to driving once it is near."""
    far = min(1.0, 2.0 * behind_away)
    return far, 1.0 - far
