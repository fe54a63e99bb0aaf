"""The figure of the villages: who lives there, what they have, and what they ask for, over time.

Blue stands for wheat and farmers, red for tools and artisans.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

ROWS = (
    (("farmers_of", "farmers", paper.BLUE), ("artisans_of", "artisans", paper.RED)),
    (("balance_of", "", paper.INK),),
    (("WheatDemand_of", "wheat", paper.BLUE), ("ToolDemand_of", "tools", paper.RED)),
)
UNITS = ("people (number)", "wheat − tools, stock", "demand (culturon)")
MOST_DRAWN = 3


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `villages`.
    """
    with paper.style():
        return {"villages": villages(run.series, int(run.parameters["n_villages"]))}


def villages(series: pd.DataFrame, count: int) -> Figure:
    """Draw people, stocks and demands of each village over time.

    Args:
        series: one row a recorded tick.
        count: the number of villages; the first three are drawn.

    Returns:
        A figure of three rows, with a column for each village.
    """
    count = min(count, MOST_DRAWN)
    figure = paper.figure(paper.PAGE, 110)
    panels = figure.subplots(len(ROWS), count, sharex=True, sharey="row", squeeze=False)
    for village in range(count):
        for row, lines in enumerate(ROWS):
            axes = panels[row, village]
            scale = paper.time_axis(axes, list(series["tick"]))
            if row < len(ROWS) - 1:
                axes.set_xlabel("")
            for column, label, colour in lines:
                values = series[f"{column}_{village}"].astype(float)
                steps = "steps-post" if row == 0 else "default"
                axes.plot(
                    series["tick"] / scale, values, color=colour, linewidth=0.9, drawstyle=steps,
                    linestyle=paper.DASHES.get(colour, "-"), label=label,
                )  # fmt: skip
            if row == 0:
                paper.panel_title(axes, "abc"[village], f"Village {village}")
                axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
            else:
                axes.yaxis.set_major_formatter("{x:,.0f}")
            if village == 0:
                axes.set_ylabel(UNITS[row])
            if village == count - 1 and len(lines) > 1:
                axes.legend(loc="best")
    return figure
