"""Drawing a run's figures into its folder: the model's own, or one of every series column."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.catalogue import load_figures
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


def draw_figures(folder: str | Path, trust: bool = False) -> list[Path]:
    """Draw a run's figures as PDF and PNG under ``figures/`` in its folder.

    The model's ``figures.py`` says which by ``draw(run: Run) -> dict[str, Figure]``; without that
    file there is one figure, ``series``. Matplotlib's settings are as before afterwards.

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
    """Every column of a run's series over time, one panel each.

    Args:
        run: a run.

    Returns:
        The figure.
    """
    from socialmind.drawing import style as paper

    series = run.series
    columns = [name for name in series.columns if name != "tick"]
    with paper.style():
        figure, panels = paper.grid(len(columns), *PANEL)
        for axes, name in zip(panels, columns, strict=True):
            scale = paper.time_axis(axes, list(series["tick"]))
            axes.plot(series["tick"] / scale, series[name].astype(float), color=paper.BLUE)
            axes.set_title(name.replace("_", " "))
    return figure


def _figures(run: Run, model: Path | None) -> dict[str, Figure]:
    """What the model's ``draw`` gives, or the figure of all series."""
    module = None if model is None else load_figures(model)
    if model is None or module is None:
        return {"series": draw_series(run)}
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
