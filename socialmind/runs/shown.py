"""A run as a notebook shows it: what it is, how far it came, its series, where its files are."""

from __future__ import annotations

import base64
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING, Any

from coglogo_py.border.html_table import as_html as table
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PANELS = 3
"""How many columns of the series the figure has at most."""
DOTS = 110
"""Pixels an inch."""
PANEL = (58.0, 40.0)
"""Width and height of a panel, in mm."""


def as_html(run: Any) -> str:
    """Return a run as HTML: a table, a small figure of its first series, and the folder.

    Args:
        run: a `Run`.
    """
    manifest = run.manifest
    rows: list[tuple[str, object]] = [
        ("model", run.model),
        ("seed", run.seed),
        ("ticks", f"{run.ticks:,} of {manifest.ticks:,}, {manifest.status}"),
        ("parameters", ", ".join(f"{name} {value}" for name, value in run.parameters.items())),
    ]
    if manifest.branch is not None:
        said = manifest.branch
        changes = ", ".join(said["change"]) or "nothing changed"
        rows.append(("branch", f"of {said['run']} at tick {said['tick']:,}: {changes}"))
    if manifest.error is not None:
        rows.append(("error", manifest.error))
    return f"{table(rows)}{_figure(run)}<p><code>{escape(str(run.folder))}</code></p>"


def _figure(run: Any) -> str:
    """Return the first columns of numbers of the series as a picture, if there are any."""
    try:
        series = run.series
    except SocialmindError:  # nothing is safe yet, or it cannot be read: the table says how it is
        return ""
    columns = [one for one in series.columns if one != "tick" and series[one].dtype.kind in "bif"]
    if not columns or series.empty:
        return ""
    from socialmind.drawing import style as paper

    with paper.style():
        figure, panels = paper.grid(len(columns[:PANELS]), *PANEL)
        for axes, name in zip(panels, columns, strict=False):
            scale = paper.time_axis(axes, list(series["tick"]))
            axes.plot(series["tick"] / scale, series[name].astype(float), color=paper.BLUE)
            axes.set_title(name.replace("_", " "))
        return as_picture(figure, "series of the run")


def as_picture(figure: Figure, words: str) -> str:
    """Return a small figure as HTML that holds it, on white whatever stands around.

    Args:
        figure: what is shown.
        words: what that is, for who cannot see it.
    """
    content = BytesIO()
    figure.savefig(content, format="png", dpi=DOTS, facecolor="white")
    picture = base64.b64encode(content.getvalue()).decode("ascii")
    return f'<img alt="{escape(words)}" src="data:image/png;base64,{picture}">'
