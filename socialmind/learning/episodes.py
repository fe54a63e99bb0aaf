"""Episodes: genomes judged in worlds, many at once, on which all learning on a plane stands.

An episode is a model from its setup to an interruption or the limit of ticks. Its score is the sum
of its rewards. Worlds run in lockstep, a lane each, so that their minds are evaluated together;
what comes out does not depend on how many lanes there are, or in what order episodes begin.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.connection import connect, connected_arrays
from socialmind.errors import ModelError, SocialmindError
from socialmind.language.nodes import nearest
from socialmind.mind.description import MindDescription
from socialmind.mind.inhabitants import Steering
from socialmind.mind.minds import Minds
from socialmind.worlds.plane.lockstep_text import LOCKSTEP

if TYPE_CHECKING:
    from socialmind.model import Model

LANES = 64
"""How many worlds run in lockstep: their minds' arrays fit into a core's own cache."""
MOST_ROUNDS = 100_000
"""Ticks of all lanes between two looks at Ctrl-C, at most."""
STRETCH = 0.2
"""Seconds, about, between two looks at Ctrl-C."""


@dataclass(frozen=True)
class Outcome:
    """What episodes came to; arrays of the shape (individuals, repetitions).

    Attributes:
        score: the sum of the rewards, the mean of the robots.
        ticks: how long each lasted.
        ended: 0 at the limit of ticks, else 1 and the number of the interruption.
        fields: what was recorded at the end, by name: of robots' fields (individuals, repetitions,
            robots), of the model's variables (individuals, repetitions).
    """

    score: NDArray[np.float64]
    ticks: NDArray[np.int64]
    ended: NDArray[np.int64]
    fields: dict[str, NDArray[Any]]


class Episodes:
    """Judges genomes of skills, or whole minds, in the worlds of a model on a plane.

    Args:
        model_class: the model.
        parameters: values of its parameters that differ from the defaults.
        hierarchy: the mind of the robots instead of the model's own: a folder, a YAML file or a
            `MindDescription`; for several populations with minds a mapping.
        master: the name of the master skill instead of the population's own.
        skill: the skill that learns, or several: their genomes stand one after another.
        drive: a drive module (thesis, 5.1.3) instead of the population's own.
        ticks: the limit of an episode, 1 or more; the model's own by default.
        population: whose minds these are; the first one with a hierarchy by default.
        lanes: how many worlds run in lockstep.
        physics: "compiled", or "pymunk", which runs one world after another.
        record: what to give back: fields of the robots that the minds steer, variables of the
            model, or "population.field" for other robots.
        without: names of interruptions that are not heeded.

    Raises:
        ModelError: no plane, no such skill or field, or a mind that does not fit the bodies.
    """

    def __init__(
        self,
        model_class: type[Model],
        parameters: Mapping[str, Any] | None = None,
        hierarchy: Any = None,
        master: str | None = None,
        skill: str | Sequence[str] | None = None,
        drive: Any = None,
        ticks: int | None = None,
        population: str | None = None,
        lanes: int = LANES,
        physics: str = "compiled",
        record: Sequence[str] = (),
        without: Sequence[str] = (),
    ) -> None:
        if model_class.shape.plane is None:
            raise ModelError(f"episodes of {model_class.name!r}", "a model on a plane")
        self.model_class = model_class
        self.parameters = dict(parameters or {})
        self.ticks = model_class.ticks if ticks is None else int(ticks)
        if self.ticks < 1:
            raise SocialmindError(f"ticks: found {ticks!r}; expected a whole number, 1 or more")
        self.lanes = lanes
        self.physics = physics
        self.record = tuple(record)
        self.without = tuple(without)
        for name, one in model_class.populations.items():
            if one.hierarchy is not None and name not in model_class.shape.plane.robots:
                raise ModelError(f"episodes with hierarchies of {name!r}", "those of robots alone")
        if lanes < 1:
            raise SocialmindError(f"lanes: found {lanes!r}; expected a whole number, 1 or more")
        self.skills = (skill,) if isinstance(skill, str) else tuple(skill or ())
        minded = [n for n, one in model_class.shape.plane.robots.items() if one.hierarchy]
        self.population = population or (minded[0] if minded else "")
        if self.population not in minded:
            hint = nearest(self.population, minded) if minded else "none has a hierarchy"
            raise ModelError(f"the population {self.population!r} of {model_class.name!r}",
                             "one with a hierarchy", hint)  # fmt: skip
        self._robots = model_class.shape.plane.robots
        self._recorded = {name: self._place(name) for name in self.record}
        given = hierarchy
        if hierarchy is not None and not isinstance(hierarchy, Mapping):
            given = {self.population: hierarchy}
        self.steerings = model_class.steerings(given)
        mine, led = self.description, self.steerings[self.population]
        for name in self.skills:
            mine.skill(name)
        self.steerings[self.population] = Steering(
            _filled(mine, self.skills), master or led.master, drive or led.drive
        )
        reached = self.steerings[self.population].assembly.skills
        for name in self.skills:
            if name not in reached:
                raise mine.skill(name).refused(
                    f"which the master {self.steerings[self.population].master!r} does not reach"
                )
        self.genome_size = sum(mine.skills[name].genome_size for name in self.skills)
        self._batch: _Batch | None = None
        self._room: dict[str, int] = {}

    def _place(self, name: str) -> tuple[str | None, str]:
        """Return where something to record stands: a population, or None for the model's own."""
        shape = self.model_class.shape
        population, _, field = name.rpartition(".")
        population = population or self.population
        if population in self._robots and field in shape.populations[population].fields:
            return population, field
        if name in shape.variables:
            return None, name
        known = [*shape.populations[self.population].fields, *shape.variables]
        raise ModelError(f"{name!r} to record", "a field or a variable", nearest(name, known))

    @property
    def description(self) -> MindDescription:
        """The mind that learns, with zeros where a genome is still to be learned."""
        mind = self.steerings[self.population].mind
        if not isinstance(mind, MindDescription):
            return MindDescription.load(mind)
        return mind

    def run(self, genomes: ArrayLike | None, seeds: Sequence[int]) -> Outcome:
        """Judge individuals, each in the same worlds.

        Args:
            genomes: (individuals, `genome_size`), or None for the mind as it is.
            seeds: of the worlds, 0 … 2⁶⁴ − 1, one for each repetition.

        Raises:
            ModelError: genomes of another shape, or that are not finite numbers.
            SocialmindError: an episode failed.
        """
        rows = self._rows(genomes)
        individuals = 1 if genomes is None else len(rows)
        shape = (individuals, len(seeds))
        if 0 in shape:
            empty = np.zeros(shape)
            return Outcome(empty, empty.astype(int), empty.astype(int), {})
        individual = np.repeat(np.arange(individuals), len(seeds))
        bad = [seed for seed in seeds if not 0 <= seed < 2**64]
        if bad:
            raise SocialmindError(f"seed: found {bad[0]!r}; expected a whole number, 0 … 2**64 - 1")
        keys = np.tile(np.array(list(seeds), np.uint64), individuals)
        if self.physics != "compiled":
            return self._one_by_one(rows, individual, keys, shape)
        lanes = min(self.lanes, len(keys))
        while True:
            if self._batch is None or len(self._batch.models) < lanes:
                self._batch = _Batch(self, lanes, self._room)
            try:
                return self._batch.run(rows, individual, keys, shape)
            except _Crowded as crowded:
                self._room, self._batch = crowded.room, None

    def model(self, seed: int, genome: ArrayLike | None = None) -> Model:
        """Return the model of one episode, before its first tick, to look at or to go on with.

        Args:
            seed: of the world.
            genome: (`genome_size`,), or None for the mind as it is.
        """
        steerings = dict(self.steerings)
        if genome is not None:
            rows = self._rows(np.atleast_2d(genome))
            mind = with_genomes(self.description, self.skills, rows[0])
            steerings[self.population] = replace(steerings[self.population], mind=mind)
        return self.model_class(
            seed=int(seed),
            hierarchy=steerings,
            physics=self.physics,
            without=self.without,
            **self.parameters,
        )

    def _rows(self, genomes: ArrayLike | None) -> NDArray[np.float64]:
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

    def _one_by_one(
        self,
        rows: NDArray[np.float64],
        individual: NDArray[np.int64],
        keys: NDArray[np.uint64],
        shape: tuple[int, int],
    ) -> Outcome:
        """Run one world after another."""
        score, ticks, ended = (
            np.zeros(len(keys)),
            np.zeros(len(keys), int),
            np.zeros(len(keys), int),
        )
        fields: dict[str, list[Any]] = {name: [] for name in self.record}
        for job, (one, key) in enumerate(zip(individual.tolist(), keys.tolist(), strict=True)):
            model = self.model(key, rows[one] if len(rows) else None)
            while model.over is None and model.tick < self.ticks:
                model.advance(1)
            tables = [model.tables[name] for name in self._robots]
            scores = [one for table in tables for one in table.rows["score"][table.alive].tolist()]
            score[job] = sum(scores) / max(len(scores), 1)
            ticks[job], ended[job] = model.tick, int(model.context["_over"])
            for name, values in fields.items():
                population, field = self._recorded[name]
                if population is None:
                    values.append(np.copy(model.context[field]))
                    continue
                founders = max(model._size(model.populations[population].size, 0), 1)
                values.append(model.tables[population].rows[field][:founders].copy())
        stacked = {name: np.array(values) for name, values in fields.items()}
        found = {name: a.reshape(*shape, *a.shape[1:]) for name, a in stacked.items()}
        return Outcome(score.reshape(shape), ticks.reshape(shape), ended.reshape(shape), found)


