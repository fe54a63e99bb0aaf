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
BUDGET, SEEDS, RECOVER = 300, 2, 8

METHODS = ("cmaes", "tpe", "lhs", "abc")
COMPARED = ("influence.Artisan.ProduceTools", "reinforcement.Artisan.TradeToolsForWheat")
COMPARED_TICKS, COMPARED_BUDGET, COMPARED_SEEDS, COMPARED_RECOVER = 3_000, 80, 1, 6
"""Two of the weights, over fewer ticks: what four methods find at equal budget."""


def data(ticks: int = TICKS) -> pd.DataFrame:
    """Return the series of one run with the known weights, every 300 ticks."""
    society = load_model(MODEL)(seed=SEED)
    rows = []
    for tick in range(0, ticks + 1, EVERY):
        society.advance(tick - society.tick)
        if tick >= FIRST:
            row = society.series()
            rows.append({"tick": tick, **{name: float(row[name]) for name in COLUMNS}})
    return pd.DataFrame(rows)


def six_weights(home: Path, quick: bool = False, workers: int | None = None) -> Fit:
    """Fit all weights, or go on with the fit that was begun.

    Args:
        home: the folder of all fits.
        quick: a small one, which shows that all works.
        workers: processes; one for each processor by default.
    """
    if (home / "weights").exists():
        return resume_fit(home / "weights", workers)
    budget, recover = (48, 2) if quick else (BUDGET, RECOVER)
    return fit(
        MODEL, data(), RANGES, budget, seeds=SEEDS, recover=recover, workers=workers,
        out=home / "weights",
    )  # fmt: skip


def two_weights(method: str, home: Path, quick: bool = False, workers: int | None = None) -> Fit:
    """Fit two weights by a method, or go on with the fit that was begun; arguments as above."""
    if (home / method).exists():
        return resume_fit(home / method, workers)
    ranges = {name: RANGES[name] for name in COMPARED}
    budget, recover = (8, 1) if quick else (COMPARED_BUDGET, COMPARED_RECOVER)
    return fit(
        MODEL, data(COMPARED_TICKS), ranges, budget, method=method, seeds=COMPARED_SEEDS,
        recover=recover, workers=workers, out=home / method,
    )  # fmt: skip
