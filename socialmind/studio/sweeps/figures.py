"""The figures that a sweep calls for, as SVG for the page."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

from socialmind.documents.labels import defaults_of, labels_of_sweep
from socialmind.drawing import style as paper
from socialmind.errors import SocialmindError
from socialmind.experiments.figures.of_sweeps import Wanted, draw_sweep
from socialmind.experiments.sweeps.result import Sweep
from socialmind.runs.sources import recorded_class

WIDTH = 130.0
"""Of a figure on the page, in mm."""


def drawn(folder: Path, outcome: str | None = None) -> dict[str, Any]:
    """Return the figures of a sweep: heat maps, responses and bands, with their captions.

    Args:
        folder: the sweep's; it may be going on.
        outcome: a measure or column of the runs' table; all measures by default.

    Returns:
        ``figures``: name, caption and SVG of each; ``notes``: what was left out, and why.

    Raises:
        SocialmindError: no run is finished, or nothing can be drawn.
    """
    sweep = Sweep(folder)
    try:
        model_class = recorded_class(sweep.capsule)
    except SocialmindError:
        model_class = None  # the axes lack its units
    labels = labels_of_sweep(sweep.manifest, model_class)
    wanted = Wanted((outcome,) if outcome else (), width=WIDTH, captions=False)
    found = draw_sweep(sweep, wanted, labels, defaults_of(model_class))
    figures = []
    with paper.style():
        for name, figure in found.figures.items():
            content = BytesIO()
            figure.savefig(content, format="svg", **paper.FORMS["svg"])
            caption = found.captions.get(name, "")
            figures.append({"name": name, "caption": caption, "svg": content.getvalue().decode()})
    return {"figures": figures, "notes": list(found.notes)}
