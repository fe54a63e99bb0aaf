"""The contract of optimisers: genomes are asked for, judged, and their scores told."""

from __future__ import annotations

import copy
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_whole
from socialmind.errors import ModelError
from socialmind.learning.optimisers.generator import generator_at, words_of
from socialmind.learning.optimisers.settings import Setting, checked

State = dict[str, Any]
"""Arrays and numbers by name, as `numpy.savez` writes them and `numpy.load` reads them."""

Generation = Any
"""Individuals: genomes as an array of shape (population, size); where they are graphs, a list."""


class Optimiser(ABC):
    """What finds better genomes, a generation at a time.

    A generation is drawn as soon as the one before is judged, so that the state holds it: an
    optimiser that is restored between `ask` and `tell` gives the generation in hand once more.

    Subclasses say `keyword` and `known_settings`, and write `_begin`, `_advance`,
    `_own_state` and `_restore_own`; all that they draw is drawn from `_generator`. Those whose
    individuals are graphs say `graphs`, and write `_checked_size`, `_checked_first`,
    `_genomes_state`, `_restore_genomes` and `_check_fits` too.

    Args:
        size: weights in a genome, 1 or more; where individuals are graphs, the numbers of inputs
            and outputs.
        seed: decides all draws; 0 or more.
        settings: values by name, others than the defaults of `known_settings`.
        first: individuals to begin from, the foremost first, shape (k, size); where they are
            graphs, a list. They stand at the head of the first generation, as many as fit into it.

    Attributes:
        generation: how many generations were told.
        best_score: the score of the best individual; minus infinity before the first is told.

    Raises:
        ModelError: an argument is outside its range.

    >>> from socialmind.learning.optimisers.genetic import Genetic
    >>> search = Genetic(3, seed=1, settings={"population": 30})
    >>> for generation in range(40):
    ...     genomes = search.ask()
    ...     search.tell(-((genomes - 0.5) ** 2).sum(axis=1))
    >>> search.generation, search.best.round(1).tolist()
    (40, [0.5, 0.5, 0.5])
    """

    keyword: ClassVar[str]
    """Its name in a lesson (LEARNINGMETHOD in `.simbatch` files)."""

    known_settings: ClassVar[Mapping[str, Setting]]
    """Its settings by name."""

    graphs: ClassVar[bool] = False
    """Whether individuals are graphs with weights (`NeatGenome`), not genomes of one size."""

    def __init__(
        self,
        size: int | tuple[int, int],
        seed: int,
        settings: Mapping[str, Any] | None = None,
        first: Any = None,
    ) -> None:
        self.size = self._checked_size(size)
        self.settings = MappingProxyType(checked(self.known_settings, settings or {}))
        self._generator = np.random.default_rng(whole("seed", seed, 0))
        self._asked = False
        self.generation = 0
        self.best_score = -math.inf
        self._genomes: Generation = self._begin(self._checked_first(first))
        self._best: Any = copy.copy(self._genomes[0])

    @property
    def population(self) -> int:
        """How many individuals a generation has."""
        return int(self.settings["population"])

    @property
    def best(self) -> Any:
        """The best individual of all generations (Algorithm 1): shape (size,), or a graph.

        Raises:
            ModelError: no generation was told yet.
        """
        if not self.generation:
            raise ModelError("no best genome before the first generation is told")
        return copy.copy(self._best)

    def ask(self) -> Generation:
        """Return the genomes of the generation, shape (population, size), or a list of graphs.

        Raises:
            ModelError: its genomes were asked for already, and no scores told.
        """
        if self._asked:
            raise ModelError(
                f"generation {self.generation} asked for twice", "ask, then tell", "tell scores"
            )
        self._asked = True
        return copy.copy(self._genomes)

    def tell(self, scores: ArrayLike) -> None:
        """Take the scores of the genomes that were asked for, and draw the next generation.

        Args:
            scores: shape (population,), finite, the higher the better.

        Raises:
            ModelError: the generation was not asked for, or the scores are of another shape or not
                finite.
        """
        if not self._asked:
            raise ModelError("scores of a generation not asked for", "ask, then tell", "ask first")
        told = _numbers("scores", scores)
        if told.shape != (self.population,):
            raise ModelError(f"scores of shape {told.shape}", f"({self.population},)")
        wrong = np.flatnonzero(~np.isfinite(told))
        if wrong.size:
            raise ModelError(f"the score {told[wrong[0]]} of genome {wrong[0]}", "a finite number")
        leader = int(told.argmax())
        if told[leader] > self.best_score:
            self._best, self.best_score = copy.copy(self._genomes[leader]), float(told[leader])
        self._genomes = self._advance(self._genomes, told)
        self.generation += 1
        self._asked = False

    def state(self) -> State:
        """Return all that `restore` needs, as arrays and numbers."""
        return {
            "generation": self.generation,
            "best_score": self.best_score,
            "generator": words_of(self._generator),
            **self._genomes_state(),
            **self._own_state(),
        }

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from a state of an optimiser of the same kind, size and settings, bit by bit.

        Args:
            state: what `state` returned, also after a way through `numpy.savez`.

        Raises:
            ModelError: the state is one of another kind, size or population; the optimiser is as it
            was.
        """
        own = self.state()
        if sorted(state) != sorted(own):
            raise ModelError(
                f"a state of {', '.join(sorted(state))}",
                f"one of {', '.join(sorted(own))}",
                f"restore a state of {self.keyword}",
            )
        self._check_fits(state, own)
        self._generator = generator_at(state["generator"])
        self._restore_own(state)
        self._restore_genomes(state)
        self.generation = int(state["generation"])
        self.best_score = float(state["best_score"])
        self._asked = False

    @abstractmethod
    def _begin(self, first: Generation) -> Generation:
        """Return the first generation, begun from individuals, shape (k, size), k of 0 or more."""

    @abstractmethod
    def _advance(self, genomes: Generation, scores: NDArray[np.float64]) -> Generation:
        """Return the generation that follows one with these scores."""

    def _own_state(self) -> State:
        """Return what the subclass remembers beside the generation: the same names at all times."""
        return {}

    def _restore_own(self, state: Mapping[str, Any]) -> None:  # noqa: B027  # some have nothing
        """Take what `_own_state` returned."""

    def _genomes_state(self) -> State:
        """Return the generation and the best genome."""
        return {"genomes": self._genomes.copy(), "best": self._best.copy()}

    def _restore_genomes(self, state: Mapping[str, Any]) -> None:
        """Take what `_genomes_state` returned."""
        self._genomes = np.array(state["genomes"], dtype=np.float64)
        self._best = np.array(state["best"], dtype=np.float64)

    def _check_fits(self, state: Mapping[str, Any], own: State) -> None:
        """Refuse a state of another size or population than its own."""
        for name in own:
            check_shape(self.keyword, name, np.shape(state[name]), np.shape(own[name]))

    def _drawn(self, count: int) -> NDArray[np.float64]:
        """Return genomes with weights drawn in [-1, 1], shape (count, size)."""
        return self._generator.uniform(-1.0, 1.0, (count, self.size))

    def _checked_size(self, size: Any) -> Any:
        return whole("genome size", size, 1)

    def _checked_first(self, first: Any) -> Generation:
        if first is None:
            return np.zeros((0, self.size))
        given = _numbers("first individuals", first)
        if given.ndim != 2 or given.shape[1] != self.size:
            raise ModelError(f"first individuals of shape {given.shape}", f"(k, {self.size})")
        if not np.isfinite(given).all():
            raise ModelError("first individuals that are not finite", "finite weights")
        return given


def whole(name: str, value: Any, low: int) -> int:
    """Return a whole number that an optimiser is given.

    Raises:
        ModelError: it is none, or below `low`.
    """
    if not is_whole(value) or value < low:
        raise ModelError(f"{name}={shown(value)} of an optimiser", f"a whole number, {low} or more")
    return int(value)


def _numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    try:
        return np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ModelError(f"{name} that are no table of numbers", "numbers") from None


def check_shape(keyword: str, name: str, found: tuple[int, ...], expected: tuple[int, ...]) -> None:
    """Refuse an array of a state of another shape than expected.

    Raises:
        ModelError: so it is.
    """
    if found != expected:
        raise ModelError(
            f"{name!r} of shape {found} in a state of {keyword}",
            str(expected),
            "restore with the same genome size and settings",
        )