class _Crowded(Exception):  # noqa: N818  # nobody outside sees it
    """Births found no room.

    Args:
        room: how many slots each population needs.
    """

    def __init__(self, room: dict[str, int]) -> None:
        super().__init__(room)
        self.room = room


class _Batch:
    """The worlds of all lanes, their minds, and where compiled code finds them."""

    def __init__(self, episodes: Episodes, lanes: int, room: Mapping[str, int]) -> None:
        self.episodes = episodes
        self.rounds = 1
        make = episodes.model_class
        self.models = [
            make.before_setup(
                hierarchy=episodes.steerings, without=episodes.without, **episodes.parameters
            )
            for _ in range(lanes)
        ]
        self.founders = {name: len(table.rows) for name, table in self.models[0].tables.items()}
        for model in self.models:
            for name, slots in room.items():
                while len(model.tables[name].rows) < slots:
                    model.tables[name].grow()
        self.minds: dict[str, Minds] = {}
        for name, robots in episodes._robots.items():
            if robots.hierarchy:
                self.minds[name] = self._minds(name, lanes)
        copies: list[tuple[int, int, int]] = []
        self.copy_begin = np.zeros(lanes + 1, np.int64)
        self._kept: list[Any] = []
        for lane, model in enumerate(self.models):
            connect(model)
            for name, minds in self.minds.items():
                model.context[f"_{name}_hierarchy"] = minds.address
                model.context[f"_{name}_first"] = lane * len(model.tables[name].rows)
            for array in (model.contexts, *connected_arrays(model)):
                copy = array.copy()
                self._kept.append(copy)
                if array.nbytes:
                    copies.append((_address(copy), _address(array), array.nbytes))
            self.copy_begin[lane + 1] = len(copies)
        self.copies = np.array(copies, np.int64)
        self.contexts = np.array([_address(model.contexts) for model in self.models], np.int64)
        self.job = np.full(lanes, -1, np.int64)
        self.module = self.models[0].engine.module
        self.work = np.zeros(1, LOCKSTEP)

    def _minds(self, name: str, lanes: int) -> Minds:
        episodes = self.episodes
        mine = name == episodes.population
        own = episodes.model_class.populations[name]
        robots = len(self.models[0].tables[name].rows)
        led = episodes.steerings[name]
        mind: Any = led.mind
        minds = Minds(
            mind,
            led.master,
            lanes * robots,
            own_genomes=mine and bool(episodes.skills),
            drive=led.drive,
            instances=lanes * own.instances,
            lanes=min(lanes * robots, LANES),
        )
        minds.divide(lanes, name)
        return minds

    def run(
        self,
        genomes: NDArray[np.float64],
        individual: NDArray[np.int64],
        keys: NDArray[np.uint64],
        shape: tuple[int, int],
    ) -> Outcome:
        """Run all episodes."""
        episodes, jobs, work = self.episodes, len(keys), self.work[0]
        score = np.zeros(jobs)
        words = {name: np.zeros(jobs, np.int64) for name in ("individual", "ticks", "ended")}
        words["individual"][:] = individual
        words["seed_0"] = (keys & np.uint64(0xFFFFFFFF)).astype(np.int64)
        words["seed_1"] = (keys >> np.uint64(32)).astype(np.int64)
        minds = self.minds[episodes.population]
        weights = np.array([n for s in episodes.skills for n in _places(minds, s)], np.int64)
        tables = [self.models[0].tables[name] for name in episodes._robots]
        rows: dict[str | None, NDArray[Any]] = {
            name: np.zeros((jobs, len(table.rows)), table.dtype)
            for name, table in zip(episodes._robots, tables, strict=True)
        }
        wanted = any(population is None for population, _ in episodes._recorded.values())
        rows[None] = np.zeros((jobs, 1) if wanted else (jobs, 0), self.models[0].contexts.dtype)
        out = np.array([(_address(one), one.nbytes // jobs) for one in rows.values()], np.int64)
        self.job[:] = -1
        work["lanes"], work["jobs"], work["next"] = len(self.models), jobs, 0
        work["limit"], work["failed"] = episodes.ticks, -1
        work["genome_size"] = weights.size if len(genomes) else 0
        work["learner"] = list(episodes._robots).index(episodes.population)
        arrays = {
            "contexts": self.contexts, "job": self.job, "copies": self.copies,
            "copy_begin": self.copy_begin, "score": score, "genomes": genomes,
            "weights": weights, "out": out, **words,
        }  # fmt: skip
        for name, array in arrays.items():
            work[name] = _address(array)
        if not len(genomes) and episodes.skills:
            for name in episodes.skills:
                minds.set_genome(name, episodes.description.skills[name].genome)
        call, address = self.module.run_lanes.ctypes, _address(self.work)
        status = 1
        while status > 0:
            begin = time.perf_counter()
            status = call(address, self.rounds, 0)
            took = time.perf_counter() - begin
            self.rounds = max(
                1, min(2 * self.rounds, MOST_ROUNDS, int(self.rounds * STRETCH / (took + 1e-9)))
            )
        if status < 0:
            self._fail(genomes, individual, keys)
        fields = {}
        for name, (population, field) in episodes._recorded.items():
            values = rows[population][field]
            values = values[:, 0] if population is None else values[:, : self.founders[population]]
            fields[name] = values.reshape(*shape, *values.shape[1:])
        return Outcome(
            score.reshape(shape),
            words["ticks"].reshape(shape),
            words["ended"].reshape(shape),
            fields,
        )

    def _fail(
        self,
        genomes: NDArray[np.float64],
        individual: NDArray[np.int64],
        keys: NDArray[np.uint64],
    ) -> None:
        """Run the episode that failed once more, alone, which says where and why.

        Raises:
            RuleError: what failed.
            _Crowded: nothing but the room for births, which a world alone makes as it goes.
        """
        job, known = int(self.work["failed"][0]), None
        for name, minds in self.minds.items():
            if job < 0 and minds.failed_agent >= 0:
                known = minds.failure()
                job = int(self.job[minds.failed_agent // len(self.models[0].tables[name].rows)])
        if job >= 0:
            genome = genomes[individual[job]] if len(genomes) else None
            alone = self.episodes.model(int(keys[job]), genome)
            while alone.over is None and alone.tick < self.episodes.ticks:
                alone.advance(1)
            here = self.models[0].tables
            room = {name: len(table.rows) for name, table in alone.tables.items()}
            if any(slots > len(here[name].rows) for name, slots in room.items()):
                raise _Crowded({n: max(room[n], len(here[n].rows)) for n in room})
        where = f"the episode of the world {int(keys[job])}" if job >= 0 else "an episode"
        raise known or SocialmindError(f"{where} failed")


def _filled(description: MindDescription, skills: Sequence[str]) -> MindDescription:
    """Return a mind whose learning skills have some genome."""
    size = sum(description.skills[name].genome_size for name in skills)
    unset = [name for name in skills if description.skills[name].genome is None]
    if not unset:
        return description
    zeros = np.zeros(size)
    return with_genomes(description, skills, zeros, only=unset)


def with_genomes(
    description: MindDescription,
    skills: Sequence[str],
    genome: NDArray[np.float64],
    only: Sequence[str] | None = None,
) -> MindDescription:
    """Return a mind with other weights of some skills.

    Args:
        description: the mind.
        skills: whose genomes stand one after another in `genome`.
        genome: (their sizes together,).
        only: those to be replaced; all by default.
    """
    changed = []
    first = 0
    for name in skills:
        skill = description.skills[name]
        part = genome[first : first + skill.genome_size]
        first += skill.genome_size
        if only is None or name in only:
            changed.append(replace(skill, genome=part))
    return description.with_modules(skills=changed)


def _places(minds: Minds, skill: str) -> range:
    found = minds.assembly.genome_of(skill)
    return range(found.start, found.stop)


def _address(array: NDArray[Any]) -> int:
    return int(array.__array_interface__["data"][0])
