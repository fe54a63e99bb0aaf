"""Sweeps side by side at the points that they share, and how they differ, with intervals."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from socialmind.errors import SocialmindError
from socialmind.experiments.figures.design import Design, design_of
from socialmind.experiments.figures.estimates import Estimates, Summary, difference, estimates
from socialmind.experiments.figures.of_sweeps import outcomes_of
from socialmind.experiments.measures.intervals import LEVEL
from socialmind.experiments.sweeps.columns import POINT, SEED, STATUS, Names
from socialmind.experiments.sweeps.result import Sweep
from socialmind.runs.folders import FINISHED

COMPARED = "sweep"
"""The column that says which sweep a row is of."""


@dataclass(frozen=True)
class SweepsCompared:
    """Sweeps side by side.

    Attributes:
        table: a row for each outcome, sweep and point that all share: `outcome`, `sweep`, what
            varies, `runs`, `mean`, `low`, `high`, and of the difference from the first sweep
            `difference`, `difference_low`, `difference_high` and `paired`, whether it is of pairs
            of runs with the same seed; bounds are NaN where there is one run.
        sweeps: their names, the reference first.
        outcomes: what is compared.
        design: the points that all have, and what varies among them.
        by: what varies in any of them.
        level: of the intervals.
        notes: what else tells the sweeps apart, and what could not be compared.
    """

    table: pd.DataFrame
    sweeps: tuple[str, ...]
    outcomes: tuple[str, ...]
    design: Design
    by: tuple[str, ...]
    level: float
    notes: tuple[str, ...]

    @property
    def paired(self) -> str:
        """How differences were taken, in words."""
        kinds = set(self.table.loc[self.table[COMPARED] != self.sweeps[0], "paired"])
        if len(kinds) > 1:
            return "in pairs of equal seeds where there are some"
        return "in pairs of equal seeds" if kinds == {True} else "of all runs"

    def means(self, outcome: str) -> Estimates:
        """Return the means of an outcome, by what varies and `sweep`."""
        own = self.table[self.table["outcome"] == outcome]
        own = own.rename(columns={"mean": "middle"})[
            [*self.by, COMPARED, "runs", "middle", "low", "high"]
        ]
        return Estimates(own, (*self.by, COMPARED), outcome, Summary("mean", self.level))

    def differences(self, outcome: str, reference: bool = False) -> Estimates:
        """Return how far the other sweeps are from the first, likewise.

        Args:
            outcome: one that is compared.
            reference: whether the first is there as well, which is no way from itself.
        """
        own = self.table[(self.table["outcome"] == outcome)].drop(columns=["low", "high"])
        own = own if reference else own[own[COMPARED] != self.sweeps[0]]
        renamed = {"difference": "middle", "difference_low": "low", "difference_high": "high"}
        own = own.rename(columns=renamed)[[*self.by, COMPARED, "runs", "middle", "low", "high"]]
        return Estimates(own, (*self.by, COMPARED), outcome, Summary("mean", self.level))


def compare_sweeps(
    sweeps: Mapping[str, Sweep], outcomes: Sequence[str] = (), level: float = LEVEL
) -> SweepsCompared:
    """Compare sweeps with the first of them, at the points that all have.

    At a point where two sweeps have the same seeds, as sweeps of one design and the same `--seeds`
    do, the difference is of pairs.

    Args:
        sweeps: by name; the first is the reference.
        outcomes: measures, or ends of series; all measures that they share by default, or else the
            first ends of series.
        level: of the intervals.

    Raises:
        SocialmindError: fewer than two, designs that vary other things, no point that all have, or
            no outcome that all have.
    """
    if len(sweeps) < 2:
        raise SocialmindError("one sweep alone; give another to compare it with")
    first, *others = sweeps
    by = _varied(sweeps[first])
    for name in others:
        _refuse_other_columns(first, by, name, _varied(sweeps[name]))
    if COMPARED in by:
        raise SocialmindError(f"a parameter called {COMPARED} varies, as the table calls sweeps")
    points = _shared(sweeps, by)
    wanted = _outcomes(sweeps, outcomes)
    runs = {name: _at_points(one, points, by) for name, one in sweeps.items()}
    rows = [
        row
        for outcome in wanted
        for name in sweeps
        for row in _rows(outcome, name, first, runs, by, level)
    ]
    columns = [
        "outcome", COMPARED, *by, "runs", "mean", "low", "high", "difference", "difference_low",
        "difference_high", "paired",
    ]  # fmt: skip
    return SweepsCompared(
        pd.DataFrame(rows, columns=columns),
        tuple(sweeps),
        tuple(wanted),
        design_of(points, by),
        tuple(by),
        level,
        tuple(_notes(sweeps, points)),
    )


def named(folders: Sequence[Path]) -> dict[str, Sweep]:
    """Return sweeps by the names of their folders, by their paths where two are called alike."""
    short = [one.absolute().name for one in folders]
    full = short if len(set(short)) == len(short) else [str(one) for one in folders]
    if len(set(full)) < len(full):
        raise SocialmindError(f"{folders[0]}: stands twice; expected different sweeps")
    return {name: Sweep(one) for name, one in zip(full, folders, strict=True)}


def _varied(sweep: Sweep) -> list[str]:
    names = Names(tuple(sweep.varied), tuple(sweep.manifest.measures))
    return [names.of_varied(one) for one in sweep.varied]


def _refuse_other_columns(first: str, by: Sequence[str], name: str, other: Sequence[str]) -> None:
    if set(by) != set(other):
        said = [", ".join(one) or "nothing" for one in (by, other)]
        raise SocialmindError(
            f"{first} varies {said[0]}, {name} {said[1]}: their points do not meet; expected "
            "sweeps over the same columns"
        )


def _shared(sweeps: Mapping[str, Sweep], by: Sequence[str]) -> pd.DataFrame:
    """Return the points that all sweeps have, in the order of the first."""
    if not by:
        return pd.DataFrame({POINT: [0]})
    first, *others = sweeps.values()
    points = first.design[[POINT, *by]].drop_duplicates(by)
    for other in others:
        points = points.merge(other.design[list(by)].drop_duplicates(), on=list(by))
    if points.empty:
        said = [
            f"{name} has {one} {_values(sweep, one)}"
            for one in by
            for name, sweep in sweeps.items()
        ]
        raise SocialmindError(f"no point that all sweeps have; {'; '.join(said)}")
    return points


def _values(sweep: Sweep, column: str) -> str:
    values = sweep.design[column].drop_duplicates().tolist()
    shown = ", ".join(map(str, values[:6]))
    return f"{shown} …" if len(values) > 6 else shown


def _outcomes(sweeps: Mapping[str, Sweep], asked: Sequence[str]) -> list[str]:
    found = [outcomes_of(one, asked)[0] for one in sweeps.values()]
    shared = [one for one in found[0] if all(one in other for other in found)]
    if not shared:
        said = "; ".join(f"{n} {', '.join(f)}" for n, f in zip(sweeps, found, strict=True))
        raise SocialmindError(
            f"no measure that all sweeps have: {said}; --column NAME takes an end of the series"
        )
    return shared


def _at_points(sweep: Sweep, points: pd.DataFrame, by: Sequence[str]) -> pd.DataFrame:
    runs = sweep.runs[sweep.runs[STATUS] == FINISHED]
    return runs.merge(points[list(by)], on=list(by)) if by else runs


def _rows(
    outcome: str,
    name: str,
    first: str,
    runs: Mapping[str, pd.DataFrame],
    by: Sequence[str],
    level: float,
) -> list[dict[str, Any]]:
    """Return the rows of an outcome and a sweep, a point each."""
    own = estimates(runs[name], by, outcome, Summary("mean", level))
    rows = []
    for point in own.table.to_dict("records"):
        at = [_finite(_of_point(runs[one], by, point), outcome) for one in (name, first)]
        away, low, high, paired = 0.0, math.nan, math.nan, False
        if name == first:
            low = high = 0.0
        elif at[1].empty:
            away = math.nan
        else:
            found, paired = difference(at[0], at[1], outcome, level)
            away, low, high = found.mean, found.low, found.high
        rows.append(
            {"outcome": outcome, COMPARED: name, **{one: point[one] for one in by},
             "runs": point["runs"], "mean": point["middle"], "low": point["low"],
             "high": point["high"], "difference": away, "difference_low": low,
             "difference_high": high, "paired": paired}
        )  # fmt: skip
    return rows


def _of_point(runs: pd.DataFrame, by: Sequence[str], point: Mapping[Any, Any]) -> pd.DataFrame:
    if not by:
        return runs
    return runs[np.logical_and.reduce([runs[one] == point[one] for one in by])]


def _finite(runs: pd.DataFrame, outcome: str) -> pd.DataFrame:
    own = runs[[SEED, outcome]].astype({outcome: float})
    return own[np.isfinite(own[outcome])]


def _notes(sweeps: Mapping[str, Sweep], points: pd.DataFrame) -> list[str]:
    """Return what is to be said of what else tells the sweeps apart."""
    first = next(iter(sweeps.values())).manifest
    notes = []
    for name, sweep in sweeps.items():
        manifest = sweep.manifest
        left = len(sweep.design) - len(points)
        if left > 0:
            notes.append(f"{name}: {left} of its {len(sweep.design)} points are no other's")
        if manifest.ticks != first.ticks:
            notes.append(f"{name}: runs of {manifest.ticks:,} ticks, the first of {first.ticks:,}")
        if manifest.model["name"] != first.model["name"]:
            notes.append(f"{name}: of the model {manifest.model['name']}")
        odd = {s: n for s, n in manifest.counts.items() if s != FINISHED and n}
        if odd:
            told = ", ".join(f"{n:,} {status.replace('_', ' ')}" for status, n in odd.items())
            notes.append(f"{name}: {told}")
    return notes
