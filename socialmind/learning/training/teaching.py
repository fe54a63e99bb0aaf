"""A lesson being taught: an optimiser, generation by generation, and the finals."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError, nearest
from socialmind.learning.episodes.evaluation import Evaluation
from socialmind.learning.episodes.evaluators import Evaluators
from socialmind.learning.episodes.learners import with_zeros
from socialmind.learning.lessons import keys
from socialmind.learning.lessons.lesson import FIXED, KNOWN, Lesson
from socialmind.learning.optimisers.contract import Optimiser
from socialmind.learning.training import archive
from socialmind.learning.training.finalists import (
    Finalists,
    Finals,
    Individual,
    arrays_of,
    arrays_of_finals,
    finals_of,
    individual_of,
)
from socialmind.mind.description import MindDescription
from socialmind.mind.modules import Skill
from socialmind.work.workers import Stop

COLUMNS = ("generation", "best", "mean", "deviation", "best_so_far", "ticks", "seconds")
"""The columns of a lesson's curve: scores of a generation's individuals, each the mean over its
worlds; ticks of the lesson so far; seconds that the generation took."""
VALIDATED = "validated"
"""The column behind them in lessons with validation: the best individual's score on its worlds."""


@dataclass(frozen=True, eq=False)
class Result:
    """What came of a lesson.

    Attributes:
        winner: the individual that did best in the finals.
        score: its mean score there.
        deviation: the standard deviation of its scores there.
        best: the best individual of all generations (thesis, Algorithm 1).
        finalists: the mean scores in the finals, by generation.
        rows: the curve, shape (generations, columns of `COLUMNS`, and `VALIDATED` if there is); of
            several starts one after the other.
        ticks: of all generations and all finals.
    """

    winner: Individual
    score: float
    deviation: float
    best: Individual
    finalists: tuple[tuple[int, float], ...]
    rows: NDArray[np.float64]
    ticks: int


