"""The figures of a fit: true against found, profiles, and the best against the data."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.drawing import style as paper
from socialmind.experiments.calibration.result import Fit
from socialmind.experiments.calibration.target import SERIES, TICK

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WIDTH, HEIGHT = 60.0, 52.0
"""Of a panel, in millimetres."""
LONGEST = 26
"""Characters of a line over a panel."""


def figures_of(fit: Fit) -> dict[str, Figure]:
    """Return the figures of a fit: `best`, `profiles`, and `recovery` where there is one."""
    with paper.style():
        found = {"best": draw_best(fit), "profiles": draw_profiles(fit)}
        if fit.manifest.recover:
            found["recovery"] = draw_recovery(fit)
    return found


def draw_recovery(fit: Fit) -> Figure:
    """Draw for each parameter what was found against what was true, with intervals."""
    table = fit.parameters.set_index("parameter")
    figure, panels = paper.grid(len(fit.manifest.vary), WIDTH, HEIGHT)
    for axes, one in zip(panels, fit.manifest.vary, strict=False):
        name = one["name"]
        rows = fit.recovery[fit.recovery["parameter"] == name]
        axes.plot([one["low"], one["high"]], [one["low"], one["high"]], color=paper.PALE, zorder=1)
        for _, row in rows.iterrows():
            colour = paper.BLUE if row["covers"] else paper.RED
            axes.plot([row["true"]] * 2, [row["low"], row["high"]], color=colour, linewidth=0.7)
            axes.plot(row["true"], row["found"], "o", color=colour, markersize=3, zorder=3)
        _scaled(axes, one, both=True)
        axes.set_xlabel("true")
        axes.set_ylabel("found")
        axes.set_title(
            f"{_in_lines(name)}\n{table.loc[name, 'verdict']}, gain {table.loc[name, 'gain']:.2f}"
        )
    return figure


def draw_profiles(fit: Fit) -> Figure:
    """Draw the best distance in each piece of each parameter's range, over all trials."""
    figure, panels = paper.grid(len(fit.manifest.vary), WIDTH, HEIGHT)
    trials = fit.trials[(fit.trials["search"] == 0) & np.isfinite(fit.trials["distance"])]
    luck = fit.best["luck"]
    top = _top(fit.profiles["distance"], luck)
    for axes, one in zip(panels, fit.manifest.vary, strict=False):
        name = one["name"]
        every = fit.profiles[fit.profiles["parameter"] == name]
        rows = every.dropna(subset=["distance"])
        axes.plot(trials[name], trials["distance"], ".", color=paper.PALE, markersize=2, zorder=1,
                  label="a trial")  # fmt: skip
        axes.plot(rows["value"], rows["distance"], "o-", color=paper.BLUE, markersize=3,
                  label="the least in a tenth of the range")  # fmt: skip
        middles = [_middle(row["from"], row["to"], one["log"]) for _, row in every.iterrows()]
        axes.plot(middles, every["smooth"], color=paper.PURPLE, linewidth=0.8,
                  label="a surface through all trials")  # fmt: skip
        axes.axvline(fit.values[name], color=paper.INK, linewidth=0.6, label="found")
        if luck is not None:
            axes.axhline(luck, color=paper.GOLD, linewidth=0.8, label="plausible below")
        _scaled(axes, one)
        axes.set_ylim(-0.04 * top, top)  # a surface that comes to nothing is seen
        axes.set_xlabel(_in_lines(name))
        axes.set_ylabel("distance")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=min(3, len(panels)))
    return figure


def draw_best(fit: Fit) -> Figure:
    """Draw the data, and the runs with the values found on new seeds."""
    target, runs = fit.target, fit.best_runs
    figure, panels = paper.grid(len(target.columns), WIDTH, HEIGHT)
    for n, (axes, name) in enumerate(zip(panels, target.columns, strict=False)):
        axes.set_title(name)
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


def _in_lines(name: str) -> str:
    """Return a name that fits over a panel: what is long is broken behind its first full stop."""
    return name if len(name) <= LONGEST else name.replace(".", ".\n", 1)


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
