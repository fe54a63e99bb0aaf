"""One society of the study: run, and measured, as a whole and village by village."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from socialmind.catalogue import load_model
from socialmind.experiments.measures.division import (
    division_by_chance,
    division_of_labour,
    share_specialised,
    works_of,
)
from socialmind.experiments.measures.settling import role_changes

CULTURES: dict[str, dict[str, Any]] = {
    "a community each": {},
    "one community": {"one_community": True},
    "no demands": {"demand_step": 0.0},
}
EVERY = 1_000
"""Ticks between two records."""
DEALS = 200
"""How often people are dealt out anew among the villages, for what luck alone gives."""


def lived(culture: str, seed: int, ticks: int) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Run a society and measure its last quarter.

    Args:
        culture: one of `CULTURES`.
        seed: of every draw.
        ticks: length of the run.

    Returns:
        A row for the society, and one for each village with people.
    """
    model = load_model("farmers_artisans_traders")(seed, **CULTURES[culture])
    roles, works, stocks = [], [], []
    for _ in range(ticks // EVERY):
        model.advance(EVERY)
        farmer, artisan = model.callings()
        own = {"tick": model.tick, "agent": model.humans.id}
        roles.append(pd.DataFrame({**own, "role": np.where(artisan > farmer, "artisan", "farmer")}))
        for task, done in (("wheat", model.humans.grown), ("tools", model.humans.made)):
            works.append(pd.DataFrame({**own, "task": task, "amount": done}))
        stocks.append((model.villages.staple, model.villages.ware))
    people, work = pd.concat(roles), pd.concat(works, ignore_index=True)
    work["amount"] = work.groupby(["agent", "task"])["amount"].diff().fillna(work["amount"])
    late = ticks * 3 // 4
    home, third, last = model.members(), *_quarters(people, ticks)
    villages = _of_villages(home, third, last, np.array(stocks), model.tool_price)
    done = works_of(work, since=late + 1).to_numpy()
    settled = people[people["tick"] > late]
    spread, by_chance = spreads(last, home, seed)
    society = {
        "culture": culture,
        "seed": seed,
        "artisans": float(last.mean()),
        "spread": spread,
        "spread_by_chance": by_chance,
        "without_tools": float(np.mean([one["without_tools"] for one in villages])),
        "without_wheat": float(np.mean([one["without_wheat"] for one in villages])),
        "role_changes": role_changes(settled),
        "specialised": float(share_specialised(work, settled).mean()),
        "agents_to_tasks": division_of_labour(done).agents_to_tasks,
        "agents_to_tasks_by_chance": division_by_chance(done, draws=5).agents_to_tasks,
        "wheat": float(model.humans.wheat.mean()),
        "tools": float(model.humans.tools.mean()),
    }
    named = {"culture": culture, "seed": seed}
    return society, [{**named, **one} for one in villages]


def _quarters(people: pd.DataFrame, ticks: int) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return for how much of the third and of the last quarter each agent was an artisan."""
    artisan = people.assign(artisan=people["role"] == "artisan")
    parts = []
    for begin in (ticks // 2, ticks * 3 // 4):
        some = artisan[(artisan["tick"] > begin) & (artisan["tick"] <= begin + ticks // 4)]
        parts.append(some.groupby("agent")["artisan"].mean().to_numpy())
    return parts[0], parts[1]


def _of_villages(
    home: NDArray[Any], third: NDArray[Any], last: NDArray[Any], stocks: NDArray[Any], price: float
) -> list[dict[str, Any]]:
    """Return a row for each village with people."""
    late = stocks[len(stocks) * 3 // 4 :]
    rows = []
    for village in range(stocks.shape[2]):
        own = home == village
        if not own.any():
            continue
        wheat, tools = late[:, 0, village], late[:, 1, village]
        rows.append(
            {
                "village": village,
                "people": int(own.sum()),
                "artisans_third": float(third[own].mean()),
                "artisans_last": float(last[own].mean()),
                "others_third": float(third.mean()),
                "others_last": float(last.mean()),
                "balance": float((wheat - tools).mean()),
                "balance_deviation": float((wheat - tools).std()),
                "without_tools": float((tools <= 1).mean()),
                "without_wheat": float((wheat <= price).mean()),
            }
        )
    return rows


def spreads(mix: ArrayLike, home: ArrayLike, seed: int = 0) -> tuple[float, float]:
    """Return how far apart the mixes of villages are, and how far luck would put them.

    Args:
        mix: for how much of the time each agent was an artisan, 0 … 1.
        home: the village of each; −1 for none.
        seed: of the deals.

    Returns:
        The standard deviation of the villages' mean mixes, weighted by their people; and the mean
        of the same when people are dealt out anew among villages of the same sizes.

    >>> spreads([1, 1, 0, 0], [0, 0, 1, 1])[0]
    0.5
    >>> spreads([1, 0, 1, 0], [0, 0, 1, 1])[0]
    0.0
    """
    mix, home = np.asarray(mix, float), np.asarray(home)
    mix, home = mix[home >= 0], home[home >= 0]
    _, place, sizes = np.unique(home, return_inverse=True, return_counts=True)

    def spread(values: NDArray[np.float64]) -> float:
        means = np.bincount(place, values) / sizes
        return math.sqrt(float((sizes * (means - values.mean()) ** 2).sum() / sizes.sum()))

    rng = np.random.default_rng(seed)
    deals = [spread(rng.permutation(mix)) for _ in range(DEALS)]
    return spread(mix), float(np.mean(deals))
