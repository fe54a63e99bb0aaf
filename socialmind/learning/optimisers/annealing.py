"""Simulated annealing (Kirkpatrick, Gelatt and Vecchi 1983)."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from socialmind.learning.optimisers.contract import Optimiser, State
from socialmind.learning.optimisers.settings import Setting

COLDEST = sys.float_info.min
"""The lowest temperature."""


class Annealing(Optimiser):
    """One genome that wanders to its neighbours, less and less often to worse ones.

    A generation is the genome that it stands on, at the head, and neighbours of it; the genome is
    judged again beside them, since scores of one generation compare where worlds change from one to
    the next. The best neighbour is taken where it is no worse, and else with the probability
    exp(difference / temperature). After each generation the temperature and the size of the steps
    are multiplied by their factors.

    Attributes:
        temperature: the temperature now; 0 where it waits for scores that differ.

    >>> search = Annealing(2, seed=3, settings={"neighbours": 3, "temperature": 0.5})
    >>> search.ask().shape
    (4, 2)
    >>> search.tell([1.0, 0.0, 0.0, 2.0])
    >>> search.temperature
    0.495
    """

    keyword: ClassVar[str] = "ANNEALING"
    known_settings: ClassVar[Mapping[str, Setting]] = MappingProxyType(
        {
            "neighbours": Setting(
                "neighbours judged in a generation, beside the genome itself", 4, low=1, whole=True
            ),
            "temperature": Setting(
                "the temperature at the start, in units of the score; 0 for the standard deviation "
                "of scores in the first generation whose scores differ",
                0.0,
            ),
            "cooling": Setting("the factor of the temperature each generation", 0.99, high=1.0),
            "step": Setting("the standard deviation of a gene's step at the start", 0.3),
            "narrowing": Setting("the factor of the steps each generation", 0.998, high=1.0),
            "mutation": Setting("the probability that a gene steps", 0.3, high=1.0),
        }
    )

    @property
    def population(self) -> int:
        """How many genomes a generation has."""
        return 1 + int(self.settings["neighbours"])

    def _begin(self, first: NDArray[np.float64]) -> NDArray[np.float64]:
        self.temperature = self.settings["temperature"]
        self._step = self.settings["step"]
        given = first[: self.population] if len(first) else self._drawn(1)
        return np.concatenate([given, self._neighbours(given[0], self.population - len(given))])

    def _advance(
        self, genomes: NDArray[np.float64], scores: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        if not self.temperature:
            self.temperature = float(scores.std())
        challenger = 1 + int(scores[1:].argmax())
        difference = float(scores[challenger] - scores[0])
        # Drawn in any case, so that the draws that follow do not hang on it.
        chance = self._generator.random()
        taken = difference >= 0.0 or (
            self.temperature > 0.0 and chance < math.exp(difference / self.temperature)
        )
        stands = genomes[challenger if taken else 0]
        if self.temperature:
            # Never down to 0, which stands for a temperature that is still to be found.
            self.temperature = max(self.temperature * self.settings["cooling"], COLDEST)
        self._step *= self.settings["narrowing"]
        return np.concatenate([stands[None], self._neighbours(stands, self.population - 1)])

    def _neighbours(self, genome: NDArray[np.float64], count: int) -> NDArray[np.float64]:
        """Return neighbours, shape (count, size): one gene at least steps."""
        steps = self._generator.random((count, self.size)) < self.settings["mutation"]
        steps[np.arange(count), self._generator.integers(0, self.size, count)] = True
        drawn = self._generator.normal(0.0, self._step, (count, self.size))
        return genome + np.where(steps, drawn, 0.0)

    def _own_state(self) -> State:
        return {"temperature": self.temperature, "step": self._step}

    def _restore_own(self, state: Mapping[str, Any]) -> None:
        self.temperature = float(state["temperature"])
        self._step = float(state["step"])
