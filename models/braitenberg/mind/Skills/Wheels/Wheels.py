"""The wiring of a vehicle, the only skill that it has (thesis, figure 2.3)."""


def wheels(left, right, crossed, inhibiting):
    """Let each eye drive a wheel."""
    on_left, on_right = left, right
    if crossed > 0.5:
        on_left, on_right = right, left
    if inhibiting > 0.5:
        on_left, on_right = 1.0 - on_left, 1.0 - on_right
    return on_left, on_right
