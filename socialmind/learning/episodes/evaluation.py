"""How individuals are evaluated: an environment, a mind, and the skills whose genomes they are."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.mind.description import MindDescription
from socialmind.mind.files.packing import files_of, mind_of
from socialmind.mind.modules import Skill
from socialmind.sources.folders import file_of_class

COMPILED, PYMUNK = "compiled", "pymunk"
"""The engines of physical worlds."""

Genomes = NDArray[np.float64]


class Scores(NamedTuple):
    """What came of episodes: individuals by worlds.

    Attributes:
        score: shape (k, r).
        ticks: how long they went on, shape (k, r).
    """

    score: NDArray[np.float64]
    ticks: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Evaluation:
    """How individuals are evaluated.

    Attributes:
        environment: a model, or a class with the interface of `Episodes` but for the model.
        mind: the mind; the genomes of the skills that learn are exchanged.
        master: the skill that steers.
        skills: the skills that learn.
        ticks: the length of an episode; None for the environment's own.
        parameters: of the environment.
        drive: the drive module of the hierarchy.
        engine: `compiled` or `pymunk`.
    """

    environment: type[Any]
    mind: MindDescription
    master: str
    skills: tuple[str, ...]
    ticks: int | None = None
    parameters: Mapping[str, Any] = field(default_factory=dict)
    drive: Callable[..., None] | None = None
    engine: str = COMPILED

    def with_skill(self, skill: Skill) -> Evaluation:
        """Return the evaluation with another skill in the place of the one of its name."""
        return replace(self, mind=self.mind.with_modules(skills=[skill]))

    def episodes(self) -> Any:
        """Return the `Episodes` that run there."""
        arguments: dict[str, Any] = {
            "parameters": dict(self.parameters),
            "hierarchy": self.mind,
            "master": self.master,
            "skill": self.skills if len(self.skills) > 1 else self.skills[0],
            "drive": self.drive,
            "ticks": self.ticks,
            "physics": self.engine,
        }
        if not self.of_a_model:
            return self.environment(**arguments)
        if not self.environment.shape.world.has_episodes:
            from socialmind.learning.episodes.society_episodes import SocietyEpisodes

            return SocietyEpisodes(self.environment, **arguments)
        from socialmind.learning.episodes.plane_episodes import Episodes

        return Episodes(self.environment, **arguments)

    @property
    def of_a_model(self) -> bool:
        """Whether the environment is a model, and no class that runs episodes in its own way."""
        from socialmind.model import Model

        return issubclass(self.environment, Model)

    def worker(self) -> _Evaluator:
        """Return who evaluates genomes on worlds, one piece after another."""
        return _Evaluator(self, self.episodes())

    @cached_property
    def by_skill(self) -> EvaluationOfSkills:
        """The evaluation of individuals that are whole skills, whose functions may differ."""
        return EvaluationOfSkills(self)

    def __reduce__(self) -> tuple[Any, ...]:
        # The mind travels as its files, which may stand elsewhere on another machine, or nowhere.
        return _unpacked, (
            files_of(self.mind), self.environment, self.master, self.skills, self.ticks,
            dict(self.parameters), self.drive, self.engine,
        )  # fmt: skip


def _unpacked(files: dict[str, bytes], environment: type[Any], *rest: Any) -> Evaluation:
    return Evaluation(environment, mind_of(files), *rest)


@dataclass(frozen=True, eq=False)
class EvaluationOfSkills:
    """An evaluation of individuals that are whole skills: each has episodes of its own.

    Attributes:
        evaluation: the one with any of them.
    """

    evaluation: Evaluation

    def worker(self) -> _Evaluator:
        """Return who evaluates skills on worlds, one piece after another."""
        return _Evaluator(self.evaluation)


@dataclass(frozen=True, eq=False)
class Piece:
    """Individuals and worlds that are evaluated in one go.

    Attributes:
        individuals: the places of the individuals in the generation.
        worlds: the places of the worlds.
        genomes: shape (k, genome size); or one skill for each individual, where their functions
            differ.
        seeds: of the worlds.
    """

    individuals: slice
    worlds: slice
    genomes: Genomes | tuple[Skill, ...]
    seeds: tuple[int, ...]


def pieces_of(genomes: Genomes | Sequence[Skill], seeds: Sequence[int], count: int) -> list[Piece]:
    """Cut individuals by worlds into about so many pieces; individuals first.

    >>> cut = pieces_of(np.zeros((3, 1)), [7, 8], 4)
    >>> [(one.individuals, one.seeds) for one in cut][:2]
    [(slice(0, 1, None), (7,)), (slice(0, 1, None), (8,))]
    """
    individuals = _slices(len(genomes), count)
    worlds = _slices(len(seeds), -(-count // len(individuals)))
    return [
        Piece(one, other, _some(genomes, one), tuple(seeds[other]))
        for one in individuals
        for other in worlds
    ]


def _some(genomes: Genomes | Sequence[Skill], which: slice) -> Genomes | tuple[Skill, ...]:
    return genomes[which] if isinstance(genomes, np.ndarray) else tuple(genomes[which])


def _slices(length: int, count: int) -> list[slice]:
    """Return at most so many slices of nearly the same length."""
    bounds = np.linspace(0, length, min(max(count, 1), length) + 1).round().astype(int)
    return [slice(int(a), int(b)) for a, b in pairwise(bounds)]


@dataclass(eq=False)
class _Evaluator:
    """Evaluates one piece after another.

    Attributes:
        evaluation: where.
        episodes: that genomes are put into; None for skills, which each have their own.
    """

    evaluation: Evaluation
    episodes: Any = None

    def stop(self) -> None:
        """Drop the piece in hand soon."""
        if self.episodes is not None:
            self.episodes.stopped = True

    def do(self, piece: Piece) -> Scores:
        """Run the episodes of a piece.

        Raises:
            ModelError: scores that are no finite numbers, or of a wrong shape.
        """
        if self.episodes is None:
            each = [self.evaluation.with_skill(skill).episodes() for skill in piece.genomes]
            outcomes = [one.run(None, piece.seeds) for one in each]
        else:
            outcomes = [self.episodes.run(piece.genomes, piece.seeds)]
        scores = Scores(
            np.concatenate([np.asarray(one.score, np.float64) for one in outcomes]),
            np.concatenate([np.asarray(one.ticks, np.int64) for one in outcomes]),
        )
        _check(scores, (len(piece.genomes), len(piece.seeds)), self.evaluation.environment)
        return scores


def _check(scores: Scores, shape: tuple[int, int], environment: type[Any]) -> None:
    """Refuse scores of a wrong shape, and those that are no finite numbers."""
    if scores.score.shape == shape and np.isfinite(scores.score).all():
        return
    wrong = (
        f"scores of shape {scores.score.shape}"
        if scores.score.shape != shape
        else "scores that are no finite numbers"
    )
    raise ModelError(
        f"{wrong} from the environment {environment.__name__}",
        f"finite scores of shape {shape}",
        "look at its rewards",
        file_of_class(environment),
    )
