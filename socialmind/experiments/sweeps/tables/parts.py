"""The files of parts, read; one that cannot be is named."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.columns import RUN
from socialmind.experiments.sweeps.tables.pieces import runs_in

if TYPE_CHECKING:
    import pyarrow as pa
    import pyarrow.parquet as pq


@contextmanager
def part(path: Path) -> Iterator[pq.ParquetFile]:
    """Open the file of a part.

    Raises:
        SocialmindError: it cannot be read.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        with pq.ParquetFile(path) as file:
            yield file
    except (OSError, pa.ArrowException) as error:
        raise SocialmindError(
            f"{path}: cannot be read as a table; it is missing, cut off or was changed; take it "
            "from a copy of the folder"
        ) from error


def schema_of(path: Path) -> pa.Schema:
    """Return names and types of the columns of a part."""
    with part(path) as file:
        return file.schema_arrow


def rows_of(path: Path) -> pa.Table:
    """Return the rows of a part."""
    with part(path) as file:
        return file.read(use_threads=False)


def group_of(path: Path, group: int) -> pa.Table:
    """Return the rows of a part's row group."""
    with part(path) as file:
        return file.read_row_group(group, use_threads=False)


def runs_of(path: Path) -> NDArray[np.int64]:
    """Return the run of each row of a part."""
    with part(path) as file:
        return runs_in(file.read([RUN], use_threads=False))
