"""Six link weights of the farmers and artisans, fitted to a run with known ones."""

from __future__ import annotations

from pathlib import Path

import pandas as pd

from socialmind.catalogue import load_model
from socialmind.experiments import Fit, fit, resume_fit

MODEL = "farmer_artisan"
KNOWN = {
    "influence.Farmer.GrowWheat": 5.0,
    "influence.Artisan.ProduceTools": 5.0,
    "reinforcement.Farmer.TradeWheatForTools": 0.05,
    "reinforcement.Farmer.TradeToolsForWheat": -0.05,
    "reinforcement.Artisan.TradeToolsForWheat": 0.05,
    "reinforcement.Artisan.TradeWheatForTools": -0.05,
}
"""The weights of the model's own scheme: what the data are made with."""
RANGES = {
    "influence.Farmer.GrowWheat": (1.0, 10.0),
    "influence.Artisan.ProduceTools": (1.0, 10.0),
    "reinforcement.Farmer.TradeWheatForTools": (0.0, 0.15),
    "reinforcement.Farmer.TradeToolsForWheat": (-0.15, 0.0),
    "reinforcement.Artisan.TradeToolsForWheat": (0.0, 0.15),
    "reinforcement.Artisan.TradeWheatForTools": (-0.15, 0.0),
}
COLUMNS = [
    "farmers", "artisans", "wheat", "tools", "village_tools", "wheat_demand", "specialisation",
]  # fmt: skip
TICKS, EVERY, FIRST = 6_000, 300, 600
SEED = 2020
"""Of the run that the data are of."""
METHODS = ("cmaes", "tpe", "lhs", "abc")
BUDGET, SEEDS, RECOVER = 300, 2, 8


def data() -> pd.DataFrame:
    """Return the series of one run with the known weights, every 300 ticks."""
    society = load_model(MODEL)(seed=SEED)
    rows = []
    for tick in range(0, TICKS + 1, EVERY):
        society.advance(tick - society.tick)
        if tick >= FIRST:
            row = society.series()
            rows.append({"tick": tick, **{name: float(row[name]) for name in COLUMNS}})
    return pd.DataFrame(rows)


def fitted(method: str, home: Path, quick: bool = False, workers: int | None = None) -> Fit:
    """Fit the weights by a method, or go on with a fit that was begun.

    Args:
        method: its name.
        home: the folder of all fits.
        quick: a small one, which shows that all works.
        workers: processes; one for each processor by default.
    """
    folder = home / method
    if folder.exists():
        return resume_fit(folder, workers)
    size = (48, 2, 4) if quick else (BUDGET, SEEDS, RECOVER)
    budget, seeds, recover = size
    return fit(
        MODEL, data(), RANGES, budget, TICKS, method=method, seeds=seeds, recover=recover,
        workers=workers, out=folder,
    )  # fmt: skip
