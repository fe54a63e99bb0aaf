"""The sweeps of the study: what varies, between which values, what is measured, for how long."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import pandas as pd

from socialmind.experiments import Sweep, designs, resume_sweep, sweep

MODEL = "farmer_artisan"
TICKS, EVERY = 150_000, 2_500
"""Length of a run, and ticks between two records: the last 20 are the last third."""
LONG, SELDOM = 400_000, 5_000
"""The same of the runs that show when the society settles."""
QUICK = 25
"""A smaller version's runs are so many times shorter."""
MEASURES = {
    "artisan_share": "100 * mean(artisans[-20:]) / last(population)",
    "wheat_each": "mean(wheat[-20:]) / last(population)",
    "tools_each": "mean(tools[-20:]) / last(population)",
    "artisan_share_before": "100 * mean(artisans[-40:-20]) / last(population)",
}
"""Over the last third of a run; the last one over the third before, to see whether it settled."""
UNITS = {"artisan_share": "% of agents", "wheat_each": "wheat", "tools_each": "tools"}
OUTPUTS = tuple(UNITS)

RANGES = {
    "tool_price": (83.5, 250.5),
    "food_decay": (0.001656, 0.004968),
    "tool_durability": (92.0, 276.0),
    "max_tool_production": (0.038, 0.114),
    "demand_intensity": (0.505, 1.515),
    "plan_duration": (20, 60),
    "n_agents": (13, 37),
    "world_size": (17, 49),
    "n_villages": (1, 3),
}
"""From half of what the thesis has (section 3.3) to one and a half; of villages it has one."""
WHOLE = ("plan_duration", "n_agents", "world_size", "n_villages")
"""Parameters that are whole numbers."""
COUNTING = ("tool_price", "food_decay", "tool_durability", "max_tool_production")
"""What Saltelli's design varies."""


@dataclass(frozen=True)
class Plan:
    """A sweep of the study.

    Attributes:
        name: of the results.
        sampler: of the design.
        columns: what varies.
        size: of the design.
        quick: the size of a smaller version.
        ticks: length of a run.
        every: ticks between two records.
        measures: of runs; without any the sweep keeps its series.
        seeds: replicates at each point.
    """

    name: str
    sampler: str
    columns: tuple[str, ...]
    size: int
    quick: int
    ticks: int = TICKS
    every: int = EVERY
    measures: Mapping[str, str] = field(default_factory=lambda: MEASURES)
    seeds: int = 2

    def design(self, quick: bool = False) -> pd.DataFrame:
        """Return the points."""
        chosen = {name: RANGES[name] for name in self.columns}
        whole = [name for name in chosen if name in WHOLE]
        size = self.quick if quick else self.size
        return designs.SAMPLERS[self.sampler].make(chosen, size, whole=whole)

    def swept(self, folder: Path, quick: bool = False, workers: int | None = None) -> Sweep:
        """Return the sweep, begun in a folder or gone on with."""
        if (folder / "manifest.json").exists():
            return Sweep(resume_sweep(folder, workers=workers))
        shorter = QUICK if quick else 1
        return Sweep(
            sweep(
                MODEL, self.design(quick), self.ticks // shorter, range(self.seeds),
                measures=self.measures, every=self.every // shorter, out=folder, workers=workers,
            )
        )  # fmt: skip


SETTLING = Plan("settling", "lhs", tuple(RANGES)[:6], 32, 9, ticks=LONG, every=SELDOM, measures={})
SCREENING = Plan("screening", "morris", tuple(RANGES), 10, 4)
SHARES = Plan("shares", "saltelli", COUNTING, 32, 8)
