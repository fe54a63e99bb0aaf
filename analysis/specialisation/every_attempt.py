"""The part of the page about every attempt: all of them, what was chosen, and further worlds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import pandas as pd

from socialmind.experiments import html

from .claims import found
from .reading import unsure
from .societies import CONDITIONS, SOCIETIES, Size
from .tables import FURTHER_PAIRS, FURTHER_TITLES
from .words import number, one_of, percent, shares, spread

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TIMES = {"first": "first choice", "again": "second"}


def attempts(
    tables: Mapping[str, pd.DataFrame], figures: Mapping[str, Figure], size: Size
) -> list[str]:
    """Return what is said and shown of every attempt."""
    rows = []
    for one in SOCIETIES.values():
        own = tables["attempts"][tables["attempts"]["society"] == one.name]
        for attempt, part in own.groupby("attempt", sort=False):
            by = part.set_index("condition")
            row: dict[str, object] = {
                "society": one.title, "attempt": attempt or "–",
                "worlds": int(by.loc["undisturbed", "worlds"]),
            }  # fmt: skip
            for name, condition in CONDITIONS.items():
                row[condition.title] = percent(by.loc[name, "within"])
            row["changes of roles"] = number(by.loc["undisturbed", "changes"])
            row["objects"] = number(by.loc["undisturbed", "delivered"], 0)
            rows.append(row)
    return [
        found("attempts", tables, size),
        html.picture(
            figures["attempts"],
            "Figure 2. The share of worlds all through whose last quarter the split stays within "
            "one robot of the wanted one. A dot is an attempt at a lesson; a line the mean with "
            "its interval of 95 %, over attempts and worlds where there are attempts, over worlds "
            "where nothing was learned.",
            "Shares of worlds of every attempt, for each society and condition.",
        ),
        html.table(
            rows,
            "Table 1. Every attempt. Of those chosen in bodies some had several trainings, of "
            "which one counts (Table 10). Shares of worlds within one robot of the "
            "wanted split; in the last two columns, undisturbed, changes of roles for each robot "
            "and 10,000 ticks, and objects brought home.",
            numbers=True,
        ),
        _choices(tables["chosen"]),
        *_further(tables),
    ]


def _choices(table: pd.DataFrame) -> str:
    """A table of what each attempt's minds come to that were chosen in bodies, by both choices."""
    parts = {
        str(choice): own.set_index("attempt") for choice, own in table.groupby("choice", sort=False)
    }
    conditions = [one for one in CONDITIONS if one in table]
    choosing_keys = ["training", "lesson", "what"]
    rows = []
    minds = [own[choosing_keys] for own in parts.values()]
    anew = (minds[0] != minds[1]).any(axis=1)
    for attempt in parts["first"].index:
        row: dict[str, object] = {"attempt": f"{attempt} *" if anew[attempt] else attempt}
        for choice, own in parts.items():
            one = own.loc[attempt]
            row[f"{TIMES[choice]}:\nleast when chosen"] = percent(one[conditions].min())
            for name in conditions:
                share = one[f"{name}_reported"]
                row[f"{TIMES[choice]}:\n{CONDITIONS[name].title}"] = percent(share) + (
                    " ‡" if unsure(share) else ""
                )
        rows.append(row)
    worlds = parts["again"]["worlds"]
    alone = ", ".join(map(str, worlds.index[worlds < worlds.max()]))
    few = f" (attempts {alone}, with one such mind each, in {worlds.min()})" if alone else ""
    return html.table(
        rows,
        "Table 2. The attempts whose minds were chosen in bodies, first in 36 worlds for choosing, "
        f"then, of those that had been the best, in 72{few}. For each choice: the least share of "
        "worlds, over three conditions, with which the mind was chosen; and its shares in forty "
        "worlds in which nothing was chosen, others for each choice. *, another mind than by the "
        "first choice; ‡, the interval of 95 % (Wilson’s) reaches below 75 %.",
        numbers=True,
    )


def _further(tables: Mapping[str, pd.DataFrame]) -> list[str]:
    """Tables of the worlds that had no part in any design; none of a small study."""
    means = tables["means"][tables["means"]["society"].isin(FURTHER_TITLES)]
    if means.empty:
        return []
    conditions = [one for one in CONDITIONS if one in set(means["condition"])]
    rows: list[dict[str, object]] = []
    for society, title in FURTHER_TITLES.items():
        row: dict[str, object] = {"society": title}
        for name in conditions:
            found = one_of(means, "within", society=society, condition=name)
            several = found["attempts"] > 1
            row["attempts"] = int(found["attempts"]) if several else "–"
            row[CONDITIONS[name].title] = shares(found) + (
                f"\n{percent(found['least'])} … {percent(found['most'])}" if several else ""
            )
        rows.append(row)
    away = tables["differences"]
    apart = [
        {
            "beside each other": f"{FURTHER_TITLES[one]} – {FURTHER_TITLES[other]}",
            **{
                CONDITIONS[name].title: spread({**row, "mean": row["difference"]})
                for name in conditions
                for row in [one_of(away, "within", society=one, reference=other, condition=name)]
            },
        }
        for one, other in FURTHER_PAIRS
    ]
    return [
        html.table(
            rows,
            "Table 3. The same forty worlds for all, seeds 6101 … 6140, which had no part in any "
            "design; they are those of the last look at what was chosen, after which there was no "
            "other. Shares within one robot with intervals of 95 % over attempts and worlds, and "
            "the worst and the best attempt; over worlds where nothing was learned. Adding three "
            "was not run.",
            numbers=True,
        ),
        html.table(apart, "", numbers=True),
        _trainings(tables["further-attempts"], conditions),
    ]


def _trainings(table: pd.DataFrame, conditions: list[str]) -> str:
    """A table of all trainings at the lesson of those that were chosen in bodies."""
    own = table[table["society"] == "unchosen_further"]
    shares_of = own.pivot(index="attempt", columns="condition", values="within")
    rows: list[dict[str, object]] = [
        {
            "training": training,
            **{CONDITIONS[name].title: percent(float(row[name])) for name in conditions},
        }
        for training, row in shares_of.iterrows()
    ]
    return html.table(
        rows,
        "Every training at the lesson of those chosen in bodies, as its last lesson left it, in "
        "the worlds of Table 3. Which trainings began anew hung on what the ones before had come "
        "to, so that they are not draws of their own, as the intervals above take them.",
        numbers=True,
    )
