"""The sweeps of the study: what varies, between which values, what is measured, for how long."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from socialmind.experiments import Sweep, designs, resume_sweep, sweep

MODEL = "farmer_artisan"
TICKS = 150_000
EVERY = 2_500
"""Ticks between two records: the last 20 are the last third of a run."""
MEASURES = {
    "artisan_share": "100 * mean(artisans[-20:]) / last(population)",
    "wheat_each": "mean(wheat[-20:]) / last(population)",
    "tools_each": "mean(tools[-20:]) / last(population)",
    "artisan_share_before": "100 * mean(artisans[-40:-20]) / last(population)",
}
"""Over the last third of a run; the last one over the third before, to see whether it settled."""
UNITS = {"artisan_share": "% of agents", "wheat_each": "wheat", "tools_each": "tools"}
OUTPUTS = tuple(UNITS)

THESIS = {
    "tool_price": 167.0,
    "food_decay": 0.003312,
    "tool_durability": 184.0,
    "max_tool_production": 0.076,
    "demand_intensity": 1.01,
}
"""What the thesis has (section 3.3); each varies between half of it and one and a half."""
WHOLE = {
    "plan_duration": (20, 60),
    "n_agents": (13, 37),
    "world_size": (17, 49),
    "n_villages": (1, 3),
}
"""Whole numbers: the same, but for the villages, of which the thesis has one."""
COUNTING = ("tool_price", "food_decay", "tool_durability", "max_tool_production")
"""What is left after the screening."""


@dataclass(frozen=True)
class Plan:
    """A sweep of the study.

    Attributes:
        name: of its design, and of the results.
        columns: what varies.
        size: of the design.
        quick: the size of a smaller version.
        seeds: replicates at each point.
    """

    name: str
    columns: tuple[str, ...]
    size: int
    quick: int
    seeds: int = 2

    def design(self, quick: bool = False) -> pd.DataFrame:
        """Return the points."""
        known = ranges()
        chosen = {name: known[name] for name in self.columns}
        whole = [name for name in chosen if name in WHOLE]
        make = designs.SAMPLERS[self.name].make
        return make(chosen, self.quick if quick else self.size, whole=whole)

    def swept(self, folder: Path, quick: bool = False, workers: int | None = None) -> Sweep:
        """Return the sweep, begun in a folder or gone on with."""
        if (folder / "manifest.json").exists():
            return Sweep(resume_sweep(folder, workers=workers))
        ticks, every = (TICKS // 25, EVERY // 25) if quick else (TICKS, EVERY)
        return Sweep(
            sweep(
                MODEL, self.design(quick), ticks, range(self.seeds), measures=MEASURES, every=every,
                out=folder, workers=workers,
            )
        )  # fmt: skip


def ranges() -> dict[str, tuple[float, float]]:
    """Return what each parameter varies between."""
    return {name: (value / 2, 1.5 * value) for name, value in THESIS.items()} | WHOLE


SCREENING = Plan("morris", (*THESIS, *WHOLE), 10, 2)
SHARES = Plan("saltelli", COUNTING, 32, 2)
