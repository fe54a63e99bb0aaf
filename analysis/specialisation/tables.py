"""The tables of the study: every attempt, means and differences, with intervals over both."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
import pandas as pd

from socialmind.experiments.measures.crossed import crossed_difference, crossed_interval
from socialmind.experiments.measures.intervals import (
    Interval,
    interval_of,
    share_difference,
    share_interval,
)

from .societies import COMPARED_WITH, REFERENCE


@dataclass(frozen=True)
class Measured:
    """A measure, as tables and figures show it.

    Attributes:
        name: of its column.
        title: of a panel.
        unit: of its axis.
        definition: in a sentence.
        digits: behind the point.
    """

    name: str
    title: str
    unit: str
    definition: str
    digits: int = 2


MEASURED = {
    one.name: one
    for one in (
        Measured(
            "last_distance", "Distance", "robots, last quarter",
            "Robots that would have to change roles for the wanted split, Σ |n_r − w_r · n| / 2 "
            "over the roles r; the mean over the records of the last quarter.",
        ),
        Measured(
            "within", "Within one robot", "share of worlds",
            "Whether the split stays within one robot of the wanted one all through the last "
            "quarter; the share of worlds in which it does.",
        ),
        Measured(
            "settled_after", "Time to settle", "ticks",
            "Ticks from the start, or from the shock, to the first record from which the split "
            "stays within one robot of the wanted one for 5,000 ticks. A world that never settles "
            "counts with all ticks that were left.", 0,
        ),
        Measured(
            "changes", "Role changes", "a robot and 10,000 ticks",
            "Changes of role for each robot and 10,000 ticks, in the whole run.",
        ),
        Measured(
            "late_changes", "Late role changes", "a robot and 10,000 ticks",
            "Changes of role for each robot and 10,000 ticks in the last quarter.",
        ),
        Measured(
            "specialised", "Specialised robots", "share of robots",
            "The share of robots of whose deliveries in the last 10,000 ticks (three or more) 80 % "
            "are of one kind; the mean over the last quarter.",
        ),
        Measured(
            "agents_to_tasks", "Division of labour", "I / H(tasks)",
            "The mutual information of agents and tasks over the entropy of tasks, in the last "
            "quarter: how much knowing the agent says about the task, 0 … 1 (Gorelick, Bertram, "
            "Killeen & Fewell, 2004). Compared with what dealing out the same pieces of work at "
            "random gives.",
        ),
        Measured(
            "delivered", "Objects delivered", "objects",
            "All objects brought home in the whole run.", 0,
        ),
        Measured(
            "in_ratio", "In the wanted ratio", "objects",
            "Of the objects delivered in each half, the largest part with that half's wanted "
            "ratio.", 0,
        ),
    )
}  # fmt: skip
"""By name, in the order of figures and tables."""
OVER_SHARES = ("last_distance", "settled_after", "changes", "agents_to_tasks")
"""Those that are looked at over the share of programmed robots."""
FURTHER = "chosen_{}"
"""The society of the attempts that were chosen in bodies, before, first or again, in further
worlds."""
FURTHER_WAYS = {
    "delivered_anew": "delivered_further",
    "chosen_again": FURTHER.format("again"),
    "like_bodies": "unchosen_further",
    "supervised_role": "supervised_further",
    "programmed": "programmed_further",
    "evolved_scheme": "evolved_further",
    "fixed_thresholds": "fixed_thresholds_further",
    "reinforced_thresholds": "reinforced_thresholds_further",
}
"""Societies of the ways of `further_worlds`."""
FURTHER_TITLES = dict(
    zip(
        FURTHER_WAYS.values(),
        (
            "learned by deliveries",
            "by deliveries, chosen",
            "the lesson of those chosen, every training, nothing chosen",
            "learned, supervised",
            "programmed",
            "scheme, evolved",
            "fixed thresholds",
            "reinforced thresholds",
        ),
        strict=True,
    )
)
LEARNED_FURTHER = ("chosen_again", "unchosen_further", "delivered_further", "supervised_further")
FURTHER_PAIRS = (
    *product((*LEARNED_FURTHER, "evolved_further"), ("programmed_further",)),
    *product(LEARNED_FURTHER, ("fixed_thresholds_further", "reinforced_thresholds_further")),
    ("chosen_again", "delivered_further"),
    ("unchosen_further", "delivered_further"),
    ("delivered_further", "supervised_further"),
)
RUN = ("society", "attempt", "share", "condition", "seed")


def judged(worlds: pd.DataFrame) -> pd.DataFrame:
    """Return worlds with division of labour beyond luck's."""
    return worlds.assign(
        beyond_chance=worlds["agents_to_tasks"] - worlds["agents_to_tasks_by_chance"]
    )


