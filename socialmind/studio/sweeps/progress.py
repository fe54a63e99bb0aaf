"""How far a sweep came: runs by status, how fast they come, those that failed."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pandas as pd

from socialmind.experiments.sweeps.columns import ERROR, POINT, REPLICATE, RUN, SEED, STATUS
from socialmind.experiments.sweeps.result import Sweep
from socialmind.runs.folders import FINISHED, RUNNING, is_held

MOST_ROWS = 500
"""Runs that a page is told of, the failed ones first, then those done last."""
WAITING = ("pending", "running")


def told(folder: Path) -> dict[str, Any]:
    """Return what a page shows of a sweep.

    Args:
        folder: the sweep's; it may be going on.

    Raises:
        SocialmindError: it is no sweep's folder, or a table cannot be read.
    """
    sweep = Sweep(folder)
    runs = sweep.runs
    manifest = sweep.manifest
    counts = {str(name): int(number) for name, number in runs[STATUS].value_counts().items()}
    done = sum(number for name, number in counts.items() if name not in WAITING)
    going = manifest.status == RUNNING and is_held(folder)
    return {
        "model": manifest.model["name"],
        "status": manifest.status if manifest.status != RUNNING or going else "interrupted",
        "error": manifest.error,
        "design": manifest.design["name"],
        "points": manifest.points,
        "varied": list(manifest.columns),
        "measures": list(manifest.measures),
        "ticks": manifest.ticks,
        "runs": len(runs),
        "done": done,
        "counts": counts,
        **_pace(folder, float(manifest.timings.get("seconds", 0.0)), done, len(runs), going),
        "failed": _rows(sweep, runs[~runs[STATUS].isin([FINISHED, *WAITING])], with_error=True),
        "latest": _rows(sweep, runs[runs[STATUS] == FINISHED].iloc[::-1]),
    }


def _pace(folder: Path, seconds: float, done: int, runs: int, going: bool) -> dict[str, Any]:
    """Return runs a second and the seconds left, of a sweep that goes on by its last parts."""
    if not going:
        return {"rate": done / seconds if seconds > 0 and done else None, "left": None}
    parts = sorted((folder / "parts" / "runs").glob("*.parquet"))
    begun = (folder / "design.parquet").stat().st_mtime
    passed = (parts[-1].stat().st_mtime if parts else time.time()) - begun
    if done == 0 or passed <= 0:
        return {"rate": None, "left": None}
    rate = done / passed
    return {"rate": rate, "left": max(0.0, (runs - done) / rate)}


def _rows(sweep: Sweep, runs: pd.DataFrame, with_error: bool = False) -> list[dict[str, Any]]:
    """Return runs as rows of a page: number, seed, what varies, measures."""
    shown = [*sweep.varied, *sweep.manifest.measures]
    columns = [RUN, POINT, REPLICATE, SEED, STATUS, *([ERROR] if with_error else [])]
    columns += [name for name in shown if name in runs and name not in columns]
    kept = runs[[name for name in columns if name in runs]].head(MOST_ROWS)
    kept = kept.assign(**{SEED: kept[SEED].astype(str)})  # a page's numbers have but 53 bits
    return [
        {str(name): _plain(value) for name, value in row.items()} for row in kept.to_dict("records")
    ]


def _plain(value: Any) -> Any:
    if value is None or value is pd.NA or (isinstance(value, float) and value != value):
        return None
    return value.item() if hasattr(value, "item") else value
