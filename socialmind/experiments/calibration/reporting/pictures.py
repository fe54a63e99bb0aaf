"""The figures of a fit: true against found, profiles, and the best against the data."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from string import ascii_lowercase
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.drawing import style as paper
from socialmind.experiments.calibration.result import Fit
from socialmind.experiments.calibration.target import SERIES, TICK
from socialmind.experiments.figures.labels import word_name

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH, HEIGHT = 60.0, 56.0
"""Of a panel, in millimetres."""
LONGEST = 30
"""Characters of a line over or below a panel."""


def figures_of(fit: Fit) -> dict[str, Figure]:
    """Return the figures of a fit: `best`, `profiles`, and `recovery` where there is one."""
    with paper.style():
        found = {"best": draw_best(fit), "profiles": draw_profiles(fit)}
        if fit.manifest.recover:
            found["recovery"] = draw_recovery(fit)
    return found


def draw_recovery(fit: Fit) -> Figure:
    """Draw for each parameter what was found against what was true, with intervals.

    A dot is the best trial, an interval of a surface through all of them: it need not hold the dot.
    """
    table = fit.parameters.set_index("parameter")
    figure, panels = paper.grid(len(fit.manifest.vary), WIDTH, HEIGHT)
    labels = {True: "found, with its interval", False: "found; the interval misses the truth"}
    for number, (axes, one) in enumerate(zip(panels, fit.manifest.vary, strict=False)):
        name = one["name"]
        rows = fit.recovery[fit.recovery["parameter"] == name]
        ends = [one["low"], one["high"]]
        axes.plot(ends, ends, color=paper.PALE, zorder=1, label="found = true")
        for _, row in rows.iterrows():
            held = bool(row["covers"])
            colour = paper.BLUE if held else paper.RED
            axes.plot([row["true"]] * 2, [row["low"], row["high"]], color=colour, linewidth=0.7)
            # Not clipped: a dot at the end of a range is whole.
            axes.plot(row["true"], row["found"], "o" if held else "s", color=colour, markersize=3,
                      zorder=3, clip_on=False, label=labels[held])  # fmt: skip
        _scaled(axes, one, both=True)
        axes.set_xlabel("true")
        axes.set_ylabel("found")
        said = f"{table.loc[name, 'verdict']}, gain {table.loc[name, 'gain']:.2f}"
        _head(axes, number, f"{_in_lines(name)}\n{said}")
    _key(figure, panels)
    return figure


def draw_profiles(fit: Fit) -> Figure:
    """Draw the best distance in each piece of each parameter's range, over all trials."""
    figure, panels = paper.grid(len(fit.manifest.vary), WIDTH, HEIGHT)
    trials = fit.trials[(fit.trials["search"] == 0) & np.isfinite(fit.trials["distance"])]
    luck = fit.best["luck"]
    top = _top(fit.profiles["distance"], luck)
    near = trials["distance"] <= top
    for number, (axes, one) in enumerate(zip(panels, fit.manifest.vary, strict=False)):
        name = one["name"]
        every = fit.profiles[fit.profiles["parameter"] == name]
        rows = every.dropna(subset=["distance"])
        axes.plot(trials.loc[near, name], trials.loc[near, "distance"], ".", color=paper.PALE,
                  markersize=2, zorder=1, label="a trial")  # fmt: skip
        if not near.all():
            far = trials.loc[~near, name]
            axes.plot(far, np.full(len(far), top), "|", color=paper.GREY, markersize=5,
                      markeredgewidth=0.5, clip_on=False, label="a trial farther away")  # fmt: skip
        axes.plot(rows["value"], rows["distance"], "o-", color=paper.BLUE, markersize=3,
                  label="the least in a tenth of the range")  # fmt: skip
        middles = [_middle(row["from"], row["to"], one["log"]) for _, row in every.iterrows()]
        axes.plot(middles, every["smooth"], color=paper.PURPLE, linewidth=1.0,
                  linestyle=paper.DASHES[paper.PURPLE],
                  label="a surface through all trials, cut at 0")  # fmt: skip
        axes.axvline(fit.values[name], color=paper.INK, linewidth=0.6, label="found")
        if luck is not None:
            axes.axhline(luck, color=paper.GOLD, linewidth=0.8, label="plausible below")
        _scaled(axes, one)
        axes.set_ylim(-0.04 * top, top)  # a surface that comes to nothing is seen
        axes.set_xlabel(_in_lines(name))
        axes.set_ylabel("distance from the data")
        _head(axes, number, "")
    _key(figure, panels)
    return figure