def with_changes(worlds: pd.DataFrame, kinds: pd.DataFrame) -> pd.DataFrame:
    """Return worlds with the changes of roles in the whole run, those of both kinds together.

    Args:
        worlds: a row for each run.
        kinds: of the same runs, a row for each kind of robots: `robots` and `changes`.
    """
    run = list(RUN)
    weighed = kinds.assign(changes=kinds["changes"] * kinds["robots"])
    sums = weighed.groupby(run)[["changes", "robots"]].sum()
    changes = (sums["changes"] / sums["robots"]).rename("changes")
    return worlds.join(changes, on=run)


def by_world(part: pd.DataFrame, measure: str) -> pd.DataFrame:
    """Return a measure by attempt and seed; worlds in which it is unknown are left out."""
    table = part.pivot_table(index="attempt", columns="seed", values=measure, dropna=False)
    return table.replace([math.inf, -math.inf], math.nan).dropna(axis="columns")


def square(part: pd.DataFrame, measure: str) -> np.ndarray:
    """Return a measure as (attempts, worlds); worlds in which it is unknown are left out."""
    return by_world(part, measure).to_numpy(float)


def interval(values: np.ndarray, share: bool = False) -> Interval:
    """Return the mean and its interval: over attempts and worlds, or worlds where one attempt is.

    Args:
        values: (attempts, worlds).
        share: whether it is the share of worlds in which something is so, which has an interval
            with a width where it is so in all.
    """
    if values.size == 0:
        return Interval(math.nan, math.nan, math.nan)
    if len(values) > 1:
        return crossed_interval(values)
    return share_interval(values[0]) if share else interval_of(values[0])


def means(frame: pd.DataFrame, by: Sequence[str], measures: Sequence[str]) -> pd.DataFrame:
    """Return means with intervals over attempts and worlds.

    Args:
        frame: a row for each run: `attempt`, `seed`.
        by: the columns that make groups, which are kept in the order in which they come.
        measures: the columns that are measured; infinite and missing numbers are left out.

    Returns:
        A row for each group and measure: those of `by`, `measure`, `attempts`, `worlds`, `mean`,
        `low`, `high`, and the means of the worst and the best attempt, `least` and `most`.

    >>> frame = pd.DataFrame({"society": "a", "attempt": 0, "seed": [1, 2], "goods": [1.0, 3.0]})
    >>> means(frame, ["society"], ["goods"])[["society", "measure", "worlds", "mean"]]
      society measure  worlds  mean
    0       a   goods       2   2.0
    """
    rows = []
    for key, part in frame.groupby(list(by), sort=False):
        for name in measures:
            values = square(part, name)
            found = interval(values, share=name == "within")
            each = values.mean(axis=1) if values.size else np.array([math.nan])
            rows.append(
                {
                    **dict(zip(by, key, strict=True)),
                    "measure": name,
                    "attempts": values.shape[0],
                    "worlds": values.shape[1],
                    "mean": found.mean,
                    "low": found.low,
                    "high": found.high,
                    "least": each.min(),
                    "most": each.max(),
                }
            )
    return pd.DataFrame(rows)


def further(choices: pd.DataFrame, worlds: int) -> pd.DataFrame:
    """Return the rows of means for attempts of which only their shares of worlds are known.

    Intervals are over attempts.

    Args:
        choices: a row for each `choice` and attempt: the share within one robot, by condition, in
            columns that end in `_reported`.
        worlds: of each.

    >>> table = pd.DataFrame({"choice": "again", "turned_reported": [0.5, 1.0]})
    >>> further(table, 40)[["society", "condition", "mean", "least"]]
            society condition  mean  least
    0  chosen_again    turned  0.75    0.5
    """
    return pd.DataFrame(
        [
            {
                "society": FURTHER.format(choice), "condition": name.removesuffix("_reported"),
                "measure": "within", "attempts": len(table), "worlds": worlds,
                **vars(interval_of(table[name])), "least": table[name].min(),
                "most": table[name].max(),
            }
            for choice, table in choices.groupby("choice")
            for name in table.columns
            if name.endswith("_reported")
        ]
    )  # fmt: skip


