"""Who steers the robots of a population, as a number of the model's record.

`MINDS`: each robot's mind; `OUTSIDE`: somebody outside, all of them; below 0: their minds, but for
the one robot whose code it is (`in_hand`).
"""

from __future__ import annotations

MINDS, OUTSIDE = 0, 1


def in_hand(number: int) -> int:
    """Return the code of the robot that is steered alone by its identity; or the other way.

    >>> in_hand(0), in_hand(in_hand(7))
    (-1, 7)
    """
    return -1 - number
