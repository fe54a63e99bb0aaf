"""Recordings: what a source answered to the inputs that it met, episode by episode."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.numbers import whole_number
from socialmind.errors import ModelError
from socialmind.mind import Skill

EPISODE = "episode"
"""The column of a table that says which episode a line belongs to."""


@dataclass(frozen=True, eq=False)
class Recording:
    """Inputs and the source's outputs to them, in the order in which they came.

    Args:
        inputs: shape (records, inputs of the skill), 0 … 1.
        outputs: shape (records, outputs of the skill), 0 … 1.
        lengths: how many records each episode has, one after another; None for a single episode.

    Raises:
        ModelError: the shapes do not fit each other, or a value is outside [0, 1].

    >>> Recording([[0.1], [0.9]], [[1.0], [0.0]])
    <recording of 2 records in 1 episode: 1 input, 1 output>
    """

    inputs: NDArray[np.float64]
    outputs: NDArray[np.float64]
    lengths: tuple[int, ...] | None = None

    def __post_init__(self) -> None:
        for name in ("inputs", "outputs"):
            object.__setattr__(self, name, _shares(getattr(self, name), name))
        if len(self.inputs) != len(self.outputs):
            raise ModelError(
                f"a recording of {len(self.inputs)} inputs and {len(self.outputs)} outputs",
                "as many of one as of the other",
            )
        given = (len(self),) if self.lengths is None else self.lengths
        lengths = tuple(
            whole_number(one, "records of an episode", 0, None, ModelError) for one in given
        )
        if sum(lengths) != len(self):
            raise ModelError(f"episodes of {lengths} records", f"{len(self)} records in all")
        object.__setattr__(self, "lengths", tuple(one for one in lengths if one))

    def __len__(self) -> int:
        return len(self.inputs)

    @property
    def episodes(self) -> list[slice]:
        """Where each episode's records are."""
        ends = np.cumsum(self.lengths or (), dtype=int).tolist()
        return [slice(first, end) for first, end in zip([0, *ends], ends, strict=False)]

    def joined(self, other: Recording) -> Recording:
        """Return both recordings as one, the other's episodes behind.

        Raises:
            ModelError: the other has other numbers of inputs and outputs.
        """
        for own, theirs in ((self.inputs, other.inputs), (self.outputs, other.outputs)):
            if own.shape[1] != theirs.shape[1]:
                raise ModelError(f"{other} to be joined", f"one like {self}")
        return Recording(
            np.concatenate([self.inputs, other.inputs]),
            np.concatenate([self.outputs, other.outputs]),
            (*(self.lengths or ()), *(other.lengths or ())),
        )

    @classmethod
    def read(cls, file: str | Path, skill: Skill) -> Recording:
        """Return the recording of a table: a person's commands, say, beside what they saw.

        Args:
            file: a CSV file. Its columns are named as in the skill's description, `SE:S1` or
                `MO:MotL`, in any order; a column `episode` says with which line another episode
                begins: there its value changes. Further columns count for nothing. What the skill
                has twice, such as a variable that it reads and writes, has two columns, the inputs'
                first.
            skill: the skill whose inputs and outputs they are.

        Raises:
            ModelError: a column is missing or there too often, a line has more cells than there are
                columns, or a value is no number in [0, 1], with file and line.
        """
        path = Path(file)
        try:
            # Excel begins a table in UTF-8 with a mark, which is no part of the first name.
            with path.open(encoding="utf-8-sig", newline="") as table:
                lines = csv.reader(table)
                found = next(lines, [])
                rows = [(lines.line_num, row) for row in lines if row]
        except (OSError, UnicodeDecodeError, csv.Error) as error:
            raise ModelError(f"the table cannot be read: {error}", file=path) from None
        columns = [str(one) for one in (*skill.inputs, *skill.outputs)]
        places = _places(columns, found, path)
        values = np.zeros((len(rows), len(columns)))
        lengths: list[int] = []
        last: Any = None
        for place, (line, row) in enumerate(rows):
            if len(row) > len(found):
                raise ModelError(
                    f"{len(row)} cells", f"{len(found)}, one for each column", file=path, line=line
                )
            cells = [*row, *[""] * (len(found) - len(row))]
            values[place] = [
                _share(cells[at], column, path, line)
                for at, column in zip(places, columns, strict=True)
            ]
            now = cells[found.index(EPISODE)] if EPISODE in found else None
            if not lengths or now != last:
                lengths.append(0)
            lengths[-1] += 1
            last = now
        count = len(skill.inputs)
        return cls(values[:, :count], values[:, count:], tuple(lengths))

    def write(self, file: str | Path, skill: Skill) -> None:
        """Write the recording as a table that `read` takes.

        Args:
            file: the CSV file.
            skill: the skill whose inputs and outputs they are.

        Raises:
            ModelError: it cannot be written there.
        """
        check_fits(self, skill)
        columns = [str(one) for one in (*skill.inputs, *skill.outputs)]
        try:
            with Path(file).open("w", encoding="utf-8", newline="") as table:
                lines = csv.writer(table)
                lines.writerow([EPISODE, *columns])
                for number, places in enumerate(self.episodes):
                    for row in np.hstack([self.inputs[places], self.outputs[places]]).tolist():
                        lines.writerow([number, *row])
        except OSError as error:
            raise ModelError(f"the table cannot be written: {error}", file=Path(file)) from None

    def __repr__(self) -> str:
        counts = (
            (len(self), "record"),
            (len(self.lengths or ()), "episode"),
            (self.inputs.shape[1], "input"),
            (self.outputs.shape[1], "output"),
        )
        words = [f"{count} {word}{'s' * (count != 1)}" for count, word in counts]
        return f"<recording of {words[0]} in {words[1]}: {words[2]}, {words[3]}>"


