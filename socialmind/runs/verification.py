"""Running a capsule's model again and comparing the tables, value by value."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from coglogo_py.border.errors import one_line
from socialmind.agents.agent_columns import POPULATION
from socialmind.agents.group_columns import PARTS
from socialmind.errors import SocialmindError
from socialmind.runs import folders
from socialmind.runs.branching.kept import interventions_of
from socialmind.runs.capsule import Capsule
from socialmind.runs.execution import Progress, run
from socialmind.runs.sources import changes_since, recorded_class, require_minds
from socialmind.runs.tables.columns import from_arrow
from socialmind.runs.tables.files import content_of, pieces
from socialmind.runs.tables.names import AGENTS, EVENTS, LINKS

if TYPE_CHECKING:
    import pyarrow as pa

    from socialmind.model import Model

RELATIVE_TOLERANCE = 1e-6
ABSOLUTE_TOLERANCE = 1e-9


@dataclass(frozen=True)
class Difference:
    """The first place where two tables differ.

    Args:
        table: ``series`` or ``agents``.
        message: what differs, where, and both values.
    """

    table: str
    message: str

    def __str__(self) -> str:
        return f"{self.table}: {self.message}"


@dataclass(frozen=True)
class Replay:
    """What a replay found.

    Args:
        exact: whether the two were compared exactly, which they are on equal platforms; elsewhere
            numbers may differ by 1e-6 of their size (1e-9 near zero), all else by nothing.
        differences: where the tables differ; empty when the run is reproduced.
        notes: what else is not as it was: source, versions.
    """

    exact: bool
    differences: tuple[Difference, ...]
    notes: tuple[str, ...]

    @property
    def equal(self) -> bool:
        """Whether the run is reproduced."""
        return not self.differences


def replay(
    folder: str | Path,
    model_class: type[Model] | None = None,
    on_progress: Progress | None = None,
    kept: bool = False,
    trust: bool = False,
) -> Replay:
    """Run a capsule's model again, in a temporary folder, and compare what comes out.

    Args:
        folder: of a finished run.
        model_class: the model; loaded from where the run says it stands by default.
        on_progress: as for `socialmind.experiments.run`.
        kept: whether to take the copies of the model's source that the run keeps.
        trust: run programs that this user has neither named nor run before.

    Returns:
        Whether the tables are reproduced, and where they first differ.

    Raises:
        SocialmindError: the run is not finished, or its model or tables are missing.
    """
    stored = Capsule(folder)
    manifest = stored.manifest
    if manifest.status != folders.FINISHED:
        raise SocialmindError(
            f"{stored.folder}: the run is {manifest.status} at tick {manifest.ticks_done} of "
            f"{manifest.ticks}; finish it with --resume first"
        )
    require_minds(stored, trust)
    cls = recorded_class(stored, kept, trust) if model_class is None else model_class
    notes = [changed] if (changed := changes_since(stored, cls)) else []
    here = folders.versions()
    notes += [
        f"{name} {here.get(name)} here, {version} in the run"
        for name, version in manifest.versions.items()
        if here.get(name) != version
    ]
    exact = manifest.platforms == [folders.fingerprint()]
    differences = _tampering(stored)
    first = next(iter(getattr(cls, "populations", {})), None)
    with tempfile.TemporaryDirectory(prefix="socialmind-replay-") as place:
        again = run(
            cls,
            ticks=manifest.ticks_done,
            seed=manifest.seed,
            parameters=manifest.parameters,
            scheme=stored.schemes or None,
            hierarchy=stored.minds or None,
            every=manifest.every,
            agents_every=manifest.agents_every,
            out=Path(place) / "run",
            compiled=manifest.compiled,
            on_progress=on_progress,
            engine=manifest.engine,
            links=LINKS in manifest.tables and bool(getattr(cls, "networks", None)),
            events=EVENTS in manifest.tables,
            interventions=interventions_of(stored, trust),
        )
        made = Capsule(again).manifest.tables
        for name in stored.manifest.tables:
            found: Difference | None = Difference(name, "the model gives no such table now")
            if name in made:
                found = compare(stored.table(name), Capsule(again).table(name), name, exact, first)
            differences += [found] if found else []
    return Replay(exact, tuple(differences), tuple(notes))


def _tampering(stored: Capsule) -> list[Difference]:
    """Tables that are not those the run wrote, by the hashes in its manifest."""
    return [
        Difference(name, f"{stored.table(name).name} is not the table that the run wrote")
        for name, table in stored.manifest.tables.items()
        if content_of(stored.table(name)).sha256 != table["sha256"]
    ]


def compare(
    stored: Path, again: Path, name: str, exact: bool = True, first: str | None = None
) -> Difference | None:
    """The first difference between two tables, in the order of their rows.

    A run made before the column `population` is compared by the columns and rows that it has.

    Args:
        stored: Parquet file of the run.
        again: Parquet file of the run made again.
        name: of the table, for the message.
        exact: False allows numbers to differ by 1e-6 of their size, or 1e-9.
        first: the model's first population.

    Returns:
        None when there is none.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    schema, found = pq.read_schema(again), pq.read_schema(stored)
    population = None
    if found.names != schema.names:
        own = set(found.names)
        today = {one for one in schema.names if one in own or not one.startswith(PARTS)}
        before = name == AGENTS and POPULATION in today - own and own < today
        if not before and own != today:
            return Difference(
                name, f"columns {', '.join(found.names)} in the run; {', '.join(schema.names)} now"
            )
        population = first if before else None
        schema = pa.schema([schema.field(column) for column in found.names])
    lengths = [0, 0]
    try:
        sides = pieces([stored], schema), pieces([again], schema, population=population)
        # The two have the same pieces, but for the last when their lengths differ.
        for here, there in zip_longest(*sides, fillvalue=pa.Table.from_batches([], schema)):
            rows = min(here.num_rows, there.num_rows)
            difference = _first_difference(here.slice(0, rows), there.slice(0, rows), exact)
            if difference is not None:
                return Difference(name, difference)
            lengths = [lengths[0] + here.num_rows, lengths[1] + there.num_rows]
    except pa.ArrowException as error:
        return Difference(name, f"column types differ ({one_line(str(error))})")
    except UnicodeDecodeError:
        return Difference(name, "a text in the run is no text any more")
    if lengths[0] != lengths[1]:
        return Difference(name, f"{lengths[0]} rows in the run, {lengths[1]} now")
    return None


