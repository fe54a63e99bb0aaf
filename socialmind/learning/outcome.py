"""What episodes came to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Outcome:
    """What episodes came to; arrays of the shape (individuals, repetitions).

    Attributes:
        score: the sum of the rewards, the mean of all robots that have lived in the episode.
        ticks: how long each lasted.
        ended: 0 at the limit of ticks, else 1 and the number of the interruption.
        fields: what was recorded at the end, by name: of the model's variables (individuals,
            repetitions); of robots' fields (individuals, repetitions, robots), all that have lived
            in order of birth, the dead as they were at last, and zeros where an episode had fewer
            than another one.
        lived: for each robots' field, how many robots it tells of.
    """

    score: NDArray[np.float64]
    ticks: NDArray[np.int64]
    ended: NDArray[np.int64]
    fields: dict[str, NDArray[Any]]
    lived: dict[str, NDArray[np.int64]] = field(default_factory=dict)


def filled(values: Sequence[NDArray[Any]]) -> NDArray[Any]:
    """Return arrays of different lengths as one, filled up with zeros.

    >>> filled([np.array([1, 2]), np.array([3])]).tolist()
    [[1, 2], [3, 0]]
    """
    most = max(len(one) for one in values)
    found = np.zeros((len(values), most, *values[0].shape[1:]), values[0].dtype)
    for place, one in enumerate(values):
        found[place, : len(one)] = one
    return found