def named_further(table: pd.DataFrame) -> pd.DataFrame:
    """Return means or differences of `further_worlds` as rows of these tables.

    >>> found = pd.DataFrame({"way": ["delivered_anew"], "condition": ["turned"], "mean": [0.5]})
    >>> named_further(found)[["society", "condition", "measure", "mean"]]
                 society condition measure  mean
    0  delivered_further    turned  within   0.5
    """
    names = {"way": "society", "than": "reference"}
    told = table.replace({old: FURTHER_WAYS for old in names if old in table})
    return told.rename(columns=names).assign(measure="within")


def further_attempts(table: pd.DataFrame) -> pd.DataFrame:
    """Return in what share of the further worlds each attempt keeps the split.

    Args:
        table: by way, attempt and condition, a column a world.

    >>> rows = pd.MultiIndex.from_tuples([("like_bodies", 3, "turned")],
    ...                                  names=["way", "attempt", "condition"])
    >>> further_attempts(pd.DataFrame([[1, 0, 1, 1]], index=rows))
                society  attempt condition  within
    0  unchosen_further        3    turned    0.75
    """
    found = table.mean(axis=1).rename("within").reset_index()
    return found.replace({"way": FURTHER_WAYS}).rename(columns={"way": "society"})


def attempts(worlds: pd.DataFrame) -> pd.DataFrame:
    """Return what each attempt came to in how many `worlds`: the means of measures over them."""
    groups = worlds.groupby(["society", "attempt", "condition"], sort=False)
    means = groups[list(MEASURED)].mean()
    means.insert(0, "worlds", groups.size())
    return means.reset_index()


def differences(worlds: pd.DataFrame) -> pd.DataFrame:
    """Compare societies with the programmed one, and lessons with each other, in equal worlds.

    Args:
        worlds: `society`, `attempt`, `condition`, `seed` and measures.

    Returns:
        A row for each society, condition and measure, and for each society that it is compared
        with, the `reference`: the difference of the means in the worlds that both have met, with
        its interval over attempts and worlds.
    """
    rows = []
    for condition, part in worlds.groupby("condition", sort=False):
        parts = dict(tuple(part.groupby("society", sort=False)))
        pairs = [(one, REFERENCE) for one in parts if one != REFERENCE]
        pairs += [pair for pair in COMPARED_WITH if set(pair) <= set(parts)]
        for society, reference in pairs:
            for name in MEASURED:
                found = _difference(parts[society], parts[reference], name)
                rows.append(
                    {
                        "society": society,
                        "reference": reference,
                        "condition": condition,
                        "measure": name,
                        "difference": found.mean,
                        "low": found.low,
                        "high": found.high,
                    }
                )
    return pd.DataFrame(rows)


def _difference(own: pd.DataFrame, base: pd.DataFrame, measure: str) -> Interval:
    """Return how much more a society comes to than another; of one without attempts, pairwise."""
    if base["attempt"].nunique() > 1:
        one, other = by_world(own, measure), by_world(base, measure)
        shared = one.columns.intersection(other.columns)
        return crossed_difference(one[shared], other[shared])
    other = own["seed"].map(base.set_index("seed")[measure])
    away = square(own.assign(away=own[measure] - other), "away")
    if measure == "within" and len(away) == 1 and (away == away[0, 0]).all():
        return share_difference(own[measure], other)  # a bootstrap of what is alike has no width
    return interval(away)


def over_time(course: pd.DataFrame, by: Sequence[str]) -> pd.DataFrame:
    """Return mean distance and share of specialised robots at each record.

    Args:
        course: `seed`, `tick`, `distance`, `specialised`.
        by: the columns that make groups.
    """
    groups = course.groupby([*by, "tick"], sort=False)[["distance", "specialised"]]
    return groups.mean().reset_index()


def between_kinds(kinds: pd.DataFrame, measures: Sequence[str]) -> pd.DataFrame:
    """Compare the programmed with the learned robots of mixed societies, world by world.

    Args:
        kinds: of mixed societies: `condition`, `attempt`, `seed`, `share`, `kind` and measures.
        measures: their columns.

    Returns:
        A row for each condition and measure: how much more it is of the programmed, averaged over
        shares, with its interval over attempts and worlds.
    """
    rows = []
    run = ["condition", "attempt", "seed", "share"]
    for name in measures:
        table = kinds.pivot_table(index=run, columns="kind", values=name)
        away = (table["programmed"] - table["learned"]).rename("away").reset_index()
        away = away.groupby(run[:3], sort=False)["away"].mean().reset_index()
        for condition, part in away.groupby("condition", sort=False):
            found = interval(square(part, "away"))
            rows.append(
                {
                    "condition": condition,
                    "measure": name,
                    "difference": found.mean,
                    "low": found.low,
                    "high": found.high,
                }
            )
    return pd.DataFrame(rows)
