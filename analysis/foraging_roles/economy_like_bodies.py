"""The economy of deliveries with trips as long, and objects as far, as they are in bodies.

The model's own economy tells every robot other distances at every trip, all within a tenth. In
bodies robots that set out at about the same time see the same objects nearest, at any distance
between a third and two thirds of what they can see. A robot whose CollectSelect is of two minds
about its ROLE goes where the nearer object is; in the economy that is luck, which tells robots
apart, and in bodies they all go the same way. So minds that settled in the economy changed roles
together in bodies. Trips there are less even, and first ones shorter, which tells robots apart too.

What bodies do was measured by `trips_in_bodies`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.catalogue import load_file
from socialmind.errors import ModelError
from socialmind.learning.outcome import Outcome
from socialmind.mind import MindDescription
from socialmind.mind.minds import Minds

from .trainings import MODEL

DELIVERIES = load_file(MODEL / "deliveries.py")

SHARES = (0.0, 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 1.0)
"""Of the trips or readings, how many are at most as long as the numbers that follow."""
TRIPS = (440.0, 545.0, 605.0, 705.0, 790.0, 885.0, 1030.0, 1180.0, 1600.0)
"""Ticks of a trip of a robot that does not get stuck."""
STUCK, LONGEST = 0.001, 4400.0
"""The share of trips on which a robot gets stuck until it is rescued, and the longest then."""
FIRST = 0.93
"""How much shorter the first trip is, from near the middle in any direction."""
UNEVEN = 0.04
"""At most, the logarithm of how much longer trips for A are in a world, and shorter those for B."""
NEAREST, FARTHEST = 0.31, 0.72
"""Readings of the distance to the nearest object of a kind from the drop zone."""
DISTANCE = 0.51
"""The mean reading."""
OF_WORLD, OF_TIME, OF_ROBOT = 0.03, 0.05, 0.055
"""Standard deviations of readings: between worlds; between times in a world, which all robots
share; and between robots at a time."""
AS_LONG = 300.0
"""Ticks for which about the same objects are nearest."""


@dataclass(frozen=True)
class Terms(DELIVERIES.DeliveryTerms):  # type: ignore[misc]  # of a file that is loaded by path
    """What is lost, as in the economy of deliveries.

    Attributes:
        unsettled: by ever being more than one robot away from the wanted split in the last quarter.
        turns: by each change of what robots bring, for each robot, whenever it is: where few have
            to change, many need not.
    """

    unsettled: float = 0.0
    turns: float = 0.0


OWN = {one.name for one in fields(Terms)} - {one.name for one in fields(DELIVERIES.DeliveryTerms)}


class World(DELIVERIES.DeliveryWorld):
    """What a seed decides: the robots, ratio and event as in the model's economy, other trips."""

    def __init__(self, seed: int, terms: Any, ticks: int) -> None:
        super().__init__(seed, terms, ticks)
        rng = np.random.default_rng([seed % 2**63, 2])
        size = self.trips.shape
        self.uneven = math.exp(rng.uniform(-UNEVEN, UNEVEN))
        self.trips = np.interp(rng.random(size), SHARES, TRIPS)
        stuck = rng.random(size) < STUCK
        self.trips = np.where(stuck, rng.uniform(TRIPS[-1], LONGEST, size), self.trips)
        self.trips[:, 0] *= FIRST
        begun = np.cumsum(self.trips, axis=1) - self.trips
        when = (begun // AS_LONG).astype(int)
        at_times = rng.normal(0.0, OF_TIME, (2, when.max() + 1))
        away = DISTANCE + rng.normal(0.0, OF_WORLD, (2, 1, 1)) + at_times[:, when]
        self.away = np.clip(away + rng.normal(0.0, OF_ROBOT, (2, *size)), NEAREST, FARTHEST)


class Deliveries(DELIVERIES.Deliveries):
    """Worlds side by side, in which all changes are counted."""

    def __init__(self, drawn: Sequence[World], copies: int, ticks: int, heads: Any) -> None:
        self.turns = np.zeros(len(drawn) * copies)
        super().__init__(drawn, copies, ticks, heads)

    def _see(
        self, rows: NDArray[np.int64], robot: NDArray[np.int64], is_b: NDArray[np.bool_]
    ) -> None:
        before = self.brought[rows, robot]
        self.turns[rows] += (before >= 0) & (before != is_b)
        super()._see(rows, robot, is_b)

    def costs(self, terms: Terms) -> NDArray[np.float64]:
        """Return what each world has cost."""
        by_deliveries: NDArray[np.float64] = super().costs(terms)
        unsettled = terms.unsettled * (self.out_last > 0)
        return by_deliveries + unsettled + terms.turns * self.turns / self.first


class DeliveryEconomy(DELIVERIES.DeliveryEconomy):
    """The model's economy of deliveries in worlds like bodies'; its parameters are `Terms`."""

    def __init__(self, parameters: Mapping[str, Any], *others: Any, **named: Any) -> None:
        known = {name: one for name, one in parameters.items() if name not in OWN}
        super().__init__(known, *others, **named)
        self.terms = Terms(**parameters)

    def run(self, genomes: ArrayLike, seeds: Sequence[int]) -> Outcome:
        """Judge individuals, each in the same worlds.

        Args:
            genomes: (individuals, `genome_size`), those of both skills one after the other.
            seeds: of the worlds, one for each repetition.

        Returns:
            The scores, and of each episode `within` and `changes` as in the model's economy.
        """
        rows = np.ascontiguousarray(genomes, np.float64)
        shape = len(rows), len(seeds)
        agents = len(rows) * len(seeds)
        if self._heads is None or len(self._heads.role) != agents:
            self._heads = DELIVERIES.Heads(
                *(Minds(one, agents=agents, own_genomes=True) for one in self.parts)
            )
        split = np.split(np.repeat(rows, len(seeds), axis=0), self._cut, axis=1)
        for minds, part, genome in zip(self._heads, self.learning, split, strict=False):
            minds.set_genome(next(iter(part.skills)), genome)
        drawn = [World(seed, self.terms, self.ticks) for seed in seeds]
        worlds = Deliveries(drawn, len(rows), self.ticks, self._heads)
        while worlds.go_on(self._heads):
            pass
        seen = {"within": worlds.out_last == 0, "changes": worlds.late_changes()}
        return Outcome(
            -worlds.costs(self.terms).reshape(shape),
            np.full(shape, self.ticks),
            np.zeros(shape, int),
            {name: values.reshape(shape) for name, values in seen.items()},
        )


class Errands:
    """Single trips with any role, to objects as far as they are in bodies, as an environment.

    What counts are pairs of an A and a B that are brought home in the time that two trips take, as
    in the model's errands.

    Raises:
        ModelError: arguments that count for nothing.
    """

    ticks = DELIVERIES.Errands.ticks

    def __init__(
        self,
        parameters: Mapping[str, Any],
        hierarchy: MindDescription,
        master: str,
        skill: str,
        drive: Any = None,
        ticks: int | None = None,
        physics: str = "compiled",
    ) -> None:
        if parameters or drive is not None or ticks is not None:
            raise ModelError("errands with parameters, a drive or ticks", "none")
        self.part = DELIVERIES.choosing(hierarchy, skill)
        self.skill = next(iter(self.part.skills.values()))
        self.genome_size = self.skill.genome_size
        self._minds: Minds | None = None

    def run(self, genomes: ArrayLike, seeds: Sequence[int]) -> Outcome:
        """Judge individuals, each with the same roles and distances.

        Args:
            genomes: (individuals, `genome_size`).
            seeds: of roles and distances, one for each repetition.
        """
        rows = np.ascontiguousarray(genomes, np.float64)
        shape, trips = (len(rows), len(seeds)), DELIVERIES.ERRANDS
        agents = len(rows) * len(seeds)
        if self._minds is None or len(self._minds) != agents:
            self._minds = Minds(self.part, agents=agents, own_genomes=True)
        self._minds.set_genome(self.skill.name, np.repeat(rows, len(seeds), axis=0))
        drawn = np.tile(np.array([errands(seed, trips) for seed in seeds]), (len(rows), 1, 1))
        took, to_b = np.zeros((2, agents))
        for role, a, b in drawn.transpose(2, 1, 0):
            fetches_b, slower = DELIVERIES.chosen(self._minds, role, a, b)
            took += slower
            to_b += fetches_b
        score = 2 * np.minimum(to_b, trips - to_b) / took
        ticks = np.full(shape, self.ticks)
        return Outcome(score.reshape(shape), ticks, np.zeros(shape, int), {})


def errands(seed: int, trips: int) -> NDArray[np.float64]:
    """Return role and distances before each trip, shape (3, trips)."""
    rng = np.random.default_rng(seed)
    return np.vstack([rng.random(trips), rng.uniform(NEAREST, FARTHEST, (2, trips))])
