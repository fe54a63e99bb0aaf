"""The runs of a sweep: which point, which replicate, which seed, and when there are enough.

A run's number says all of it: `point · most + replicate`, where `most` is how many replicates a
point can have. So numbers, seeds and results hang neither on the order of work nor on workers.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, whole_number
from socialmind.errors import SocialmindError
from socialmind.experiments.measures.intervals import LEVEL, share_interval, student
from socialmind.learning.lessons.keys import seed_for

SWEEP = "sweep"
"""What these seeds are for."""
LARGEST_SEED = 2**63 - 1
"""A table's columns hold whole numbers of 64 bits with a sign."""
FEWEST = 5
"""Replicates at which the width of an interval is looked at first."""
STEP = 5
"""Replicates that are added at a point before it is looked at again."""


@dataclass(frozen=True)
class Until:
    """When a point has replicates enough: its interval of 95 % is narrow.

    Attributes:
        half_width: at most, in the measure's unit; with `relative` in hundredths of the mean.
        measure: a measure or a column of the series.
        relative: whether it is a percentage.
    """

    half_width: float
    measure: str
    relative: bool = False

    @classmethod
    def read(cls, text: str) -> Until:
        """Read `0.05:farmers` or `5%:farmers`.

        Raises:
            SocialmindError: it is neither.

        >>> Until.read("5%:farmers")
        Until(half_width=5.0, measure='farmers', relative=True)
        """
        width, _, measure = text.partition(":")
        relative = width.strip().endswith("%")
        try:
            found = float(width.strip().removesuffix("%"))
        except ValueError:
            found = math.nan
        if not measure.strip() or not is_number(found) or not found > 0:
            raise SocialmindError(
                f"--until {text}: expected HALF_WIDTH:MEASURE, as 0.05:farmers or 5%:farmers"
            )
        return cls(found, measure.strip(), relative)

    def __str__(self) -> str:
        return f"{self.half_width:g}{'%' if self.relative else ''}:{self.measure}"

    def reached(self, values: Sequence[float]) -> bool:
        """Return whether the interval of some values, Student's, is narrow enough.

        That of values that are all 0 or 1 is the one of their share, which has a width also where
        all are alike.

        >>> Until(1.0, "x").reached([3, 3, 3, 3]), Until(1.0, "x").reached([0, 10, 0, 10])
        (True, False)
        >>> Until(0.05, "settled").reached([1, 1, 1, 1, 1])
        False
        """
        count = len(values)
        if count < 2:
            return False
        mean = math.fsum(values) / count
        if set(values) <= {0, 1}:
            share = share_interval(values)
            half = (share.high - share.low) / 2
        else:
            variance = math.fsum((one - mean) ** 2 for one in values) / (count - 1)
            half = student(LEVEL, count - 1) * math.sqrt(variance / count)
        return half <= (self.half_width * abs(mean) / 100 if self.relative else self.half_width)


@dataclass(frozen=True)
class Replicates:
    """The replicates at each point.

    Attributes:
        seeds: one for each replicate that every point has.
        common: whether replicate r has the r-th seed at every point.
        until: adds replicates; None for none.
        most: replicates at a point at most.
    """

    seeds: tuple[int, ...]
    common: bool = False
    until: Until | None = None
    most: int = 0

    def __post_init__(self) -> None:
        seeds = tuple(whole_number(s, "seed", 0, LARGEST_SEED, SocialmindError) for s in self.seeds)
        if not seeds:
            raise SocialmindError("no seeds; give one at least, as --seeds 0:20")
        if len(set(seeds)) < len(seeds):
            raise SocialmindError("seeds: one stands twice; the same run would count as two")
        object.__setattr__(self, "seeds", seeds)
        if self.until is None:
            if self.most not in (0, len(seeds)):
                raise SocialmindError("--at-most is for --until; leave it out, or give both")
            object.__setattr__(self, "most", len(seeds))
            return
        if seeds != tuple(range(seeds[0], seeds[0] + len(seeds))):
            raise SocialmindError("--until adds seeds after the last; give them as a range, 0:5")
        if self.most < len(seeds):
            found = f"--at-most {self.most}" if self.most else "--until without --at-most"
            raise SocialmindError(f"{found}; expected {len(seeds)} or more, the seeds there are")
        whole_number(seeds[0] + self.most - 1, "the last seed", 0, LARGEST_SEED, SocialmindError)

    def run_of(self, point: int, replicate: int) -> int:
        """Return the number of a run."""
        return point * self.most + replicate

    def place_of(self, run: int) -> tuple[int, int]:
        """Return the point and the replicate of a run."""
        return divmod(run, self.most)

    def seed_of(self, run: int) -> int:
        """Return the seed of a run, as `socialmind run --seed` takes it."""
        point, replicate = self.place_of(run)
        given = replicate < len(self.seeds)
        seed = self.seeds[replicate] if given else self.seeds[0] + replicate
        return seed if self.common else seed_for(SWEEP, seed, point)

    def record(self) -> dict[str, Any]:
        """Return what a manifest says of them."""
        return {
            "seeds": list(self.seeds),
            "common": self.common,
            "until": None if self.until is None else str(self.until),
            "most": self.most,
        }

    @classmethod
    def of_record(cls, record: Mapping[str, Any]) -> Replicates:
        """Return the replicates that a manifest tells of."""
        until = None if record["until"] is None else Until.read(record["until"])
        return cls(tuple(record["seeds"]), record["common"], until, record["most"])


