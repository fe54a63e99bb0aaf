"""How far robots go for an object, by the function of CollectVariable."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from socialmind.catalogue import load_model
from socialmind.drawing import style as paper
from socialmind.experiments import score
from socialmind.experiments.studies import Way, write_figure, write_page
from socialmind.experiments.trainings.plans import attempts_of
from socialmind.mind import MindDescription

from .trainings import FUNCTIONS, known

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from socialmind.learning import Training

SEED = 73
"""Of the worlds that attempts are scored in."""
MEASURES = ("path_ratio", "path", "objects", "survived")
MARK = 1.3
"""How much longer than those of the plain hierarchy ways may be: a bound of this project's own."""
TITLES = {
    "selecting": "influence\nnetwork",
    "selecting_hidden": "influence\nnetwork, one\nhidden layer",
    "linear": "network,\nno hidden\nlayer",
    "perceptron": "perceptron,\ntwo hidden\nlayers",
}
"""Of the functions, in the figure."""

Row = dict[str, Any]


def write_comparison(
    trainings: Mapping[str, tuple[Training | None, str]], way: Way, worlds: int, out: Path
) -> list[Path]:
    """Write a row for each attempt, a figure, and what they say.

    Args:
        trainings: by plan, each with a line on where it comes from.
        way: in which they are come by.
        worlds: how many each attempt is scored in.
        out: the folder.
    """
    attempts = attempts_of({name: training for name, (training, _) in trainings.items()})
    rows = [row_of(*attempt, worlds) for attempt in attempts]
    made = (
        f"{way.said('target-functions', 'target_variable')} Scored in {worlds} worlds that "
        f"no training has seen (seed {SEED}), the same ones for all."
    )
    told = [made, *(line for _, line in trainings.values())]
    page = write_page("target-functions", "Functions of CollectVariable", told, lines_of(rows), out)
    return [*write_figure("target-functions", draw(rows), rows, out), page]


def row_of(name: str, attempt: int, mind: MindDescription, worlds: int) -> Row:
    """Return what an attempt comes to.

    Args:
        name: of the training.
        attempt: its number.
        mind: what it learned.
        worlds: how many it is scored in.
    """
    found = score(load_model("target_variable"), mind, episodes=worlds, seed=SEED)
    row: Row = {"training": name, "attempt": attempt, "worlds": worlds, "seed": SEED}
    row |= {key: round(found.intervals[key].mean, 4) for key in MEASURES}
    row["path_ratio_low"] = round(found.intervals["path_ratio"].low, 4)
    row["path_ratio_high"] = round(found.intervals["path_ratio"].high, 4)
    return row


def lines_of(rows: list[Row]) -> list[str]:
    """Return what the attempts come to, in words and a table."""
    lines = []
    for name in dict.fromkeys(row["training"] for row in rows):
        own = np.array([row["path_ratio"] for row in rows if row["training"] == name], float)
        objects = np.array([row["objects"] for row in rows if row["training"] == name])
        size = known(FUNCTIONS[name][1]).skills["CollectVariable"].genome_size
        ways, said = own[np.isfinite(own)], "no attempt brings an object home"
        if len(ways):
            said = (
                f"ways of {ways.mean():.2f} ({ways.min():.2f} to {ways.max():.2f}) times those of "
                f"the plain hierarchy; {int((ways <= MARK).sum())} of {len(own)} attempts within "
                f"{MARK}; {objects.mean():.1f} objects"
            )
        lines.append(f"- `{name}`, {FUNCTIONS[name][0]}, {size} weights: {said}.")
    heads = ["training", "attempt", *MEASURES]
    lines += ["", f"| {' | '.join(heads)} |", "|" + "---|" * len(heads)]
    lines += [f"| {' | '.join(str(row[key]) for key in heads)} |" for row in rows]
    return lines


def draw(rows: list[Row]) -> Figure:
    """Draw the ratio of each attempt, with its interval over worlds."""
    names = list(dict.fromkeys(row["training"] for row in rows))
    with paper.style():
        figure = paper.figure(paper.COLUMN, 78)
        axes = figure.subplots()
        for place, name in enumerate(names):
            own = [row for row in rows if row["training"] == name]
            for number, row in enumerate(own):
                at = place + 0.5 * ((number + 0.5) / len(own) - 0.5)
                if not np.isfinite(row["path_ratio"]):
                    # On the axis, not above it, where it would read as a ratio.
                    axes.plot(at, 0.0, "x", color=paper.RED, markersize=4, clip_on=False,
                              zorder=5, transform=axes.get_xaxis_transform())  # fmt: skip
                    continue
                axes.plot([at, at], [row["path_ratio_low"], row["path_ratio_high"]],
                          color=paper.GREY, linewidth=0.8)  # fmt: skip
                axes.plot(at, row["path_ratio"], "o", color=paper.BLUE, markersize=3)
        # 1 and the mark are in sight wherever the points are.
        axes.plot([0, 0], [1.0, 1.05 * MARK], alpha=0.0)
        axes.axhline(MARK, color=paper.INK, linewidth=0.6, linestyle=(0, (3, 2)))
        axes.set_xticks(range(len(names)), [TITLES[name] for name in names])
        axes.tick_params(axis="x", length=0)
        axes.set_xlim(-0.5, len(names) - 0.5)
        axes.set_ylabel("way for an object\n(plain hierarchy: 1)")
        axes.set_xlabel("function of CollectVariable")
        attempt: dict[str, Any] = {"color": paper.GREY, "marker": "o", "markersize": 3}
        attempt |= {"markerfacecolor": paper.BLUE, "markeredgecolor": paper.BLUE}
        none: dict[str, Any] = {"color": paper.RED, "marker": "x", "markersize": 4}
        key = [
            Line2D([], [], label="an attempt, with its interval", **attempt),
            Line2D([], [], label="no object home", linestyle="none", **none),
            Line2D([], [], label=f"{MARK}, our bound", color=paper.INK, linewidth=0.6,
                   linestyle=(0, (3, 2))),
        ]  # fmt: skip
        figure.legend(handles=key, loc="outside upper left", ncols=2)
    return figure
