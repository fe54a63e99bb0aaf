"""Three kinds of object in place of two: the scheme and thresholds, in the economy without bodies.

python -m analysis.foraging_roles.three_kinds [--quick]

What an object is worth is the model's own, for any number of kinds:
0.5 + 0.15 (w − s) / (w (1 − w)), w being the share that is wanted of a kind and s its share of the
counts. In the scheme plenty of a
kind opens the plans of all others; a robot with thresholds hears the call of each other kind as
loud as its own object's worth is low, and looks at them in a random order. Neither is fitted anew.

The learned minds are not here: their ROLE is one number that means A or B, by which half it is in,
and the worth of the last object, which ForageRole reads, does not say which other is scarce.

A row of `results/three_kinds.csv` is a way, a ratio, a number of robots, what happens half-way, and
a world for reporting; `results/three_kinds.md` has the means.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.catalogue import load_file

from .luck import BEGUN, DECIDED, Luck
from .results import NINE
from .scheme_economy import DECIDING, WRITTEN
from .threshold_scan import CONTROLLERS, RULES
from .told_intervals import in_brackets
from .trainings import ECONOMY, MODEL
from .worlds import SCHEME_ECONOMY

PAYOFF = load_file(MODEL / "payoff.py")
RESULTS = Path(__file__).parent / "results"
WORLDS, FEW = 32, 2
NOTHING, TURNED = "nothing", "ratio turned round"
SETTINGS = (
    ("1:2", 9), ("1:1:1", 9), ("2:3:4", 9), ("1:2:3", 12), ("1:2:3", 36),
)  # fmt: skip
OF = 9  # robots, to which distances are scaled
KEYS = ["way", "ratio", "robots", "event"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def shares_of(ratio: str) -> Floats:
    """Return the wanted shares of a ratio.

    >>> shares_of("1:1:2").tolist()
    [0.25, 0.25, 0.5]
    """
    parts = np.array([float(one) for one in ratio.split(":")])
    return np.asarray(parts / parts.sum())


class Kinds(ECONOMY.Worlds):
    """Worlds with objects of several kinds; a robot's role is the number of one.

    Args:
        drawn: what is different in them.
        seeds: of the first roles and of decisions, one for each of `drawn`.
        ticks: how long they go on.
        wanted: the shares that are wanted, (kinds,); turned round where worlds say so.
        way: how robots decide.
    """

    def __init__(
        self, drawn: Sequence[Any], seeds: Sequence[int], ticks: int, wanted: Floats, way: Way
    ) -> None:
        self.kinds = len(wanted)
        self.luck = Luck(seeds, DECIDED)
        most, count = max(one.most for one in drawn), len(drawn)
        begun = Luck(seeds, BEGUN).draw(range(count), most, 1 + self.kinds)
        self.fetches, self.begun = (self.kinds * begun[..., 0]).astype(int), begun[..., 1:]
        self.shares = np.tile(wanted, (count, 1))
        self.at_first = self.shares.copy()
        super().__init__(drawn, 1, ticks)
        self.held = PAYOFF.COUNTED * self.robots[:, None] * self.shares
        self.state = way.begin(self)
        self.way = way
        self.off_last = np.zeros(count)

    def _off(self) -> Floats:
        """Return how many robots would have to change for the wanted split, in each world."""
        kinds = np.arange(self.kinds)
        there = (self.here[:, :, None] & (self.fetches[:, :, None] == kinds)).sum(axis=1)
        return np.asarray(np.abs(there - self.shares * self.robots[:, None]).sum(axis=1) / 2)

    def _pass(self, then: Floats) -> None:
        took, since = then - self.now, 0.75 * self.limit
        self.off_last += self.off_now * (np.maximum(then, since) - np.maximum(self.now, since))
        self.held *= ((1 - ECONOMY.DECAY) ** took)[:, None]
        super()._pass(then)

    def _deliver(self, rows: Ints, who: Ints, minds: Any) -> None:
        """Pay the robots that deliver, and let them decide what to fetch next."""
        robot = who[rows]
        kind = self.fetches[rows, robot]
        self.held[rows, kind] += 1
        share = self.held[rows, kind] / self.held[rows].sum(axis=1)
        wanted = self.shares[rows, kind]
        payoff = PAYOFF.worth((wanted - share) / (wanted * (1 - wanted)))
        after = self.way.decide(self, rows, robot, kind, np.clip(payoff, 0.0, 1.0))
        self.fetches[rows, robot] = after
        self.done[rows, robot] += 1
        # As with two: trips for the first kind are longer and those for the last one shorter.
        stretch = self.uneven[rows] ** np.linspace(1, -1, self.kinds)[after]
        length = self.trips[self.which[rows], robot, self.done[rows, robot]]
        self.next[rows, robot] = self.now[rows] + stretch * length
        changed = rows[after != kind]
        if len(changed):
            late = self._late(self.now + 1e-9) > self._late(self.now)
            self.changes[changed] += late[changed]
            self.off_now = self._off()

    def _happen(self, row: int) -> None:
        """Turn the wanted ratio round."""
        self.next[row, self.most] = np.inf
        self.shares[row] = self.shares[row, ::-1]
        self.off_now = self._off()


# Ways to decide -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Way:
    """How robots decide.

    Attributes:
        begin: returns what robots keep, of the worlds.
        decide: returns what robots fetch next, of worlds, rows, robots, kinds and payoffs.
    """

    begin: Callable[[Kinds], Any]
    decide: Callable[[Kinds, Ints, Ints, Ints, Floats], Ints]


def another(worlds: Kinds, rows: Ints, kind: Ints) -> Ints:
    """Return kinds other than those given, drawn evenly."""
    further = 1 + ((worlds.kinds - 1) * worlds.luck.draw(rows)).astype(int)
    return (kind + further) % worlds.kinds


def callings(worlds: Kinds) -> Floats:
    """Return the callings that robots begin with."""
    return np.full(worlds.fetches.shape, DECIDING.FIRST_CALLING)


def by_scheme(worlds: Kinds, rows: Ints, robot: Ints, kind: Ints, payoff: Floats) -> Ints:
    """Decide by the scheme, with the numbers as written, plenty opening all other plans."""
    calling = worlds.state[rows, robot] * DECIDING.CALLING_FACTOR
    calling += DECIDING.PERCENT * payoff * WRITTEN["reinforcement_a"]
    lack = DECIDING.PERCENT * (DECIDING.AS_IT_SHOULD_BE - payoff)
    own, other = WRITTEN["calling_a"] * calling, WRITTEN["plenty_of_a"] * np.maximum(lack, 0.0)
    offset = np.maximum(1.0 - np.minimum(own, other), 0.0)  # as `weight_shares` has it
    others = (worlds.kinds - 1) * (other + offset)
    chance = np.where(lack > WRITTEN["tolerance"], others / (own + offset + others), 0.0)
    changed = worlds.luck.draw(rows) < chance
    worlds.state[rows, robot] = np.where(changed, DECIDING.FIRST_CALLING, calling)
    return np.where(changed, another(worlds, rows, kind), kind)


def thresholds(given: Mapping[str, float]) -> Way:
    """Return the way of thresholds with the parameters of `ForagingByThresholds`."""
    low, high = given["lowest_threshold"], given["highest_threshold"]

    def begin(worlds: Kinds) -> Floats:
        middle, span = (low + high) / 2, (high - low) * given["variety"]
        return np.asarray(middle + (worlds.begun - 0.5) * span)

    def decide(worlds: Kinds, rows: Ints, robot: Ints, kind: Ints, payoff: Floats) -> Ints:
        held = worlds.state[rows, robot]
        own = np.arange(worlds.kinds) == kind[:, None]
        change = np.where(own, -given["learning"], given["forgetting"])
        held = worlds.state[rows, robot] = np.clip(held + change, low, high)
        stimulus = np.maximum(0.0, DECIDING.AS_IT_SHOULD_BE - payoff)[:, None]
        drawn = worlds.luck.draw(rows, 2, worlds.kinds)
        hears = drawn[:, 0] < RULES.response(stimulus, held)
        order = np.where(hears & ~own, drawn[:, 1], np.inf)
        return np.where(np.isfinite(order).any(axis=1), order.argmin(axis=1), kind)

    return Way(begin, decide)


def at_random(worlds: Kinds, rows: Ints, robot: Ints, kind: Ints, payoff: Floats) -> Ints:
    """Draw the next kind by the shares that were wanted at first."""
    cumulative = worlds.at_first[rows].cumsum(axis=1)
    return np.asarray((worlds.luck.draw(rows)[:, None] > cumulative).sum(axis=1))


def greedily(worlds: Kinds, rows: Ints, robot: Ints, kind: Ints, payoff: Floats) -> Ints:
    """Take another kind wherever the payoff lacks anything."""
    return np.where(payoff < DECIDING.AS_IT_SHOULD_BE, another(worlds, rows, kind), kind)


WAYS: Mapping[str, Way] = {
    "programmed": Way(callings, by_scheme),
    **{name: thresholds(given) for name, given in CONTROLLERS.items()},
    "random roles": Way(lambda worlds: None, at_random),
    "greedy": Way(lambda worlds: None, greedily),
}


# The study ----------------------------------------------------------------------------------------


def judged(
    way: str, ratio: str, robots: int, event: str, worlds: Sequence[int], ticks: int = ECONOMY.TICKS
) -> pd.DataFrame:
    """Return what robots come to, a row for each world."""
    happens = ECONOMY.REVERSED if event == TURNED else ECONOMY.NOTHING
    terms = ECONOMY.Terms(**{**NINE, "numbers": (robots,), "events": (happens,)})
    drawn = [ECONOMY.World(seed, terms, ticks) for seed in worlds]
    found = Kinds(drawn, worlds, ticks, shares_of(ratio), WAYS[way])
    while found.go_on(None):
        pass
    keys = dict(zip(KEYS, (way, ratio, robots, event), strict=True))
    return pd.DataFrame(
        {
            "world": list(worlds),
            "within_one": (found.out_last == 0).astype(int),
            "off": OF * found.off_last / (0.25 * ticks) / robots,
            "changes": found.late_changes(),
        }
    ).assign(attempt=0, **keys)[[*KEYS, "attempt", "world", "within_one", "off", "changes"]]


def settings() -> Iterator[tuple[str, str, int, str]]:
    """Yield all ways and settings; an even ratio is not turned round."""
    for ratio, robots in SETTINGS:
        events = (NOTHING,) if len(set(ratio.split(":"))) == 1 else (NOTHING, TURNED)
        for event in events:
            for way in WAYS:
                yield way, ratio, robots, event


def report(table: pd.DataFrame) -> str:
    """Return the means with intervals as Markdown."""
    lines = [
        "| ratio | robots | half-way | way | within one | off, of nine | changes |",
        "|---" * 7 + "|",
    ]
    for (ratio, robots, event, way), part in table.groupby(
        ["ratio", "robots", "event", "way"], sort=False
    ):
        cells = [
            in_brackets(part, name, form)
            for name, form in (("within_one", ".0%"), ("off", ".2f"), ("changes", ".2f"))
        ]
        lines.append(f"| {ratio} | {robots} | {event} | {way} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def main(arguments: Sequence[str]) -> None:
    """Judge all, keep what comes of it and print it."""
    quick = "--quick" in arguments
    worlds = SCHEME_ECONOMY[: FEW if quick else WORLDS]
    ticks = 8000 if quick else ECONOMY.TICKS
    table = pd.concat([judged(*one, worlds, ticks) for one in settings()], ignore_index=True)
    if quick:
        print(report(table))
        return
    path = RESULTS / "three_kinds.csv"
    table.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
    text = report(pd.read_csv(path))  # with the digits that are kept
    (RESULTS / "three_kinds.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main(sys.argv[1:])
