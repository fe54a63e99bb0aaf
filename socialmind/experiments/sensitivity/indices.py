"""The sensitivity of a sweep's outputs: by the design's own indices, or by regression."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, whole_number
from socialmind.errors import SocialmindError
from socialmind.experiments.measures.intervals import LEVEL
from socialmind.experiments.sensitivity import effects, regression, variance
from socialmind.experiments.sensitivity.luck import Luck, luck_of
from socialmind.experiments.sensitivity.resampling import FEW
from socialmind.experiments.sensitivity.responses import Response, Swept, read_responses
from socialmind.experiments.sensitivity.variance import Rows
from socialmind.experiments.sweeps.replicates import LARGEST_SEED
from socialmind.experiments.sweeps.result import Sweep

SOBOL, MORRIS, FAST, REGRESSION = "sobol", "morris", "fast", "regression"
METHODS = {"saltelli": SOBOL, "morris": MORRIS, "fast": FAST}
"""The method of each design that is made for one."""
MAIN = {
    SOBOL: variance.TOTAL,
    FAST: variance.TOTAL,
    MORRIS: effects.MU_STAR,
    REGRESSION: regression.SRC,
}
"""The index that parameters are ordered by."""


@dataclass(frozen=True)
class Sensitivity:
    """What the outputs of a sweep depend on.

    Attributes:
        method: `sobol`, `morris`, `fast` or `regression`.
        design: as the manifest names it.
        parameters: what varies, in the order of the design.
        ranges: of these, for a design that samples.
        outputs: those that have indices.
        table: a row for each output, index and parameter: `output`, `index`, `parameter`, `other`
            (of a pair; empty else), `value`, `low`, `high`.
        luck: a row for each output: `output`, `points`, `runs`, `mean`, `deviation` (of the points'
            means), `variance_of_luck` (between runs of one point), `luck_of_a_run`,
            `luck_of_means` (shares of a variance), the three with `_low` and `_high`, and `floor`:
            the total index, or mu*, that a parameter without any effect has by luck alone. NaN
            where points have one run each.
        level: of the intervals.
        seed: of the draws behind them.
        notes: what a reader has to know of this sweep.
    """

    method: str
    design: str
    parameters: tuple[str, ...]
    ranges: Mapping[str, tuple[float, float]]
    outputs: tuple[str, ...]
    table: pd.DataFrame
    luck: pd.DataFrame
    level: float
    seed: int
    notes: tuple[str, ...]

    def of(self, output: str, index: str) -> pd.DataFrame:
        """Return the rows of one output and index, in the order of the design."""
        table = self.table
        rows = table[(table["output"] == output) & (table["index"] == index)]
        return rows.reset_index(drop=True)

    def ordered(self, output: str) -> list[str]:
        """Return the parameters by what they do to an output, the most first."""
        rows = self.of(output, MAIN[self.method])
        size = rows["value"].abs().fillna(-1.0)
        return rows["parameter"].iloc[np.argsort(-size.to_numpy(), kind="stable")].tolist()


def sensitivity_of(
    sweep: Sweep | str | Path,
    of: Sequence[str] | None = None,
    level: float = LEVEL,
    seed: int = 0,
    regress: bool = False,
) -> Sensitivity:
    """Return what the outputs of a sweep depend on, by the method that its design is made for.

    `saltelli` gives Sobol indices of first, total and second order (Saltelli et al., 2010, Computer
    Physics Communications 181: 259–270), `morris` elementary effects (Morris, 1991, Technometrics
    33: 161–174), `fast` indices of first and total order (Saltelli et al., 1999, Technometrics 41:
    39–56), all others coefficients of regression, and rank correlations. They are of the mean over
    the runs of a point.

    >>> from socialmind.experiments import sensitivity_of              # doctest: +SKIP
    >>> found = sensitivity_of("sweeps/farmer_artisan-001")            # doctest: +SKIP
    >>> found.of("settled", "total")[["parameter", "value", "low", "high"]]   # doctest: +SKIP

    Args:
        sweep: or its folder.
        of: outputs, as `runs.parquet` calls them; by default all measures, or where there are none,
            all ends of the series.
        level: of the intervals, above 0 and below 1.
        seed: of the draws behind the intervals, 0 or more.
        regress: whether to take regression and rank correlation whatever the design.

    Raises:
        SocialmindError: no sweep's folder; an output that there is not, or that is the same in all
            runs; runs that the design cannot do without; points that are not the design's.
    """
    if not is_number(level) or not 0 < level < 1:
        raise SocialmindError(f"level: found {shown(level)}; expected a number between 0 and 1")
    whole_number(seed, "seed", 0, LARGEST_SEED, SocialmindError)
    swept = read_responses(sweep, of)
    name = str(swept.made["name"])
    method = REGRESSION if regress else METHODS.get(name, REGRESSION)
    notes: list[str] = []
    varying = _varying(swept, notes)
    if method == REGRESSION:
        analysis: _Designed | _Regression = _Regression(swept, level, seed)
    else:
        varying = _whole(swept, varying, name, notes)
        analysis = (_Morris if method == MORRIS else _Variance)(swept, level, seed)
    rows, luck = [], []
    for output in varying:
        found, told = analysis.of(output)
        rows += [(output.name, *one[:3], *one[3].tolist()) for one in found]
        luck.append(told)
    columns = ["output", "index", "parameter", "other", "value", "low", "high"]
    told_luck = pd.DataFrame(luck)
    if name == "sobol":
        notes.append("sobol is the sequence that fills a space; Sobol indices need saltelli.")
    notes += [*analysis.notes, *_about_runs(swept, varying, told_luck)]
    return Sensitivity(
        method,
        name,
        tuple(map(str, swept.points.columns)),
        sampled_ranges(swept.made),
        tuple(output.name for output in varying),
        pd.DataFrame(rows, columns=columns),
        told_luck,
        level,
        seed,
        tuple(dict.fromkeys(notes)),
    )


def sampled_ranges(made: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Return the ranges that a design was sampled in; nothing where it says none.

    A design's word is whatever stood in its data frame's `attrs`.

    >>> sampled_ranges({"name": "lhs", "ranges": {"a": [0.0, 1.0]}})
    {'a': (0.0, 1.0)}
    >>> sampled_ranges({"name": "lhs", "ranges": {"a": "wide"}})
    {}
    """
    found = {}
    ranges = made.get("ranges")
    for name, bounds in ranges.items() if isinstance(ranges, Mapping) else ():
        good = isinstance(bounds, Sequence) and len(bounds) == 2 and all(map(is_number, bounds))
        if not good or not bounds[0] < bounds[1]:
            return {}
        found[str(name)] = float(bounds[0]), float(bounds[1])
    return found


