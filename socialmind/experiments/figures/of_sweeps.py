"""The figures that a sweep calls for: which of them its design allows, and how each is put up."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.figures.design import Varying, baseline_of, design_of
from socialmind.experiments.figures.estimates import Effects, Estimates, Summary, effects, estimates
from socialmind.experiments.figures.labels import Labels, value_name
from socialmind.experiments.figures.layouts import (
    bands_figure,
    effects_figure,
    partial_figure,
    put_caption,
    response_figure,
)
from socialmind.experiments.figures.palette import MOST_LINES
from socialmind.experiments.figures.panels import TICK
from socialmind.experiments.sweeps.columns import RUN, STATUS, Names
from socialmind.experiments.sweeps.measures.expressions import Expression
from socialmind.experiments.sweeps.replicates import Replicates
from socialmind.experiments.sweeps.result import Sweep
from socialmind.runs.folders import FINISHED

MOST_OUTCOMES = 4
"""Ends of series that are drawn of a sweep without measures, unless some are asked for."""
MOST_EFFECTS = 24
"""Rows of a figure of effects; of more points those that differ in one thing alone are shown."""
MOMENTS, FEWEST_MOMENTS, MOST_INTERVALS = 100, 20, 3000
"""Ticks of a band at most and at least, and intervals of a figure of bands in all, about."""


@dataclass(frozen=True)
class Wanted:
    """What figures are asked for.

    Attributes:
        of: outcomes, columns of `runs.parquet`; all measures by default, or else the first ends of
            series.
        summary: how replicates are summed up.
        baseline: values of the point that others are compared with; see `baseline_of`.
        width: of a figure, in mm.
        captions: whether a line below each figure says how it was made.
    """

    of: tuple[str, ...] = ()
    summary: Summary = field(default_factory=Summary)
    baseline: Mapping[str, Any] = field(default_factory=dict)
    width: float = paper.COLUMN
    captions: bool = True


@dataclass
class Drawn:
    """Figures of a sweep.

    Attributes:
        figures: by name.
        captions: of each, how it was made and what failed.
        notes: what was left out, and why.
    """

    figures: dict[str, Figure] = field(default_factory=dict)
    captions: dict[str, str] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def draw_sweep(
    sweep: Sweep,
    wanted: Wanted | None = None,
    labels: Labels | None = None,
    defaults: Mapping[str, Any] | None = None,
) -> Drawn:
    """Draw what the design of a sweep calls for.

    Args:
        sweep: a sweep, which may be going on.
        wanted: which outcomes, how replicates are summed up, how wide.
        labels: names and units of columns; `documents.labels` has a model's own.
        defaults: of the model's parameters, for the baseline.

    Returns:
        Of each outcome `response-…`, `effects-…` and `series-…`, as far as the design has them.

    Raises:
        SocialmindError: no such outcome or baseline, nothing numeric, no finished run.
    """
    wanted, labels = wanted or Wanted(), labels or Labels()
    if not (sweep.runs[STATUS] == FINISHED).any():
        raise SocialmindError(f"{sweep.folder}: no run is finished; nothing to draw yet")
    outcomes, notes = outcomes_of(sweep, wanted.of)
    return _Drawing(sweep, wanted, labels, defaults or {}).drawn(outcomes, notes)


def outcomes_of(sweep: Sweep, asked: Sequence[str] = ()) -> tuple[list[str], list[str]]:
    """Return the outcomes of a sweep that are drawn, and what is to be said of others.

    Raises:
        SocialmindError: one that was asked for is none, or there is none with numbers.
    """
    manifest = sweep.manifest
    names = Names(tuple(manifest.columns), tuple(manifest.measures))
    ends = [names.of_series(one) for one in manifest.series_columns]
    runs = sweep.runs
    known = [
        one
        for one in [*manifest.measures, *ends]
        if one in runs.columns and pd.api.types.is_numeric_dtype(runs[one])
    ]
    for one in asked:
        if one not in known:
            raise SocialmindError(
                f"{sweep.folder}: no measure or end of a series called {one!r} that holds "
                f"numbers; {nearest(one, known)}"
            )
    if not known:
        raise SocialmindError(
            f"{sweep.folder}: no measure and no end of a series holds numbers; nothing to draw"
        )
    if asked:
        return list(dict.fromkeys(asked)), []
    measures = [one for one in known if one in manifest.measures]
    if measures:
        return measures, []
    chosen, left = known[:MOST_OUTCOMES], known[MOST_OUTCOMES:]
    if not left:
        return chosen, []
    said = f"of {len(known)} ends of series {len(chosen)} are drawn; --of {left[0]} draws another"
    return chosen, [said]


class _Drawing:
    """One sweep's figures, in one width and manner."""

    def __init__(
        self, sweep: Sweep, wanted: Wanted, labels: Labels, defaults: Mapping[str, Any]
    ) -> None:
        self.sweep, self.wanted, self.labels, self.defaults = sweep, wanted, labels, defaults
        names = Names(tuple(sweep.varied), tuple(sweep.manifest.measures))
        varied = [names.of_varied(one) for one in sweep.varied]
        self.names = names
        self.design = design_of(sweep.design, varied)
        runs = sweep.runs
        self.finished = runs[runs[STATUS] == FINISHED]
        self.lacking = _lacking(sweep)
        self.out = Drawn()

    def drawn(self, outcomes: Sequence[str], notes: Sequence[str]) -> Drawn:
        self.out.notes += notes
        with paper.style():
            baseline = self._baseline()
            for of in outcomes:
                self._response(of)
                if baseline is not None:
                    self._effects(of, baseline)
            for column in self._series_columns(outcomes):
                self._bands(column)
        return self.out

    def _response(self, of: str) -> None:
        by = self.design.names
        if not by:
            self.out.notes.append("nothing varies: there is no response to draw")
            return
        found = estimates(self.finished, by, of, self.wanted.summary)
        if found.table.empty:
            self.out.notes.append(f"{of}: no run has a number; it is not drawn")
            return
        labels, width = self._labels_of(of), self.wanted.width
        if self.design.crossed:
            figure, extra = response_figure(found, self.design, labels, width), ""
        else:
            figure, extra = partial_figure(found, self.design, labels, width)
        self._keep(f"response-{of}", figure, self._said(found, extra))

    def _baseline(self) -> dict[str, Any] | None:
        """Return the baseline of effects; None where the design has none."""
        crossed = self.design.crossed or self.sweep.manifest.design.get("name") == "table"
        if not crossed and not self.wanted.baseline:
            return None
        return baseline_of(self.design, self.wanted.baseline, self.defaults)

    def _effects(self, of: str, baseline: Mapping[str, Any]) -> None:
        if self.wanted.baseline and self.wanted.summary.statistic != "mean":
            self.out.notes.append("effects are differences of means, whatever --statistic says")
        by = self.design.names
        try:
            found = effects(self.finished, by, of, baseline, self.wanted.summary.level)
        except SocialmindError as error:
            self.out.notes.append(f"{error}: no effects")
            return
        rows = found.table
        shown = ""
        if len(rows) > MOST_EFFECTS:
            changed = sum((rows[name] != baseline[name]).astype(int) for name in by)
            rows = rows[changed == 1]
            shown = "; points that differ from it in one thing"
        if rows.empty:
            self.out.notes.append(f"{of}: no point beside the baseline has a value: no effects")
            return
        if len(rows) > 2 * MOST_EFFECTS:
            self.out.notes.append(
                f"{of}: {len(found.table)} points beside the baseline, too many rows for effects"
            )
            return
        found = Effects(rows, found.by, of, found.baseline, found.level)
        figure = effects_figure(found, self._labels_of(of), self.wanted.width)
        at = ", ".join(f"{self.labels.name(n)} {value_name(v)}" for n, v in baseline.items())
        self._keep(f"effects-{of}", figure,
                   self._line(f"{found.said}, from {at}{shown}"))  # fmt: skip

    def _labels_of(self, of: str) -> Labels:
        """Return the labels of an outcome: what ends of series are is said."""
        if of in self.sweep.manifest.measures:
            return self.labels
        return self.labels.also({of: f"{self.labels.name(of)} at the end"}, {})

    def _series_columns(self, outcomes: Sequence[str]) -> list[str]:
        """Return the columns of the series that the outcomes are made of."""
        manifest = self.sweep.manifest
        if not manifest.keeps_series:
            self.out.notes.append("the sweep keeps no series (--every 0): there are no bands")
            return []
        ends = {self.names.of_series(one): one for one in manifest.series_columns}
        found: list[str] = []
        for one in outcomes:
            text = manifest.measures.get(one, {}).get("expression")
            found += Expression(one, text).columns if text else [ends[one]] if one in ends else []
        return [one for one in dict.fromkeys(found) if one in manifest.series_columns]

    def _bands(self, column: str) -> None:
        columns = self.design.columns
        if len(columns) > 3 or not self.design.crossed:
            return
        series = self.sweep.series
        if not pd.api.types.is_numeric_dtype(series[column]):
            return
        by = [one.name for one in columns]
        shown = [_some(one) for one in columns]
        points = math.prod(map(len, shown))
        ticks = _moments(series[TICK].unique(), points)
        # Of runs that stopped on their way all have what they recorded until then.
        own = series.loc[series[TICK].isin(ticks), [RUN, TICK, column]]
        rows = own.merge(self.finished[[RUN, *by]], on=RUN, suffixes=(" series", ""))
        name = f"{column} series" if f"{column} series" in rows else column
        for one, values in zip(columns, shown, strict=True):
            rows = rows[rows[one.name].isin(values)]
        found = estimates(rows, [*by, TICK], name, self.wanted.summary)
        if found.table.empty:
            return
        end = self.names.of_series(column)
        found = replace(found, of=end)
        kept = [Varying(o.name, v, o.numeric) for o, v in zip(columns, shown, strict=True)]
        figure = bands_figure(found, kept, self.labels, self.wanted.width)
        left = any(len(o.values) > len(v) for o, v in zip(columns, shown, strict=True))
        extra = "; some of the values" if left else ""
        self._keep(f"series-{column}", figure, self._said(found, extra, of_runs=False))

    def _said(self, found: Estimates, extra: str = "", of_runs: bool = True) -> str:
        runs = sorted(set(found.table["runs"]))
        many = f"{runs[0]}" if len(runs) == 1 else f"{runs[0]} to {runs[-1]}"
        if not self.design.crossed:
            told = f"{found.summary.statistic}s of {many} runs a point"
        elif not found.has_intervals:
            told = "one run a point: no intervals"
        else:
            told = f"{found.said}; {many} runs a point"
        return self._line(f"{told}{extra}", found.without if of_runs else 0)

    def _line(self, told: str, without: int = 0) -> str:
        parts = [told, *([f"{without} runs without a value"] if without else []), *self.lacking]
        line = "; ".join(parts)
        return f"{line[0].upper()}{line[1:]}."

    def _keep(self, name: str, figure: Figure, caption: str) -> None:
        safe = "".join(one if one.isalnum() or one in "-_" else "_" for one in name)
        self.out.figures[safe] = figure
        self.out.captions[safe] = caption
        if self.wanted.captions:
            put_caption(figure, caption)


