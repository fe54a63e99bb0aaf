"""A lesson: which skill learns in which environment, by which optimiser, for how long."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from hashlib import sha256
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_whole
from socialmind.errors import ModelError
from socialmind.learning.optimisers.contract import Optimiser
from socialmind.learning.optimisers.registry import optimiser_named
from socialmind.learning.optimisers.settings import checked
from socialmind.mind.modules import Skill

SCRATCH, KNOWN = "scratch", "known"
"""Where a skill that has a genome begins: anew, or at what it knows."""
FRESH, FIXED = "fresh", "fixed"
"""Which worlds a generation is judged on: others than the one before, or the same ones."""

First = NDArray[np.float64] | Callable[[Skill, int], NDArray[np.float64]]


@dataclass(frozen=True, eq=False)
class Lesson:
    """What is learned in one go (thesis, 5.3.2 and A.4).

    Attributes:
        name: its name, unlike those of other lessons.
        environment: a model with rewards, or its name in the `lessons.py` where the lesson stands;
            or any class with the interface of `learning.episodes.plane_episodes.Episodes` but
            for the model.
        skill: the skill that learns, or several whose genomes are learned as one; the lesson's
            name where none is given.
        master: the skill that steers the robot; the skill that learns where none is given.
        repetitions: how many worlds each individual of a generation is judged on, 1 or more. They
            are the same for all of them.
        ticks: the length of an episode, 1 or more; the environment's own where none is given.
        generations: how many at most, 1 or more.
        optimiser: its keyword, such as `GENETIC`.
        settings: the optimiser's settings that are not to be its defaults.
        drive: the drive module of the hierarchy (thesis, 5.1.3).
        stand_ins: skills that take the places of those of their names below the master while it
            lasts, such as programs, for an environment in which these cannot act.
        first: individuals to begin from, shape (k, genome size), such as
            `learning.imprinting.imprint.first_population` gives; or a function of the skill and a
            seed that returns them.
        start: `scratch` for weights drawn anew; `known` for those that the skill has, and
            mutations of them.
        spread: the standard deviation of these mutations.
        worlds: `fresh` for other worlds in each generation, `fixed` for the same ones in all.
        budget: ticks after which no other generation begins; None for no such limit.
        parameters: of the environment, by name.
        finalists: how many individuals are judged once more after the last generation, 1 or more.
        finals: on how many worlds, 1 or more.
        starts: how many times it is begun at most, each time for all its generations and by other
            draws, 1 or more. The winner of the finals of all starts counts, which are on the same
            worlds.
        enough: a score in the finals from which there is no other start; None for all of them.
        validation: on how many worlds, the same ones in all generations, the best individual of
            each generation is judged once more for the curve alone; 0 for none. It changes nothing
            of what is learned, and its ticks are not counted.
        file, line: where it was read from.

    Raises:
        ModelError: an argument is outside its range.

    >>> from socialmind import Model
    >>> class Field(Model):
    ...     pass
    >>> lesson = Lesson("Seek", Field, generations=50, settings={"population": 30})
    >>> lesson.skills, lesson.master
    (('Seek',), 'Seek')
    """

    name: str
    environment: Any
    skill: str | tuple[str, ...] = ""
    master: str = ""
    repetitions: int = 4
    ticks: int | None = None
    generations: int = 100
    optimiser: str = "GENETIC"
    settings: Mapping[str, float] = field(default_factory=dict)
    drive: Callable[..., None] | None = None
    first: First | None = None
    start: str = SCRATCH
    spread: float = 0.1
    worlds: str = FRESH
    budget: int | None = None
    parameters: Mapping[str, Any] = field(default_factory=dict)
    stand_ins: tuple[Skill, ...] = ()
    finalists: int = 10
    finals: int = 32
    starts: int = 1
    enough: float | None = None
    validation: int = 0
    file: str | None = field(default=None, repr=False)
    line: int | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name.strip() or not self.name.isprintable():
            raise ModelError(f"{self.name!r} as the name of a lesson", "a text", file=self.file)
        if not isinstance(self.environment, str) and not inspect.isclass(self.environment):
            raise self.refused(
                f"with the environment {self.environment!r}", "a class with rewards, or its name"
            )
        self._check_skills()
        for what in ("repetitions", "generations", "finalists", "finals", "starts"):
            self._check_whole(what, getattr(self, what))
        for what in ("ticks", "budget"):
            if getattr(self, what) is not None:
                self._check_whole(what, getattr(self, what))
        self._check_whole("validation", self.validation, least=0)
        for what, values in (("start", (SCRATCH, KNOWN)), ("worlds", (FRESH, FIXED))):
            if getattr(self, what) not in values:
                expected = f"{values[0]!r} or {values[1]!r}"
                raise self.refused(f"with {what}={getattr(self, what)!r}", expected)
        spread = self.spread
        if not is_number(spread) or spread < 0.0:
            raise self.refused(f"with spread={shown(spread)}", "a number, 0 or more")
        if self.enough is not None and not is_number(self.enough):
            raise self.refused(f"with enough={shown(self.enough)}", "a score, or None")
        if self.drive is not None and not callable(self.drive):
            raise self.refused(f"with the drive {self.drive!r}", "a function of the mind")
        try:
            kind = self.kind
            checked(kind.known_settings, self.settings)
        except ModelError as error:
            raise self.refused(f"with {error.found}", error.expected, error.remedy) from None
        if self.first is not None and self.start == KNOWN:
            raise self.refused("with first individuals and start='known'", "one of both")
        if getattr(kind, "graphs", False) and (self.first is not None or self.start == KNOWN):
            begins = "start='known'" if self.start == KNOWN else "first individuals"
            raise self.refused(f"with {self.optimiser} and {begins}", "graphs that begin anew")
        self._freeze("stand_ins", tuple(self.stand_ins))
        if not all(isinstance(one, Skill) for one in self.stand_ins):
            raise self.refused(f"with stand_ins={self.stand_ins!r}", "skills")
        self._freeze("settings", MappingProxyType(dict(self.settings)))
        self._freeze("parameters", MappingProxyType(dict(self.parameters)))

    def _check_skills(self) -> None:
        given: Iterable[Any] = (self.skill,) if isinstance(self.skill, str) else self.skill
        skills = tuple(given) if self.skill else (self.name,)
        if not all(isinstance(one, str) and one for one in skills) or not skills:
            raise self.refused(f"with the skill {self.skill!r}", "a skill's name, or several")
        if len(dict.fromkeys(skills)) < len(skills):
            raise self.refused(f"with the skills {', '.join(skills)}", "each skill once")
        if not self.master and len(skills) > 1:
            raise self.refused("with several skills and no master", "master=, the skill on top")
        self._freeze("skill", skills)
        self._freeze("master", self.master or skills[0])

    def _check_whole(self, what: str, value: Any, least: int = 1) -> None:
        if not is_whole(value) or value < least:
            raise self.refused(f"with {what}={shown(value)}", f"a whole number, {least} or more")
        self._freeze(what, int(value))

    def _freeze(self, name: str, value: Any) -> None:
        object.__setattr__(self, name, value)

    @property
    def skills(self) -> tuple[str, ...]:
        """The names of the skills that learn."""
        return (self.skill,) if isinstance(self.skill, str) else self.skill

    @property
    def kind(self) -> type[Optimiser]:
        """The class of its optimiser."""
        return optimiser_named(self.optimiser)

    @property
    def episode_ticks(self) -> int:
        """The most ticks that an episode takes; 0 where nobody says it."""
        return int(self.ticks or getattr(self.environment, "ticks", 0) or 0)

    def changed(self, **fields: Any) -> Lesson:
        """Return the lesson with other fields."""
        return replace(self, **fields)

    def refused(
        self, what: str, expected: str | None = None, remedy: str | None = None
    ) -> ModelError:
        """Return the error that says what is wrong with the lesson, and where it stands."""
        return ModelError(
            f"the lesson {self.name!r} {what}", expected, remedy, self.file, self.line
        )

    def record(self) -> dict[str, Any]:
        """Return what decides its result, as the manifest of a training keeps it."""
        return {
            "name": self.name,
            "environment": _name_of(self.environment),
            "skills": list(self.skills),
            "master": self.master,
            "repetitions": self.repetitions,
            "ticks": self.ticks,
            "generations": self.generations,
            "optimiser": self.optimiser.upper(),
            "settings": checked(self.kind.known_settings, self.settings),
            "drive": _name_of(self.drive),
            "first": self._first_record(),
            "start": self.start,
            "spread": self.spread,
            "worlds": self.worlds,
            "budget": self.budget,
            "parameters": dict(self.parameters),
            "finalists": self.finalists,
            "finals": self.finals,
            # A lesson without them has the record that it would have if there were no such thing.
            **({"validation": self.validation} if self.validation else {}),
            **({"starts": self.starts, "enough": self.enough} if self.starts > 1 else {}),
            **({"stand_ins": [one.name for one in self.stand_ins]} if self.stand_ins else {}),
        }

    def _first_record(self) -> str | None:
        """Return what gives the first individuals, or how many are given and which."""
        if self.first is None or callable(self.first):
            return _name_of(self.first)
        given = np.ascontiguousarray(self.first, np.float64)
        return f"{len(given)} given, SHA-256 {sha256(given.tobytes()).hexdigest()[:16]}"


def _name_of(something: Any) -> str | None:
    if something is None or isinstance(something, str):
        return something
    return str(getattr(something, "__qualname__", something))
