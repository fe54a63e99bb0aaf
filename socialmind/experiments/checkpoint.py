"""The one file that a run goes on from, and that says which parts of its tables count."""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from socialmind.errors import SocialmindError

_RECORD = "checkpoint"
_STATE = "state/"


@dataclass(frozen=True)
class Checkpoint:
    """A run at one tick.

    Args:
        tick: ticks done.
        recorded: for each table, the last tick whose rows its parts hold.
        parts: for each table, names of the parts that count, in order.
        idle: how often an agent found no available plan so far, and the first agent and tick.
        loop_seconds: time spent in the model's ticks so far.
        seconds: time spent in all so far.
        state: the model's state.
    """

    tick: int
    recorded: dict[str, int]
    parts: dict[str, list[str]]
    idle: dict[str, int | None]
    loop_seconds: float
    seconds: float
    state: Mapping[str, np.ndarray]

    def save(self, path: Path) -> None:
        """Write the file in one step: whenever the process is killed, a whole one stands there."""
        record = {
            "tick": self.tick,
            "recorded": self.recorded,
            "parts": self.parts,
            "idle": self.idle,
            "loop_seconds": self.loop_seconds,
            "seconds": self.seconds,
        }
        arrays: dict[str, Any] = {_STATE + name: array for name, array in self.state.items()}
        for name, array in self.state.items():
            if array.dtype.hasobject:
                raise SocialmindError(
                    f"the model's state {name!r} holds Python objects; "
                    "state() gives arrays of numbers, truth values or texts"
                )
        unfinished = path.with_name(path.name + ".partial")
        with unfinished.open("wb") as file:
            np.savez(file, **arrays | {_RECORD: np.array(json.dumps(record))})
            file.flush()
            os.fsync(file.fileno())
        unfinished.replace(path)

    @classmethod
    def load(cls, path: Path) -> Checkpoint:
        """Read a checkpoint.

        Raises:
            SocialmindError: the file is not a whole checkpoint.
        """
        try:
            with np.load(path, allow_pickle=False) as file:
                record = json.loads(str(file[_RECORD]))
                state = {
                    name.removeprefix(_STATE): file[name]
                    for name in file.files
                    if name.startswith(_STATE)
                }
            return cls(state=state, **record)
        except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
            raise SocialmindError(
                f"{path}: not a whole checkpoint ({error}); "
                "delete it and the run starts again from its first tick"
            ) from error
