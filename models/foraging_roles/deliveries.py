"""The economy judged from outside: what robots bring home counts, and nothing of their minds.

The thesis does not let a teacher look into a mind (7.2.1, 9.2.2). So what a robot does is told by
the kind that it brought home last, and which kind it fetches is for its CollectSelect to say, which
is learned together with ForageRole: what a ROLE means is for the robots to find.

A CollectSelect of two minds is slow here as it is in the arena, where the way is a mixture of both
(`FAINT`, `PACE`).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import ModelError
from socialmind.learning.outcome import Outcome
from socialmind.mind import MindDescription
from socialmind.mind.minds import Minds

from .economy import (
    ASTRAY,
    DETOUR,
    REMOVED,
    TICKS,
    TRIP,
    Terms,
    World,
    Worlds,
    thinking,
)
from .payoff import scarcity_of_a, worth

NEAREST, FARTHEST = 0.35, 0.45  # readings of the distance to the nearest object from the drop zone
AT_OBJECT, OTHER_SIDE = 0.02, 0.75  # and where a robot picks one up: of its kind, of the other
FAINT = (0.0, 0.1, 0.2, 0.3, 0.4, 0.9, 1.0)
"""The influence on the other Collect, as a share of that on the one that is followed."""
PACE = (1.0, 0.93, 0.83, 0.33, 0.16, 0.08, 0.06)
"""Trips of bodies in a time with such a share, beside those without; between them linear."""
CHOICE = "CollectSelect"
ERRANDS = 64  # trips on which a CollectSelect is judged in a world
USUAL = TRIP * (1 + ASTRAY * DETOUR / 2)  # ticks of a trip on the mean


@dataclass(frozen=True)
class DeliveryTerms(Terms):
    """What is lost, by deliveries: a robot is in B from when it brings a B home until an A.

    Attributes:
        missing: by objects that were not brought home, as a share of what robots that go straight
            bring.
    """

    missing: float = 1.0


class DeliveryEconomy:
    """Robots that deliver, are paid, and choose what to fetch, as a lesson's environment.

    Its arguments are those of `Economy`; parameters are those of `DeliveryTerms`. The skill that
    learns says what the role is to be; of two the second one says which Collect that means, which
    else is the CollectSelect that the mind has.

    Raises:
        ModelError: skills that cannot be judged here, or arguments that count for nothing.
    """

    ticks = TICKS

    def __init__(
        self,
        parameters: Mapping[str, Any],
        hierarchy: MindDescription,
        master: str,
        skill: str | Sequence[str],
        drive: Any = None,
        ticks: int | None = None,
        physics: str = "compiled",
    ) -> None:
        if drive is not None:
            raise ModelError("an economy with a drive", "none")
        role, *choice = (skill,) if isinstance(skill, str) else skill
        if len(choice) > 1:
            raise ModelError(f"an economy of deliveries for {skill!r}", "a role and a choice of it")
        self.terms = DeliveryTerms(**parameters)
        self.ticks = TICKS if ticks is None else ticks
        self.parts = thinking(hierarchy, role), choosing(hierarchy, *(choice or [CHOICE]))
        self.learning = self.parts[: 1 + len(choice)]
        sizes = [_only(one).genome_size for one in self.learning]
        self.genome_size = sum(sizes)
        self._cut = sizes[:-1]
        self._heads: Heads | None = None

    def run(self, genomes: ArrayLike, seeds: Sequence[int]) -> Outcome:
        """Judge individuals, each in the same worlds.

        Args:
            genomes: (individuals, `genome_size`), those of both skills one after the other.
            seeds: of the worlds, one for each repetition.

        Returns:
            The scores; and of each episode `within`, whether it stayed within one robot of the
            wanted split all through its last quarter; `changes` of what robots bring in the late
            parts, for each robot and 10,000 ticks; and `brought`, objects for each robot.
        """
        rows = np.ascontiguousarray(genomes, np.float64)
        shape = len(rows), len(seeds)
        agents = len(rows) * len(seeds)
        if self._heads is None or len(self._heads.role) != agents:
            self._heads = Heads(
                *(Minds(one, agents=agents, own_genomes=True) for one in self.parts)
            )
        split = np.split(np.repeat(rows, len(seeds), axis=0), self._cut, axis=1)
        for minds, part, genome in zip(self._heads, self.learning, split, strict=False):
            minds.set_genome(_only(part).name, genome)
        drawn = [DeliveryWorld(seed, self.terms, self.ticks) for seed in seeds]
        worlds = Deliveries(drawn, len(rows), self.ticks, self._heads)
        while worlds.go_on(self._heads):
            pass
        fields = {
            "within": worlds.out_last == 0,
            "changes": worlds.late_changes(),
            "brought": worlds.delivered / worlds.first,
        }
        fields = {name: values.reshape(shape) for name, values in fields.items()}
        score = -worlds.costs(self.terms)
        ticks = np.full(shape, self.ticks)
        return Outcome(score.reshape(shape), ticks, np.zeros(shape, int), fields)


class Heads(NamedTuple):
    """What decides in all robots.

    Attributes:
        role: says what the role is to be.
        choice: which Collect that means.
    """

    role: Minds
    choice: Minds


def _only(mind: MindDescription) -> Any:
    return next(iter(mind.skills.values()))


def choosing(mind: MindDescription, skill: str) -> MindDescription:
    """Return a mind of one skill, that reads role and distances and says what is fetched.

    Args:
        mind: the robot's.
        skill: the skill, with the inputs `VA:ROLE`, `SE:DISTOBJA`, `SE:DISTOBJB` and the outputs
            `SK:CollectA`, `SK:CollectB`.

    Raises:
        ModelError: a skill with other inputs or outputs.
    """
    given = mind.skill(skill)
    links = [str(one) for one in given.inputs], [str(one) for one in given.outputs]
    inputs, outputs = ["VA:ROLE", "SE:DISTOBJA", "SE:DISTOBJB"], ["SK:CollectA", "SK:CollectB"]
    if links != (inputs, outputs):
        raise given.refused(f"with the links {links}", f"the links {(inputs, outputs)}")
    alone = given.changed(
        inputs=("SE:ROLE", "SE:DISTOBJA", "SE:DISTOBJB"),
        outputs=("MO:A", "MO:B"),
        genome=np.zeros(given.genome_size) if given.genome is None else given.genome,
    )
    return MindDescription("Chooser", ["ROLE", "DISTOBJA", "DISTOBJB"], ["A", "B"], (), [alone])


def chosen(
    minds: Minds, role: NDArray[np.float64], a: Any, b: Any
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Return which kind robots fetch, and how many times longer it takes them than it could.

    They choose in the drop zone, and must not think otherwise where the object is.

    Args:
        minds: that say which Collect a role means.
        role: of the robots, as all that follow.
        a: how far the nearest A is, as they read it.
        b: likewise.
    """
    fetches_b, faint = said(minds, role, a, b)
    there = np.where(fetches_b, OTHER_SIDE, AT_OBJECT)
    still_b, faint_there = said(minds, role, there, OTHER_SIDE + AT_OBJECT - there)
    faint = np.where(still_b == fetches_b, np.maximum(faint, faint_there), 1.0)
    return fetches_b, 1 / np.interp(faint, FAINT, PACE)