def read_seeds(text: str) -> tuple[int, ...]:
    """Read `0:50` (0 … 49), `7`, or `1,5,9`.

    Raises:
        SocialmindError: it is none of them.

    >>> read_seeds("0:3"), read_seeds("1,5")
    ((0, 1, 2), (1, 5))
    """
    try:
        begin, colon, end = text.partition(":")
        if colon:
            found = tuple(range(int(begin or 0), int(end)))
        else:
            found = tuple(int(one) for one in text.split(","))
    except (ValueError, MemoryError, OverflowError):
        found = ()
    if not found:
        raise SocialmindError(f"--seeds {shown(text)}: expected a range as 0:50, or 1,5,9")
    return found


class Waiting:
    """The runs that are still to be done, point by point, as an iterator that can grow.

    Args:
        points: how many there are.
        replicates: at each.
        known: the runs that are done already, and what the wanted measure came to; None where a
            run has no such number.
    """

    def __init__(
        self, points: int, replicates: Replicates, known: Mapping[int, float | None]
    ) -> None:
        self._replicates = replicates
        self._known = dict(known) if replicates.until else dict.fromkeys(known)
        self._coming = self._from_start(points)
        self._further: list[int] = []
        self._asked: dict[int, int] = {}
        self._open: dict[int, int] = {}
        self.total = points * len(replicates.seeds)
        if replicates.until is None:
            return
        for point in range(points):
            self._ask(point, len(replicates.seeds))
            self._look(point)

    def __iter__(self) -> Iterator[int]:
        return self

    def __next__(self) -> int:
        if self._further:
            return self._further.pop()
        return next(self._coming)

    def note(self, run: int, value: float | None) -> None:
        """Take down what came of a run; it may ask for more at its point."""
        if self._replicates.until is None:
            return
        point, _ = self._replicates.place_of(run)
        if run in self._known:
            return
        self._known[run] = value
        self._open[point] -= 1
        self._look(point)

    def _from_start(self, points: int) -> Iterator[int]:
        for point in range(points):
            for replicate in range(len(self._replicates.seeds)):
                run = self._replicates.run_of(point, replicate)
                if run not in self._known:
                    yield run

    def _look(self, point: int) -> None:
        """Ask for more replicates at a point, as long as all are there and its interval is wide."""
        while self._open[point] == 0:
            asked = self._asked[point]
            if asked >= self._replicates.most or (asked >= FEWEST and self._reached(point)):
                return
            following = FEWEST if asked < FEWEST else asked + STEP
            self._ask(point, min(following, self._replicates.most))

    def _ask(self, point: int, count: int) -> None:
        """Want so many replicates at a point."""
        before = self._asked.get(point, 0)
        self._asked[point] = count
        runs = [self._replicates.run_of(point, one) for one in range(before, count)]
        missing = [run for run in runs if run not in self._known]
        self._open[point] = len(missing)
        if before:
            self.total += len(runs)
            self._further += reversed(missing)

    def _reached(self, point: int) -> bool:
        until = self._replicates.until
        runs = (self._replicates.run_of(point, one) for one in range(self._asked[point]))
        values = [one for run in runs if (one := self._known[run]) is not None]
        return until is None or until.reached([one for one in values if math.isfinite(one)])
