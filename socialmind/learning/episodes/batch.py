"""A batch: worlds side by side that run one episode after another, and the minds of all of them."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.compiling.memory import address
from socialmind.errors import SocialmindError
from socialmind.learning.episodes.learners import Halted
from socialmind.learning.outcome import Outcome, filled
from socialmind.mind.minds import Minds
from socialmind.society.connection import connect, connected_arrays
from socialmind.worlds.plane.ticks.lockstep_text import LOCKSTEP

if TYPE_CHECKING:
    from socialmind.learning.episodes.plane_episodes import Episodes

LANES = 64
"""How many worlds run in lockstep: their minds' arrays fit into a core's own cache."""
MOST_ROUNDS = 100_000
"""Ticks of all lanes between two looks at Ctrl-C, at most."""
STRETCH = 0.2
"""Seconds, about, between two looks at Ctrl-C."""


class Crowded(Exception):  # noqa: N818  # the episodes catch it
    """Births found no room.

    Args:
        room: how many slots and identities each population needs.
    """

    def __init__(self, room: dict[str, tuple[int, int]]) -> None:
        super().__init__(room)
        self.room = room


class Batch:
    """The worlds of all lanes, their minds, and where compiled code finds them."""

    def __init__(self, episodes: Episodes, lanes: int, room: Mapping[str, tuple[int, int]]) -> None:
        self.episodes = episodes
        self.rounds = 1
        make = episodes.model_class
        self.models = [
            make.before_setup(
                hierarchy=episodes.steerings, without=episodes.without, **episodes.parameters
            )
            for _ in range(lanes)
        ]
        for model in self.models:
            for name, (slots, identities) in room.items():
                model.tables[name].reserve(slots, identities)
        minded = [name for name, robots in episodes.robots.items() if robots.hierarchy]
        self.minds: dict[str, Minds] = {name: self._minds(name, lanes) for name in minded}
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
                    copies.append((address(copy), address(array), array.nbytes))
            self.copy_begin[lane + 1] = len(copies)
        self.copies = np.array(copies, np.int64)
        self.contexts = np.array([address(model.contexts) for model in self.models], np.int64)
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
            own_genomes=episodes.skills if mine else (),
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
        minds.state_arrays.individual[...] = -1  # nobody's who is judged now
        weights = np.array([n for s in episodes.skills for n in _places(minds, s)], np.int64)
        tables = [self.models[0].tables[name] for name in episodes.robots]
        rows: dict[str | None, NDArray[Any]] = {
            name: np.zeros((jobs, len(table.slot_of)), table.dtype)
            for name, table in zip(episodes.robots, tables, strict=True)
        }
        for kept in rows.values():
            kept["_id"] = -1  # nobody has lived yet
        wanted = any(population is None for population, _ in episodes.recorded.values())
        rows[None] = np.zeros((jobs, 1) if wanted else (jobs, 0), self.models[0].contexts.dtype)
        out = np.array([(address(one), one.nbytes // jobs) for one in rows.values()], np.int64)
        self.job[:] = -1
        work["lanes"], work["jobs"], work["next"] = len(self.models), jobs, 0
        work["limit"], work["failed"] = episodes.ticks, -1
        work["genome_size"] = weights.size if len(genomes) else 0
        work["learner"] = list(episodes.robots).index(episodes.population)
        arrays = {
            "contexts": self.contexts, "job": self.job, "copies": self.copies,
            "copy_begin": self.copy_begin, "score": score, "genomes": genomes,
            "weights": weights, "out": out, **words,
        }  # fmt: skip
        for name, array in arrays.items():
            work[name] = address(array)
        if not len(genomes) and episodes.skills:
            for name in episodes.skills:
                minds.set_genome(name, episodes.description.skills[name].genome)
        call, work_at = self.module.run_lanes.ctypes, address(self.work)
        status = 1
        while status > 0:
            if episodes.stopped:
                raise Halted
            begin = time.perf_counter()
            status = call(work_at, self.rounds, 0)
            took = time.perf_counter() - begin
            self.rounds = max(
                1, min(2 * self.rounds, MOST_ROUNDS, int(self.rounds * STRETCH / (took + 1e-9)))
            )
        if status < 0:
            self._fail(genomes, individual, keys)
        fields, lived = {}, {}
        for name, (population, field) in episodes.recorded.items():
            values = rows[population][field]
            if population is None:
                values = values[:, 0]
            else:
                there = rows[population]["_id"] >= 0
                values = filled([one[who] for one, who in zip(values, there, strict=True)])
                lived[name] = there.sum(axis=1).reshape(shape)
            fields[name] = values.reshape(*shape, *values.shape[1:])
        return Outcome(
            score.reshape(shape),
            words["ticks"].reshape(shape),
            words["ended"].reshape(shape),
            fields,
            lived,
        )

    def _fail(
        self, genomes: NDArray[np.float64], individual: NDArray[np.int64], keys: NDArray[np.uint64]
    ) -> None:
        """Run the episode that failed once more, alone, which says where and why.

        Raises:
            RuleError: what failed.
            Crowded: nothing but the room for births, which a world alone makes as it goes.
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
            room, more = {}, False
            for name, table in self.models[0].tables.items():
                slots, identities = alone.tables[name].room
                here = table.room
                room[name] = max(slots, here[0]), max(identities, here[1])
                more = more or room[name] != here
            if more:
                raise Crowded(room)
        where = f"the episode of the world {int(keys[job])}" if job >= 0 else "an episode"
        raise known or SocialmindError(f"{where} failed")


def _places(minds: Minds, skill: str) -> range:
    found = minds.assembly.genome_of(skill)
    return range(found.start, found.stop)