class _Designed(ABC):
    """A method that needs the points of its own design.

    Args:
        swept: the sweep.
        level: of the intervals.
        seed: of the draws.
    """

    size = 1
    """Points of a unit of the design."""

    def __init__(self, swept: Swept, level: float, seed: int) -> None:
        self._swept, self._level, self._seed = swept, level, seed
        self.notes: list[str] = []

    def of(self, output: Response) -> tuple[Rows, dict[str, Any]]:
        """Return the indices of an output, and what there is to say of its luck."""
        luck = luck_of(output, self.size, self._level, self._seed)
        rows = self._indices(output.means)
        return rows, _told(output, luck, self._floor(luck, float(output.means.var(ddof=1))))

    @abstractmethod
    def _indices(self, means: NDArray[np.float64]) -> Rows:
        """Return the indices of an output by its means at the points."""

    def _floor(self, luck: Luck, spread: float) -> float:
        """Return what a parameter without any effect has by luck, of a variance of the means."""
        return np.nan

    def _sampled(self) -> NDArray[np.float64]:
        """Return the points in the order of the design's ranges; refuses other columns."""
        points = self._swept.points
        self.ranges = sampled_ranges(self._swept.made)
        numbers = [pd.api.types.is_numeric_dtype(kind) for kind in points.dtypes]
        if sorted(self.ranges) != sorted(points.columns) or not all(numbers):
            raise _not_the_design(self._swept)
        self.names = list(self.ranges)
        return points[self.names].to_numpy(np.float64)


