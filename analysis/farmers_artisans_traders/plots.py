"""The figure of the study."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from socialmind.drawing import style as paper

from .villages import CULTURES

COLOURS = dict(zip(CULTURES, (paper.PURPLE, paper.GOLD, paper.GREY), strict=True))
MARKS = dict(zip(CULTURES, ("o", "^", "x"), strict=True))


def draw(societies: pd.DataFrame, villages: pd.DataFrame) -> Figure:
    """Draw what the study found.

    Args:
        societies: a row for each.
        villages: a row for each with people.

    Returns:
        A figure of three panels, as wide as a column.
    """
    with paper.style():
        figure = paper.figure(paper.COLUMN, 170, gap=1.5)
        panels = figure.subplots(3, 1, height_ratios=(1.1, 1, 1.3))
        _mixes(panels[0], villages)
        _spreads(panels[1], societies)
        _persistence(panels[2], villages)
    return figure


def _mixes(axes: Axes, villages: pd.DataFrame) -> None:
    rng = np.random.default_rng(0)  # spreads the dots, no more
    for culture in reversed(CULTURES):
        rows = villages[villages["culture"] == culture]
        people = rows["people"] + rng.uniform(-0.25, 0.25, len(rows))
        number = rows["artisans_last"] * rows["people"]
        axes.plot(
            people, number, MARKS[culture], color=COLOURS[culture], markersize=2.8, alpha=0.7,
            mew=0.6 * (MARKS[culture] == "x"), label=culture,
        )  # fmt: skip
    most = float(villages["people"].max())
    own = villages[villages["culture"] == next(iter(CULTURES))]
    share = (own["artisans_last"] * own["people"]).sum() / own["people"].sum()
    axes.plot([0, most], [0, share * most], color=paper.PURPLE, linewidth=0.8)
    axes.set_xlim(0, most + 0.6)
    axes.set_ylim(bottom=-0.15)
    axes.set_xlabel("people of a village")
    axes.set_ylabel("artisans among them")
    axes.legend(loc="upper left")
    paper.panel_title(axes, "a", "Each village's mix, last quarter")


def _spreads(axes: Axes, societies: pd.DataFrame) -> None:
    rng = np.random.default_rng(0)
    for place, (culture, colour) in enumerate(COLOURS.items()):
        rows = societies[societies["culture"] == culture]
        for column, shift, some in (("spread", -0.18, colour), ("spread_by_chance", 0.18, "white")):
            values = rows[column].to_numpy()
            at = place + shift + rng.uniform(-0.1, 0.1, len(values))
            axes.plot(
                at, values, "o", markersize=2.8, markerfacecolor=some, markeredgecolor=colour,
                markeredgewidth=0.5, alpha=0.8,
            )  # fmt: skip
            ends = [place + shift - 0.14, place + shift + 0.14]
            axes.plot(ends, [values.mean()] * 2, color=paper.INK, linewidth=1)
    axes.set_xticks(range(len(COLOURS)), ["\n".join(name.rsplit(" ", 1)) for name in COLOURS])
    axes.set_ylim(bottom=0)
    axes.set_ylabel("spread of the share of artisans")
    paper.panel_title(axes, "b", "How far villages differ; open: by luck")


def _persistence(axes: Axes, villages: pd.DataFrame) -> None:
    for culture in reversed(CULTURES):
        rows = villages[villages["culture"] == culture]
        axes.plot(
            rows["artisans_third"] - rows["others_third"],
            rows["artisans_last"] - rows["others_last"],
            MARKS[culture], color=COLOURS[culture], markersize=2.8, alpha=0.7,
            mew=0.6 * (MARKS[culture] == "x"),
        )  # fmt: skip
    axes.axline((0, 0), slope=1, color=paper.INK, linewidth=0.6, linestyle=(0, (3, 2)))
    axes.set_xlabel("village less society, third quarter")
    axes.set_ylabel("last quarter")
    paper.panel_title(axes, "c", "Whether what sets a village apart lasts")
