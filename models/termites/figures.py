"""The figure of the termites: where the chips lie, and how many piles there are over time.

A run records termites, not patches; so the society is run again, from the same seed.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from socialmind.catalogue import load_model
from socialmind.drawing import style as paper

if TYPE_CHECKING:
    from socialmind.experiments import Run

KINDS = ListedColormap(["white", paper.INK, "#f0cf7a", paper.BLUE_TO_RED[2], paper.RED])
"""Of no chip, and of the kinds of chips; in grey too each has a shade of its own."""
MAPS = 3


def draw(run: Run) -> dict[str, Figure]:
    """Draw the figure of a run.

    Args:
        run: a recorded run of this model.

    Returns:
        The figure `piles`.
    """
    society = load_model(Path(__file__).parent)(run.seed, **run.parameters)
    with paper.style():
        return {"piles": piles(society, run.series)}


def piles(society: Any, series: pd.DataFrame) -> Figure:
    """Draw three maps of the chips, and below them piles and togetherness over time.

    Args:
        society: at its beginning.
        series: one row a recorded tick.

    Returns:
        A figure of five panels.
    """
    figure = paper.figure(paper.PAGE, 115)
    top, below = figure.subfigures(2, 1, height_ratios=(1.5, 1))
    ticks = series["tick"].to_numpy(int)
    maps = top.subplots(1, MAPS, sharey=True)
    places = np.linspace(0, len(ticks) - 1, MAPS).round().astype(int)
    for letter, axes, tick in zip("abc", maps, ticks[places].tolist(), strict=True):
        society.advance(tick - society.tick)
        map_of_chips(axes, society.world)
        axes.set_ylabel("y (patches)" if letter == "a" else "")
        paper.panel_title(axes, letter, f"Tick {tick:,}")
    number, share = below.subplots(1, 2)
    scale = paper.time_axis(number, ticks.tolist())
    number.plot(series["tick"] / scale, series["piles"], color=paper.INK)
    number.set(ylabel="piles", ylim=paper.limits_with_zero(series["piles"].tolist()))
    number.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    paper.panel_title(number, "d", "Piles")
    paper.time_axis(share, ticks.tolist())
    share.plot(series["tick"] / scale, series["together"], color=paper.INK)
    share.plot(series["tick"] / scale, series["by_chance"], color=paper.GREY, linestyle="--")
    share.set(ylabel="share of patches around", ylim=(0, 1.02))
    paper.panel_title(share, "e", "Chips beside their kind; dashes: by chance")
    return figure


def map_of_chips(axes: Axes, world: Any) -> None:
    """Draw the chips that lie on the ground, with a colour for each kind.

    Args:
        axes: to draw on.
        world: of a society.
    """
    span = (world.low - 0.5, world.high + 0.5)
    axes.imshow(
        world.chip.T, cmap=KINDS, vmin=0, vmax=KINDS.N - 1, origin="lower", extent=(*span, *span),
        interpolation="none",
    )  # fmt: skip
    axes.spines[["top", "right"]].set_visible(True)
    axes.set_xlabel("x (patches)")
