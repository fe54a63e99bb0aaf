"""One search for the values that come nearest to some data: the fit's own, or a recovery's.

A search asks for groups of runs and is told what came of them; what it does next hangs on that
alone. So it is begun again from a log by telling it what the log holds.
"""

from __future__ import annotations

from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.distance import Values
from socialmind.experiments.calibration.log import Key
from socialmind.experiments.calibration.methods.registry import method_called
from socialmind.experiments.calibration.plan import DATA, FINAL, NEW, TRIAL, Plan
from socialmind.experiments.calibration.target import Target
from socialmind.experiments.calibration.trying import Tried
from socialmind.learning.lessons.keys import seed_for

Record = Mapping[str, Any]
"""A line of the log."""


@dataclass
class Group:
    """Runs at one place.

    Attributes:
        search: whose.
        kind: `DATA`, `TRIAL`, `FINAL` or `NEW`.
        number: of the trial.
        place: of the unit cube.
        values: there.
        seeds: of the runs.
        tried: what came of them, as far as they are done.
    """

    search: Search
    kind: str
    number: int
    place: NDArray[np.float64]
    values: tuple[Any, ...]
    seeds: tuple[int, ...]
    tried: dict[int, Tried] = field(default_factory=dict)

    @property
    def key(self) -> Key:
        """What the log calls it."""
        return self.search.number, self.kind, self.number

    @property
    def whole(self) -> bool:
        """Whether all its runs are done."""
        return len(self.tried) == len(self.seeds)

    def record(self) -> Record:
        """Return the line of the log, once it is whole."""
        runs = [self.tried[one] for one in range(len(self.seeds))]
        found = [one.found for one in runs if one.found is not None]
        search, kind, number = self.key
        said: dict[str, Any] = {
            "search": search,
            "kind": kind,
            "number": number,
            "place": self.place.tolist(),
            "failed": len(runs) - len(found),
            "error": next((one.error for one in runs if one.error is not None), None),
        }
        if kind in (TRIAL, FINAL):
            target, failed = self.search.target, said["failed"]
            mean = np.mean(found, axis=0) if found and not failed else None
            said["distance"] = np.inf if mean is None else target.distance(mean)
        else:
            said["runs"] = [None if one.found is None else one.found.tolist() for one in runs]
        return said


class Search:
    """A search.

    Args:
        plan: of the whole fit.
        number: 0 for the fit, from 1 on the recoveries.
        truth: the known place of a recovery; None for the fit.

    Attributes:
        target: the data; of a recovery those made with the truth, once they are.
        trials: the records of the trials, in order.
        finals: those of the finalists, the nearest trials once more.
        new: the record of the runs at the best trial on new seeds.
        problem: why there is no result.
    """

    def __init__(self, plan: Plan, number: int, truth: NDArray[np.float64] | None = None) -> None:
        self.plan, self.number, self.truth = plan, number, truth
        self.target: Target = plan.target
        self.trials: list[Record] = []
        self.finals: list[Record] = []
        self.new: Record | None = None
        self.problem: str | None = None
        seed = seed_for("method", plan.seed, number)
        self.method = method_called(plan.method)(len(plan.space.dimensions), plan.trials, seed)
        self._course = self._went()
        self._open: list[Group] = []
        self._records: dict[Key, Record] = {}

    def begin(self, known: Mapping[Key, Record]) -> list[Group]:
        """Begin, or go on with what a log holds.

        Returns:
            The groups that are to be run.

        Raises:
            SocialmindError: the log is of another fit.
        """
        self._open = next(self._course)
        return self._missing(known)

    def take(self, record: Record) -> list[Group]:
        """Take up the record of a group, and return the groups that are to be run now."""
        self._records[record["search"], record["kind"], record["number"]] = record
        return self._missing({}) if all(one.key in self._records for one in self._open) else []

    def best(self) -> Record | None:
        """Return the best trial: of the finalists the nearest, else of all; None if all failed."""
        final = _nearest(self.finals)
        return self.trials[final[0]["number"]] if final else next(iter(_nearest(self.trials)), None)

    def _missing(self, known: Mapping[Key, Record]) -> list[Group]:
        """Go on as far as what is known goes."""
        while True:
            missing = []
            for one in self._open:
                if one.key in known:
                    self._records[one.key] = _checked(known[one.key], one)
                elif one.key not in self._records:
                    missing.append(one)
            if missing:
                return missing
            try:
                self._open = self._course.send([self._records.pop(one.key) for one in self._open])
            except StopIteration:
                self._open = []
                return []

    def _went(self) -> Generator[list[Group], Sequence[Record], None]:
        """Yield groups of runs that can be made at once, and be told what came of them."""
        if self.truth is not None:
            (data,) = yield [self._group(DATA, 0, self.truth)]
            if data["failed"]:
                self.problem = f"no data could be made with the known values: {data['error']}"
                return
            rng = self.plan.draws_of(self.number, "errors")
            self.target = self.plan.target.of_data(runs_of(data), rng)
        while (left := self.plan.trials - len(self.trials)) > 0:
            asked = self.method.ask()
            points, first = asked[:left], len(self.trials)
            records = yield [self._group(TRIAL, first + n, one) for n, one in enumerate(points)]
            self.trials += records
            if len(points) == len(asked):
                self.method.tell(points, np.array([one["distance"] for one in records]))
        finalists = _nearest(self.trials)[: self.plan.finalists]
        if finalists:
            self.finals += yield [
                self._group(FINAL, one["number"], np.array(one["place"])) for one in finalists
            ]
        best = self.best()
        if best is None:
            self.problem = f"no trial came to its end: {self.trials[0]['error']}"
            return
        (self.new,) = yield [self._group(NEW, 0, np.array(best["place"]))]

    def _group(self, kind: str, number: int, place: NDArray[np.float64]) -> Group:
        seeds = self.plan.seeds_of(self.number, kind, number)
        return Group(self, kind, number, place, self.plan.space.values(place), seeds)


def _nearest(records: Sequence[Record]) -> list[Record]:
    """Return the trials that came to their end, the nearest first."""
    known = [one for one in records if np.isfinite(one["distance"])]
    return sorted(known, key=lambda one: one["distance"])


def runs_of(record: Record) -> Values:
    """Return the runs of a record that came to their end: (runs, ticks, columns)."""
    return np.array([one for one in record["runs"] if one is not None])


def _checked(record: Record, group: Group) -> Record:
    if record["place"] != group.place.tolist():
        raise SocialmindError(
            f"the log has {group.kind} {group.number} of search {group.search.number} at another "
            "place than this fit: it is of another fit, or of another version of a library; start "
            "another fit"
        )
    return record
