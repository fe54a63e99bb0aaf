"""What an economy foretells of bodies: that of the model, and the one that is like bodies.

python -m analysis.foraging_roles.foretelling

A row of `results/foretelling.csv` is an attempt at `delivered_anew` and a condition: the share of
worlds within one robot of the wanted split all through the last quarter, in both economies, in
worlds for choosing; and in bodies, in the ten worlds of `analysis/specialisation`, and in the forty
`further` ones, in which robots are not added. What is printed is how the attempts' shares in an
economy go with those in bodies, by condition: Pearson's correlation, Spearman's, and Pearson's
least and greatest where one attempt is left out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import product
from pathlib import Path
from typing import Any

import pandas as pd

from socialmind.experiments.studies import topics
from socialmind.mind import MindDescription

from . import economy_like_bodies as like_bodies
from . import further_worlds
from .minds import minds_of
from .results import NINE
from .trainings import ECONOMY, LESSONS
from .worlds import CHOOSING_ECONOMY

OUT = Path(__file__).parent / "results" / "foretelling.csv"
IN_BODIES = topics()["specialisation"] / "results" / "specialisation" / "attempts.csv"
LESSON, SOCIETY = "delivered_anew", "delivered"
EVENTS = {
    "undisturbed": ECONOMY.NOTHING,
    "turned": ECONOMY.REVERSED,
    "removed": ECONOMY.REMOVED,
    "added": ECONOMY.ADDED,
}
OF_A = 0
ECONOMIES: Mapping[str, Any] = {
    "economy": like_bodies.DELIVERIES.DeliveryEconomy,
    "like_bodies": like_bodies.DeliveryEconomy,
}


def share_within(
    economy: str, mind: MindDescription, condition: str, worlds: range = CHOOSING_ECONOMY
) -> float:
    """Return the share of worlds of an economy in which nine robots of a mind settle.

    Args:
        economy: its name.
        mind: the robots'.
        condition: what happens half-way; of robots that are taken away, those in A.
        worlds: their seeds.
    """
    terms = {**NINE, "events": (EVENTS[condition],)}
    one = ECONOMIES[economy](terms, mind, LESSONS.MASTER, LESSONS.ROLE)
    if condition == "removed":
        worlds = [  # type: ignore[assignment]
            seed for seed in worlds if ECONOMY.World(seed, one.terms, one.ticks).removed == OF_A
        ]
    outcome = one.run(mind.skill(LESSONS.ROLE).genome[None], worlds)  # type: ignore[index]
    return float(outcome.fields["within"].mean())


def foretold() -> pd.DataFrame:
    """Return the shares of worlds, a row for each attempt and condition."""
    bodies = pd.read_csv(IN_BODIES)
    own = bodies[bodies["society"] == SOCIETY].set_index(["attempt", "condition"])["within"]
    further = further_worlds.read().mean(axis=1)
    rows = [
        {
            "attempt": attempt,
            "condition": condition,
            **{name: share_within(name, mind, condition) for name in ECONOMIES},
            "bodies": float(own.loc[(attempt, condition)]),  # type: ignore[arg-type]
            "further": float(further.get((LESSON, attempt, condition), math.nan)),
        }
        for attempt, mind in minds_of(LESSON).items()
        for condition in EVENTS
    ]
    return pd.DataFrame(rows)


def alike(found: pd.DataFrame) -> pd.DataFrame:
    """Return how shares in economies go with those in bodies, over attempts.

    Returns:
        A row for each economy, `worlds` in bodies and condition: `pearson`, `spearman`, and the
        `least` and the `most` that Pearson's is without one of the attempts.
    """
    rows = []
    for economy, worlds in product(ECONOMIES, ("bodies", "further")):
        for condition, part in found.dropna(subset=worlds).groupby("condition", sort=False):
            pair = part.set_index("attempt")[[economy, worlds]]
            without = [pair.drop(one).corr().iloc[0, 1] for one in pair.index]
            rows.append(
                {
                    "economy": economy,
                    "worlds": worlds,
                    "condition": condition,
                    "pearson": pair.corr().iloc[0, 1],
                    "spearman": pair.corr("spearman").iloc[0, 1],
                    "least": min(without),
                    "most": max(without),
                }
            )
    return pd.DataFrame(rows)


if __name__ == "__main__":
    found = foretold()
    found.to_csv(OUT, index=False, float_format="%.4g", lineterminator="\n")
    print(alike(found).round(2).to_string(index=False))
