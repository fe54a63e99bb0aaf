"""The few numbers of the scheme that decides about roles, tried in the economy without bodies.

python -m analysis.foraging_roles.scheme_scan [--quick]

The robots follow the very rules and the scheme of the model. Tried are the influence of a calling
on its plan, beside 1 of the plenty on the other one, and how much of a payoff may be lacking before
the other plan is open. What comes of it is kept in `results/scheme_scan.csv`.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.society import Society
from socialmind.catalogue import load_file

from .results import IN_THE_ECONOMY
from .trainings import ECONOMY, MODEL
from .worlds import CHOOSING_ECONOMY

DECIDING = load_file(MODEL / "deciding.py")
PLANS = {"CollectA": DECIDING.collect_a, "CollectB": DECIDING.collect_b}
OUT = Path(__file__).parent / "results" / "scheme_scan.csv"
INFLUENCES = (2.0, 4.0, 8.0)
TOLERANCES = (3.0, 5.0, 7.0)
TRIED = ("nine robots", "wanted ratio turned round", "three of one role taken away",
         "three added", "eighteen robots")  # fmt: skip
WORLDS, FEW = 64, 4


def scheme_with(influence: float) -> CognitiveScheme:
    """Return the model's scheme with another influence of the callings.

    Args:
        influence: of a calling on its plan.
    """
    scheme = CognitiveScheme.load(MODEL / "scheme.yaml")
    cognitons = tuple(
        replace(one, influence=dict.fromkeys(one.influence, influence))
        if one.name.startswith("Calling")
        else one
        for one in scheme.cognitons
    )
    return replace(scheme, cognitons=cognitons)


@dataclass
class Trader:
    """A robot without a body, as the rules of the model know one."""

    mind: Any
    is_b: bool
    payoff: float = 0.5
    plan: str = ""

    @property
    def hierarchy(self) -> Trader:
        """What carries out a role: nothing but the robot itself."""
        return self

    def set_variable(self, name: str, value: float) -> None:
        """Take over a role."""
        self.is_b = value >= 0.5

    def run_plan(self, model: Any, rng: Any) -> None:
        """Carry out the plan that was chosen."""
        PLANS[self.plan](self)


class Traders(ECONOMY.Worlds):
    """Worlds in which the scheme decides.

    Args:
        drawn: what is different in them.
        seeds: of decisions, one for each of `drawn`.
        ticks: how long they go on.
        scheme: what decides.
        tolerance: per cent of a payoff.
    """

    def __init__(
        self,
        drawn: Sequence[Any],
        seeds: Sequence[int],
        ticks: int,
        scheme: CognitiveScheme,
        tolerance: float,
    ) -> None:
        super().__init__(drawn, 1, ticks)
        self.model = SimpleNamespace(tolerance=tolerance)
        self.traders = [
            [Trader(society.new_mind(), bool(role >= 0.5)) for role in roles]
            for society, roles in zip(
                (Society(scheme, one) for one in seeds), self.role, strict=True
            )
        ]
        for one in (trader for several in self.traders for trader in several):
            DECIDING.begin_plan(one)

    def decided(
        self,
        rows: NDArray[np.int64],
        who: NDArray[np.int64],
        before: NDArray[np.float64],
        payoff: NDArray[np.float64],
        minds: Any,
    ) -> NDArray[np.float64]:
        """Return the roles by the plans that the robots choose."""
        roles = before.copy()
        for row in rows.tolist():
            robot = self.traders[row][who[row]]
            robot.payoff = float(payoff[row])
            DECIDING.follow_scheme(robot, self.model, None)
            roles[row] = float(robot.is_b)
        return roles


def tried(
    influence: float, tolerance: float, terms: Mapping[str, Any], worlds: int
) -> dict[str, float]:
    """Return how robots settle with some numbers of the scheme.

    Args:
        influence: of a calling on its plan.
        tolerance: per cent of a payoff.
        terms: of the economy.
        worlds: how many.
    """
    given = ECONOMY.Terms(**terms)
    seeds = CHOOSING_ECONOMY[:worlds]
    drawn = [ECONOMY.World(seed, given, ECONOMY.TICKS) for seed in seeds]
    traders = Traders(drawn, seeds, ECONOMY.TICKS, scheme_with(influence), tolerance)
    while traders.go_on(None):
        pass
    return {
        "within_one": float((traders.out_last == 0).mean()),
        "changes": float(traders.late_changes().mean()),
    }


def scan(
    influences: Sequence[float] = INFLUENCES,
    tolerances: Sequence[float] = TOLERANCES,
    worlds: int = WORLDS,
) -> pd.DataFrame:
    """Return how robots settle, a row for each combination and condition.

    Args:
        influences: of a calling on its plan.
        tolerances: per cent of a payoff.
        worlds: how many for each.
    """
    return pd.DataFrame(
        {
            "influence": influence,
            "tolerance": tolerance,
            "condition": condition,
            "worlds": worlds,
            **tried(influence, tolerance, IN_THE_ECONOMY[condition], worlds),
        }
        for influence, tolerance, condition in product(influences, tolerances, TRIED)
    )


def main(arguments: Sequence[str]) -> None:
    """Try all, keep and print what comes of it."""
    quick = "--quick" in arguments
    found = scan(worlds=FEW if quick else WORLDS)
    if not quick:
        OUT.parent.mkdir(parents=True, exist_ok=True)
        found.round(4).to_csv(OUT, index=False, lineterminator="\n")
    print(found.groupby(["influence", "tolerance"])[["within_one", "changes"]].mean().round(3))


if __name__ == "__main__":
    main(sys.argv[1:])