def _some(one: Varying) -> tuple[Any, ...]:
    """Return at most as many values as lines are told apart, evenly from the first to the last."""
    if len(one.values) <= MOST_LINES:
        return one.values
    places = np.linspace(0, len(one.values) - 1, MOST_LINES).round().astype(int)
    return tuple(one.values[place] for place in places.tolist())


def _moments(ticks: Any, points: int) -> Any:
    """Return the ticks that get intervals, evenly spread."""
    known = np.sort(np.asarray(ticks))
    most = min(MOMENTS, max(FEWEST_MOMENTS, MOST_INTERVALS // max(points, 1)))
    if len(known) <= most:
        return known
    return known[np.linspace(0, len(known) - 1, most).round().astype(int)]


def _lacking(sweep: Sweep) -> list[str]:
    """Return what is to be said of runs that did not finish."""
    runs = sweep.runs
    counts = runs[STATUS].value_counts()
    found = [f"{counts[one]} {one.replace('_', ' ')}" for one in counts.index if one != FINISHED]
    replicates = Replicates.of_record(sweep.manifest.replicates)
    if replicates.until is None:
        missing = sweep.manifest.points * len(replicates.seeds) - len(runs)
        if missing > 0 and "pending" not in counts:
            found.append(f"{missing} pending")
    total = max(len(runs), sweep.manifest.points * len(replicates.seeds))
    return [f"of {total} runs {' and '.join(found)}"] if found else []