class Teaching:
    """A lesson being taught to a mind.

    Args:
        lesson: the lesson.
        mind: the mind as it is before it.
        key: what its draws hang on: the seed of the training, the attempt, the lesson's name and
            which time around.
        engine: `compiled` or `pymunk`.
        resumed: whether `restore` follows.

    Raises:
        ModelError: lesson and mind do not fit together.
    """

    def __init__(
        self,
        lesson: Lesson,
        mind: MindDescription,
        key: Sequence[str | int],
        engine: str,
        resumed: bool = False,
    ) -> None:
        self.lesson = lesson
        self._key = tuple(key)
        self._skills = [mind.skill(name) for name in lesson.skills]
        self.evaluation = evaluation_of(lesson, mind, engine)
        self.rows: list[tuple[float, ...]] = []
        self.ticks = 0
        self._best: Individual | None = None
        self._judged: Finals | None = None
        self._begin(0, resumed)

    def _begin(self, start: int, resumed: bool = False) -> None:
        """Begin, for the first time or anew."""
        self.start = start
        self._drawn = (*self._key, keys.START, start) if start else self._key
        self.optimiser = self._optimiser(resumed)
        self.finalists = Finalists(self.lesson.finalists)

    def _optimiser(self, resumed: bool) -> Optimiser:
        lesson, seed = self.lesson, keys.seed_for(keys.OPTIMISER, *self._drawn)
        if getattr(lesson.kind, "graphs", False):
            # Topologies grow from what the skill reads and commands, not from a number of weights.
            kind: Any = lesson.kind
            made: Optimiser = kind.of_skill(self._skills[0], seed, lesson.settings)
            return made
        size = sum(skill.genome_size for skill in self._skills)
        first = None if resumed else self._first(size)
        return lesson.kind(size, seed, lesson.settings, first)

    def _first(self, size: int) -> NDArray[np.float64] | None:
        """Return the individuals that it begins from, if there are any."""
        lesson, seed = self.lesson, keys.seed_for(keys.BEGINNING, *self._drawn)
        if lesson.first is not None:
            given = lesson.first
            return np.asarray(given(self._skills[0], seed) if callable(given) else given)
        if lesson.start != KNOWN:
            return None
        count = lesson.kind(size, seed, lesson.settings).population
        known = np.concatenate([skill.genome for skill in self._skills])
        population = np.tile(known, (count, 1))
        drawn = np.random.default_rng(seed).normal(0.0, lesson.spread, (count - 1, size))
        population[1:] += drawn
        return population

    @property
    def best(self) -> Individual | None:
        """The best individual of all generations so far (thesis, Algorithm 1)."""
        return self._best

    @property
    def generation(self) -> int:
        """How many generations are done."""
        return len(self.rows)

    @property
    def over(self) -> bool:
        """Whether no other generation begins."""
        budget, enough = self.lesson.budget, self.lesson.enough
        return (
            self.generation >= self.lesson.generations * self.lesson.starts
            or (budget is not None and self.ticks >= budget)
            or (
                # A start that is over has been judged.
                self.generation == self.lesson.generations * (self.start + 1)
                and self._judged is not None
                and enough is not None
                and self._judged.score >= enough
            )
        )

    def advance(self, evaluators: Evaluators, stop: Stop) -> None:
        """Judge a generation and draw the next.

        Raises:
            Stopped: `stop` said so; nothing is changed but that the generation was asked for.
        """
        begun = time.perf_counter()
        number = self.generation + 1
        asked = self.optimiser.ask()
        flat = isinstance(asked, np.ndarray)
        outcome = evaluators.evaluate(
            self.evaluation,
            asked if flat else [self._skill_of(one.graph, one.weights) for one in asked],
            self._worlds(number),
            stop,
        )
        scores = outcome.score.mean(axis=1)
        leader = int(scores.argmax())
        best = Individual(
            asked[leader] if flat else asked[leader].weights,
            None if flat else asked[leader].graph,
            float(scores[leader]),
            number,
        )
        finalists = copy(self.finalists)
        finalists.add(best)
        # Before anything changes: it may be stopped as well.
        validated = self._validated(best, evaluators, stop)
        last = number == self.lesson.generations * (self.start + 1)
        if last and self.lesson.starts > 1:
            self._judged = self._finals(finalists, evaluators, stop).after(self._judged)
        self.optimiser.tell(scores)
        self.finalists = finalists
        if self._best is None or best.score > self._best.score:
            self._best = best
        self.ticks += int(outcome.ticks.sum())
        self.rows.append(
            (
                float(number), best.score, float(scores.mean()), float(scores.std()),
                self._best.score, float(self.ticks), max(0.0, time.perf_counter() - begun),
                *validated,
            )
        )  # fmt: skip
        if last and not self.over:
            self._begin(self.start + 1)

    def _validated(self, best: Individual, evaluators: Evaluators, stop: Stop) -> tuple[float, ...]:
        """Return the score of an individual on the worlds of validation, if there are any."""
        if not self.lesson.validation:
            return ()
        worlds = keys.seeds_for(self.lesson.validation, keys.VALIDATION, *self._key)
        outcome = evaluators.evaluate(self.evaluation, self._asked([best]), worlds, stop)
        return (float(outcome.score.mean()),)

    def _asked(self, some: Sequence[Individual]) -> Any:
        """Return individuals as evaluators take them."""
        if some[-1].graph is None:
            return np.stack([one.genome for one in some])
        return [self._skill_of(one.graph, one.genome) for one in some]

    def _worlds(self, generation: int) -> list[int]:
        which = 0 if self.lesson.worlds == FIXED else generation
        return keys.seeds_for(self.lesson.repetitions, keys.WORLD, *self._drawn, which)

    def result(self, evaluators: Evaluators, stop: Stop) -> Result:
        """Judge the finalists on common worlds and return what the lesson has given.

        Raises:
            Stopped: `stop` said so; nothing is changed.
        """
        if self._best is None:
            raise ModelError("the finals of a lesson before its first generation")
        found = self._judged
        begun_at = self.lesson.generations * self.start
        whole = self.generation == begun_at + self.lesson.generations
        if found is None or (self.generation > begun_at and not whole):
            found = self._finals(self.finalists, evaluators, stop).after(found)
        return Result(
            found.winner,
            found.score,
            found.deviation,
            self._best,
            found.finalists,
            np.array(self.rows),
            self.ticks + found.ticks,
        )

    def _finals(self, finalists: Finalists, evaluators: Evaluators, stop: Stop) -> Finals:
        chosen = finalists.chosen()
        if self.lesson.start == KNOWN:
            # What was known before is not given up for anything worse.
            known = np.concatenate([skill.genome for skill in self._skills])
            before = Individual(known, None, float("nan"), 0)
            if not any(one.same(before) for one in chosen):
                chosen.insert(0, before)
        worlds = keys.seeds_for(self.lesson.finals, keys.FINAL, *self._key)
        outcome = evaluators.evaluate(self.evaluation, self._asked(chosen), worlds, stop)
        means = outcome.score.mean(axis=1)
        place = int(means.argmax())
        return Finals(
            chosen[place],
            float(means[place]),
            float(outcome.score[place].std()),
            tuple((one.generation, float(mean)) for one, mean in zip(chosen, means, strict=True)),
            int(outcome.ticks.sum()),
        )

    def _skill_of(self, graph: Any, weights: Any) -> Skill:
        return self._skills[0].changed(function=graph, genome=weights)

    def learned(self, individual: Individual) -> list[Skill]:
        """Return the skills with the genomes of an individual."""
        return individual.given_to(self._skills)

    def state(self) -> dict[str, Any]:
        """Return all that `restore` needs, as arrays by name."""
        return {
            "rows": np.array(self.rows).reshape(-1, len(COLUMNS) + bool(self.lesson.validation)),
            "ticks": np.array(self.ticks),
            **archive.under("optimiser/", self.optimiser.state()),
            **archive.under("finalists/", self.finalists.state()),
            **({} if self._best is None else archive.under("best/", arrays_of(self._best))),
            **({"start": np.array(self.start)} if self.start else {}),
            **(
                {}
                if self._judged is None
                else archive.under("judged/", arrays_of_finals(self._judged))
            ),
        }

    def restore(self, arrays: Mapping[str, Any]) -> None:
        """Go on from what `state` gave."""
        if "start" in arrays:
            self._begin(int(arrays["start"]), resumed=True)
        judged = archive.part(arrays, "judged/")
        self._judged = finals_of(judged) if judged else None
        self.rows = [tuple(row) for row in arrays["rows"].tolist()]
        self.ticks = int(arrays["ticks"])
        self.optimiser.restore(archive.part(arrays, "optimiser/"))
        self.finalists.restore(archive.part(arrays, "finalists/"))
        best = archive.part(arrays, "best/")
        self._best = individual_of(best) if best else None