def check_fits(recording: Recording, skill: Skill) -> None:
    """Refuse a recording of another number of inputs or outputs than a skill has.

    Raises:
        ModelError: so it is.
    """
    found = recording.inputs.shape[1], recording.outputs.shape[1]
    expected = len(skill.inputs), len(skill.outputs)
    if found != expected:
        raise skill.refused(
            f"to be trained on {found[0]} inputs and {found[1]} outputs",
            f"{expected[0]} and {expected[1]}, as it has",
        )


def _places(columns: Sequence[str], found: Sequence[str], file: Path) -> list[int]:
    """Return where the columns of a skill stand in a table's first line."""
    for column in columns:
        if column not in found:
            raise ModelError(
                f"a table without the column {column!r}",
                f"the columns {', '.join(columns)}",
                file=file,
                line=1,
            )
    for column in (EPISODE, *columns):
        expected = max(columns.count(column), 1)
        if found.count(column) not in (0, expected):
            times = "once" if expected == 1 else f"{expected} times, as the skill has it"
            raise ModelError(
                f"{found.count(column)} columns {column!r}", f"each {times}", file=file, line=1
            )
    left = {column: [at for at, name in enumerate(found) if name == column] for column in columns}
    return [left[column].pop(0) for column in columns]


def _shares(values: Sequence[Any] | NDArray[Any], what: str) -> NDArray[np.float64]:
    """Return values as a read-only array of shares, or refuse them."""
    try:
        array = np.array(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise ModelError(f"{what} of a recording that are no table", "rows of numbers") from None
    if array.ndim != 2:
        raise ModelError(f"{what} of a recording of shape {array.shape}", "(records, values)")
    wrong = ~((array >= 0.0) & (array <= 1.0))
    if wrong.any():
        record, place = np.argwhere(wrong)[0]
        raise ModelError(
            f"{array[record, place]} in record {record} of the {what} of a recording",
            "a number, 0 … 1",
        )
    array.setflags(write=False)
    return array


def _share(text: str | None, column: str, file: Path, line: int) -> float:
    try:
        value = float(text or "")
    except ValueError:
        value = np.nan
    if not 0.0 <= value <= 1.0:
        raise ModelError(f"{text!r} for {column}", "a number, 0 … 1", file=file, line=line)
    return value


def of_episodes(episodes: Iterable[tuple[Sequence[Any], Sequence[Any]]], skill: Skill) -> Recording:
    """Return the recording of episodes, each a pair of its inputs and outputs, for a skill."""
    inputs: list[Any] = []
    outputs: list[Any] = []
    lengths = []
    for read, answered in episodes:
        inputs += read
        outputs += answered
        lengths.append(len(read))
    return Recording(
        np.array(inputs, dtype=np.float64).reshape(len(inputs), len(skill.inputs)),
        np.array(outputs, dtype=np.float64).reshape(len(outputs), len(skill.outputs)),
        tuple(lengths),
    )
