"""How the columns of a sweep's tables are called, where two would be called alike."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from socialmind.errors import SocialmindError

RUN, POINT, REPLICATE, SEED, STATUS, ERROR, TICKS = (
    "run",
    "point",
    "replicate",
    "seed",
    "status",
    "error",
    "ticks",
)
RESERVED = (RUN, POINT, REPLICATE, SEED, STATUS, ERROR, TICKS)
"""What the table of runs has anyway."""


@dataclass(frozen=True)
class Names:
    """The columns of the tables.

    Args:
        varied: the columns of the design.
        measures: the measures.
    """

    varied: tuple[str, ...]
    measures: tuple[str, ...]

    def of_varied(self, name: str) -> str:
        """Return the column of what varies: `parameter.run` for a parameter called `run`."""
        return f"parameter.{name}" if name in RESERVED else name

    def of_series(self, name: str) -> str:
        """Return the column of a column of the series, `series.price` where a parameter varies so.

        >>> names = Names(("price",), ("settled",))
        >>> names.of_series("price"), names.of_series("farmers")
        ('series.price', 'farmers')
        """
        taken = name in RESERVED or name in self.varied or name in self.measures
        return f"series.{name}" if taken else name

    def first(self, series: Sequence[str]) -> list[str]:
        """Return the columns of the runs' table in order, with those of the series' end.

        Args:
            series: the columns of the series.
        """
        design = [self.of_varied(name) for name in self.varied]
        ends = [self.of_series(name) for name in series]
        return [
            *(RUN, POINT, REPLICATE),
            *design,
            *(SEED, STATUS, ERROR, TICKS),
            *ends,
            *self.measures,
        ]

    def check(self, series: Iterable[str]) -> None:
        """Refuse measures that are called as something else is.

        Args:
            series: the columns of the series.

        Raises:
            SocialmindError: so one is.
        """
        for name in self.measures:
            taken = {
                "a column that the table of runs has": name in RESERVED,
                "what varies": name in self.varied,
                "a column of the series, whose end the table has": name in series,
            }
            for what, so in taken.items():
                if so:
                    raise SocialmindError(f"a measure called {name}, as {what}; give another name")


def of_ticks(name: str, table: str) -> str:
    """Return the column of a model's own column in a table with `run` and `tick`.

    Args:
        name: of the model's column.
        table: `series` or `agents`.

    >>> of_ticks("run", "series"), of_ticks("farmers", "series")
    ('series.run', 'farmers')
    """
    return f"{table}.{name}" if name == RUN else name
