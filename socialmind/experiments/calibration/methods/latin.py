"""A Latin hypercube: trials all over the ranges, whatever comes of them. The baseline."""

from __future__ import annotations

import numpy as np

from socialmind.experiments.calibration.methods.contract import (
    Distances,
    Method,
    MissingMethodError,
    Points,
)


class Latin(Method):
    """Of each dimension, one trial in each of n equal slices.

    >>> np.sort(Latin(2, 4, 1).ask(), axis=0).astype(str).shape
    (4, 2)
    """

    def ask(self) -> Points:
        """Return all trials."""
        try:
            from scipy.stats import qmc
        except ImportError:
            raise MissingMethodError("scipy") from None
        rng = np.random.default_rng(self.seed)
        return np.asarray(qmc.LatinHypercube(self.size, seed=rng).random(self.trials))

    def tell(self, points: Points, distances: Distances) -> None:
        """Nothing hangs on it."""
