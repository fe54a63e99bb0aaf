"""The other way round: farmers by a written scheme, by learned minds, by distilled schemes."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from socialmind.catalogue import load_file

from .societies import Size
from .tables import Measured, interval, square

STUDY = load_file(Path(__file__).parents[1] / "farmer_artisan" / "learned.py")
SOCIETIES = {
    "written": "the scheme that somebody wrote",
    "learned": "a perceptron that was taught for wheat, and reads the same cognitons; all attempts",
    "distilled": "a scheme of few links that was distilled from such a perceptron; all attempts",
    "shipped": "the perceptron of the model, one more attempt at the same lesson",
}
REFERENCE = "learned"
"""The society that the others are compared with."""
DISTILLED = "distilled.yaml"
"""The file of the scheme that is distilled from the model's mind."""
MEASURED = {
    one.name: one
    for one in (
        Measured(
            "prosperity", "Wheat of a person", "comfortable stocks",
            "The mean stock of wheat at the end, over the one that leaves no need.",
        ),
        Measured(
            "specialised", "Specialised agents", "share of agents",
            "As for robots; a piece of work is what an agent is seen doing at a record.",
        ),
        Measured(
            "agents_to_tasks", "Division of labour", "I / H(tasks)", "As for robots.",
        ),
        Measured(
            "role_changes", "Role changes", "an agent and 10,000 ticks",
            "While settled: within one agent of 20 farmers and 5 artisans, which is near what "
            "runs of the written scheme come to.",
        ),
        Measured(
            "last_distance", "Distance to 20 : 5", "agents, last quarter",
            "As for robots, to 20 farmers and 5 artisans.",
        ),
        Measured(
            "delivered", "Tools to others", "tools",
            "Tools that an agent sold less those that it bought, of agents that sold more.", 0,
        ),
    )
}  # fmt: skip


@dataclass(frozen=True)
class Found:
    """What was found of the societies.

    Attributes:
        worlds: `society`, `attempt`, `seed` and measures.
        course: `society`, `attempt`, `seed`, `tick`, `artisans` and `specialised`.
    """

    worlds: pd.DataFrame
    course: pd.DataFrame


def found(size: Size, home: Path, workers: int | None = None) -> Found:
    """Distil a scheme from each learned mind, and run all societies on the same seeds.

    Args:
        size: of the study.
        home: where the scheme that is distilled from the model's mind is written.
        workers: processes; one for each processor by default.
    """
    made = STUDY.all_societies(size.farmers, size.farmers_ticks, size.attempts, workers)
    home.mkdir(parents=True, exist_ok=True)
    own, _ = made.distilled[STUDY.SHIPPED]
    own.scheme.save(home / DISTILLED)
    return Found(made.worlds, made.course)


def differences(worlds: pd.DataFrame, measures: list[str]) -> pd.DataFrame:
    """Compare societies with those of the learned minds, seed by seed.

    What is distilled from a mind stands beside that mind; what nobody learned, and the model's
    mind, beside each of them.

    Args:
        worlds: `society`, `attempt`, `seed` and measures, a row for each run.
        measures: their columns.

    Returns:
        A row for each society and measure: `difference`, with its interval over attempts and
        seeds, `low` and `high`.
    """
    rows = []
    base = worlds[worlds["society"] == REFERENCE].set_index(["attempt", "seed"])
    for society in [one for one in worlds["society"].unique() if one != REFERENCE]:
        own = worlds[worlds["society"] == society].set_index(["attempt", "seed"])
        for name in measures:
            if society == "distilled":
                away = own[name] - base[name]
            else:
                seeds = base.index.get_level_values("seed")
                away = own[name].droplevel("attempt").reindex(seeds).to_numpy() - base[name]
            told = interval(square(away.rename("away").reset_index(), "away"))
            rows.append(
                {
                    "society": society, "measure": name, "difference": told.mean,
                    "low": told.low, "high": told.high,
                }
            )  # fmt: skip
    return pd.DataFrame(rows)
