"""The figures that a sweep calls for: which of them its design allows, and how each is put up."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from textwrap import fill
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.figures.design import Design, Varying, baseline_of, design_of
from socialmind.experiments.figures.estimates import Effects, Estimates, Summary, effects, estimates
from socialmind.experiments.figures.labels import Labels, value_name
from socialmind.experiments.figures.palette import MOST_LINES
from socialmind.experiments.figures.panels import (
    TICK,
    draw_bands,
    draw_effects,
    draw_response,
    draw_scatter,
    draw_surface,
)
from socialmind.experiments.sweeps.columns import RUN, STATUS, Names
from socialmind.experiments.sweeps.measures.expressions import Expression
from socialmind.experiments.sweeps.replicates import Replicates
from socialmind.experiments.sweeps.result import Sweep
from socialmind.runs.folders import FINISHED

MOST_OUTCOMES = 4
"""Ends of series that are drawn of a sweep without measures, unless some are asked for."""
NARROWEST_PANEL = 40.0
"""Width of a panel among several, in mm."""
LINE = 1.36
"""Width of a letter of 7 points, in mm, about."""
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
    chosen = known[:MOST_OUTCOMES]
    left = known[MOST_OUTCOMES:]
    said = [f"of {len(known)} ends of series {len(chosen)} are drawn; --of {left[0]} draws others"]
    return chosen, said if left else []


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
        if self.finished.empty:
            raise SocialmindError(f"{sweep.folder}: no run is finished; nothing to draw yet")
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
        if rows.empty or len(rows) > 2 * MOST_EFFECTS:
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
        found = Estimates(found.table, found.by, end, found.summary, found.without)
        kept = [Varying(o.name, v, o.numeric) for o, v in zip(columns, shown, strict=True)]
        figure = bands_figure(found, kept, self.labels, self.wanted.width)
        left = any(len(o.values) > len(v) for o, v in zip(columns, shown, strict=True))
        extra = "; some of the values" if left else ""
        self._keep(f"series-{column}", figure, self._said(found, extra, "tick"))

    def _said(self, found: Estimates, extra: str = "", per: str = "point") -> str:
        runs = sorted(set(found.table["runs"]))
        many = f"{runs[0]}" if len(runs) == 1 else f"{runs[0]} to {runs[-1]}"
        if not self.design.crossed:
            told = f"{found.summary.statistic}s of {many} runs a point"
        elif not found.has_intervals:
            told = f"one run a {per}: no intervals"
        else:
            told = f"{found.summary.said}; {many} runs a {'point' if per == 'tick' else per}"
        without = found.without if per == "point" else 0
        return self._line(f"{told}{extra}", without)

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


def put_caption(figure: Figure, caption: str) -> None:
    """Write a line below a figure that says how it was made, in grey."""
    letters = int(figure.get_figwidth() * 25.4 / LINE)
    figure.supxlabel(
        fill(caption, letters), x=0.01, ha="left", fontsize=7, color=paper.GREY
    )  # fmt: skip


def response_figure(found: Estimates, design: Design, labels: Labels, width: float) -> Figure:
    """Return the figure of an outcome over up to four columns whose values are crossed.

    One number: a curve. One of names: dots. Two of numbers: a map of cells, and curves with
    intervals. Three or four: panels for each value of the third and fourth.

    Args:
        found: the outcome, by what varies.
        design: the design, crossed.
        labels: names and units.
        width: in mm.
    """
    columns = design.columns
    if len(columns) == 1:
        figure = paper.figure(width, min(0.7 * width, 75))
        draw_response(figure.subplots(), found, columns[0].name, labels=labels)
        return figure
    first, second, *others = columns
    as_lines = len(second.values) <= MOST_LINES
    if not others:
        if as_lines and not (first.numeric and second.numeric):
            figure = paper.figure(width, min(0.8 * width, 85))
            draw_response(figure.subplots(), found, first.name, second.name, labels)
            _key(figure, [figure.axes[0]], second, labels, width)
            return figure
        return _two_views(found, first, second, as_lines, labels, width)
    figure, panels = _small_multiples(columns[2:], labels, width, 46.0)
    known = found.table[["low", "high", "middle"]].to_numpy(float)
    limits = (float(np.nanmin(known[:, 2])), float(np.nanmax(known[:, 2])))
    for axes, values in panels:
        own = found.only(values)
        if as_lines:
            draw_response(axes, own, first.name, second.name, labels, second)
            axes.set_ylim(*_with_air(known))
        else:
            draw_surface(axes, own, first.name, second.name, labels, limits, bar=False)
    drawn = [axes for axes, _ in panels]
    if as_lines:
        _key(figure, drawn, second, labels, width)
    else:
        bar = figure.colorbar(drawn[0].collections[0], ax=drawn, pad=0.02, aspect=30)
        bar.outline.set_visible(False)  # type: ignore[operator]  # a spine, not a list of them
        bar.set_label(labels.axis(found.of))
    _inner_labels(drawn, figure)
    return figure


def _two_views(
    found: Estimates, first: Varying, second: Varying, as_lines: bool, labels: Labels, width: float
) -> Figure:
    """Return a map of cells, and beside or below it the curves with their intervals.

    Of too many lines the second is a map of how wide the intervals are.
    """
    beside = width >= 2 * 75
    figure = paper.figure(width, 72 if beside else 126)
    panels = figure.subplots(1, 2) if beside else figure.subplots(2, 1)
    draw_surface(panels[0], found, first.name, second.name, labels)
    paper.panel_title(panels[0], "a", "")
    if as_lines:
        draw_response(panels[1], found, first.name, second.name, labels)
        panels[1].legend(
            title=rf"$\bf{{b}}$   {labels.axis(second.name)}", ncols=min(len(second.values), 3), fontsize=7,
            title_fontsize=8, loc="lower left", bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2,
            alignment="left", columnspacing=1.2, handlelength=2.6,
        )  # fmt: skip
    elif found.has_intervals:
        half = found.table.assign(middle=(found.table["high"] - found.table["low"]) / 2)
        half = half.assign(low=math.nan, high=math.nan)
        widths = Estimates(half, found.by, "half", found.summary)
        unit = labels.units.get(found.of, "")
        called = labels.also({"half": "half the width of the interval"}, {"half": unit})
        draw_surface(panels[1], widths, first.name, second.name, called)
        paper.panel_title(panels[1], "b", "")
    else:
        panels[1].set_visible(False)
    return figure


def partial_figure(
    found: Estimates, design: Design, labels: Labels, width: float
) -> tuple[Figure, str]:
    """Return the figure of an outcome at points that fill a space: against each column in turn.

    Args:
        found: the outcome, by what varies.
        design: the design.
        labels: names and units.
        width: in mm.

    Returns:
        The figure, and what a caption says of its lines.
    """
    columns = design.columns
    across = max(1, min(len(columns), int(width // NARROWEST_PANEL)))
    down = -(-len(columns) // across)
    figure = paper.figure(width, 12 + 44 * down)
    panels = figure.subplots(down, across, squeeze=False, sharey=True)
    for axes, one in zip(panels.flat, columns, strict=False):
        draw_scatter(axes, found, one.name, labels)
    for axes in panels.flat[len(columns) :]:
        axes.set_visible(False)
    _inner_labels(list(panels.flat[: len(columns)]), figure)
    splined = any(one.numeric and len(one.values) >= 10 for one in columns)
    lines = "smoothing splines" if splined else "means at each value"
    if splined and not any(len(axes.lines[0].get_xdata()) for axes in figure.axes if axes.lines):
        lines = 'none, for want of scipy (pip install "socialmind[analysis]")'
    return figure, f"; a dot a point, whatever the other parameters are; lines: {lines}"


def bands_figure(
    found: Estimates, columns: Sequence[Varying], labels: Labels, width: float
) -> Figure:
    """Return the figure of a column of the series over time: lines with bands, panels beyond.

    Args:
        found: the column, by what varies and `tick`.
        columns: what varies, at most three: as lines, as columns of panels, as rows of panels.
        labels: names and units.
        width: in mm.
    """
    if len(columns) < 2:
        figure = paper.figure(width, min(0.75 * width, 75))
        by = columns[0] if columns else None
        draw_bands(figure.subplots(), found, by.name if by else None, labels, by)
        panels = [(figure.axes[0], {})]
    else:
        figure, panels = _small_multiples(columns[1:], labels, width, 40.0)
        known = found.table[["low", "high", "middle"]].to_numpy(float)
        for axes, values in panels:
            draw_bands(axes, found.only(values), columns[0].name, labels, columns[0])
            axes.set_ylim(*_with_air(known))
    drawn = [axes for axes, _ in panels]
    if columns:
        _key(figure, drawn, columns[0], labels, width)
    _inner_labels(drawn, figure)
    return figure


def effects_figure(found: Effects, labels: Labels, width: float) -> Figure:
    """Return the figure of effects beside a baseline, a row a point.

    Args:
        found: the differences.
        labels: names and units.
        width: in mm.
    """
    figure = paper.figure(width, 28 + 4.6 * max(3, len(found.table)))
    names = None
    if len(found.by) > 1:
        names = [_changes(row, found, labels) for _, row in found.table.iterrows()]
    draw_effects(figure.subplots(), found, labels, names)
    return figure


def _changes(row: pd.Series, found: Effects, labels: Labels) -> str:
    """Return what differs from the baseline at a point."""
    return ", ".join(
        f"{labels.name(name)} {value_name(row[name])}"
        for name in found.by
        if row[name] != found.baseline[name]
    )


def _small_multiples(
    columns: Sequence[Varying], labels: Labels, width: float, height: float
) -> tuple[Figure, list[tuple[Axes, dict[str, Any]]]]:
    """Return a figure with a panel for each value of one column, or each pair of two."""
    most = max(1, int(width // NARROWEST_PANEL))
    if len(columns) == 1:
        places = [{columns[0].name: value} for value in columns[0].values]
        across = min(most, len(places))
        down = -(-len(places) // across)
    else:
        places = [{columns[1].name: b, columns[0].name: a}
                  for b in columns[1].values for a in columns[0].values]  # fmt: skip
        across, down = len(columns[0].values), len(columns[1].values)
        if across > 1.6 * most:
            raise SocialmindError(
                f"{across} columns of panels, a value of {columns[0].name} each, in {width:g} mm; "
                "give more room: --width double"
            )
    figure = paper.figure(width, 16 + height * down)
    panels = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
    for axes, values in zip(panels.flat, places, strict=False):
        said = [f"{labels.name(name)} {value_name(value)}" for name, value in values.items()]
        letters = int(width / across / LINE * 0.8)
        axes.set_title("\n".join(fill(one, letters) for one in said), fontsize=7)
    for axes in panels.flat[len(places) :]:
        axes.set_visible(False)
    return figure, list(zip(panels.flat, places, strict=False))


def _inner_labels(panels: Sequence[Axes], figure: Figure) -> None:
    """Leave labels of axes out where the panel beside or below has the same."""
    places = {}
    for axes in panels:
        spec = axes.get_subplotspec()
        if spec is not None:
            places[spec.rowspan.start, spec.colspan.start] = axes
    for (row, column), axes in places.items():
        left, below = places.get((row, column - 1)), places.get((row + 1, column))
        if left is not None and left.get_ylabel() == axes.get_ylabel():
            axes.set_ylabel("")
        if below is not None and below.get_xlabel() == axes.get_xlabel():
            axes.set_xlabel("")
        elif below is None:
            axes.tick_params(labelbottom=True)


def _key(
    figure: Figure, panels: Sequence[Axes], one: Varying, labels: Labels, width: float
) -> None:
    """Put the key of lines above the panels."""
    handles, names = panels[0].get_legend_handles_labels()
    longest = max(map(len, names)) if names else 1
    room = max(1, int(width / (12 + longest * LINE)))
    figure.legend(
        handles, names, title=labels.axis(one.name), title_fontsize=7, alignment="left",
        loc="outside upper left", ncols=min(len(names), room), columnspacing=1.2, handlelength=2.6,
    )  # fmt: skip


def _with_air(known: np.ndarray[Any, Any]) -> tuple[float, float]:
    low, high = float(np.nanmin(known)), float(np.nanmax(known))
    air = 0.05 * (high - low) or 0.5
    return low - air, high + air


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
