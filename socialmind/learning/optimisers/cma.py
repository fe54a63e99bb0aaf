"""CMA-ES, the evolution strategy that adapts a covariance matrix (Hansen 2016), by `cmaes`."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.learning.optimisers.contract import Optimiser, State
from socialmind.learning.optimisers.settings import Setting

PREFIX = "library"
"""What names of the library's own state begin with in ours; they go on with an underscore."""


class MissingCmaesError(SocialmindError, ImportError):
    """The library `cmaes` is not installed."""


class Cma(Optimiser):
    """A normal distribution of genomes that moves, and stretches, to where scores are high.

    Only the order of scores counts, not their scale. When the library finds the distribution
    converged, degenerate or too wide, the search starts again around a genome drawn in [-1, 1];
    the best individual of all generations is kept.

    First individuals give the distribution its mean, and where they differ its size.

    >>> search = Cma(5, seed=2)
    >>> search.ask().shape
    (8, 5)
    """

    keyword: ClassVar[str] = "CMAES"
    known_settings: ClassVar[Mapping[str, Setting]] = MappingProxyType(
        {
            "population": Setting(
                "genomes in a generation; 0 for 4 + 3 ln(size), rounded down (Hansen 2016, eq. 48)",
                0,
                low=4,
                whole=True,
                automatic=True,
            ),
            "step": Setting(
                "the standard deviation at the start, about a quarter of the range of good weights",
                0.5,
                low=1e-9,
            ),
        }
    )

    @property
    def population(self) -> int:
        """How many genomes a generation has."""
        return int(self.settings["population"]) or 4 + math.floor(3 * math.log(self.size))

    def _begin(self, first: NDArray[np.float64]) -> NDArray[np.float64]:
        mean = first.mean(axis=0) if len(first) else self._drawn(1)[0]
        # Equal individuals are compared, since their standard deviation is not 0 when rounded.
        differ = bool((first != first[:1]).any())
        step = float(first.std(axis=0).mean()) if differ else self.settings["step"]
        self._library = self._around(mean, step)
        given = first[: self.population]
        return np.concatenate([given, self._sampled()[len(given) :]])

    def _advance(
        self, genomes: NDArray[np.float64], scores: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        # Ranks, since the library's test for flat scores goes by their scale.
        ranks = np.unique(-scores, return_inverse=True)[1].astype(np.float64)
        self._library.tell(list(zip(genomes, ranks.tolist(), strict=True)))
        if self._library.should_stop():
            self._library = self._around(self._drawn(1)[0], self.settings["step"])
        return self._sampled()

    def _around(self, mean: NDArray[np.float64], step: float) -> Any:
        """Return the library's optimiser, with a normal distribution around a mean."""
        return _library().CMA(mean=mean, sigma=step, population_size=self.population, seed=0)

    def _sampled(self) -> NDArray[np.float64]:
        """Return a generation, shape (population, size)."""
        # The library's own generator is not part of what it saves: each generation has its seed.
        self._library.reseed_rng(int(self._generator.integers(1 << 32)))
        genomes = np.array([self._library.ask() for _ in range(self.population)])
        # A copy keeps half of the covariance matrix. Without it the halves may differ in the last
        # bit, and a restored optimiser would go on from another matrix.
        self._library = copy.deepcopy(self._library)
        return genomes

    def _own_state(self) -> State:
        # Copies, since the library changes its mean and its history in place.
        return {
            f"{PREFIX}{name}": copy.copy(value)
            for name, value in sorted(self._library.__getstate__().items())
            if isinstance(value, np.ndarray | float | int) and not isinstance(value, bool)
        }

    def _restore_own(self, state: Mapping[str, Any]) -> None:
        own = self._library.__getstate__()
        for name, value in self._own_state().items():
            # Numbers come back from a file as arrays without dimensions.
            given = np.array(state[name], dtype=np.asarray(value).dtype)
            own[name.removeprefix(PREFIX)] = given if given.ndim else given.item()
        self._library = copy.deepcopy(self._library)
        self._library.__setstate__(own)


def _library() -> Any:
    try:
        return import_module("cmaes")
    except ImportError as error:
        raise MissingCmaesError(
            "CMA-ES needs the library cmaes, which is not installed; "
            "pip install 'socialmind[learning]'"
        ) from error
