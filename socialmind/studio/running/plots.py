"""What panels of plots show of agents: histograms of a value, scatters of two; and as tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.model import Model
from socialmind.studio.running.colouring import NOTHING, Coloured, of_agents

BINS = 24
POINTS = 3000
"""Points of a scatter that a page is sent at most, every second, third … agent of more."""


@dataclass(frozen=True)
class Panel:
    """A panel at a moment.

    Attributes:
        said: what the header of a frame says of it.
        columns: the numbers, by name.
    """

    said: Mapping[str, Any]
    columns: Mapping[str, NDArray[Any]] = field(default_factory=dict)


def panel_of(society: Model, panel: Mapping[str, Any]) -> Panel:
    """Return what a panel shows of a society at this moment.

    Args:
        society: as it is.
        panel: ``kind``: "histogram" of ``x``, or "scatter" of ``x`` and ``y``, colourings of a
            ``population`` such as "field wheat"; others, such as "series", show nothing of agents.

    Raises:
        SocialmindError: there is no such population or value.
    """
    kind = panel.get("kind")
    if kind not in ("histogram", "scatter"):
        return Panel({"kind": kind})
    x = _values(society, panel, "x")
    said = {name: panel.get(name) for name in ("kind", "population", "x", "y")}
    if kind == "histogram":
        return _histogram(x, said)
    known = x.values, _values(society, panel, "y").values
    step = max(1, -(-len(known[0]) // POINTS))
    across, up = (_numbers(one[::step]) for one in known)
    order = np.argsort(across, kind="stable")
    return Panel(said, {"x": across[order], "y": up[order]})


def table_of(
    society: Model, panel: Mapping[str, Any], history: Mapping[str, list[Any]]
) -> dict[str, list[Any]]:
    """Return what a panel shows as columns of a table, with nothing left out.

    Args:
        society: as it is.
        panel: as of `panel_of`; ``kind`` "series" has ``names``.
        history: the series so far.

    Raises:
        SocialmindError: there is no such population, value or series.
    """
    if panel.get("kind") == "series":
        names = [name for name in panel.get("names", ()) if name in history]
        return {name: list(history[name]) for name in ("tick", *names)}
    table = society.tables.get(str(panel.get("population")))
    if table is None:
        raise SocialmindError(f"no population {panel.get('population')!r}")
    columns: dict[str, list[Any]] = {"agent": table.id.tolist()}
    for axis in ("x", "y") if panel.get("kind") == "scatter" else ("x",):
        found = _values(society, panel, axis)
        values: list[Any] = found.values.tolist()
        if found.words:
            values = [None if one == NOTHING else found.words[one] for one in values]
        columns[str(panel[axis]).partition(" ")[2] or str(panel[axis])] = [
            None if one != one else one for one in values
        ]
    return columns


def _values(society: Model, panel: Mapping[str, Any], axis: str) -> Coloured:
    population = panel.get("population")
    if population not in society.populations:
        raise SocialmindError(f"no population {population!r}")
    return of_agents(society, str(population), str(panel.get(axis)))


def _histogram(found: Coloured, said: dict[str, Any]) -> Panel:
    if found.words:
        counts = np.bincount(found.values, minlength=NOTHING + 1)[: len(found.words)]
        return Panel({**said, "words": list(found.words)}, {"counts": counts.astype(np.uint32)})
    known = found.values[np.isfinite(found.values)]
    low, high = (float(known.min()), float(known.max())) if len(known) else (0.0, 1.0)
    whole = len(known) > 0 and high - low < BINS and bool((known == np.round(known)).all())
    bins = int(high - low) + 1 if whole else BINS
    ends = (low - 0.5, high + 0.5) if whole else (low, high if high > low else low + 1.0)
    counts, _ = np.histogram(known, bins, ends)
    return Panel({**said, "low": ends[0], "high": ends[1]}, {"counts": counts.astype(np.uint32)})


def _numbers(values: NDArray[Any]) -> NDArray[np.float32]:
    numbers = values.astype(np.float32)
    if values.dtype == np.uint8:
        numbers[values == NOTHING] = np.nan
    return numbers
