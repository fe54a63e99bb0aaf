"""The curve of a training: a row for each generation of each lesson of each attempt."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.learning.training import archive
from socialmind.learning.training.attempt import CHECKPOINT, load_checkpoint, results_of
from socialmind.learning.training.teaching import COLUMNS, VALIDATED
from socialmind.work.files import make_room

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

WHOLE = ("generation", "ticks")
"""The columns of whole numbers."""
PANEL = (58.0, 42.0)
"""Width and height of a lesson's panel, in mm."""


def read_curve(attempts: Iterable[tuple[int, Path]]) -> pd.DataFrame:
    """Return what attempts have done up to their last checkpoints.

    Args:
        attempts: their numbers and folders.

    Returns:
        Columns attempt, cycle, lesson, generation, best, mean, deviation, best_so_far, ticks,
        seconds; and validated, where a lesson has validation.
    """
    import pandas as pd

    parts = []
    for number, folder in attempts:
        for cycle, lesson, rows in _lessons(folder):
            columns = [*COLUMNS, VALIDATED][: rows.shape[1]]
            named = dict(zip(columns, rows.T, strict=True))
            part = pd.DataFrame({"attempt": number, "cycle": cycle, "lesson": lesson, **named})
            parts.append(part)
    if not parts:
        return pd.DataFrame(columns=["attempt", "cycle", "lesson", *COLUMNS])
    return pd.concat(parts, ignore_index=True).astype(dict.fromkeys(WHOLE, "int64"))


def _lessons(folder: Path) -> list[tuple[int, str, np.ndarray]]:
    """Return cycle, name and rows of each lesson of an attempt that has a generation."""
    if not (folder / CHECKPOINT).is_file():
        return []
    record, arrays = load_checkpoint(folder)
    found = []
    for file, told, own in results_of(folder, record["done"]):
        with archive.reading(file):
            found.append((told["cycle"], told["lesson"], checked_rows(own["rows"])))
    if record["in_hand"] is not None:
        with archive.reading(folder / CHECKPOINT):
            rows = checked_rows(arrays["teaching/rows"])
            found.append((record["position"][1], record["in_hand"], rows))
    return [one for one in found if len(one[2])]


def checked_rows(found: np.ndarray) -> np.ndarray:
    """Return the rows of a lesson as its file had them, (generations, columns).

    Raises:
        ValueError: they are no such rows.
    """
    columns = len(COLUMNS)
    if found.ndim == 1 and not len(found):
        return found
    if found.ndim != 2 or found.shape[1] not in (columns, columns + 1) or found.dtype.kind != "f":
        raise ValueError(f"rows of the shape {found.shape}")
    return found


def write_curve(curve: pd.DataFrame, path: Path) -> dict[str, Any]:
    """Write a curve as Parquet, in one step.

    Args:
        curve: the table.
        path: the file.

    Returns:
        ``rows``, ``columns`` and ``sha256`` of its content but for the seconds, which are never the
        same twice.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    from socialmind.runs.tables.digest import ContentDigest

    table = pa.Table.from_pandas(curve, preserve_index=False).replace_schema_metadata(None)
    unfinished = make_room(path.with_name(path.name + ".partial"))
    pq.write_table(table, unfinished, compression="zstd")
    unfinished.replace(path)
    lasting = table.drop_columns(["seconds"])
    digest = ContentDigest(lasting.schema)
    digest.update(lasting)
    return asdict(digest.content())


def draw_curve(curve: pd.DataFrame) -> Figure:
    """Draw the best individual's score in each generation (figures 6.2 to 6.5).

    A grey line is an attempt, blue is their median, a dot where one ends before the others.

    Args:
        curve: the table.

    Returns:
        A figure with a panel for each lesson, in the order of the curriculum.
    """
    from socialmind.drawing import style as paper

    lessons = list(dict.fromkeys(curve["lesson"]))
    with paper.style():
        figure, panels = paper.grid(len(lessons), *PANEL)
        for axes, lesson in zip(panels, lessons, strict=True):
            own = curve[curve["lesson"] == lesson]
            # Those of a lesson taught over and over follow upon each other.
            lines = [best.to_numpy() for _, best in own.groupby("attempt")["best"]]
            paper.attempts(axes, lines)
            axes.set_title(lesson)
            axes.set_xlabel("generation")
            axes.set_ylabel("score of the best")
    return figure
