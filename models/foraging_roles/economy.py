"""An economy without bodies, in which a trip is but the time that it takes.

Roles come about over thousands of trips, and learning how takes millions: too many to drive them.
Here a robot that has delivered delivers again after a time that is drawn as the bodies' trips are
long, and in between nothing happens. The market, its decay and the payoff are the model's own.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.economy import proportional_decay
from socialmind.errors import ModelError
from socialmind.learning.outcome import Outcome
from socialmind.mind import MindDescription
from socialmind.mind.minds import Minds

from .payoff import COUNTED, scarcity_of_a, worth
from .roles import ALL_A, ALL_B, RANDOM, UNDECIDED

TICKS = 60_000
DECAY = 0.0005  # of the counts in a tick, as in the model
TRIP, SPREAD = 800.0, 160.0  # ticks that a trip of the bodies takes, and the deviation
SHORTEST = 0.4  # of that, at least
ASTRAY, DETOUR = 0.03, 2.0  # the share of trips with a detour, and the longest one, in trips
UNEVEN = 0.1  # at most, the logarithm of how much longer trips for A are, and shorter those for B
NOTHING, REVERSED, REMOVED, ADDED = range(4)
"""What happens half-way: nothing, the wanted ratio is turned round, a third of the robots of one
role are taken away, or as many are added."""
NEAR = 0.5  # robots away from the wanted split that are no matter


@dataclass(frozen=True)
class Terms:
    """Which worlds there are, and what is lost in them.

    Attributes:
        numbers: of robots, of which one is drawn.
        ratios: shares of B that are wanted, likewise.
        starts: the robots' roles at the start, as in the model, likewise.
        events: what happens half-way, likewise.
        off: what is lost by all robots being away from the wanted split, all the time.
        off_late: by the same beyond `NEAR` when there was time to settle: in the second and the
            last quarter.
        out_late: by being more than one robot away then.
        change: by a change of roles for each robot and 10,000 ticks then.
        counts: by a share of B among the counts that is 1 away from the wanted one.
    """

    numbers: tuple[int, ...] = (6, 9, 9, 9, 12, 18)
    ratios: tuple[float, ...] = (1 / 3, 1 / 2, 2 / 3)
    starts: tuple[int, ...] = (ALL_A, ALL_B, UNDECIDED, RANDOM)
    events: tuple[int, ...] = (NOTHING, REVERSED, REMOVED, ADDED)
    off: float = 1.0
    off_late: float = 3.0
    out_late: float = 0.3
    change: float = 0.1
    counts: float = 0.0


class Economy:
    """Robots that deliver, are paid, and think about their roles, as a lesson's environment.

    Its arguments are those of `socialmind.learning.episodes.Episodes` after the model; parameters
    are those of `Terms`. A world is how many robots there are, their roles at the start, what is
    wanted, how long each trip takes and what happens half-way.

    Raises:
        ModelError: a skill that cannot be judged here, or arguments that count for nothing.
    """

    ticks = TICKS

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
        if drive is not None:
            raise ModelError("an economy with a drive", "none")
        self.terms = Terms(**parameters)
        self.ticks = TICKS if ticks is None else ticks
        self.mind = thinking(hierarchy, skill)
        self.genome_size = self.mind.skill(skill).genome_size
        self._minds: Minds | None = None

    def run(self, genomes: ArrayLike, seeds: Sequence[int]) -> Outcome:
        """Judge individuals, each in the same worlds.

        Args:
            genomes: (individuals, `genome_size`).
            seeds: of the worlds, one for each repetition.

        Returns:
            The scores, all below 0; and of each episode `within`, whether it stayed within one
            robot of the wanted split all through its last quarter, and `changes` of roles in the
            late parts, for each robot and 10,000 ticks.
        """
        rows = np.ascontiguousarray(genomes, np.float64)
        shape = len(rows), len(seeds)
        agents = len(rows) * len(seeds)
        if self._minds is None or len(self._minds) != agents:
            self._minds = Minds(self.mind, agents=agents, own_genomes=True)
        self._minds.set_genome(next(iter(self.mind.skills)), np.repeat(rows, len(seeds), axis=0))
        drawn = [World(seed, self.terms, self.ticks) for seed in seeds]
        worlds = Worlds(drawn, len(rows), self.ticks)
        while worlds.go_on(self._minds):
            pass
        score = -worlds.costs(self.terms)
        ticks = np.full(shape, self.ticks)
        fields = {"within": worlds.out_last == 0, "changes": worlds.late_changes()}
        fields = {name: values.reshape(shape) for name, values in fields.items()}
        return Outcome(score.reshape(shape), ticks, np.zeros(shape, int), fields)


def thinking(mind: MindDescription, skill: str) -> MindDescription:
    """Return a mind of one skill, that reads payoff and role and says what the role is to be.

    Args:
        mind: the robot's.
        skill: the skill, with the inputs `SE:PAYOFF`, `VA:ROLE` and the output `VA:ROLE`.

    Raises:
        ModelError: a skill with other inputs or outputs.
    """
    given = mind.skill(skill)
    links = [str(one) for one in given.inputs], [str(one) for one in given.outputs]
    if links != (["SE:PAYOFF", "VA:ROLE"], ["VA:ROLE"]):
        raise given.refused(
            f"with the links {links}", "the inputs SE:PAYOFF, VA:ROLE and the output VA:ROLE"
        )
    alone = given.changed(
        inputs=("SE:PAYOFF", "SE:ROLE"),
        outputs=("MO:ROLE",),
        genome=np.zeros(given.genome_size),
    )
    return MindDescription("Trader", ["PAYOFF", "ROLE"], ["ROLE"], (), [alone])


class World:
    """What a seed decides.

    Attributes:
        robots, most: how many there are at first, and at most.
        begun: each robot's role when it begins, 0 … 1.
        wanted: the share of B that is wanted at first.
        event: what happens half-way.
        removed: the role of which robots are taken away, 1 for B.
        uneven: how many times longer trips for A are, and those for B shorter.
        trips: ticks of each trip of each robot, one after the other; (most, trips).
    """

    def __init__(self, seed: int, terms: Terms, ticks: int) -> None:
        rng = np.random.default_rng(seed)
        self.robots = int(rng.choice(terms.numbers))
        self.most = self.robots + self.robots // 3
        starts = np.full(self.most, terms.starts[rng.integers(len(terms.starts))])
        starts[self.robots :] = terms.starts[rng.integers(len(terms.starts))]
        at_random = rng.random(self.most)
        self.begun = np.select(
            [starts == ALL_A, starts == ALL_B, starts == UNDECIDED, starts == RANDOM],
            [0.0, 1.0, 0.5, at_random],
        )
        self.wanted = float(rng.choice(terms.ratios))
        self.event = terms.events[rng.integers(len(terms.events))]
        self.removed = int(rng.integers(2))
        self.uneven = math.exp(rng.uniform(-UNEVEN, UNEVEN))
        size = self.most, int(ticks * math.exp(UNEVEN) / (SHORTEST * TRIP)) + 3
        self.trips = rng.normal(TRIP, SPREAD, size)
        self.trips += (rng.random(size) < ASTRAY) * rng.uniform(0.0, DETOUR * TRIP, size)
        self.trips = np.maximum(self.trips, SHORTEST * TRIP)
        self.trips[:, 0] *= rng.uniform(SHORTEST, 1.0, self.most)  # on the way already


class Worlds:
    """Many worlds side by side, each at its own time; arrays (worlds,) or (worlds, robots).

    Args:
        drawn: what is different in them.
        copies: how often there are all of these, one after another.
        ticks: how long they go on.
    """

    def __init__(self, drawn: Sequence[World], copies: int, ticks: int) -> None:
        self.which = np.tile(np.arange(len(drawn)), copies)
        most, count = max(one.most for one in drawn), len(self.which)
        self.rows = np.arange(count)
        self.limit = float(ticks)
        self.half = self.limit / 2
        self.trips = np.full((len(drawn), most, drawn[0].trips.shape[1]), np.inf)
        role = np.zeros((len(drawn), most))
        for row, one in enumerate(drawn):
            self.trips[row, : one.most] = one.trips
            role[row, : one.most] = one.begun
        self.role = role[self.which]
        self.event = np.array([one.event for one in drawn])[self.which]
        self.removed = np.array([one.removed for one in drawn])[self.which]
        self.uneven = np.array([one.uneven for one in drawn])[self.which]
        self.wanted = np.array([one.wanted for one in drawn])[self.which]
        self.first = np.array([one.robots for one in drawn])[self.which]
        self.robots = self.first.copy()
        self.here = np.arange(most) < self.first[:, None]
        self.next = np.full((count, most + 2), np.inf)  # and the event half-way, and the end
        self.next[:, :most] = np.where(self.here, self.trips[self.which, :, 0], np.inf)
        self.next[self.event != NOTHING, most] = self.half
        self.next[:, most + 1] = self.limit
        self.done = np.zeros((count, most), int)
        self.count_b = COUNTED * self.robots * self.wanted
        self.count_a = COUNTED * self.robots - self.count_b
        self.now = np.zeros(count)
        self.off, self.off_late, self.out_late, self.out_last = np.zeros((4, count))
        self.changes, self.counts = np.zeros((2, count))
        self.most = most
        self.off_now = self._off()

    def _off(self) -> NDArray[np.float64]:
        """Return how many robots each world is away from the wanted split."""
        in_b = (self.here & (self.role >= 0.5)).sum(axis=1)
        return np.abs(in_b - self.wanted * self.robots)

    def go_on(self, minds: Any) -> bool:
        """Let the next thing happen in each world; return whether there is more to come."""
        who = self.next.argmin(axis=1)
        then = self.next[self.rows, who]
        going_on = np.isfinite(then)
        self._pass(np.where(going_on, then, self.now))
        for row in np.flatnonzero(who == self.most):
            self._happen(row)
        self.next[who > self.most] = np.inf
        rows = np.flatnonzero(going_on & (who < self.most))
        if len(rows):
            self._deliver(rows, who, minds)
        return bool(np.isfinite(self.next).any())

    def _pass(self, then: NDArray[np.float64]) -> None:
        """Let time pass: costs grow, counts decay."""
        took = then - self.now
        late = self._late(then) - self._late(self.now)
        last = np.maximum(then - 0.75 * self.limit, 0) - np.maximum(self.now - 0.75 * self.limit, 0)
        out = self.off_now > 1 + 1e-9
        self.off += took * self.off_now / self.robots
        self.off_late += late * np.maximum(self.off_now - NEAR, 0) / self.robots
        self.out_late += late * out
        self.out_last += last * out
        share = self.count_b / (self.count_a + self.count_b)
        self.counts += took * np.abs(share - self.wanted)
        left = (1 - DECAY) ** took
        self.count_a = proportional_decay(self.count_a, 1 - left)
        self.count_b = proportional_decay(self.count_b, 1 - left)
        self.now = then

    def _late(self, then: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how much of the time so far was late: the second and the last quarter."""
        quarter = self.limit / 4
        return np.clip(then - quarter, 0, quarter) + np.clip(then - 3 * quarter, 0, quarter)

    def _deliver(self, rows: NDArray[np.int64], who: NDArray[np.int64], minds: Any) -> None:
        """Pay the robots that deliver, and let them think about their roles."""
        before = self.role[self.rows, np.minimum(who, self.most - 1)]
        is_b = before >= 0.5
        self.count_a[rows] += ~is_b[rows]
        self.count_b[rows] += is_b[rows]
        scarcity = scarcity_of_a(self.count_b, self.count_a, self.wanted)
        payoff = np.clip(worth(np.where(is_b, -scarcity, scarcity)), 0.0, 1.0)
        robot, role = who[rows], self.decided(rows, who, before, payoff, minds)[rows]
        self.role[rows, robot] = role
        self.done[rows, robot] += 1
        stretch = np.where(role >= 0.5, 1 / self.uneven[rows], self.uneven[rows])
        length = self.trips[self.which[rows], robot, self.done[rows, robot]]
        self.next[rows, robot] = self.now[rows] + stretch * length
        changed = rows[(role >= 0.5) != is_b[rows]]
        if len(changed):
            late = self._late(self.now + 1e-9) > self._late(self.now)
            self.changes[changed] += late[changed]
            self.off_now = self._off()

    def decided(
        self,
        rows: NDArray[np.int64],
        who: NDArray[np.int64],
        before: NDArray[np.float64],
        payoff: NDArray[np.float64],
        minds: Any,
    ) -> NDArray[np.float64]:
        """Return what roles are to be after a delivery; others decide in a way of their own.

        Args:
            rows: the worlds that count; all others' roles are for nobody.
            who: the robot of each world that has delivered, (worlds,) as all that follow.
            before: its role, 0 … 1.
            payoff: what the object was worth, 0 … 1.
            minds: what decides.
        """
        minds.set_sensor("PAYOFF", payoff)
        minds.set_sensor("ROLE", before)
        minds.step()
        role: NDArray[np.float64] = minds.actuator("ROLE")
        return role

    def _happen(self, row: int) -> None:
        """Let happen in a world what happens half-way."""
        self.next[row, self.most] = np.inf
        third = self.first[row] // 3
        if self.event[row] == REVERSED:
            self.wanted[row] = 1 - self.wanted[row]
        elif self.event[row] == REMOVED:
            is_b = self.role[row] >= 0.5
            gone = np.flatnonzero(self.here[row] & (is_b == (self.removed[row] == 1)))[:third]
            self.here[row, gone] = False
            self.next[row, gone] = np.inf
            self.robots[row] -= len(gone)
        elif self.event[row] == ADDED:
            come = np.arange(self.first[row], self.first[row] + third)
            self.here[row, come] = True
            self.next[row, come] = self.half + self.trips[self.which[row], come, 0]
            self.robots[row] += third
        self.off_now = self._off()

    def late_changes(self) -> NDArray[np.float64]:
        """Return the changes of roles when it was late, for each robot and 10,000 ticks."""
        return self.changes / self.first / (self.half / 10_000)

    def costs(self, terms: Terms) -> NDArray[np.float64]:
        """Return what each world has cost."""
        return (
            terms.off * self.off / self.limit
            + terms.off_late * self.off_late / self.half
            + terms.out_late * self.out_late / self.half
            + terms.change * self.late_changes()
            + terms.counts * self.counts / self.limit
        )
