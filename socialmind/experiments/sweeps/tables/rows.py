"""The rows of the runs' table: what a run's number says of it, also where it is not done yet."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from socialmind.experiments.sweeps.columns import ERROR, POINT, REPLICATE, RUN, SEED, STATUS
from socialmind.experiments.sweeps.replicates import Replicates
from socialmind.runs.folders import RUNNING

PENDING = "pending"


@dataclass(frozen=True)
class RunRows:
    """What the design of a sweep says of its runs.

    Args:
        names: the columns of what varies.
        values: of each point, in the order of the names.
        replicates: at each point.
    """

    names: Sequence[str]
    values: Sequence[Sequence[Any]]
    replicates: Replicates

    def of(self, run: int) -> dict[str, Any]:
        """Return what a run's number says of it."""
        point, replicate = self.replicates.place_of(run)
        varied = dict(zip(self.names, self.values[point], strict=True))
        seed = self.replicates.seed_of(run)
        return {RUN: run, POINT: point, REPLICATE: replicate, **varied, SEED: seed}

    def missing(
        self, done: Collection[int], running: Collection[int] = ()
    ) -> Iterator[dict[str, Any]]:
        """Yield the rows of runs that are not done, in order.

        Args:
            done: runs that are.
            running: runs that workers have in hand, those that `--until` added among them.
        """
        first = (
            self.replicates.run_of(point, replicate)
            for point in range(len(self.values))
            for replicate in range(len(self.replicates.seeds))
        )
        for run in sorted({*first, *running}.difference(done)):
            status = RUNNING if run in running else PENDING
            yield {**self.of(run), STATUS: status, ERROR: None}