def said(
    minds: Minds, role: NDArray[np.float64], a: Any, b: Any
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Return whether B has more influence than A, and that of the other as a share of it."""
    minds.set_sensor("ROLE", role)
    minds.set_sensor("DISTOBJA", a)
    minds.set_sensor("DISTOBJB", b)
    minds.step()
    to_a, to_b = minds.actuator("A"), minds.actuator("B")
    more, less = np.maximum(to_a, to_b), np.minimum(to_a, to_b)
    return to_b > to_a, np.divide(less, more, out=np.ones_like(more), where=more > 0)


class Errands:
    """Single trips with any role, as a lesson's environment: what a role means is to be found.

    For each trip a role is drawn; it stands for a drive module, which sets a variable before there
    is a skill that does (thesis, 5.1.3 and 7.1.2). What counts are pairs of an A and a B that
    are brought home, in the time that two trips take. Its arguments are those of `Economy`; it has
    no parameters.
    """

    ticks = ERRANDS * int(TRIP)

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
        self.part = choosing(hierarchy, skill)
        self.genome_size = _only(self.part).genome_size
        self._minds: Minds | None = None

    def run(self, genomes: ArrayLike, seeds: Sequence[int]) -> Outcome:
        """Judge individuals, each with the same roles and distances.

        Args:
            genomes: (individuals, `genome_size`).
            seeds: of roles and distances, one for each repetition.
        """
        rows = np.ascontiguousarray(genomes, np.float64)
        shape = len(rows), len(seeds)
        agents = len(rows) * len(seeds)
        if self._minds is None or len(self._minds) != agents:
            self._minds = Minds(self.part, agents=agents, own_genomes=True)
        self._minds.set_genome(_only(self.part).name, np.repeat(rows, len(seeds), axis=0))
        drawn = np.array([_errands(seed) for seed in seeds])
        drawn = np.tile(drawn, (len(rows), 1, 1))
        took, to_b = np.zeros((2, agents))
        for role, a, b in drawn.transpose(2, 1, 0):
            fetches_b, slower = chosen(self._minds, role, a, b)
            took += slower
            to_b += fetches_b
        score = 2 * np.minimum(to_b, ERRANDS - to_b) / took
        ticks = np.full(shape, self.ticks)
        return Outcome(score.reshape(shape), ticks, np.zeros(shape, int), {})


def _errands(seed: int) -> NDArray[np.float64]:
    """Return role and distances before each trip, shape (3, trips)."""
    rng = np.random.default_rng(seed)
    return np.vstack([rng.random(ERRANDS), rng.uniform(NEAREST, FARTHEST, (2, ERRANDS))])


class DeliveryWorld(World):
    """What a seed decides; the same trips as in the economy, and how far objects are.

    Attributes:
        away: readings of the distances to the nearest A and B before each trip; (2, most, trips).
    """

    def __init__(self, seed: int, terms: Terms, ticks: int) -> None:
        super().__init__(seed, terms, ticks)
        rng = np.random.default_rng([seed % 2**63, 1])
        self.away = rng.uniform(NEAREST, FARTHEST, (2, *self.trips.shape))


class Deliveries(Worlds):
    """Many worlds side by side, in which robots are known by what they bring home.

    Args:
        drawn, copies, ticks: as those of `Worlds`.
        heads: what decides in the robots.
    """

    def __init__(
        self, drawn: Sequence[DeliveryWorld], copies: int, ticks: int, heads: Heads
    ) -> None:
        most, count = max(one.most for one in drawn), len(drawn) * copies
        self.brought = np.full((count, most), -1)  # 1 for a B, 0 for an A, -1 for nothing yet
        self.delivered, self.robot_ticks = np.zeros((2, count))
        super().__init__(drawn, copies, ticks)
        self.away = np.full((len(drawn), 2, *self.trips.shape[1:]), NEAREST)
        for row, one in enumerate(drawn):
            self.away[row, :, : one.most] = one.away
        self.fetches_b = np.zeros((count, most), bool)
        self.slower = np.ones((count, most))
        for robot in range(most):
            each = np.full(count, robot)
            self.fetches_b[:, robot], self.slower[:, robot] = self._chosen(
                each, self.role[:, robot], heads
            )
        self.next[:, :most] *= self.slower

    def _off(self) -> NDArray[np.float64]:
        """Return how many robots each world is away from the wanted split, as far as is seen."""
        seen = self.here & (self.brought >= 0)
        in_b = (seen & (self.brought == 1)).sum(axis=1)
        return np.abs(in_b - self.wanted * seen.sum(axis=1))

    def _pass(self, then: NDArray[np.float64]) -> None:
        self.robot_ticks += (then - self.now) * self.robots
        super()._pass(then)

    def _chosen(
        self, robot: NDArray[np.int64], role: NDArray[np.float64], heads: Heads
    ) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
        """Return which kind a robot of each world fetches next, and how much slower it is."""
        a, b = self.away[self.which, :, robot, self.done[self.rows, robot]].T
        return chosen(heads.choice, role, a, b)

    def _deliver(self, rows: NDArray[np.int64], who: NDArray[np.int64], minds: Any) -> None:
        """Pay the robots that deliver, and let them choose what to fetch next."""
        every = np.minimum(who, self.most - 1)
        is_b = self.fetches_b[self.rows, every]
        self.count_a[rows] += ~is_b[rows]
        self.count_b[rows] += is_b[rows]
        scarcity = scarcity_of_a(self.count_b, self.count_a, self.wanted)
        payoff = np.clip(worth(np.where(is_b, -scarcity, scarcity)), 0.0, 1.0)
        role = self.decided(rows, who, self.role[self.rows, every], payoff, minds.role)
        robot = who[rows]
        self.role[rows, robot] = role[rows]
        self.done[rows, robot] += 1
        fetches_b, slower = self._chosen(every, role, minds)
        self.fetches_b[rows, robot] = fetches_b[rows]
        stretch = np.where(fetches_b, 1 / self.uneven, self.uneven) * slower
        length = self.trips[self.which[rows], robot, self.done[rows, robot]]
        self.next[rows, robot] = self.now[rows] + stretch[rows] * length
        self._see(rows, robot, is_b[rows])

    def _see(
        self, rows: NDArray[np.int64], robot: NDArray[np.int64], is_b: NDArray[np.bool_]
    ) -> None:
        """Note what robots have brought."""
        before = self.brought[rows, robot]
        self.brought[rows, robot] = is_b
        self.delivered[rows] += 1
        other = before != is_b
        if other.any():
            changed = rows[other & (before >= 0)]
            late = self._late(self.now + 1e-9) > self._late(self.now)
            self.changes[changed] += late[changed]
            self.off_now = self._off()

    def _happen(self, row: int) -> None:
        """Let happen in a world what happens half-way; who fetches what is taken for its role."""
        if self.event[row] == REMOVED:
            role = self.role[row].copy()
            self.role[row] = self.fetches_b[row]
            super()._happen(row)
            self.role[row] = role
        else:
            super()._happen(row)
            come = slice(self.first[row], self.robots[row])
            on_the_way = self.next[row, come] - self.half
            self.next[row, come] = self.half + on_the_way * self.slower[row, come]

    def costs(self, terms: Terms) -> NDArray[np.float64]:
        """Return what each world has cost."""
        missing = 1 - self.delivered * USUAL / self.robot_ticks
        by_split: NDArray[np.float64] = super().costs(terms)
        return by_split + terms.missing * missing  # type: ignore[attr-defined]
