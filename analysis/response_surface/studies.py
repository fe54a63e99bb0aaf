"""Artisans over the price of a tool and the intensity of demand: a response surface."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from socialmind.experiments.studies import Study, Way


def surface(way: Way, out: Path) -> list[Path]:
    """Sweep the grid, or take the kept runs of it, and write figure, table and page.

    Args:
        way: how the runs are come by.
        out: the folder.
    """
    from .surface import write_surface

    return write_surface(way, out)


studies = (
    Study(
        "response-surface",
        "artisans by the price of a tool and the intensity of demand",
        *(partial(surface, way) for way in (Way.FULL, Way.QUICK, Way.KEPT)),
    ),
)