class _Variance(_Designed):
    """Sobol indices of Saltelli's design, and FAST."""

    def __init__(self, swept: Swept, level: float, seed: int) -> None:
        super().__init__(swept, level, seed)
        points = self._sampled()
        if swept.made["name"] == "saltelli":
            good, self.size = variance.is_saltelli(points), 2 * len(self.names) + 2
            self._of = variance.sobol_indices
        else:
            good, self._of = variance.is_fast(points, swept.made), variance.fast_indices
        if not good:
            raise _not_the_design(swept)
        if swept.made["name"] == "saltelli":
            _refuse_few(swept, len(points) // self.size, 8, "blocks")
            _note_few(self.notes, len(points) // self.size, "blocks")

    def _indices(self, means: NDArray[np.float64]) -> Rows:
        return self._of(means, self.names, self._level, self._seed)

    def _floor(self, luck: Luck, spread: float) -> float:
        return float(luck.of_means[0])


class _Morris(_Designed):
    """Elementary effects."""

    def __init__(self, swept: Swept, level: float, seed: int) -> None:
        super().__init__(swept, level, seed)
        points = self._sampled()
        steps = effects.steps_of(points, list(self.ranges.values()))
        if steps is None:
            raise _not_the_design(swept)
        _refuse_few(swept, len(steps), 4, "trajectories")
        self._steps, self.size = steps, len(self.names) + 1
        _note_few(self.notes, len(steps), "trajectories")

    def _indices(self, means: NDArray[np.float64]) -> Rows:
        return effects.morris_indices(means, self._steps, self.names, self._level, self._seed)

    def _floor(self, luck: Luck, spread: float) -> float:
        return effects.effect_of_luck(luck.error_of_means(spread), self._steps)


class _Regression:
    """Coefficients and correlations of any points; arguments as of `_Designed`."""

    def __init__(self, swept: Swept, level: float, seed: int) -> None:
        self._swept, self._level, self._seed = swept, level, seed
        self.notes: list[str] = []

    def of(self, output: Response) -> tuple[Rows, dict[str, Any]]:
        """Return the indices of an output at the points that have a number of it."""
        swept = self._swept
        lacking = swept.lacking(output)
        if lacking:
            self.notes.append(f"{lacking}. They are left out.")
        known = output.counts > 0
        there = output.at(known)
        found = regression.regressors(swept.points[known].reset_index(drop=True))
        columns, count = found.matrix.shape[1], int(known.sum())
        if not columns:
            raise SocialmindError(f"{swept.folder}: nothing varies between its points")
        if count < columns + 3:
            raise SocialmindError(
                f"{swept.folder}: {count} points with a value of {output.name} for a line through "
                f"{columns} column{'s' * (columns > 1)}; expected {columns + 3} at least, and many "
                "more for narrow intervals"
            )
        self.notes += found.notes
        together = regression.correlated(found)
        self.notes += [together] if together else []
        _note_few(self.notes, count, "points")
        rows = regression.regression_indices(there.means, found, self._level, self._seed)
        return rows, _told(there, luck_of(there, 1, self._level, self._seed), np.nan)


def _varying(swept: Swept, notes: list[str]) -> list[Response]:
    """Return the outputs that differ between points; refuses what was asked for and does not."""
    constant = [one for one in swept.outputs if one.constant]
    varying = [one for one in swept.outputs if not one.constant]
    said = [f"{one.name} is {np.nanmean(one.means):g}" for one in constant]
    if constant and (swept.asked or not varying):
        raise SocialmindError(
            f"{swept.folder}: {', '.join(said)} at all points: it depends on nothing that varies"
        )
    if constant:
        notes.append(f"{', '.join(said)} at all points, which depends on nothing: left out.")
    return varying


def _whole(
    swept: Swept, outputs: Sequence[Response], design: str, notes: list[str]
) -> list[Response]:
    """Return the outputs that have a value at every point; refuses what was asked for and has not.

    Raises:
        SocialmindError: none has.
    """
    holes = {one.name: lacking for one in outputs if (lacking := swept.lacking(one))}
    if holes and (swept.asked or len(holes) == len(outputs)):
        remedy = f"go on with {swept.resumed}, or " if swept.unfinished else ""
        raise SocialmindError(
            f"{swept.folder}: {design} needs a value at every point, and "
            f"{next(iter(holes.values()))}; {remedy}take what regression tells of the other "
            "points: --regression"
        )
    notes += [f"{lacking}, and {design} needs all: left out." for lacking in holes.values()]
    return [one for one in outputs if one.name not in holes]


def _not_the_design(swept: Swept) -> SocialmindError:
    name = swept.made["name"]
    return SocialmindError(
        f"{swept.folder}: its manifest says {name}, but its points are not those that {name} makes "
        "in their order (rows or columns were moved, changed, left out or added); sweep over the "
        "design as it is made, or take what regression tells: --regression"
    )


def _refuse_few(swept: Swept, units: int, fewest: int, what: str) -> None:
    """Refuse a design of so few units that drawing them anew tells nothing of others."""
    if units < fewest:
        name = swept.made["name"]
        raise SocialmindError(
            f"{swept.folder}: {what} of the design: found {units}; expected {fewest} or more, else "
            f"intervals tell nothing; sweep with --sample {name}:{4 * fewest}, or more"
        )


def _note_few(notes: list[str], units: int, what: str) -> None:
    if units < FEW:
        notes.append(f"{units} {what} alone: the intervals are rough, {FEW} or more would do.")


def _about_runs(swept: Swept, outputs: Sequence[Response], luck: pd.DataFrame) -> list[str]:
    """Return what is to be said of runs that are missing, of luck and of common seeds."""
    notes = []
    for one in outputs:
        most = int(one.counts.max())
        fewer = int(((one.counts < most) & (one.counts > 0)).sum())
        if fewer and swept.unfinished:
            unfinished = ", ".join(f"{n:,} {what}" for what, n in swept.unfinished.items())
            notes.append(
                f"{fewer:,} points have fewer runs than others (runs that did not finish: "
                f"{unfinished}); their means are of those that there are."
            )
    if luck["luck_of_a_run"].isna().any():
        notes.append(
            "Points have one run each, so nobody knows how much is luck: it looks like "
            "interactions of all parameters. Sweep with --seeds 0:5, or more."
        )
    elif outputs and outputs[0].common:
        notes.append(
            "All points share their seeds (--common): the intervals hold for these seeds, and say "
            "nothing of others."
        )
    return notes


def _told(output: Response, luck: Luck, floor: float) -> dict[str, Any]:
    """Return the row of an output in the table of luck."""
    row: dict[str, Any] = {
        "output": output.name,
        "points": len(output.means),
        "runs": int(output.counts.sum()),
        "mean": float(output.means.mean()),
        "deviation": float(output.means.std(ddof=1)),
    }
    for name, one in (
        ("variance_of_luck", luck.variance),
        ("luck_of_a_run", luck.of_a_run),
        ("luck_of_means", luck.of_means),
    ):
        row |= {name: one[0], f"{name}_low": one[1], f"{name}_high": one[2]}
    return row | {"floor": floor}
