"""Graze: stay where there is food, walk on where there is none."""


def graze(food):
    """Go straight on, the slower the more food is under the feet."""
    return 0.5, 0.4 * (1.0 - food)
