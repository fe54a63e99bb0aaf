"""What episodes came to."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Outcome:
    """What episodes came to; arrays of the shape (individuals, repetitions).

    Attributes:
        score: the sum of the rewards, the mean of the robots.
        ticks: how long each lasted.
        ended: 0 at the limit of ticks, else 1 and the number of the interruption.
        fields: what was recorded at the end, by name: of robots' fields (individuals, repetitions,
            robots), of the model's variables (individuals, repetitions).
    """

    score: NDArray[np.float64]
    ticks: NDArray[np.int64]
    ended: NDArray[np.int64]
    fields: dict[str, NDArray[Any]]
