"""The tables of the study: means with intervals, and differences with effect sizes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from socialmind.experiments.measures.effects import comparisons
from socialmind.experiments.measures.intervals import interval_of

from .societies import MIXED, REFERENCE
from .words import one_of, side


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
            "late_changes", "Late role changes", "the same, last quarter",
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


def judged(worlds: pd.DataFrame) -> pd.DataFrame:
    """Return worlds with whether each settled at last, and division of labour beyond luck's."""
    return worlds.assign(
        settled=np.isfinite(last_settling(worlds)).astype(float),
        beyond_chance=worlds["agents_to_tasks"] - worlds["agents_to_tasks_by_chance"],
    )


def mixed_of(frame: pd.DataFrame) -> pd.DataFrame:
    """Return what a table holds of mixed societies, those of one kind alone among them."""
    alike = frame["society"].isin(["mixed", "learned", "programmed"])
    return frame[alike & frame["condition"].isin(MIXED)]


def with_changes(worlds: pd.DataFrame, kinds: pd.DataFrame) -> pd.DataFrame:
    """Return worlds with the changes of roles in the whole run, those of both kinds together.

    Args:
        worlds: a row for each run.
        kinds: of the same runs, a row for each kind of robots: `robots` and `changes`.
    """
    run = ["society", "share", "condition", "seed"]
    weighed = kinds.assign(changes=kinds["changes"] * kinds["robots"])
    sums = weighed.groupby(run)[["changes", "robots"]].sum()
    changes = (sums["changes"] / sums["robots"]).rename("changes")
    return worlds.join(changes, on=run)


def means(frame: pd.DataFrame, by: Sequence[str], measures: Sequence[str]) -> pd.DataFrame:
    """Return means with intervals.

    Args:
        frame: a row for each run.
        by: the columns that make groups, which are kept in the order in which they come.
        measures: the columns that are measured; infinite and missing numbers are left out.

    Returns:
        A row for each group and measure: those of `by`, `measure`, `n`, `mean`, `low`, `high`.

    >>> frame = pd.DataFrame({"society": ["a", "a"], "goods": [1.0, 3.0]})
    >>> means(frame, ["society"], ["goods"])[["society", "measure", "n", "mean"]]
      society measure  n  mean
    0       a   goods  2   2.0
    """
    rows = []
    for key, part in frame.groupby(list(by), sort=False):
        for name in measures:
            known = part[name].to_numpy(float)
            known = known[np.isfinite(known)]
            row = {**dict(zip(by, key, strict=True)), "measure": name, "n": len(known)}
            if len(known):
                found = interval_of(known)
                row |= {"mean": found.mean, "low": found.low, "high": found.high}
            else:
                row |= {"mean": math.nan, "low": math.nan, "high": math.nan}
            rows.append(row)
    return pd.DataFrame(rows)


def over_time(course: pd.DataFrame, by: Sequence[str]) -> pd.DataFrame:
    """Return mean distance and share of specialised robots at each record, as `means` does.

    Args:
        course: `seed`, `tick`, `distance`, `specialised`.
        by: the columns that make groups.
    """
    return means(course, [*by, "tick"], ["distance", "specialised"])


def settled_by(worlds: pd.DataFrame, by: Sequence[str], end: int) -> pd.DataFrame:
    """Return what share of worlds has settled how soon after the start, or after the shock.

    Args:
        worlds: `settling_ticks`, and `recovery_ticks_1` where there was a shock.
        by: the columns that make groups.
        end: the last number of ticks that is of interest.

    Returns:
        A row for each group and step: those of `by`, `ticks`, `share`.

    >>> worlds = pd.DataFrame({"society": "a", "settling_ticks": [100.0, math.inf],
    ...                        "recovery_ticks_1": math.nan})
    >>> settled_by(worlds, ["society"], 900)[["ticks", "share"]].values.tolist()
    [[0.0, 0.0], [100.0, 0.5], [900.0, 0.5]]
    """
    rows = []
    for key, part in worlds.groupby(list(by), sort=False):
        took = np.sort(last_settling(part))
        steps = np.unique(took[took <= end])
        share = [float((took <= step).mean()) for step in steps]
        points = list(zip(steps.tolist(), share, strict=True))
        if not points or points[0][0] > 0:
            points.insert(0, (0.0, 0.0))
        points.append((float(end), points[-1][1]))
        rows += [
            {**dict(zip(by, key, strict=True)), "ticks": ticks, "share": part_settled}
            for ticks, part_settled in points
        ]
    return pd.DataFrame(rows)


