"""A sweep as a notebook shows it: what it is, how far it came, what came out, where it lies."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

from coglogo_py.border.html_table import as_html as table
from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.columns import ERROR, POINT, REPLICATE, RUN, SEED, STATUS, TICKS
from socialmind.runs.folders import FINISHED
from socialmind.runs.shown import PANEL, PANELS, as_picture

if TYPE_CHECKING:
    import pandas as pd

MOST_RUNS = 50_000
"""Of more runs no figure is drawn: showing a sweep is to take no time."""
OWN = (RUN, POINT, REPLICATE, SEED, STATUS, ERROR, TICKS)
MARK = 3.0
"""Size of a point, in points of print."""


def as_html(sweep: Any) -> str:
    """Return a sweep as HTML: a table, a small figure of its first outcomes, and the folder.

    Args:
        sweep: a `Sweep`.
    """
    manifest = sweep.manifest
    done = {name: number for name, number in manifest.counts.items() if number}
    counted = ", ".join(f"{number:,} {name.replace('_', ' ')}" for name, number in done.items())
    seconds = float(manifest.timings.get("seconds", 0.0))
    rows: list[tuple[str, object]] = [
        ("sweep of", manifest.model["name"]),
        ("varies", ", ".join(manifest.columns) or "nothing"),
        ("design", f"{manifest.design['name']}, {manifest.points:,} points"),
        ("replicates", f"{len(manifest.replicates['seeds']):,} seeds"),
        ("runs", f"{counted or 'none yet'}; of {manifest.ticks:,} ticks, in {seconds:,.0f} s"),
    ]
    if manifest.status != FINISHED:
        rows.append(("status", manifest.status))
    if manifest.fixed:
        rows.append(("set", ", ".join(f"{name} {one}" for name, one in manifest.fixed.items())))
    if manifest.measures:
        rows.append(("measures", ", ".join(manifest.measures)))
    if manifest.error is not None:
        rows.append(("error", manifest.error))
    drawn = _figure(sweep) if sum(done.values()) <= MOST_RUNS else ""
    return f"{table(rows)}{drawn}<p><code>{escape(str(sweep.folder))}</code></p>"


def _figure(sweep: Any) -> str:
    """Return the first outcomes over what varies first, the mean at each of its values."""
    varied = list(sweep.manifest.columns)
    try:
        runs: pd.DataFrame = sweep.runs
    except SocialmindError:  # none is safe yet, or it cannot be read: the table says how it is
        return ""
    finished = runs[runs[STATUS] == FINISHED]
    outcomes = [
        name
        for name in [*sweep.manifest.measures, *runs.columns]
        if name in runs and name not in (*OWN, *varied) and runs[name].dtype.kind in "bif"
    ]
    shown = list(dict.fromkeys(outcomes))[:PANELS]
    if not varied or not shown or finished.empty:
        return ""
    from socialmind.drawing import style as paper

    first = varied[0]
    with paper.style():
        figure, panels = paper.grid(len(shown), *PANEL)
        for axes, name in zip(panels, shown, strict=False):
            means = finished.groupby(first)[name].mean()
            axes.plot(means.index, means.astype(float), "o", ms=MARK, color=paper.BLUE)
            axes.set_title(name.replace("_", " "))
            axes.set_xlabel(first)
        return as_picture(figure, f"means over {first}")
