"""The figure of the study."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from socialmind.drawing import style as paper

from .measures import band
from .replicate import Replicate


def draw(replicates: Sequence[Replicate], shock: int) -> Figure:
    """Draw what the replicates show.

    Args:
        replicates: one for each seed.
        shock: the tick of the shock.

    Returns:
        A figure of five panels.
    """
    with paper.style():
        figure = paper.figure(paper.PAGE, 112, gap=1.5)
        panels = figure.subplot_mosaic("aabbcc;dddeee", height_ratios=(1, 1))
        _artisans(panels["a"], replicates)
        _specialisation(panels["b"], replicates)
        _correlations(panels["c"], replicates)
        _distances(panels["d"], replicates)
        _shock(panels["e"], replicates, shock)
    return figure


def _artisans(axes: Axes, replicates: Sequence[Replicate]) -> None:
    final = [int(replicate.artisans[-1]) for replicate in replicates]
    numbers, counts = np.unique(final, return_counts=True)
    axes.bar(numbers, counts, width=0.75, color=paper.RED)
    axes.axvspan(2.5, 9.5, color=paper.GREY, alpha=0.12, linewidth=0)
    axes.set_xlim(min(1.5, numbers[0] - 1), max(10.5, numbers[-1] + 1))
    axes.set_xticks(range(3, 10, 2))
    axes.yaxis.get_major_locator().set_params(integer=True)
    axes.set_xlabel(f"artisans of {replicates[0].agents} at the end")
    axes.set_ylabel("seeds (number)")
    paper.panel_title(axes, "a", "Artisans")


def _specialisation(axes: Axes, replicates: Sequence[Replicate]) -> None:
    ticks = replicates[0].ticks
    scale = paper.time_axis(axes, ticks)
    samples = np.array([replicate.specialisation for replicate in replicates])
    mean, low, high = band(samples)
    for sample in samples:
        axes.plot(ticks / scale, sample, color=paper.PURPLE, linewidth=0.4, alpha=0.25)
    axes.fill_between(ticks / scale, low, high, color=paper.PURPLE, alpha=0.35, linewidth=0)
    axes.plot(ticks / scale, mean, color=paper.PURPLE, linewidth=1.3)
    axes.set_ylim(0, 1.02)
    axes.set_ylabel("mean |t − w| / (t + w)")
    paper.panel_title(axes, "b", "Specialisation")


def _correlations(axes: Axes, replicates: Sequence[Replicate]) -> None:
    rng = np.random.default_rng(0)  # spreads the dots, no more
    for place, (field, colour) in enumerate(
        (("correlation_mind", paper.BLUE), ("correlation_land", paper.GOLD))
    ):
        values = np.array([getattr(replicate, field) for replicate in replicates])
        values = values[np.isfinite(values)]
        spread = rng.uniform(-0.16, 0.16, len(values))
        axes.plot(place + spread, values, "o", color=colour, markersize=2.6, alpha=0.75, mew=0)
        if len(values):
            axes.plot([place - 0.28, place + 0.28], [np.median(values)] * 2, color=paper.INK)
            axes.annotate(
                f"{np.median(values):.2f}",
                (place + 0.3, np.median(values)),
                fontsize=7,
                va="center",
            )
    axes.axhline(0, color=paper.GREY, linewidth=0.5, zorder=0)
    axes.set_xticks((0, 1), ("by mind", "by land"))
    axes.set_xlim(-0.5, 1.7)
    axes.set_ylim(-1, 1)
    axes.set_ylabel("Spearman's ρ of one seed")
    paper.panel_title(axes, "c", "Nearer, earlier")


def _distances(axes: Axes, replicates: Sequence[Replicate]) -> None:
    distance = np.concatenate([replicate.distance for replicate in replicates])
    tick = np.concatenate([replicate.tick_mind for replicate in replicates])
    end = float(replicates[0].ticks[-1])
    known = np.isfinite(distance)
    distance, tick = distance[known], np.minimum(tick[known], end) / 1000
    axes.plot(
        distance, tick, "o", color=paper.BLUE, markersize=2, alpha=0.3, mew=0, rasterized=True
    )
    edges = np.arange(0, distance.max(initial=0) + 3, 3)
    for low, high in pairwise(edges):
        inside = tick[(distance >= low) & (distance < high)]
        if len(inside) >= 5:
            quartiles = np.percentile(inside, (25, 50, 75))
            middle = (low + high) / 2
            axes.plot([middle] * 2, quartiles[[0, 2]], color=paper.INK, linewidth=1)
            axes.plot(middle, quartiles[1], "o", color=paper.INK, markersize=3.5)
    axes.set_xlim(left=0)
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("distance of land to village (patches)")
    axes.set_ylabel("specialised at (thousand ticks)")
    paper.panel_title(axes, "d", "Specialising against distance; medians, quartiles")


def _shock(axes: Axes, replicates: Sequence[Replicate], shock: int) -> None:
    ticks = replicates[0].ticks
    scale = paper.time_axis(axes, ticks)
    start = ticks >= shock - (ticks[-1] - shock) / 5
    ends = []
    for name, field, colour in (
        ("undisturbed", "artisans", paper.GREY),
        ("shocked", "artisans_shocked", paper.RED),
    ):
        samples = np.array([getattr(replicate, field) for replicate in replicates], float)
        mean, low, high = band(samples)
        if field == "artisans_shocked":
            at = int(np.searchsorted(ticks, shock))
            after = band([[replicate.recovery.after] for replicate in replicates])
            times = np.insert(ticks.astype(float), at + 1, shock)
            mean, low, high = (
                np.insert(line, at + 1, value)
                for line, value in zip((mean, low, high), after, strict=True)
            )
            shown = np.insert(start, at + 1, True)
        else:
            times, shown = ticks.astype(float), start
        axes.fill_between(
            times[shown] / scale, low[shown], high[shown], color=colour, alpha=0.25, linewidth=0
        )
        axes.plot(times[shown] / scale, mean[shown], color=colour, linewidth=1.3)
        ends.append((float(mean[-1]), name, colour))
    axes.axvline(shock / scale, color=paper.INK, linewidth=0.6, linestyle=(0, (3, 2)))
    axes.set_xlim(ticks[start][0] / scale, ticks[-1] / scale)
    axes.set_ylim(0, None)
    axes.set_ylabel("artisans, mean of seeds")
    paper.panel_title(axes, "e", "Half of the artisans turned into farmers")
    paper.label_ends(axes, ends)