def _first_difference(here: pa.Table, there: pa.Table, exact: bool) -> str | None:
    """Column, tick and both values at the first row where two pieces of a table differ."""
    first: tuple[int, int] | None = None
    for position, (a, b) in enumerate(zip(here.columns, there.columns, strict=True)):
        rows = np.flatnonzero(_differs(a.combine_chunks(), b.combine_chunks(), exact))
        if len(rows) and (first is None or rows[0] < first[0]):
            first = (int(rows[0]), position)
    if first is None:
        return None
    row, position = first
    place = f"tick {here['tick'][row].as_py()}"
    if "agent" in here.schema.names and here.schema.names[position] != "agent":
        place += f", agent {here['agent'][row].as_py()}"
    values = f"{here.column(position)[row].as_py()!r} in the run"
    values += f", {there.column(position)[row].as_py()!r} now"
    return f"column {here.schema.names[position]} first differs at {place}: {values}"


def _differs(a: pa.Array, b: pa.Array, exact: bool) -> np.ndarray:
    """Where two columns of one type and length differ."""
    one, other = from_arrow(a), from_arrow(b)
    missing = one.missing != other.missing
    x, y = one.values, other.values
    if not len(x):  # nulls alone
        return missing
    if one.text or other.text:
        return missing | np.array([s != t for s, t in zip(a, b, strict=True)])
    if x.dtype.kind != "f":
        return missing | (x != y)
    if exact:
        unequal = x.view(np.int64) != y.view(np.int64)
    else:
        bound = np.maximum(
            ABSOLUTE_TOLERANCE, RELATIVE_TOLERANCE * np.maximum(np.abs(x), np.abs(y))
        )
        with np.errstate(invalid="ignore"):  # inf - inf
            near = np.isfinite(x) & np.isfinite(y) & (np.abs(x - y) <= bound)
        unequal = (x != y) & ~near
    return missing | (unequal & ~(np.isnan(x) & np.isnan(y)))
