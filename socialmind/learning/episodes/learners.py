"""Whose minds learn in episodes: a population, its skills that learn, and their genomes.

What episodes on a plane and episodes of societies have in common.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coglogo_py.border.numbers import whole_number
from socialmind.errors import ModelError, SocialmindError, nearest
from socialmind.mind.description import MindDescription
from socialmind.mind.modules import Skill
from socialmind.mind.steering import Steering

if TYPE_CHECKING:
    from socialmind.model import Model


class Halted(Exception):  # noqa: N818  # who stops the episodes waits for it
    """Episodes were stopped from another thread."""


@dataclass(frozen=True, eq=False)
class Learners:
    """The minds of a model of which some skills learn.

    Attributes:
        population: the name of the population that learns.
        skills: the skills that learn; their genomes stand one after another.
        steerings: the minds of all populations that have some; zeros stand for genomes that are
            still to be learned.
    """

    population: str
    skills: tuple[str, ...]
    steerings: Mapping[str, Steering]

    @property
    def description(self) -> MindDescription:
        """The mind that learns."""
        return _described(self.steerings[self.population])

    @property
    def genome_size(self) -> int:
        """How many weights the skills that learn have together."""
        return sum(self.description.skills[name].genome_size for name in self.skills)

    def rows(self, genomes: ArrayLike | None) -> NDArray[np.float64]:
        """Return genomes as (individuals, genome_size), none for None.

        Raises:
            ModelError: another shape, or numbers that are not finite.
        """
        if genomes is None:
            return np.zeros((0, self.genome_size))
        rows = np.ascontiguousarray(genomes, np.float64)
        if rows.ndim != 2 or rows.shape[1] != self.genome_size:
            raise ModelError(
                f"genomes of the shape {rows.shape}",
                f"(individuals, {self.genome_size}), the weights of {', '.join(self.skills)}",
            )
        if not np.isfinite(rows).all():
            raise ModelError("a genome with a weight that is not finite", "finite numbers")
        return rows

    def skills_with(self, genome: NDArray[np.float64]) -> list[Skill]:
        """Return the skills that learn, with the weights of a genome."""
        return shared_out(genome, [self.description.skills[name] for name in self.skills])

    def steerings_with(self, genome: ArrayLike | None) -> dict[str, Steering]:
        """Return the minds of all populations, with a genome in that which learns."""
        steerings = dict(self.steerings)
        if genome is not None:
            row = self.rows(np.atleast_2d(np.asarray(genome)))[0]
            mind = self.description.with_modules(skills=self.skills_with(row))
            steerings[self.population] = replace(steerings[self.population], mind=mind)
        return steerings


def learners_of(
    model_class: type[Model],
    minded: Sequence[str],
    hierarchy: Any = None,
    master: str | None = None,
    skill: str | Sequence[str] | None = None,
    drive: Any = None,
    population: str | None = None,
) -> Learners:
    """Return who learns in a model.

    Args:
        model_class: the model.
        minded: the names of its populations that may learn.
        hierarchy: their mind instead of the model's own; for several populations a mapping.
        master: the name of the master skill instead of the population's own.
        skill: the skill that learns, or several.
        drive: a drive module instead of the population's own.
        population: whose minds these are; the first one by default.

    Raises:
        ModelError: no such population or skill, or a skill that the master does not reach.
    """
    skills = (skill,) if isinstance(skill, str) else tuple(skill or ())
    name = population or (minded[0] if minded else "")
    if name not in minded:
        hint = nearest(name, minded) if minded else "none has a hierarchy"
        raise ModelError(
            f"the population {name!r} of {model_class.name!r}", "one with a hierarchy", hint
        )
    given = hierarchy
    if hierarchy is not None and not isinstance(hierarchy, Mapping):
        given = {name: hierarchy}
    steerings = model_class.steerings(given)
    led = steerings[name]
    mine = _described(led)
    mine, top, drive = with_zeros(mine, skills), master or led.master, drive or led.drive
    if drive is not None and top is not None:
        mine = _ready(mine, top)
    steerings[name] = Steering(mine, top, drive)
    reached = steerings[name].assembly.skills
    for one in skills:
        if one not in reached:
            raise mine.skill(one).refused(
                f"which the master {steerings[name].master!r} does not reach"
            )
    return Learners(name, skills, steerings)


def length_of(model_class: type[Model], ticks: int | None) -> int:
    """Return the ticks of an episode: those given, or the model's own.

    Raises:
        SocialmindError: fewer than 1.
    """
    return whole_number(
        model_class.ticks if ticks is None else ticks, "ticks", 1, None, SocialmindError
    )


def world_seeds(seeds: Sequence[int]) -> list[int]:
    """Return the seeds of worlds as Python's numbers.

    Raises:
        SocialmindError: one is no whole number, 0 … 2⁶⁴ − 1.
    """
    return [whole_number(one, "seed", 0, 2**64 - 1, SocialmindError) for one in seeds]


def _described(steering: Steering) -> MindDescription:
    mind = steering.mind
    return mind if isinstance(mind, MindDescription) else MindDescription.load(mind)


def _ready(description: MindDescription, master: str) -> MindDescription:
    """Return a mind without what is not learned yet and no part of the master's hierarchy.

    A drive reaches all skills of a mind, so all of them are made ready to run, and those still to
    be learned cannot be. What stands above one goes with it.
    """
    reached = set(description.below(*({master} & set(description.skills))))
    unset = {n for n, one in description.skills.items() if one.genome_size and one.genome is None}
    left = [
        name
        for name in description.skills
        if name not in reached and unset.difference(reached).intersection(description.below(name))
    ]
    return description.with_modules(without=left) if left else description


def with_zeros(description: MindDescription, skills: Sequence[str]) -> MindDescription:
    """Return a mind whose learning skills have weights, 0 where they are not set yet."""
    chosen = [description.skill(name) for name in skills]
    unset = [one for one in chosen if one.genome is None and one.genome_size]
    zeros = [one.changed(genome=np.zeros(one.genome_size)) for one in unset]
    return description.with_modules(skills=zeros) if zeros else description


def shared_out(genome: NDArray[np.float64], skills: Sequence[Skill]) -> list[Skill]:
    """Return skills with the weights of a genome, in which theirs stand one after another's."""
    places = pairwise(np.cumsum([0, *(skill.genome_size for skill in skills)]).tolist())
    pairs = zip(skills, places, strict=True)
    return [skill.changed(genome=genome[first:end]) for skill, (first, end) in pairs]
