"""CMA-ES, an evolution strategy that adapts a covariance matrix (Hansen, 2016), by `cmaes`."""

from __future__ import annotations

from importlib import import_module
from typing import Any, ClassVar

import numpy as np

from socialmind.experiments.calibration.methods.contract import (
    Distances,
    Method,
    MissingMethodError,
    Points,
)

WIDTH = 0.3
"""The first standard deviation, of the unit cube's side."""
SEEDS = 2**31
"""The library takes seeds below this."""


class Cma(Method):
    """A normal distribution that moves, and stretches, to where distances are small.

    Only their order counts. It begins in the middle; when the library finds it converged or
    degenerate, it begins again at a place drawn evenly.
    """

    library: ClassVar[str] = "cmaes"

    def __init__(self, size: int, trials: int, seed: int) -> None:
        super().__init__(size, trials, seed)
        self._rng = np.random.default_rng(seed)
        # The library does not search in one dimension: of two, the second then counts for nothing.
        self._wide = max(2, size)
        self._library = self._begun(np.full(self._wide, 0.5))

    def ask(self) -> Points:
        """Return the trials of the next generation."""
        self._asked = np.array([self._library.ask() for _ in range(self._library.population_size)])
        return self._asked[:, : self.size]

    def tell(self, points: Points, distances: Distances) -> None:
        """Move the distribution; failed trials count as the worst."""
        self._library.tell(list(zip(self._asked, distances.tolist(), strict=True)))
        if self._library.should_stop():
            self._library = self._begun(self._rng.uniform(size=self._wide))

    def _begun(self, mean: Points) -> Any:
        try:
            library: Any = import_module("cmaes")
        except ImportError:
            raise MissingMethodError("cmaes") from None
        bounds = np.tile([0.0, 1.0], (self._wide, 1))
        seed = int(self._rng.integers(SEEDS))
        return library.CMA(mean=mean, sigma=WIDTH, bounds=bounds, seed=seed)
