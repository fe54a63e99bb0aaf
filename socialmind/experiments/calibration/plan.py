"""What a fit will do, run by run, said before its first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.numbers import whole_number
from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.methods.registry import method_called
from socialmind.experiments.calibration.space import Space
from socialmind.experiments.calibration.target import STATISTICS, Target
from socialmind.learning.lessons.keys import seed_for

FIT = "fit"
"""What these seeds are for."""
DATA, TRIAL, FINAL, NEW = "data", "trial", "final", "new"
"""Why runs are made: as data with known parameters, as trials, once more at the nearest of them to
choose the best, and at the best on new seeds."""
FINALISTS, OFTENER = 5, 4
"""So many trials are made once more, with so many times the seeds: the nearest of many noisy trials
is often the luckiest. In noisy toys errors fell by a fifth, at equal budget."""
SMALLEST = 60
"""Trials' worth of a budget below which there are no finalists."""
NEW_RUNS = 20
"""Runs at the best trial on new seeds."""
RECOVERIES = 10
"""Fits to data with known parameters, by default."""
FEWEST = 4
"""Trials that a fit has at least, for each thing that varies."""


@dataclass(frozen=True)
class Plan:
    """What a fit will do.

    Attributes:
        space: what varies.
        target: the data.
        method: by name.
        budget: runs of the fit, and of each recovery.
        seeds: runs of a trial.
        recover: recoveries, each a fit to data with known parameters.
        data_runs: runs of which such data are the mean.
        seed: of all draws.
    """

    space: Space
    target: Target
    method: str
    budget: int
    seeds: int
    recover: int = RECOVERIES
    data_runs: int = 1
    seed: int = 0

    def __post_init__(self) -> None:
        method_called(self.method)
        for name, low in {"budget": 1, "seeds": 1, "recover": 0, "data_runs": 1, "seed": 0}.items():
            whole_number(getattr(self, name), name, low, 2**63 - 1, SocialmindError)
        least = FEWEST * len(self.space.dimensions)
        if self.trials < least:
            raise SocialmindError(
                f"a budget of {self.budget} runs is {self.trials} trials of {self.seeds}; expected "
                f"{least} trials or more where {len(self.space.dimensions)} things vary, a budget "
                f"of {least * self.seeds}"
            )

    @property
    def finalists(self) -> int:
        """Trials that are made once more, at the end of the fit and of each recovery."""
        return FINALISTS if self.budget // self.seeds >= SMALLEST else 0

    @property
    def trials(self) -> int:
        """Trials of the fit, and of each recovery; what the finalists take is not among them."""
        return self.budget // self.seeds - OFTENER * self.finalists

    @property
    def spent(self) -> int:
        """Runs of the fit, and of each recovery, within the budget."""
        return (self.trials + OFTENER * self.finalists) * self.seeds

    @property
    def runs(self) -> int:
        """All runs."""
        return (1 + self.recover) * (self.spent + NEW_RUNS) + self.recover * self.data_runs

    def seeds_of(self, search: int, kind: str, number: int = 0) -> tuple[int, ...]:
        """Return the seeds of some runs; those of two purposes are never the same.

        Args:
            search: 0 for the fit, from 1 on the recoveries.
            kind: `DATA`, `TRIAL`, `FINAL` or `NEW`.
            number: of the trial.
        """
        count = self.runs_of(kind)
        return tuple(seed_for(FIT, self.seed, search, kind, number, one) for one in range(count))

    def runs_of(self, kind: str) -> int:
        """Return how many runs are made at once for a purpose."""
        return {
            DATA: self.data_runs,
            TRIAL: self.seeds,
            FINAL: OFTENER * self.seeds,
            NEW: NEW_RUNS,
        }[kind]

    def draws_of(self, search: int, purpose: str) -> np.random.Generator:
        """Return a generator of a search for one purpose."""
        return np.random.default_rng(seed_for(FIT, self.seed, search, purpose))

    def truths(self) -> NDArray[np.float64]:
        """Return the known parameters of the recoveries: drawn evenly, a Latin hypercube."""
        size = len(self.space.dimensions)
        if not self.recover:
            return np.zeros((0, size))
        rng = self.draws_of(0, "truths")
        slices = np.array([rng.permutation(self.recover) for _ in range(size)]).T
        return (slices + rng.uniform(size=slices.shape)) / self.recover

    def said(self, ticks: int) -> list[str]:
        """Return what is said before the first run.

        Args:
            ticks: of each run.
        """
        final = f" + {self.finalists} finalists × {OFTENER * self.seeds}" if self.finalists else ""
        lines = [
            f"fit by {self.method}: {self.trials:,} trials × {self.seeds} seeds{final} = "
            f"{self.spent:,} runs of {ticks:,} ticks, and {NEW_RUNS} of the best on new seeds"
        ]
        if self.recover:
            data = f"{self.data_runs} run{'s' * (self.data_runs != 1)}"
            each = self.spent + NEW_RUNS + self.data_runs
            lines.append(
                f"recovery: {self.recover} × ({data} as data and the same fit to it) = "
                f"{self.recover * each:,} runs; --recover N makes it more or fewer"
            )
            lines.append(f"in all {self.runs:,} runs")
        else:
            lines.append("no recovery: nobody will know whether such data tell the parameters")
        return [*lines, *self.target.notes()]


def data_runs_of(target: Target, given: int | None) -> int:
    """Return of how many runs known data are the mean.

    One for a series, since the data are one history; for statistics, whose error says how far
    luck may have moved them, many.
    """
    if given is not None:
        return whole_number(given, "data_runs", 1, 10_000, SocialmindError)
    return NEW_RUNS if target.kind == STATISTICS else 1