def last_settling(worlds: pd.DataFrame) -> np.ndarray:
    """Return the ticks to settle after the shock, or from the start where there was none."""
    first = worlds["settling_ticks"]
    again = worlds.get("recovery_ticks_1", first)  # no column where there was no shock at all
    return again.fillna(first).to_numpy(float)


def differences(worlds: pd.DataFrame, references: Sequence[str] = (REFERENCE,)) -> pd.DataFrame:
    """Compare societies with others, condition by condition, in pairs of equal worlds.

    Args:
        worlds: `society`, `condition`, `seed` and measures.
        references: the societies that the others are compared with.

    Returns:
        As `experiments.measures.effects.comparisons` gives it, with `condition` and `reference`
        before it.
    """
    parts = []
    for reference in references:
        for condition, part in worlds.groupby("condition", sort=False):
            columns = ["society", "seed", *MEASURED]
            found = comparisons(part[columns], reference)
            found.insert(0, "condition", condition)
            found.insert(1, "reference", reference)
            parts.append(found)
    return pd.concat(parts, ignore_index=True)


def slopes(mixed: pd.DataFrame, measures: Sequence[str]) -> pd.DataFrame:
    """Return how measures rise with the share of programmed robots, world by world.

    In each world a straight line is fitted to a measure over the share; `slope` is the mean of the
    worlds' slopes, from a share of 0 to one of 1.

    Args:
        mixed: `condition`, `share`, `seed` and measures.
        measures: their columns.

    Returns:
        A row for each condition and measure: `slope`, `low`, `high`, `n` worlds.

    >>> mixed = pd.DataFrame({"condition": "calm", "share": [0.0, 0.5, 1.0] * 2,
    ...                       "seed": [1, 1, 1, 2, 2, 2], "off": [1.0, 2.0, 3.0, 0.0, 1.0, 2.0]})
    >>> slopes(mixed, ["off"])[["slope", "low", "n"]].round(6).values.tolist()
    [[2.0, 2.0, 2.0]]
    """
    rows = []
    for condition, part in mixed.groupby("condition", sort=False):
        for name in measures:
            table = part.pivot(index="seed", columns="share", values=name).dropna()
            shares = table.columns.to_numpy(float)
            away = shares - shares.mean()
            each = table.to_numpy(float) @ away / (away**2).sum()
            found = interval_of(np.round(each, 12)) if len(each) else None
            rows.append(
                {
                    "condition": condition,
                    "measure": name,
                    "n": len(each),
                    "slope": math.nan if found is None else found.mean,
                    "low": math.nan if found is None else found.low,
                    "high": math.nan if found is None else found.high,
                }
            )
    return pd.DataFrame(rows)


def between_kinds(kinds: pd.DataFrame, measures: Sequence[str]) -> pd.DataFrame:
    """Compare the programmed with the learned robots of mixed societies, world by world.

    Args:
        kinds: `condition`, `seed`, `share`, `kind` and measures; societies of one kind alone do not
            count.
        measures: their columns.

    Returns:
        As `comparisons` gives it, with `condition` before it; each world's shares are averaged.
    """
    parts = []
    both = kinds[(kinds["share"] > 0) & (kinds["share"] < 1)]
    for condition, part in both.groupby("condition", sort=False):
        alone = part.groupby(["kind", "seed"], sort=False)[list(measures)].mean().reset_index()
        found = comparisons(alone, "learned", by="kind")
        found.insert(0, "condition", condition)
        parts.append(found)
    return pd.concat(parts, ignore_index=True)


def beyond_both(mixed: pd.DataFrame) -> dict[tuple[str, str], list[tuple[float, int]]]:
    """Return where mixtures lie beyond both kinds alone.

    Args:
        mixed: `condition`, `share`, `seed` and measures.

    Returns:
        By condition and measure, shares and on which side of both kinds they are.
    """
    found: dict[tuple[str, str], list[tuple[float, int]]] = {}
    for condition in MIXED:
        own = mixed[mixed["condition"] == condition]
        columns = [*OVER_SHARES, "seed", "share"]
        ends = [comparisons(own[columns], end, by="share") for end in (0.0, 1.0)]
        for name in OVER_SHARES:
            several = []
            for share in sorted(own["share"].unique()):
                if 0 < share < 1:
                    sides = {side(one_of(end, name, society=share)) for end in ends}
                    if len(sides) == 1 and 0 not in sides:
                        several.append((float(share), sides.pop()))
            found[condition, name] = several
    return found
