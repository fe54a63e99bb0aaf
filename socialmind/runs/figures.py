"""Drawing a run's figures into its folder: the model's own, or its series and a map."""

from __future__ import annotations

import math
import sys
from itertools import cycle
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from matplotlib.ticker import MaxNLocator

from socialmind.catalogue import load_figures
from socialmind.drawing.style import BLUE, GOLD, INK, PURPLE, RED
from socialmind.errors import ModelError, SocialmindError
from socialmind.runs.capsule import Capsule
from socialmind.runs.result import Run
from socialmind.runs.sources import recorded_folder
from socialmind.sources.folders import FIGURES_FILE
from socialmind.sources.loading import failure_in_model
from socialmind.sources.trust import programs_in, require

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PANEL = (58.0, 40.0)
"""Width and height of a panel of the figure of all series, in mm."""
LINES = (BLUE, RED, GOLD, PURPLE, INK)
"""Colours of lines and agents that are told apart."""
MARKS = ("o", "s", "^", "D", "v")
"""Of agents: blue and red are equally dark in print without colours."""
ALIKE = 20.0
"""How many times as large as another a number may be in the same panel."""


def draw_figures(folder: str | Path, trust: bool = False) -> list[Path]:
    """Draw a run's figures as PDF and PNG under ``figures/`` in its folder.

    The model's ``figures.py`` says which by ``draw(run: Run) -> dict[str, Figure]``; without that
    file there is one of its ``series``, and a ``map`` where agents have places. Matplotlib's
    settings are as before afterwards.

    Args:
        folder: the run's.
        trust: run programs that this user has neither named nor run before.

    Returns:
        The files written.

    Raises:
        SocialmindError: the run cannot be read, or ``draw`` fails or gives no figures by name.
    """
    import matplotlib as mpl

    from socialmind.drawing import style as paper

    run = Run(folder, trust)
    home = run.folder / "figures"
    model = recorded_folder(Capsule(folder))
    if model is not None:
        require(programs_in(model), trust, f"{run.folder}: its model at {model}", edited=True)
    with mpl.rc_context():
        figures = _figures(run, model)
        written = paper.save(figures, home)
    if "matplotlib.pyplot" in sys.modules:  # which keeps the figures that were made with it
        from matplotlib import pyplot

        for figure in figures.values():
            pyplot.close(figure)
    return written


def draw_series(run: Run) -> Figure:
    """Every column of a run's series over time; numbers of about one size in one panel.

    Args:
        run: a run.

    Returns:
        The figure.
    """
    from socialmind.drawing import style as paper

    series = run.series
    groups = together(series.drop(columns="tick"))
    with paper.style():
        figure, panels = paper.grid(len(groups), *PANEL)
        for axes, names in zip(panels, groups, strict=True):
            scale = paper.time_axis(axes, list(series["tick"]))
            axes.set_ylim(*paper.limits_with_zero(series[names].astype(float).to_numpy().ravel()))
            for name, colour in zip(names, cycle(LINES), strict=False):
                values = series[name].astype(float)
                axes.plot(series["tick"] / scale, values, color=colour)
            if len(names) > 1:
                last = [float(series[name].iloc[-1]) for name in names]
                said = [name.replace("_", " ") for name in names]
                paper.label_ends(axes, list(zip(last, said, cycle(LINES), strict=False)))
            axes.set_title("numbers" if len(names) > 1 else names[0].replace("_", " "))
            if series[names].dtypes.map(lambda one: one.kind == "i").all():
                axes.set_ylabel("number")
                axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    return figure


def together(series: pd.DataFrame) -> list[list[str]]:
    """Return the columns of each panel: whole numbers of about one size share one.

    Args:
        series: without its ticks.

    >>> import pandas as pd
    >>> together(pd.DataFrame({"wolves": [10, 90], "sheep": [200, 80], "heat": [0.5, 0.7]}))
    [['wolves', 'sheep'], ['heat']]
    """
    groups: list[list[str]] = []
    largest: list[float] = []
    for name in map(str, series.columns):
        whole = series[name].dtype.kind == "i"
        size = max(float(series[name].abs().max()), 1.0) if whole and len(series) else math.inf
        near = (
            place
            for place, (group, other) in enumerate(zip(groups, largest, strict=True))
            if max(size, other) <= ALIKE * min(size, other) and len(group) < len(LINES)
        )
        place = next(near, None) if math.isfinite(size) else None
        if place is None:
            groups.append([name])
            largest.append(size)
        else:
            groups[place].append(name)
            largest[place] = max(size, largest[place])
    return groups


def draw_map(run: Run) -> Figure | None:
    """Where the agents were at the last record, if they have places.

    Args:
        run: a run.

    Returns:
        The figure; None where nobody has a place.
    """
    from socialmind.drawing import style as paper

    if "agents" not in run.manifest.tables or not {"x", "y"} <= set(run.agents.columns):
        return None
    now = run.agents[run.agents["tick"] == run.agents["tick"].max()].dropna(subset=["x", "y"])
    if now.empty:
        return None
    with paper.style():
        figure = paper.figure(paper.COLUMN, paper.COLUMN)
        axes = figure.subplots()
        kinds = now["population"] if "population" in now else pd.Series("", now.index)
        looks = zip(cycle(LINES), cycle(MARKS), strict=False)
        for (kind, own), (colour, mark) in zip(now.groupby(kinds, sort=False), looks, strict=False):
            axes.scatter(own["x"], own["y"], s=9, color=colour, marker=mark, linewidths=0,
                         label=str(kind).replace("_", " "), rasterized=len(own) > 2000)  # fmt: skip
        # As wide as anybody ever went: a few agents at the end would span next to nothing.
        ever = run.agents[["x", "y"]].to_numpy(float)
        low, high = np.nanmin(ever) - 1.0, np.nanmax(ever) + 1.0
        axes.set(aspect="equal", xlim=(low, high), ylim=(low, high), xlabel="x", ylabel="y")
        axes.set_title(f"agents at tick {int(now['tick'].iloc[0]):,}")
        if kinds.nunique() > 1:
            figure.legend(loc="outside lower center", ncols=3)
    return figure


def _figures(run: Run, model: Path | None) -> dict[str, Figure]:
    """What the model's ``draw`` gives, or the figure of all series."""
    module = None if model is None else load_figures(model)
    if model is None or module is None:
        places = draw_map(run)
        return {"series": draw_series(run)} | ({} if places is None else {"map": places})
    path = model / FIGURES_FILE
    try:
        figures = module.draw(run)
    except SocialmindError:
        raise
    except Exception as error:
        raise failure_in_model(error, path, "draw(run)") from error
    odd = _odd(figures)
    if odd:
        raise ModelError(
            f"draw(run) giving {odd}",
            "a dictionary of matplotlib figures by name",
            "return {'name': figure}; a name holds letters, digits, - and _",
            path,
        )
    return dict(figures)


def _odd(figures: Any) -> str:
    """What is wrong with the answer of a ``draw``; empty when it is right."""
    from matplotlib.figure import Figure

    if not isinstance(figures, dict):
        return type(figures).__name__
    return ", ".join(
        f"{name!r}: {type(figure).__name__}"
        for name, figure in figures.items()
        if not isinstance(figure, Figure) or not str(name).replace("-", "_").isidentifier()
    )
