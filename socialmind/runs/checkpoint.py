"""The one file that a run goes on from, and that says which parts of its tables count."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import numpy as np

from coglogo_py.border.numbers import is_whole
from socialmind.errors import SocialmindError
from socialmind.runs import record as kinds
from socialmind.runs.arrays_file import load_arrays, save_arrays
from socialmind.runs.capsule import IDLE
from socialmind.runs.record import check_record
from socialmind.runs.tables.files import check_part, part_name
from socialmind.runs.tables.names import FURTHER, TABLES

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
        sums: size in bytes and SHA-256 of each part; checkpoints of before have none.
        run: what the manifest says that decides the result, as a hash; likewise.
    """

    tick: int
    recorded: dict[str, int]
    parts: dict[str, list[str]]
    idle: dict[str, int | None]
    loop_seconds: float
    seconds: float
    state: Mapping[str, np.ndarray]
    sums: dict[str, list[Any]] = field(default_factory=dict)
    run: str | None = None

    def save(self, path: Path) -> None:
        """Write the file in one step: whenever the process is killed, a whole one stands there."""
        for name, array in self.state.items():
            if array.dtype.hasobject:
                raise SocialmindError(
                    f"the model's state {name!r} holds Python objects; "
                    "state() gives arrays of numbers, truth values or texts"
                )
        record = {one.name: getattr(self, one.name) for one in fields(self) if one.name != "state"}
        arrays: dict[str, Any] = {_STATE + name: array for name, array in self.state.items()}
        save_arrays(path, record, arrays, _RECORD)

    @classmethod
    def load(cls, path: Path) -> Checkpoint:
        """Read a checkpoint.

        Raises:
            SocialmindError: the file is not a whole checkpoint.
        """
        try:
            record, arrays = load_arrays(path, _RECORD)
            check_record(record, _FIELDS, str(path))
            for name, parts in record["parts"].items():
                if parts != [part_name(name, number) for number in range(len(parts))]:
                    raise ValueError(f"its parts of {name} are not numbered")
        except (OSError, ValueError) as error:
            raise SocialmindError(
                f"{path}: not a whole checkpoint ({error}); "
                "delete it and the run starts again from its first tick"
            ) from error
        known = {one.name for one in fields(cls)}
        state = {name.removeprefix(_STATE): one for name, one in arrays.items()}
        return cls(state=state, **{key: one for key, one in record.items() if key in known})

    def check_parts(self, folder: Path) -> None:
        """Look at every part of the tables before anything is written.

        Args:
            folder: of the parts.

        Raises:
            SocialmindError: one is missing or is not what the run wrote.
        """
        for parts in self.parts.values():
            for part in parts:
                check_part(folder / part, self.sums.get(part))


_AT = kinds.whole(-1)
_PARTS = kinds.Many(kinds.TEXT)
_FIELDS = kinds.Fields(
    {
        "tick": kinds.whole(),
        "recorded": kinds.Fields(dict.fromkeys(TABLES, _AT), dict.fromkeys(FURTHER, _AT)),
        "parts": kinds.Fields(dict.fromkeys(TABLES, _PARTS), dict.fromkeys(FURTHER, _PARTS)),
        "idle": IDLE,
        "loop_seconds": kinds.NUMBER,
        "seconds": kinds.NUMBER,
    },
    {
        "sums": kinds.Each(
            kinds.Many(
                kinds.Kind(
                    "a size and a hash", lambda value: is_whole(value) or kinds.SHA256.holds(value)
                )
            )
        ),
        "run": kinds.optional(kinds.SHA256),
    },
)
