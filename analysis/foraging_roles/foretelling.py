"""What an economy foretells of bodies: that of the model, and the one that is like bodies.

python -m analysis.foraging_roles.foretelling

A row of `results/foretelling.csv` is an attempt at `delivered_anew` and a condition: the share of
worlds within one robot of the wanted split all through the last quarter, in both economies, in
worlds for choosing; and in bodies, as `analysis/specialisation` keeps it.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from socialmind.experiments.studies import topics
from socialmind.mind import MindDescription

from . import economy_like_bodies as like_bodies
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
    rows = [
        {
            "attempt": attempt,
            "condition": condition,
            **{name: share_within(name, mind, condition) for name in ECONOMIES},
            "bodies": float(own.loc[(attempt, condition)]),  # type: ignore[arg-type]
        }
        for attempt, mind in minds_of(LESSON).items()
        for condition in EVENTS
    ]
    return pd.DataFrame(rows)


if __name__ == "__main__":
    found = foretold()
    found.to_csv(OUT, index=False, float_format="%.4g", lineterminator="\n")
    for name in ECONOMIES:
        away = (found[name] - found["bodies"]).abs()
        print(
            f"{name}: correlation {found[name].corr(found['bodies']):.2f}, away {away.mean():.3f}"
        )
