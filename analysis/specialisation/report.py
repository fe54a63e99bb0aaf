"""The report: tables and figures of what was run, and the page that shows them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import pandas as pd

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_file, model_folder
from socialmind.drawing import style as paper

from . import farmers, plots
from .budgets import budgets
from .farmers_figure import villagers
from .page import page_of
from .societies import FULL, MIXED, MIXED_WITH, SEED, TRAINED, Size
from .tables import (
    MEASURED,
    attempts,
    between_kinds,
    differences,
    further,
    further_attempts,
    judged,
    means,
    named_further,
    over_time,
    with_changes,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .runs import Records

CHOOSING = load_file(TRAINED / "choosing_again.py")
LATER = load_file(TRAINED / "further_worlds.py")
BOTH = ("society", "condition")
SCHEME = "scheme.yaml"


@dataclass(frozen=True)
class Made:
    """What the report shows.

    Attributes:
        figures: by name.
        page: the HTML.
    """

    figures: Mapping[str, Figure]
    page: str


def made(
    tables: Mapping[str, pd.DataFrame], distilled: CognitiveScheme, size: Size, command: str
) -> Made:
    """Make figures and the page.

    Args:
        tables: by name.
        distilled: the scheme of the mind of the farmers' model.
        size: of the study.
        command: that makes all this.
    """
    with paper.style():
        figures = figures_of(tables, distilled, size)
    return Made(figures, page_of(tables, figures, size, command))


# Tables and figures -------------------------------------------------------------------------------


def tables_of(records: Records, village: farmers.Found, size: Size) -> dict[str, pd.DataFrame]:
    """Return all tables by name.

    What attempts come to in further worlds is as `analysis/foraging_roles` keeps it; means and
    differences of the whole study have it too.
    """
    worlds = judged(with_changes(records.worlds, records.kinds))
    alone = worlds[worlds["society"] != "mixed"]
    mixed = mixed_of(worlds, size)
    kinds = records.kinds[records.kinds["society"] == "mixed"]
    measures = [*MEASURED, "agents_to_tasks_by_chance", "beyond_chance"]
    villagers = village.worlds
    of_villagers = [*farmers.MEASURED, "agents_to_tasks_by_chance", "beyond_chance"]
    of_robots, choices = means(alone, BOTH, measures), CHOOSING.both()
    away = differences(alone)
    if size == FULL:
        kept = LATER.read()
        first = choices[choices["choice"] == "first"]
        looks = [(CHOOSING.before(), CHOOSING.BEFORE), (first, len(CHOOSING.FURTHER))]
        looked_at = [further(table, worlds) for table, worlds in looks]
        later = named_further(LATER.means(kept)).assign(worlds=len(LATER.WORLDS))
        of_robots = pd.concat([of_robots, *looked_at, later])
        told = LATER.differences(kept).rename(columns={"mean": "difference"})
        away = pd.concat([away, named_further(told)])
    tables = {"further-attempts": further_attempts(LATER.read())} if size == FULL else {}
    return {
        **tables,
        "worlds": worlds,
        "attempts": attempts(alone),
        "chosen": choices,
        "budgets": budgets(size),
        "means": of_robots,
        "differences": away,
        "course": over_time(records.course[records.course["society"] != "mixed"], BOTH),
        "robots": first_spells(records.spells),
        "mixed-means": means(mixed, ["condition", "share"], measures),
        "mixed-kinds": means(kinds, ["condition", "share", "kind"], list(plots.KINDS)),
        "mixed-kinds-differences": between_kinds(kinds, list(plots.KINDS)),
        "farmers": villagers,
        "farmers-means": means(villagers, ["society"], of_villagers),
        "farmers-differences": farmers.differences(villagers, of_villagers),
        "farmers-course": farmers_over_time(village.course),
    }


def farmers_over_time(course: pd.DataFrame) -> pd.DataFrame:
    """Return artisans and specialised agents over time, with intervals over attempts and seeds."""
    return means(course, ["society", "tick"], ["artisans", "specialised"])


def mixed_of(worlds: pd.DataFrame, size: Size) -> pd.DataFrame:
    """Return mixed societies, and those of one kind alone, in the worlds that they share."""
    alike = worlds["society"].isin(["mixed", MIXED_WITH, "programmed"])
    met = worlds["seed"] < SEED + size.mixed_worlds
    return worlds[alike & met & worlds["condition"].isin(MIXED)]


def first_spells(spells: pd.DataFrame) -> pd.DataFrame:
    """Return the spells of the first attempt of each society."""
    alone = spells[spells["society"] != "mixed"]
    first = alone.groupby("society")["attempt"].transform("min")
    return alone[alone["attempt"] == first].drop(columns=["attempt", "share"])


def figures_of(
    tables: Mapping[str, pd.DataFrame], distilled: CognitiveScheme, size: Size
) -> dict[str, Figure]:
    """Return all figures by name, in the order of the page."""
    robots, written = (
        CognitiveScheme.load(model_folder(model) / SCHEME)
        for model in ("foraging_roles", "farmer_artisan")
    )
    return {
        "programmed": plots.schemes({"programmed robots": robots}, paper.PAGE * 0.6),
        "attempts": plots.attempts(tables["attempts"], tables["means"]),
        "course": plots.course(tables["course"], size),
        "robots": plots.robots(tables["robots"], "turned", size),
        "measures": plots.measures(tables["means"]),
        "mixed": plots.mixed(tables["mixed-means"], tables["mixed-kinds"]),
        "farmers": villagers(
            tables["farmers-course"], tables["farmers-means"], tables["farmers"], size
        ),
        "schemes": plots.schemes({"written": written, "distilled": distilled}),
    }
