"""The genetic algorithm (thesis, 5.2.3, Algorithms 1 and 2)."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.learning.optimisers.contract import Optimiser
from socialmind.learning.optimisers.settings import Setting

OURS = "the thesis gives no number"


class Genetic(Optimiser):
    """Truncation, single-point crossover, mutation; weights are first drawn in [-1, 1].

    Only the order of scores counts, not their scale. The elite is judged again with its children,
    which matters where each generation meets other worlds. With `elite` 0 and `mutation` 0 it is
    Algorithm 1 to the letter, save that a generation holds exactly `population` genomes.

    >>> search = Genetic(2, seed=4, settings={"population": 10, "elite": 1})
    >>> genomes = search.ask()
    >>> search.tell(genomes[:, 0])
    >>> bool((search.ask()[0] == search.best).all())
    True
    """

    keyword: ClassVar[str] = "GENETIC"
    known_settings: ClassVar[Mapping[str, Setting]] = MappingProxyType(
        {
            "population": Setting(
                "genomes in a generation (200 to 300 in the thesis's experiments)",
                200,
                low=2,
                whole=True,
            ),
            "selected": Setting(
                "the best share of a generation, which breeds (Algorithm 1, line 8)", 0.3, high=1.0
            ),
            "tournament": Setting(
                "how many of the generation compete to be a parent; 0 for truncation, as in "
                "Algorithm 1",
                0,
                low=2,
                whole=True,
                automatic=True,
            ),
            "elite": Setting(
                f"how many of the best live on unchanged ({OURS}; 0 in Algorithm 1)", 1, whole=True
            ),
            "mutation": Setting(f"the probability that a gene mutates ({OURS})", 0.05, high=1.0),
            "step": Setting(f"the standard deviation of a mutation ({OURS})", 0.2),
            "narrowing": Setting(
                f"the factor of the steps each generation ({OURS}; 1 in Algorithm 1)",
                1.0,
                low=0.5,
                high=1.0,
            ),
        }
    )

    def _begin(self, first: NDArray[np.float64]) -> NDArray[np.float64]:
        elite = int(self.settings["elite"])
        if elite >= self.population:
            raise ModelError(f"elite={elite} of {self.population} genomes", "fewer than population")
        given = first[: self.population]
        return np.concatenate([given, self._drawn(self.population - len(given))])

    def _advance(
        self, genomes: NDArray[np.float64], scores: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        ranked = genomes[np.argsort(-scores, kind="stable")]
        elite = ranked[: int(self.settings["elite"])]
        children = self.population - len(elite)
        first, second = (ranked[self._parents(children)] for _ in range(2))
        # A pivot at the last gene copies the first parent, as Algorithm 2 has it.
        pivots = self._generator.integers(1, self.size + 1, children)
        bred = crossed(first, second, pivots)
        mutates = self._generator.random(bred.shape) < self.settings["mutation"]
        step = self.settings["step"] * self.settings["narrowing"] ** self.generation
        steps = self._generator.normal(0.0, step, bred.shape)
        return np.concatenate([elite, bred + np.where(mutates, steps, 0.0)])

    def _parents(self, count: int) -> NDArray[np.intp]:
        """Return the ranks of parents, 0 for the best."""
        competitors = int(self.settings["tournament"])
        if competitors:
            return self._generator.integers(0, self.population, (count, competitors)).min(axis=1)
        selected = max(1, round(self.settings["selected"] * self.population))
        return self._generator.integers(0, selected, count)


def crossed(
    first: NDArray[np.float64], second: NDArray[np.float64], pivots: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Return children of pairs of parents (thesis, Algorithm 2).

    Args:
        first: the parents that give the genes up to the pivot, shape (children, size).
        second: those that give the genes behind it, shape (children, size).
        pivots: shape (children,), how many genes come from the first parent, 1 … size.

    Returns:
        Shape (children, size).

    >>> crossed(np.array([[1.0, 2.0, 3.0]]), np.array([[7.0, 8.0, 9.0]]), np.array([2])).tolist()
    [[1.0, 2.0, 9.0]]
    """
    return np.where(np.arange(first.shape[1]) < pivots[:, None], first, second)
