"""Tree-structured Parzen estimators (Bergstra et al., 2011), by Optuna, in memory."""

from __future__ import annotations

import warnings
from importlib import import_module
from typing import Any, ClassVar

import numpy as np

from socialmind.experiments.calibration.methods.contract import (
    Distances,
    Method,
    MissingMethodError,
    Points,
)

TOGETHER = 8
"""Trials of a generation: so many can be made at once, and each generation knows those before."""
SEEDS = 2**31


class Tpe(Method):
    """Weighs where good trials lie against where the others do; dimensions are seen together."""

    library: ClassVar[str] = "optuna"

    def __init__(self, size: int, trials: int, seed: int) -> None:
        super().__init__(size, trials, seed)
        try:
            optuna: Any = import_module("optuna")
        except ImportError:
            raise MissingMethodError("Optuna") from None
        optuna.logging.set_verbosity(optuna.logging.WARNING)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # that some of the sampler's options may change
            sampler = optuna.samplers.TPESampler(
                seed=seed % SEEDS, multivariate=True, constant_liar=True
            )
            self._study = optuna.create_study(sampler=sampler, direction="minimize")
        uniform = optuna.distributions.FloatDistribution(0.0, 1.0)
        self._names = [f"x{number}" for number in range(size)]
        self._space = dict.fromkeys(self._names, uniform)

    def ask(self) -> Points:
        """Return the trials of the next generation."""
        self._asked = [self._study.ask(self._space) for _ in range(TOGETHER)]
        return np.array([[one.params[name] for name in self._names] for one in self._asked])

    def tell(self, points: Points, distances: Distances) -> None:
        """Take up distances; failed trials count as the worst."""
        for one, value in zip(self._asked, distances.tolist(), strict=True):
            self._study.tell(one, value)
