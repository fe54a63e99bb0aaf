"""Draws of worlds of the economy: none hangs on which other worlds are judged beside it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

BEGUN, DECIDED = 3, 4
"""Streams of a world: what its robots begin with, and what is drawn in deciding. Of the economy
itself are its seed alone, 1 (distances) and 2 (decisions by `SchemeWorlds`)."""


class Luck:
    """Draws of worlds side by side, each from a stream of its own.

    Args:
        seeds: of the worlds.
        stream: its number, beside others of the same worlds.

    >>> Luck([7, 8], BEGUN).draw([1])[0] == Luck([8], BEGUN).draw([0])[0]
    np.True_
    """

    def __init__(self, seeds: Sequence[int], stream: int) -> None:
        self._streams = [np.random.default_rng([seed % 2**63, stream]) for seed in seeds]

    def draw(self, rows: Iterable[int], *shape: int) -> NDArray[np.float64]:
        """Return numbers 0 … 1 for each of some worlds, (worlds, *shape)."""
        return np.array([self._streams[row].random(shape) for row in rows])
