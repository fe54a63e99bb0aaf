"""How many robots too many a mind puts up with, and what a payoff can tell of it.

`large_groups` writes what is found here: `results/dead_zones.csv`, those for whose payoff, told
again and again, a mind does not change its role; `results/payoffs_at_rest.csv`, how far payoffs
spread where the split is the wanted one for good, beside what one robot too many takes.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.stats import spearmanr

from socialmind.mind import MindDescription

from .contestants import PICKED, Contestant
from .economy_worlds import ROLE, learned_choice, numbers_of_scheme, with_genome
from .results import NINE
from .threshold_scan import CONTROLLERS
from .trainings import ECONOMY, MODEL

AS_IT_SHOULD_BE = 0.5
WANTED, DELIVERIES_OF_A_RUN = 2 / 3, 75

Floats = NDArray[np.float64]

# Dead zones ---------------------------------------------------------------------------------------


def dead_zone(mind: MindDescription, in_b: bool, deliveries: int) -> float:
    """Return the least lack of payoff, told at every delivery, at which a learned mind changes.

    Args:
        mind: the robot's, with a CollectSelect that changes at 0.5.
        in_b: its role at first.
        deliveries: in which it changes.

    Returns:
        0.001 … 0.5; NaN where it never does.
    """
    lacks = np.arange(1, 501) / 1000
    minds = with_genome(ECONOMY.thinking(mind, ROLE), mind, len(lacks))
    role = np.full(len(lacks), float(in_b))
    changed = np.zeros(len(lacks), bool)
    for _ in range(deliveries):
        minds.set_sensor("PAYOFF", AS_IT_SHOULD_BE - lacks)
        minds.set_sensor("ROLE", role)
        minds.step()
        role = minds.actuator("ROLE").copy()
        changed |= (role >= 0.5) != in_b
    return float(lacks[changed.argmax()]) if changed.any() else float("nan")


def robots_off(lack: float, robots: int, wanted: float = WANTED) -> float:
    """Return by how many robots a split is off where its payoff lacks so much, on the mean.

    The payoff lacks 0.15 · (share − wanted) / (wanted · (1 − wanted)); see `payoff.py`.

    >>> round(robots_off(0.075, 9), 6), round(robots_off(0.075, 36), 6)
    (1.0, 4.0)
    """
    return lack / 0.15 * wanted * (1 - wanted) * robots


def dead_zones(some: Iterable[Contestant]) -> pd.DataFrame:
    """Return how many robots too many ways put up with: a row for each attempt and role."""
    rows = []
    for one in some:
        mind = one.mind or MindDescription.load(MODEL / "mind")
        if "programmed" in one.parameters:
            tolerance = numbers_of_scheme(one)["tolerance"] / 100
            lacks = {"A": tolerance, "B": tolerance}
        elif one.way in CONTROLLERS or learned_choice(mind):
            continue  # thresholds have no dead zone; of learned choices the middle is elsewhere
        else:
            lacks = {kind: dead_zone(mind, kind == "B", DELIVERIES_OF_A_RUN) for kind in ("A", "B")}
        for kind, lack in lacks.items():
            off = {f"of_{number}": robots_off(lack, number) for number in (9, 18, 36)}
            rows.append({"way": one.way, "attempt": one.attempt, "role": kind, "lack": lack, **off})
    return pd.DataFrame(rows)


# What a payoff can tell ---------------------------------------------------------------------------


def payoffs_at_rest(
    robots: int, even: bool, worlds: Sequence[int], ticks: int
) -> tuple[float, float]:
    """Return how far payoffs of objects B spread in groups whose split is the wanted one for good.

    Args:
        robots: how many, a multiple of three.
        even: whether trips for A and for B are equally long.
        worlds: seeds.
        ticks: of a run, of which the second half counts.

    Returns:
        The mean standard deviation within a world, which time averages out; and the standard
        deviation between the worlds' means, which it does not.
    """
    terms = ECONOMY.Terms(**{**NINE, "numbers": (robots,)})
    drawn = [ECONOMY.World(seed, terms, ticks) for seed in worlds]
    found: Any = ECONOMY.Worlds(drawn, 1, ticks)
    found.role[:] = np.arange(found.most) < round(WANTED * robots)
    told = []
    if even:
        found.uneven[:] = 1.0

    def stays(rows: Any, who: Any, before: Floats, payoff: Floats, minds: Any) -> Floats:
        late = rows[(found.now[rows] > ticks / 2) & (before[rows] > 0.5)]
        told.append(np.stack([late, payoff[late]], axis=1))
        return before

    found.decided = stays
    while found.go_on(None):
        pass
    by_world = pd.DataFrame(np.concatenate(told), columns=["world", "payoff"]).groupby("world")
    return float(by_world["payoff"].std().mean()), float(by_world["payoff"].mean().std())


def spread_of_payoffs(worlds: Sequence[int], ticks: int) -> pd.DataFrame:
    """Return the spread of payoffs beside what one robot too many in B takes of one."""
    rows = []
    for even in (False, True):
        for robots in (9, 18, 36):
            within, between = payoffs_at_rest(robots, even, worlds, ticks)
            one = 0.15 / (WANTED * (1 - WANTED)) / robots
            rows.append(
                {"robots": robots, "even": even, "within": within, "between": between, "one": one}
            )
    return pd.DataFrame(rows)


def by_dead_zone(table: pd.DataFrame, zones: pd.DataFrame) -> str:
    """Return whether learned minds with wider dead zones are farther off, as a line of Markdown.

    Compared are thirty-six robots on even trips, by rank.

    Args:
        table: what was judged.
        zones: the dead zones, a row for each attempt and role.
    """
    many = table[(table["robots"] == 36) & (table["gain"] == 1.0) & table["even"]]
    off = many.groupby(["way", "attempt"])["off"].mean()
    learned = zones[zones["way"].isin([PICKED, "supervised_role"])]
    wide = learned.groupby(["way", "attempt"])["of_36"].sum()
    both = pd.concat([off, wide], axis=1, join="inner")
    found = spearmanr(both["off"], both["of_36"])
    return (
        f"Dead zones of both roles together and robots off, of {len(both)} learned minds: "
        f"Spearman's ρ = {found.statistic:.2f}, p = {found.pvalue:.2f}.\n"
    )
