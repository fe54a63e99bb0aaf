"""Individuals that are judged once more after the last generation of a lesson.

Where each generation meets other worlds, the highest score of all is luck in part: one that was
judged on easy worlds. So the foremost are compared on common ones.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.learning.episodes.learners import shared_out
from socialmind.learning.training import archive
from socialmind.mind.functions.neat.graph import NeatGraph
from socialmind.mind.modules import Skill


@dataclass(frozen=True, eq=False)
class Individual:
    """What a lesson found, and how well it did in its generation.

    Attributes:
        genome: the weights of the skills that learn, one after the other.
        graph: the function of the skill, where that was found as well.
        score: its mean score in the generation.
        generation: the generation, from 1; 0 for what the lesson began from.
    """

    genome: NDArray[np.float64]
    graph: NeatGraph | None
    score: float
    generation: int

    def same(self, other: Individual) -> bool:
        """Whether both do the same."""
        return self.graph == other.graph and np.array_equal(self.genome, other.genome)

    def given_to(self, skills: Sequence[Skill]) -> list[Skill]:
        """Return the skills that learned, with what was found."""
        if self.graph is not None:
            return [skills[0].changed(function=self.graph, genome=self.genome)]
        return shared_out(self.genome, skills)


class Finalists:
    """The individuals with the highest scores, and the best of each of the last generations.

    Args:
        count: how many distinct ones go into the finals, 1 or more: half of them, rounded up, by
            score and the others from the last generation back.

    >>> some = [Individual(np.array([x]), None, y, g) for x, y, g in [(1, 5, 1), (2, 3, 2)]]
    >>> finalists = Finalists(2)
    >>> for one in (*some, Individual(np.array([9.0]), None, 1.0, 3)):
    ...     finalists.add(one)
    >>> [one.generation for one in finalists.chosen()]
    [1, 3]
    """

    def __init__(self, count: int) -> None:
        self.count = count
        self.highest: list[Individual] = []
        self.last: list[Individual] = []

    def add(self, best: Individual) -> None:
        """Take the best individual of a generation."""
        known = [one for one in self.highest if one.same(best)]
        if not known or known[0].score < best.score:
            others = [one for one in self.highest if not one.same(best)]
            ranked = sorted([*others, best], key=lambda one: (-one.score, one.generation))
            self.highest = ranked[: -(-self.count // 2)]
        others = [one for one in self.last if not one.same(best)]
        self.last = [*others, best][-self.count :]

    def chosen(self) -> list[Individual]:
        """Return those that go into the finals, by generation."""
        chosen = list(self.highest)
        for one in reversed(self.last):
            if len(chosen) == self.count:
                break
            if not any(one.same(other) for other in chosen):
                chosen.append(one)
        return sorted(chosen, key=lambda one: one.generation)

    def state(self) -> dict[str, Any]:
        """Return all that `restore` needs, as arrays by name."""
        arrays: dict[str, Any] = {}
        for name, some in (("highest", self.highest), ("last", self.last)):
            arrays[f"{name}/count"] = np.array(len(some))
            for number, one in enumerate(some):
                arrays |= archive.under(f"{name}/{number}/", arrays_of(one))
        return arrays

    def restore(self, arrays: Mapping[str, Any]) -> None:
        """Go on from what `state` gave."""
        for name, some in (("highest", self.highest), ("last", self.last)):
            some.clear()
            for number in range(int(arrays[f"{name}/count"])):
                some.append(individual_of(archive.part(arrays, f"{name}/{number}/")))


@dataclass(frozen=True, eq=False)
class Finals:
    """What finals came to, of one start or of several.

    Attributes:
        winner: the individual that did best.
        score, deviation: the mean and the standard deviation of its scores.
        finalists: the mean scores by generation.
        ticks: of the finals.
    """

    winner: Individual
    score: float
    deviation: float
    finalists: tuple[tuple[int, float], ...]
    ticks: int

    def after(self, before: Finals | None) -> Finals:
        """Return what both came to; of equals the one before counts."""
        if before is None:
            return self
        better = self if self.score > before.score else before
        both = before.finalists + self.finalists
        return replace(better, finalists=both, ticks=before.ticks + self.ticks)


def arrays_of(individual: Individual) -> dict[str, Any]:
    """Return an individual as arrays by name."""
    graph = individual.graph
    return {
        "genome": individual.genome,
        "graph": np.array("" if graph is None else "\n".join(graph.to_lines())),
        "place": np.array([individual.score, individual.generation], np.float64),
    }


def individual_of(arrays: Mapping[str, Any]) -> Individual:
    """Return the individual of arrays that `arrays_of` gave."""
    lines = str(arrays["graph"])
    score, generation = arrays["place"]
    graph = NeatGraph.from_lines(lines.splitlines()) if lines else None
    return Individual(np.array(arrays["genome"]), graph, float(score), int(generation))


def arrays_of_finals(finals: Finals) -> dict[str, Any]:
    """Return finals as arrays by name."""
    return {
        **archive.under("winner/", arrays_of(finals.winner)),
        "finalists": np.array(finals.finalists),
        "numbers": np.array([finals.score, finals.deviation, finals.ticks]),
    }


def finals_of(arrays: Mapping[str, Any]) -> Finals:
    """Return the finals of arrays that `arrays_of_finals` gave."""
    score, deviation, ticks = arrays["numbers"].tolist()
    finalists = tuple((int(generation), mean) for generation, mean in arrays["finalists"].tolist())
    winner = individual_of(archive.part(arrays, "winner/"))
    return Finals(winner, score, deviation, finalists, int(ticks))