def evaluation_of(lesson: Lesson, mind: MindDescription, engine: str) -> Evaluation:
    """Return how a lesson's individuals are evaluated."""
    # Weights that are not set yet are exchanged for those of individuals in any case.
    mind = with_zeros(mind, lesson.skills)
    return Evaluation(
        lesson.environment,
        mind.on_stand_ins(lesson.master, lesson.stand_ins) if lesson.stand_ins else mind,
        lesson.master,
        lesson.skills,
        lesson.ticks,
        lesson.parameters,
        lesson.drive,
        engine,
    )


def check_fits(lesson: Lesson, mind: MindDescription, learned: Sequence[str]) -> None:
    """Refuse a lesson that does not fit a mind.

    Args:
        lesson: the lesson.
        mind: the mind that the training begins with.
        learned: the skills that are learned before.

    Raises:
        ModelError: so it is; says what to put right.
    """
    if isinstance(lesson.environment, str):
        raise lesson.refused(
            f"with the environment {lesson.environment!r} by name",
            "a class",
            "write the lesson into a model's lessons.py",
        )
    for name in (lesson.master, *lesson.skills):
        if name not in mind.skills:
            raise lesson.refused(
                f"of the skill {name!r}, which the mind {mind.name!r} has not",
                "one of its skills",
                nearest(name, mind.skills),
            )
    below = mind.below(lesson.master)
    for one in lesson.stand_ins:
        if one.name not in below or one.name in (lesson.master, *lesson.skills):
            raise lesson.refused(
                f"with a stand-in for {one.name!r}",
                f"stand-ins for skills below {lesson.master} that do not learn",
            )
    if lesson.stand_ins:
        mind = mind.on_stand_ins(lesson.master, lesson.stand_ins)
        below = mind.below(lesson.master)
    graphs = getattr(lesson.kind, "graphs", False)
    if graphs and len(lesson.skills) > 1:
        raise lesson.refused(f"of {len(lesson.skills)} skills by {lesson.optimiser}", "one skill")
    for name in lesson.skills:
        skill = mind.skill(name)
        if name not in below:
            raise lesson.refused(
                f"of the skill {name!r} under the master {lesson.master!r}, which does not "
                "influence it",
                f"a skill below {lesson.master}, or another master",
            )
        if not skill.genome_size and not graphs:
            raise lesson.refused(
                f"of the skill {name!r}, whose function has no weights", "a network"
            )
        if lesson.start == KNOWN and skill.genome is None and name not in learned:
            raise lesson.refused(
                f"with start='known' of the skill {name!r}, which has no weights yet",
                "start='scratch'",
                "or learn it in a lesson before",
            )
    for name in below:
        skill = mind.skill(name)
        if name in lesson.skills or not skill.genome_size or name in learned:
            continue
        if skill.genome is None:
            raise lesson.refused(
                f"with the skill {name!r} below {lesson.master!r}, which has no weights yet",
                "skills that are learned in a lesson before, or that come with weights",
                "add its lesson, or give a mind in which it is learned (--mind)",
            )
    if lesson.first is not None and not callable(lesson.first):
        size = sum(mind.skill(name).genome_size for name in lesson.skills)
        if np.ndim(lesson.first) != 2 or np.shape(lesson.first)[1] != size:
            raise lesson.refused(
                f"with first individuals of shape {np.shape(lesson.first)}", f"(k, {size})"
            )
