"""What all societies of a class share: layouts, the classes of their rows, schemes read from files.

It is made when the first society needs it, and lives as long as the class.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.files.reading import content_of, text_of
from socialmind.agents.message import NEXT, first_message
from socialmind.agents.plan_steps import ENDED
from socialmind.agents.rows import HeldRow, Row, held_class, row_class
from socialmind.compiling.layout import Asked, asked_for, model_dtype, row_dtype
from socialmind.fields import set_default
from socialmind.language.arithmetic import turned
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape, PopulationShape

if TYPE_CHECKING:
    from coglogo_py.decision import DecisionMaker
    from socialmind.mind.files.kept_minds import KeptMinds

KEPT = ("tick", "idle", "idle_agent", "idle_tick")
"""Columns of the record with a leading underscore that are state, beside the world's own."""
KEPT_SCHEMES = 64
"""So many schemes of files a class keeps, those that came last."""


class Blueprint:
    """What the societies of a class share.

    Args:
        shape: the class's.

    Attributes:
        tables: what a population's tables have in common, by its name.
        schemes: the schemes of files.
    """

    def __init__(self, shape: ModelShape) -> None:
        self._shape = shape
        self.tables = {name: TableForm(one) for name, one in shape.populations.items()}
        self.schemes = SchemeFiles()

    @cached_property
    def minds(self) -> KeptMinds:
        """The hierarchies of skills of folders."""
        from socialmind.mind.files.kept_minds import KeptMinds

        return KeptMinds()

    def record_of(self, program: Program, conditioned: tuple[str, ...]) -> RecordForm:
        """Return the layout of a society's record; arguments as of `asked_for`."""
        key = "record", conditioned
        if key not in program.made:
            program.made[key] = RecordForm(self._shape, asked_for(program, conditioned))
        found: RecordForm = program.made[key]
        return found


class RecordForm:
    """The record of a society: parameters, variables, and where its arrays are.

    Args:
        shape: the class's.
        asked: what its rules and minds ask for.

    Attributes:
        dtype: the record.
        kept: the columns that are state, and not addresses and sizes.
    """

    def __init__(self, shape: ModelShape, asked: Asked) -> None:
        self.dtype = model_dtype(shape, asked)
        kept = {f"_{one}" for one in (*KEPT, *shape.world.kept_columns)}
        names = self.dtype.names or ()
        self.kept = [n for n in names if n[0] != "_" or n.startswith("_has_") or n in kept]
        self._places: dict[tuple[str, ...], NDArray[np.int64]] = {}

    def new(self) -> NDArray[Any]:
        """Return the record of a new society, an array of one over words of eight bytes."""
        return np.zeros(self.dtype.itemsize // 8, np.int64).view(self.dtype)

    @cached_property
    def kept_bits(self) -> NDArray[np.int64]:
        """The bits of a record that are state."""
        bits = np.zeros(self.dtype.itemsize, np.uint8)
        for name in self.kept:
            column, place, *_ = self.dtype.fields[name]  # type: ignore[index]
            bits[place : place + column.itemsize] = 0xFF
        return bits.view(np.int64)

    def places_of(
        self, arrays: tuple[str, ...], columns: Callable[[], list[str]]
    ) -> NDArray[np.int64]:
        """Return which words of the record hold columns of eight bytes.

        Args:
            arrays: what tells them from others.
            columns: gives their names.
        """
        if arrays not in self._places:
            places = [self.dtype.fields[name][1] for name in columns()]  # type: ignore[index]
            self._places[arrays] = np.array(places) // 8
        return self._places[arrays]


class TableForm:
    """What the tables of a population have in common in all societies of a class.

    Args:
        shape: the population's.
    """

    def __init__(self, shape: PopulationShape) -> None:
        self._shape = shape
        self._classes: dict[frozenset[str], tuple[type[Row], type[HeldRow]]] = {}

    @cached_property
    def dtype(self) -> np.dtype[Any]:
        """The record of an agent."""
        return row_dtype(dict(self._shape.fields), self._shape)

    @cached_property
    def default(self) -> NDArray[Any]:
        """An agent as its class declares it, an array of one that stays as it is."""
        agent = np.zeros(1, self.dtype)
        for field in self._shape.fields.values():
            set_default(agent, field)
        if self._shape.minded:
            agent["_mind"] = agent["_plan"] = agent["_decided"] = -1
        if self._shape.steps is not None:
            agent["_step"] = ENDED
        if self._shape.messages_to is not None:
            agent[NEXT] = -1
        for messages in self._shape.mailboxes:
            agent[first_message(messages)] = -1
        if "heading" in self._shape.fields:
            agent["heading"] = turned(agent["heading"].item())
        agent.flags.writeable = False
        return agent

    def row_classes(self, kept: Iterable[str]) -> tuple[type[Row], type[HeldRow]]:
        """Return the classes of rows as rules and as users hold them.

        Args:
            kept: the fields whose values the world brings back into it, or refuses.
        """
        names = frozenset(kept)
        if names not in self._classes:
            bare = row_class(self._shape, names)
            self._classes[names] = bare, held_class(bare, self._shape)
        return self._classes[names]


class SchemeFiles:
    """The schemes of files: a file is looked into each time, and understood once."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, tuple[Any, ...]], tuple[bytes, CognitiveScheme]] = {}

    def load(self, path: Path, makers: tuple[type[DecisionMaker], ...]) -> CognitiveScheme:
        """Return the scheme of a file as it is now; arguments as of `CognitiveScheme.load`."""
        content = content_of(path)
        known = self._known.get((str(path), makers))
        if known is not None and known[0] == content:
            return known[1]
        scheme = CognitiveScheme.parsed(text_of(content, path, latin_1=True), path, makers)
        while len(self._known) >= KEPT_SCHEMES:
            self._known.pop(next(iter(self._known)), None)
        self._known[str(path), makers] = content, scheme
        return scheme