def draw_best(fit: Fit) -> Figure:
    """Draw the data, and the runs with the values found on new seeds."""
    target, runs = fit.target, fit.best_runs
    figure, panels = paper.grid(len(target.columns), WIDTH, HEIGHT)
    for n, (axes, name) in enumerate(zip(panels, target.columns, strict=False)):
        _head(axes, n, name.replace("_", " "))
        if target.kind == SERIES:
            wide = runs.pivot_table(name, TICK, "run") if len(runs) else None
            unit = paper.time_axis(axes, target.ticks)
            ticks = np.array(target.ticks) / unit
            if wide is not None and len(wide):
                low, high = wide.quantile(0.025, axis=1), wide.quantile(0.975, axis=1)
                at = np.array(wide.index) / unit
                axes.fill_between(at, low, high, color=paper.BLUE, alpha=0.2, linewidth=0)
                axes.plot(at, wide.mean(axis=1), color=paper.BLUE)
            axes.plot(ticks, target.values[:, n], color=paper.INK, linewidth=0.8)
        else:
            values = runs[name].to_numpy(float) if len(runs) else np.zeros(0)
            spread = np.linspace(-0.15, 0.15, max(len(values), 1))[: len(values)]
            axes.plot(1 + spread, values, "o", color=paper.PALE, markersize=2.5)
            if len(values):
                axes.plot([0.8, 1.2], [values.mean()] * 2, color=paper.BLUE)
            at, error = target.values[0, n], target.errors[n]
            axes.errorbar([0], [at], [error], fmt="o", color=paper.INK, markersize=3, capsize=2)
            axes.set_xticks([0, 1], ["data", "model"])
            axes.set_xlim(-0.5, 1.5)
    return figure


def _scaled(axes: Axes, one: Mapping[str, Any], both: bool = False) -> None:
    """Set an axis to a parameter's range and scale; both axes where both are of the parameter."""
    if one["log"]:
        axes.set_xscale("log")
    else:
        axes.locator_params(axis="x", nbins=4)  # so that long numbers stay apart
    axes.set_xlim(one["low"], one["high"])
    if both:
        if one["log"]:
            axes.set_yscale("log")
        axes.set_ylim(one["low"], one["high"])


def _head(axes: Axes, number: int, title: str) -> None:
    paper.panel_title(axes, ascii_lowercase[number % len(ascii_lowercase)], title)


def _key(figure: Figure, panels: Sequence[Axes]) -> None:
    """Name below a figure what any of its panels shows."""
    known: dict[str, Any] = {}
    for axes in panels:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            known.setdefault(label, handle)
    columns = min(3, len(panels))
    figure.legend(known.values(), known, loc="outside lower center", ncols=columns)


def _in_lines(name: str) -> str:
    """Return what a parameter is called, in lines that fit over or below a panel."""
    return fill(word_name(name), LONGEST)


def _middle(low: float, high: float, log: bool) -> float:
    return math.sqrt(low * high) if log else (low + high) / 2


def _top(distances: object, luck: float | None) -> float:
    known = np.asarray(distances, float)
    known = known[np.isfinite(known)]
    return 1.15 * max(float(np.max(known, initial=0.0)), luck or 0.0) or 1.0


def plain_number(value: float | None) -> str:
    """Return a number as a page has it.

    >>> plain_number(167.25), plain_number(None), plain_number(float("inf"))
    ('167.2', '–', 'infinite')
    """
    if value is None or math.isnan(value):
        return "–"
    return "infinite" if math.isinf(value) else f"{value:.4g}"
