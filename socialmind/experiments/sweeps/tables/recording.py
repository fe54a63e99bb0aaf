"""What runs recorded, as Arrow tables: the runs of a job together, which is sent as one stream."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from coglogo_py.border.errors import shown
from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.columns import RUN, of_ticks
from socialmind.experiments.sweeps.one_run import Columns, Outcome
from socialmind.experiments.sweeps.tables.pieces import together
from socialmind.runs.folders import FAILED
from socialmind.runs.tables.columns import EXPECTED
from socialmind.runs.tables.growing import arrow_table
from socialmind.runs.tables.names import AGENTS, SERIES

if TYPE_CHECKING:
    import pyarrow as pa

CALLED = {SERIES: "series()", AGENTS: "agents()"}
"""The function of a model that gives the rows of a table."""


def recorded(outcomes: Sequence[Outcome]) -> tuple[list[Outcome], dict[str, bytes]]:
    """Return the tables of some runs, as Arrow streams, and what runs come to with them.

    Args:
        outcomes: of the runs; one whose records no table can hold comes back as failed.
    """
    records: dict[str, list[Columns]] = {SERIES: [], AGENTS: []}
    told: list[Outcome] = []
    for one in outcomes:
        try:
            found = _records(one)
        except SocialmindError as error:
            one, found = Outcome(one.run, FAILED, f"record: {error}", one.ticks), {}
        told.append(one)
        for name, several in found.items():
            records[name] += several
    try:
        tables = {n: [_table(several, CALLED[n])] for n, several in records.items() if several}
    except SocialmindError:
        told, tables = _one_by_one(told)
    return told, {name: _stream(several) for name, several in tables.items() if several}


def from_stream(content: bytes) -> pa.Table:
    """Return the table of an Arrow stream."""
    import pyarrow as pa

    with pa.ipc.open_stream(content) as reader:
        return reader.read_all()


def _one_by_one(
    outcomes: Sequence[Outcome],
) -> tuple[list[Outcome], dict[str, list[pa.Table]]]:
    """Return tables of each run by itself: what is wrong with one, others do not suffer from."""
    told: list[Outcome] = []
    tables: dict[str, list[pa.Table]] = {SERIES: [], AGENTS: []}
    for one in outcomes:
        try:
            found = {
                n: _table(several, CALLED[n]) for n, several in _records(one).items() if several
            }
        except SocialmindError as error:
            one, found = Outcome(one.run, FAILED, f"record: {error}", one.ticks), {}
        told.append(one)
        for name, table in found.items():
            tables[name].append(table)
    return told, tables


def _records(outcome: Outcome) -> dict[str, list[Columns]]:
    """Return the rows of a run, with its number, as some columns a tick or a series.

    Raises:
        SocialmindError: the end of the series, or columns, are such as no table can hold.
    """
    for where, values in (("series(): column", outcome.final), ("measure", outcome.measured)):
        for name, one in values.items():
            fits = isinstance(one, bool | float | str) or one is None
            if not fits and not (isinstance(one, int) and -(2**63) <= one < 2**63):
                raise SocialmindError(f"{where} {name}: found {shown(one)}; expected {EXPECTED}")
    series = [] if outcome.series is None else [outcome.series]
    return {
        SERIES: [_numbered(outcome.run, one, SERIES) for one in series],
        AGENTS: [_numbered(outcome.run, one, AGENTS) for one in outcome.agents],
    }


def _numbered(run: int, record: Columns, table: str) -> Columns:
    """Return columns with the run's number and the tick in front, each of one length."""
    others = {name: values for name, values in record.items() if name != "tick"}
    tick = record["tick"]
    if isinstance(tick, int):
        length = len(next(iter(others.values()), ()))
        tick = np.full(length, tick, np.int64)
    odd = next((n for n, one in others.items() if len(one) != len(tick)), None)
    if odd is not None:
        raise SocialmindError(
            f"{CALLED[table]}: column {odd} has {len(others[odd])} values, others {len(tick)}"
        )
    named = {of_ticks(name, table): one for name, one in others.items()}
    return {RUN: np.full(len(tick), run, np.int64), "tick": tick, **named}


def _table(records: Sequence[Columns], where: str) -> pa.Table:
    if any(tuple(one) != tuple(records[0]) for one in records):
        raise SocialmindError(f"{where}: other columns at one tick than at another")
    return arrow_table(records, where)


def _stream(tables: Sequence[pa.Table]) -> bytes:
    import pyarrow as pa

    rows = tables[0] if len(tables) == 1 else together(tables)
    sink = pa.BufferOutputStream()
    with pa.ipc.new_stream(sink, rows.schema) as writer:
        writer.write_table(rows)
    return bytes(sink.getvalue().to_pybytes())
