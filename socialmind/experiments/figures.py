"""Drawing a run's figures into its folder: the model's own, or one of every series column."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.catalogue import load_figures
from socialmind.errors import ModelError
from socialmind.experiments.capsule import Capsule
from socialmind.experiments.result import Run
from socialmind.experiments.sources import recorded_folder

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PNG_DOTS_PER_INCH = 200


def draw_figures(folder: str | Path) -> list[Path]:
    """Draw a run's figures as PDF and PNG under ``figures/`` in its folder.

    The model's ``figures.py`` says which by ``draw(run: Run) -> dict[str, Figure]``; without that
    file there is one figure, ``series``. Matplotlib's settings are as before afterwards.

    Args:
        folder: the run's.

    Returns:
        The files written.

    Raises:
        SocialmindError: the run cannot be read, or ``draw`` does not give figures by name.
    """
    import matplotlib

    model = recorded_folder(Capsule(folder))
    run = Run(folder)
    module = None if model is None else load_figures(model)
    written = []
    with matplotlib.rc_context():
        figures = {"series": draw_series(run)} if module is None else module.draw(run)
        _check(figures, None if module is None else module.__file__)
        home = run.folder / "figures"
        home.mkdir(exist_ok=True)
        for name, figure in figures.items():
            for suffix, options in (
                # Without a date the same run gives the same file.
                ("pdf", {"metadata": {"CreationDate": None}}),
                ("png", {"dpi": PNG_DOTS_PER_INCH}),
            ):
                path = home / f"{name}.{suffix}"
                figure.savefig(path, **options)
                written.append(path)
    if "matplotlib.pyplot" in sys.modules:  # else pyplot keeps the figures it made
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
    from matplotlib.figure import Figure

    series = run.series
    columns = [name for name in series.columns if name != "tick"]
    across = min(3, max(1, len(columns)))
    down = max(1, -(-len(columns) // across))
    figure = Figure(figsize=(2.4 * across, 1.8 * down), layout="constrained")
    panels = figure.subplots(down, across, sharex=True, squeeze=False)
    for axes, name in zip(panels.flat, columns, strict=False):
        axes.plot(series["tick"], series[name].astype(float), color="#0072B2", linewidth=1)
        axes.set_title(name.replace("_", " "), fontsize=8, loc="left")
        axes.tick_params(labelsize=7)
        axes.spines[["top", "right"]].set_visible(False)
    for axes in panels.flat[len(columns) :]:
        axes.set_visible(False)
    figure.supxlabel("tick", fontsize=8)
    return figure


def _check(figures: object, file: str | None) -> None:
    """Raise unless `figures` are figures by names that do for files."""
    from matplotlib.figure import Figure

    if isinstance(figures, dict):
        odd = [
            f"{name!r}: {type(figure).__name__}"
            for name, figure in figures.items()
            if not isinstance(figure, Figure) or not str(name).replace("-", "_").isidentifier()
        ]
        found = ", ".join(odd)
    else:
        found = type(figures).__name__
    if found:
        raise ModelError(
            f"draw(run) giving {found}",
            "a dictionary of matplotlib figures by name",
            "return {'name': figure}; a name holds letters, digits, - and _",
            file,
        )
