"""A panel of the page as a table."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from socialmind.studio.plots.figure import Drawn


def csv_of(societies: Sequence[Drawn]) -> bytes:
    """Return what a panel shows as CSV, the rows of several societies one after another.

    >>> csv_of([Drawn({"tick": [0, 1], "sheep": [60, 57]}, "1")]).decode().split()
    ['tick,sheep', '0,60', '1,57']
    """
    tables = [pd.DataFrame(dict(one.columns)) for one in societies]
    if len(tables) > 1:
        for table, one in zip(tables, societies, strict=True):
            table.insert(0, "society", one.name)
    return pd.concat(tables).to_csv(index=False).encode()
