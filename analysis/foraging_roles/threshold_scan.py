"""The numbers of both kinds of response thresholds, tried in the economy without bodies.

python -m analysis.foraging_roles.threshold_scan [--quick]

Tried are the range of thresholds and, for reinforced ones, how fast they fall and rise, in the
worlds for choosing. What comes of it is kept in `results/threshold_scan.csv`. The numbers of the
model's `fixed_thresholds.py` are the best of the kind, by the worlds within one robot of the wanted
split over all conditions; those of `reinforced_thresholds.py`, chosen by other draws, are among the
best, which luck tells apart.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from socialmind.catalogue import load_file, load_model

from .luck import BEGUN, DECIDED, Luck
from .results import IN_THE_ECONOMY
from .scheme_scan import TRIED
from .trainings import ECONOMY, MODEL
from .worlds import CHOOSING_ECONOMY

RULES = load_file(MODEL / "thresholds.py")
OUT = Path(__file__).parent / "results" / "threshold_scan.csv"
LOWEST = (0.02, 0.05, 0.1, 0.2)
HIGHEST = (0.2, 0.5, 1.0, 2.0)
RATES = (0.01, 0.03, 0.1)
FEW = 4
NUMBERS = ("lowest_threshold", "highest_threshold", "variety", "learning", "forgetting")
CONTROLLERS: Mapping[str, Mapping[str, float]] = {
    name: {number: known[number].default for number in NUMBERS}
    for name in ("fixed_thresholds", "reinforced_thresholds")
    for known in [load_model(MODEL / f"{name}.py").parameters]
}
"""Parameters of `ForagingByThresholds` by controller."""


class Responders(ECONOMY.Worlds):
    """Worlds in which thresholds decide, by the rules of the model.

    Args:
        drawn: what is different in them.
        seeds: of the thresholds and of decisions, one for each of `drawn`.
        ticks: how long they go on.
        given: `lowest_threshold`, `highest_threshold`, `variety`, `learning` and `forgetting`.
    """

    def __init__(
        self, drawn: Sequence[Any], seeds: Sequence[int], ticks: int, given: Mapping[str, float]
    ) -> None:
        super().__init__(drawn, 1, ticks)
        self.given = SimpleNamespace(**given)
        self.luck = Luck(seeds, DECIDED)
        begun = Luck(seeds, BEGUN).draw(range(len(drawn)), self.most, 2)
        self.thresholds = RULES.begun(np.moveaxis(begun, 2, 0), self.given)

    def decided(
        self,
        rows: NDArray[np.int64],
        who: NDArray[np.int64],
        before: NDArray[np.float64],
        payoff: NDArray[np.float64],
        minds: Any,
    ) -> NDArray[np.float64]:
        """Return the roles by the tasks that the robots take up."""
        given, robot = self.given, who[rows]
        is_b = before[rows] >= 0.5
        own, other = is_b.astype(int), (~is_b).astype(int)
        low, high = given.lowest_threshold, given.highest_threshold
        for task, change in ((own, -given.learning), (other, given.forgetting)):
            found = self.thresholds[task, rows, robot] + change
            self.thresholds[task, rows, robot] = np.clip(found, low, high)
        stimulus = np.maximum(0.0, RULES.AS_IT_SHOULD_BE - payoff[rows])
        chance = RULES.response(stimulus, self.thresholds[other, rows, robot])
        takes_up = self.luck.draw(rows) < chance
        roles = before.copy()
        roles[rows] = np.where(takes_up, ~is_b, is_b)
        return roles


def tried(
    given: Mapping[str, float], terms: Mapping[str, Any], worlds: Sequence[int]
) -> dict[str, float]:
    """Return how robots settle by thresholds: the share of worlds within one, and late changes."""
    one = ECONOMY.Terms(**terms)
    drawn = [ECONOMY.World(seed, one, ECONOMY.TICKS) for seed in worlds]
    responders = Responders(drawn, worlds, ECONOMY.TICKS, given)
    while responders.go_on(None):
        pass
    return {
        "within_one": float((responders.out_last == 0).mean()),
        "changes": float(responders.late_changes().mean()),
    }


def candidates() -> list[dict[str, Any]]:
    """Return all numbers that are tried, a row for each combination."""
    ranges = [(low, high) for low, high in product(LOWEST, HIGHEST) if low < high]
    fixed = [("fixed_thresholds", *one, 1.0, 0.0, 0.0) for one in ranges]
    reinforced = [
        ("reinforced_thresholds", *one, 0.0, *rates)
        for one, rates in product(ranges, product(RATES, RATES))
    ]
    names = ("controller", *NUMBERS)
    return [dict(zip(names, row, strict=True)) for row in fixed + reinforced]


def scan(
    tried_rows: Sequence[Mapping[str, Any]], worlds: Sequence[int] = CHOOSING_ECONOMY
) -> pd.DataFrame:
    """Return how robots settle, a row for each combination and condition."""
    return pd.DataFrame(
        {
            **row,
            "condition": condition,
            **tried(
                {name: value for name, value in row.items() if name != "controller"},
                IN_THE_ECONOMY[condition],
                worlds,
            ),
        }
        for row in tried_rows
        for condition in TRIED
    )


def best(table: pd.DataFrame) -> pd.DataFrame:
    """Return the numbers of each controller that stay within one most often, then change least."""
    means = table.groupby(["controller", *NUMBERS])[["within_one", "changes"]].mean()
    ordered = means.reset_index().sort_values(
        ["within_one", "changes"], ascending=[False, True], kind="stable"
    )
    return ordered.groupby("controller").head(1).reset_index(drop=True)


def main(arguments: Sequence[str]) -> None:
    """Try all, keep what comes of it and print the best."""
    quick = "--quick" in arguments
    found = scan(candidates(), CHOOSING_ECONOMY[: FEW if quick else None])
    if not quick:
        OUT.parent.mkdir(parents=True, exist_ok=True)
        found.round(4).to_csv(OUT, index=False, lineterminator="\n")
    print(best(found).round(3).to_string())


if __name__ == "__main__":
    main(sys.argv[1:])
