"""What the runs of a sweep came to, point by point and replicate by replicate."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.sweeps.columns import POINT, REPLICATE, STATUS, Names
from socialmind.experiments.sweeps.result import Sweep
from socialmind.runs.folders import FINISHED

if TYPE_CHECKING:
    import pandas as pd

SAME = 1e-12
"""Outputs that differ by less, beside their size, are the same."""


@dataclass(frozen=True)
class Response:
    """An output at the points of a design.

    Attributes:
        name: of the output.
        values: (points, replicates); NaN where there is no run, or no number of it.
        common: whether replicate r has the same seed at every point.
    """

    name: str
    values: NDArray[np.float64]
    common: bool

    @cached_property
    def counts(self) -> NDArray[np.int64]:
        """How many runs each point has that came to a number."""
        return np.isfinite(self.values).sum(axis=1)

    @cached_property
    def means(self) -> NDArray[np.float64]:
        """The mean over the runs of each point; NaN where there is none."""
        total = np.where(np.isfinite(self.values), self.values, 0.0).sum(axis=1)
        return np.divide(total, self.counts, out=np.full(len(total), np.nan), where=self.counts > 0)

    @property
    def constant(self) -> bool:
        """Whether it is the same at all points."""
        known = self.means[np.isfinite(self.means)]
        if not len(known):
            return False
        return float(np.ptp(known)) <= SAME * max(float(np.abs(known).max()), 1e-300)

    def at(self, points: NDArray[np.bool_]) -> Response:
        """Return the output at some of the points."""
        return Response(self.name, self.values[points], self.common)


@dataclass(frozen=True)
class Swept:
    """What is known of a sweep's outputs.

    Attributes:
        folder: the sweep's.
        made: how its design was made, as the manifest says.
        points: (points, columns) what varies, in the order of the design.
        outputs: those asked for, or all.
        unfinished: of the runs that did not finish, how many there are, by what became of them.
        asked: whether the outputs were asked for by name.
    """

    folder: Path
    made: Mapping[str, Any]
    points: pd.DataFrame
    outputs: tuple[Response, ...]
    unfinished: Mapping[str, int]
    asked: bool

    @property
    def resumed(self) -> str:
        """The command that does the runs that are missing."""
        return f"`socialmind sweep --resume {shlex.quote(str(self.folder))} --retry`"

    def lacking(self, output: Response) -> str:
        """Return why points have no number of an output, in words; empty where all have one.

        >>> lacking = Swept(Path("s"), {}, None, (), {"failed": 2}, False).lacking
        >>> lacking(Response("y", np.array([[1.0], [np.nan], [np.nan]]), False))
        '2 of 3 points have no value of y (1, 2); runs that did not finish: 2 failed'
        """
        bare = np.flatnonzero(output.counts == 0)
        if not len(bare):
            return ""
        some = ", ".join(map(str, bare[:5].tolist())) + (", …" if len(bare) > 5 else "")
        what = "point has" if len(bare) == 1 else "points have"
        said = f"{len(bare):,} of {len(output.counts):,} {what} no value of {output.name} ({some})"
        if not self.unfinished:
            return f"{said}: their runs finished without a finite number"
        unfinished = ", ".join(f"{n:,} {what}" for what, n in self.unfinished.items())
        return f"{said}; runs that did not finish: {unfinished}"


def read_responses(sweep: Sweep | str | Path, of: Sequence[str] | None = None) -> Swept:
    """Return the outputs of a sweep.

    Args:
        sweep: or its folder; it may be stopped.
        of: measures or columns of the series' end, as `runs.parquet` calls them; by default all
            measures that are numbers, or where there are none, all ends of the series.

    Raises:
        SocialmindError: no sweep's folder, no run that finished, nothing that varies, or no such
            output.
    """
    found = sweep if isinstance(sweep, Sweep) else Sweep(sweep)
    manifest = found.manifest
    if not manifest.columns:
        raise SocialmindError(f"{found.folder}: nothing varies in this sweep; give it a design")
    names = Names(tuple(manifest.columns), tuple(manifest.measures))
    runs = found.runs
    finished = runs[runs[STATUS] == FINISHED]
    unfinished = _unfinished(runs, manifest.points * len(manifest.replicates["seeds"]))
    if not len(finished):
        said = ", ".join(f"{n:,} {what}" for what, n in unfinished.items())
        raise SocialmindError(
            f"{found.folder}: no run has finished ({said}); `socialmind sweep --resume` goes on"
        )
    chosen = _outputs(finished, names, manifest.series_columns, of, found.folder)
    common = bool(manifest.replicates["common"])
    shape = manifest.points, int(finished[REPLICATE].max()) + 1
    place = finished[POINT].to_numpy(np.int64), finished[REPLICATE].to_numpy(np.int64)
    responses = []
    for name in chosen:
        values = np.full(shape, np.nan)
        column = finished[name].to_numpy(np.float64, na_value=np.nan)
        values[place] = np.where(np.isfinite(column), column, np.nan)
        responses.append(Response(name, values, common))
    points = found.design.sort_values(POINT, kind="stable", ignore_index=True)
    renamed = {names.of_varied(name): name for name in manifest.columns}
    points = points[list(renamed)].rename(columns=renamed)
    asked = of is not None
    return Swept(found.folder, manifest.design, points, tuple(responses), unfinished, asked)


def _unfinished(runs: pd.DataFrame, expected: int) -> dict[str, int]:
    """Return how many runs did not finish, by what became of them."""
    counts = {
        str(name).replace("_", " "): int(count)
        for name, count in runs[STATUS].value_counts(sort=False).sort_index().items()
        if name != FINISHED
    }
    missing = counts.pop("pending", 0) + max(expected - len(runs), 0)
    return counts | ({"not run yet": missing} if missing else {})


def _outputs(
    runs: pd.DataFrame,
    names: Names,
    series: Sequence[str],
    of: Sequence[str] | None,
    folder: Path,
) -> list[str]:
    """Return the columns that are outputs and hold numbers: those asked for, or all."""
    measures = [name for name in names.measures if name in runs and _is_number(runs[name])]
    ends = [names.of_series(name) for name in series]
    ends = [name for name in ends if name in runs and _is_number(runs[name])]
    if not measures and not ends:
        raise SocialmindError(f"{folder}: its runs have no output that is a number; --measure one")
    if of is None:
        return measures or ends
    for name in of:
        if name in names.varied and f"series.{name}" in ends:
            raise SocialmindError(
                f"{name} is what varies; the end of its series is called series.{name}"
            )
        if name not in (*measures, *ends):
            hint = nearest(name, [*measures, *ends])
            if name in names.varied:
                raise SocialmindError(f"{name} is what varies, no output; {hint}")
            raise SocialmindError(f"{folder}: no output {name!r} that is a number; {hint}")
    return list(dict.fromkeys(of))


def _is_number(column: pd.Series) -> bool:
    import pandas as pd

    kind = column.dtype
    return bool(pd.api.types.is_numeric_dtype(kind) and column.notna().any())
