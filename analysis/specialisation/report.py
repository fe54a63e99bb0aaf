"""The report: tables and figures of what was run, and the page that shows them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import pandas as pd

from coglogo_py import CognitiveScheme
from socialmind.catalogue import model_folder
from socialmind.drawing import style as paper
from socialmind.experiments.measures.effects import comparisons

from . import farmers, plots
from .page import page_of
from .societies import CONDITIONS, Size
from .tables import (
    MEASURED,
    OVER_SHARES,
    between_kinds,
    differences,
    judged,
    means,
    mixed_of,
    over_time,
    settled_by,
    slopes,
    with_changes,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from .runs import Records

BOTH = ("society", "condition")
OTHERS = ("programmed", "learned")
"""The societies that all others are compared with."""
SCHEME = "scheme.yaml"


@dataclass(frozen=True)
class Made:
    """What the report shows.

    Attributes:
        tables: by name; each is written as CSV.
        figures: by name.
        page: the HTML.
    """

    tables: Mapping[str, pd.DataFrame]
    figures: Mapping[str, Figure]
    page: str


def made(records: Records, village: farmers.Found, size: Size, command: str) -> Made:
    """Make tables, figures and the page.

    Args:
        records: of the robots.
        village: of the farmers and artisans.
        size: of the study.
        command: that makes all this.
    """
    tables = tables_of(records, village, size)
    with paper.style():
        figures = figures_of(tables, village, size)
    return Made(tables, figures, page_of(tables, figures, village, size, command))


# Tables and figures -------------------------------------------------------------------------------


def tables_of(records: Records, village: farmers.Found, size: Size) -> dict[str, pd.DataFrame]:
    """Return all tables by name."""
    worlds = judged(with_changes(records.worlds, records.kinds))
    alone = worlds[worlds["society"] != "mixed"]
    mixed = mixed_of(worlds)
    kinds = mixed_of(records.kinds)
    measures = [*MEASURED, "settled", "agents_to_tasks_by_chance", "beyond_chance"]
    shares = ["condition", "share"]
    villagers = village.worlds.assign(
        beyond_chance=village.worlds["agents_to_tasks"]
        - village.worlds["agents_to_tasks_by_chance"]
    )
    of_villagers = [*farmers.MEASURED, "agents_to_tasks_by_chance", "beyond_chance"]
    return {
        "worlds": worlds,
        "means": means(alone, BOTH, measures),
        "differences": differences(alone, OTHERS),
        "course": over_time(records.course[records.course["society"] != "mixed"], BOTH),
        "settled": pd.concat(
            [
                settled_by(part, BOTH, size.half if CONDITIONS[name].parameter else size.ticks)
                for name, part in alone.groupby("condition", sort=False)
            ],
            ignore_index=True,
        ),
        "robots": records.spells[records.spells["society"] != "mixed"],
        "mixed-means": means(mixed, shares, measures),
        "mixed-slopes": slopes(mixed, OVER_SHARES),
        "mixed-kinds": means(kinds, [*shares, "kind"], list(plots.KINDS)),
        "mixed-kinds-differences": between_kinds(kinds, list(plots.KINDS)),
        "farmers": villagers,
        "farmers-means": means(villagers, ["society"], of_villagers),
        "farmers-differences": comparisons(villagers, "learned", measures=of_villagers),
        "farmers-course": means(village.course, ["society", "tick"], ["artisans", "specialised"]),
    }


def figures_of(
    tables: Mapping[str, pd.DataFrame], village: farmers.Found, size: Size
) -> dict[str, Figure]:
    """Return all figures by name, in the order of the page."""
    return {
        "programmed": plots.schemes(
            {"programmed robots": CognitiveScheme.load(model_folder("foraging_roles") / SCHEME)},
            paper.PAGE * 0.6,
        ),
        "course": plots.course(tables["course"], tables["settled"], size),
        "robots": plots.robots(tables["robots"], "turned", size),
        "measures": plots.measures(tables["means"]),
        "mixed": plots.mixed(tables["mixed-means"], tables["mixed-kinds"]),
        "farmers": plots.villagers(tables["farmers-course"], tables["farmers-means"], size),
        "schemes": plots.schemes(
            {"written": village.written, "distilled": village.distillation.scheme}
        ),
    }
