"""The figure of a travel agency: what became of requests, and prices between the limits."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pandas as pd
from matplotlib.figure import Figure

from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run


def draw(run: Run) -> dict[str, Figure]:
    """Draw every figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `trade` by name.
    """
    with paper.style():
        return {"trade": trade(run.series)}


def trade(series: pd.DataFrame) -> Figure:
    """Draw what became of requests so far, and the mean price between both sides' limits.

    Args:
        series: one row a recorded tick.

    Returns:
        A figure of two panels.
    """
    figure = paper.figure(paper.PAGE, 55)
    counts, money = figure.subplots(1, 2)
    price = series["price"].where(series["contracts"] > 0)
    shown = (
        (counts, "a", "Requests so far", "requests", (
            (series["requests"], "made", paper.GREY),
            (series["contracts"], "contracts", paper.BLUE),
            (series["withdrawn"], "withdrawn", paper.RED),
        )),
        (money, "b", "Contracts so far", "money (mean)", (
            (price + series["buyers_gain"], "buyers' limits", paper.BLUE),
            (price, "prices", paper.INK),
            (price - series["sellers_gain"], "sellers' limits", paper.RED),
        )),
    )  # fmt: skip
    for axes, letter, title, unit, lines in shown:
        scale = paper.time_axis(axes, list(series["tick"]))
        ends: list[tuple[float, str, str]] = []
        drawn: list[float] = []
        for values, name, colour in lines:
            axes.plot(series["tick"] / scale, values, color=colour)
            known = values.dropna().astype(float).tolist()
            drawn += known
            if known:
                ends.append((known[-1], name, colour))
        axes.set_ylim(*paper.limits_with_zero(drawn or [0.0]))
        axes.set_ylabel(unit)
        paper.panel_title(axes, letter, title)
        paper.label_ends(axes, ends)
    return figure
