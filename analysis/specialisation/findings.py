"""What the numbers say, in sentences. Which sentence is written is for the numbers to choose.

A difference counts when its interval of 95 % over pairs of worlds holds no zero.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import pandas as pd

from . import farmers
from .societies import CONDITIONS, MIXED, SOCIETIES
from .tables import MEASURED, OVER_SHARES, Measured
from .words import away, listed, number, one_of, percent, side, spread

MOST = 0.9
"""The share of worlds from which on a society does something nearly always."""
SELDOM = 0.1
CLEARLY = 0.1
"""Division of labour beyond luck's from which on work is divided, and not hardly."""
ROBOTS = 9


# Two societies ------------------------------------------------------------------------------------


def titled(names: Iterable[str]) -> str:
    """Societies in a sentence, by their titles."""
    return listed(f"“{SOCIETIES[one].title}”" for one in names)


def against(
    differences: pd.DataFrame,
    measures: Mapping[str, Measured],
    who: str,
    other: str,
    **where: Any,
) -> str:
    """Say how a society differs from another in the same worlds.

    Args:
        differences: as `tables.differences` gives it.
        measures: that are looked at.
        who: what the society is called.
        other: what the other one is called.
        where: values of columns that say which rows are meant.
    """
    more, alike = [], []
    for name, measured in measures.items():
        row = one_of(differences, name, **where)
        sign = side(row)
        if not sign:
            alike.append(f"the {measured.noun}")
            continue
        effect = f"; g {number(row['g'], 1)}" if math.isfinite(row["g"]) else ""
        words = measured.more if sign > 0 else measured.less
        more.append(f"{words} (difference {away(row, measured.digits)}{effect})")
    if not more:
        return f"In the same worlds {who} and {other} differ clearly in nothing that is measured."
    same = f" There is no clear difference in {listed(alike)}." if alike else ""
    return f"In the same worlds {who}, set against {other}, {listed(more)}.{same}"


# Robots -------------------------------------------------------------------------------------------


def ranked(table: pd.DataFrame, measure: str, condition: str) -> str:
    """The societies with their means of a measure, the smallest first."""
    own = table[(table["measure"] == measure) & (table["condition"] == condition)]
    own = own[own["society"].isin(SOCIETIES)].sort_values("mean", kind="stable")
    digits = MEASURED[measure].digits
    rows = own.to_dict("records")
    return listed(f"{SOCIETIES[row['society']].title} {spread(row, digits)}" for row in rows)


def holding(table: pd.DataFrame, measure: str, condition: str) -> tuple[list[str], list[str]]:
    """Return the societies in which something is so in nearly all worlds, and in hardly any."""
    shares = {one: one_of(table, measure, society=one, condition=condition)["mean"]
              for one in SOCIETIES}  # fmt: skip
    return (
        [one for one, share in shares.items() if share >= MOST],
        [one for one, share in shares.items() if share <= SELDOM],
    )


def calm(table: pd.DataFrame, differences: pd.DataFrame) -> list[str]:
    """What undisturbed societies come to.

    Args:
        table: means by `society` and `condition`.
        differences: between societies.
    """
    at = "undisturbed"
    always, never = holding(table, "within", at)
    told = ranked(table, "last_distance", at)
    found = [f"Robots away from the wanted split in the last quarter: {told}."]
    if always:
        found.append(
            f"All through the last quarter within one robot of it, in {percent(MOST)} of the "
            f"worlds or more: {titled(always)}."
        )
    else:
        found.append(
            "No society stays within one robot of it all through the last quarter in "
            f"{percent(MOST)} of the worlds."
        )
    if never:
        found.append(f"In {percent(SELDOM)} of the worlds or fewer: {titled(never)}.")
    found.append(
        against(differences, MEASURED, "the programmed society", "the learned one",
                society="programmed", reference="learned", condition=at)
    )  # fmt: skip
    divided = {one: one_of(table, "beyond_chance", society=one, condition=at) for one in SOCIETIES}
    some = [one for one, row in divided.items() if row["low"] > 0]
    none = [one for one in SOCIETIES if one not in some]
    if some:
        told = listed(f"{SOCIETIES[one].title} {spread(divided[one])}" for one in some)
        found.append(f"Division of labour beyond what luck gives: {told}.")
    if none:
        found.append(f"In {titled(none)} it is no more than that.")
    thesis = {
        name: one_of(table, name, society="thesis", condition=at)
        for name in ("within", "late_changes")
    }
    settles = "settles" if thesis["within"]["mean"] >= 0.5 else "does not settle"
    found.append(
        f"What was learned as in the thesis {settles}: it stays within one robot in "
        f"{percent(thesis['within']['mean'])} of the worlds, and a robot changes its role "
        f"{spread(thesis['late_changes'])} times in 10,000 ticks at the end."
    )
    found.append(f"Objects delivered: {ranked(table, 'delivered', at)}.")
    return found


def shocked(table: pd.DataFrame, differences: pd.DataFrame, condition: str) -> list[str]:
    """What societies come to after a shock.

    Args:
        table: means by `society` and `condition`.
        differences: between societies.
        condition: which shock.
    """
    always, never = holding(table, "settled", condition)
    share = {one: one_of(table, "settled", society=one, condition=condition) for one in SOCIETIES}
    order = sorted(SOCIETIES, key=lambda one: -share[one]["mean"])
    told = listed(f"{SOCIETIES[one].title} {percent(share[one]['mean'])}" for one in order)
    found = [f"{CONDITIONS[condition].when}, these shares of worlds settle again: {told}."]
    if always:
        took = {one: one_of(table, "settled_after", society=one, condition=condition)
                for one in always}  # fmt: skip
        first = sorted(always, key=lambda one: took[one]["mean"])
        found.append(
            "Those that nearly always do take, on the mean, "
            + listed(f"{spread(took[one], 0)} ticks ({SOCIETIES[one].title})" for one in first)
            + "."
        )
    if never:
        found.append(f"Hardly ever do {titled(never)}.")
    found.append(
        against(differences, MEASURED, "the programmed society", "the learned one",
                society="programmed", reference="learned", condition=condition)
    )  # fmt: skip
    goods = {one: one_of(table, "in_ratio", society=one, condition=condition) for one in SOCIETIES}
    best, worst = (pick(goods, key=lambda one: goods[one]["mean"]) for pick in (max, min))
    found.append(
        f"Most objects in the wanted ratio are brought home by “{SOCIETIES[best].title}” "
        f"({spread(goods[best], 0)}), fewest by “{SOCIETIES[worst].title}” "
        f"({spread(goods[worst], 0)})."
    )
    return found


# Mixed societies ----------------------------------------------------------------------------------


def share_in_words(share: float) -> str:
    """A share of nine robots.

    >>> share_in_words(1 / 3)
    '3 of 9'
    """
    return f"{round(share * ROBOTS)} of {ROBOTS}"


def mixture(
    slopes: pd.DataFrame, beyond: Mapping[tuple[str, str], Sequence[tuple[float, int]]]
) -> list[str]:
    """How measures change with the share of programmed robots.

    Args:
        slopes: as `tables.slopes` gives them.
        beyond: by condition and measure, the shares at which mixtures lie beyond both kinds alone,
            and on which side.
    """
    found = []
    for condition in MIXED:
        words = []
        for name in OVER_SHARES:
            row = one_of(slopes, name, condition=condition)
            measured = MEASURED[name]
            told = spread({**row, "mean": row["slope"]}, measured.digits)
            if row["low"] > 0:
                words.append(f"the {measured.noun} rises ({told})")
            elif row["high"] < 0:
                words.append(f"the {measured.noun} falls ({told})")
            else:
                words.append(f"the {measured.noun} shows no trend ({told})")
        found.append(f"{CONDITIONS[condition].when}, from none programmed to all, {listed(words)}.")
    for (condition, name), several in beyond.items():
        for sign, words_of in ((1, MEASURED[name].more), (-1, MEASURED[name].less)):
            shares = [share_in_words(share) for share, where in several if where == sign]
            if shares:
                found.append(
                    f"{CONDITIONS[condition].when}, a mixture with {' or '.join(shares)} "
                    f"programmed {words_of} than either kind alone."
                )
    if not any(beyond.values()):
        found.append("In nothing of this is a mixture beyond both kinds alone.")
    return found


def kinds(differences: pd.DataFrame) -> list[str]:
    """What became of the programmed and of the learned robots of mixed societies.

    Args:
        differences: as `tables.between_kinds` gives them: the programmed less the learned.
    """
    found = []
    words = {
        "in_b": (
            "the programmed robots are in B for more of the last quarter than the learned",
            "the programmed robots are in A for more of the last quarter than the learned",
            "programmed and learned robots are in B for as much of the last quarter",
        ),
        "changes": (
            "the programmed change roles more often",
            "the learned change roles more often",
            "neither kind changes roles more often",
        ),
        "delivered": (
            "the programmed deliver more objects each",
            "the learned deliver more objects each",
            "both deliver alike",
        ),
    }
    units = {"in_b": "of the time", "changes": "a robot and 10,000 ticks", "delivered": ""}
    for condition in MIXED:
        parts = []
        for name, (more, less, same) in words.items():
            row = one_of(differences, name, condition=condition, society="programmed")
            told = f"{away(row)} {units[name]}".strip()
            parts.append(f"{ {1: more, -1: less, 0: same}[side(row)] } ({told})")
        found.append(f"{CONDITIONS[condition].when}, in one society, {'; '.join(parts)}.")
    return found


# Farmers and artisans -----------------------------------------------------------------------------


def villagers(
    table: pd.DataFrame, differences: pd.DataFrame, links: Sequence[tuple[str, str, float]],
    plans: Mapping[str, float], overlap: float, same: float,
) -> list[str]:  # fmt: skip
    """What farmers and artisans come to by a written scheme, a learned mind and a distilled one.

    Args:
        table: means by `society`.
        differences: from the learned one.
        links: of the distilled scheme: cogniton, plan, weight.
        plans: the mean probability of each plan, in the learned mind.
        overlap: of the distilled scheme's choices with those of the mind.
        same: the share of states in which both would rather do the same.
    """
    rows = {
        (one, name): one_of(table, name, society=one)
        for one in farmers.SOCIETIES
        for name in ("prosperity", "beyond_chance", "delivered")
    }
    found = [
        "Comfortable stocks of wheat a person at the end: "
        + listed(f"{one} {spread(rows[one, 'prosperity'])}" for one in farmers.SOCIETIES)
        + "."
    ]
    for one in farmers.SOCIETIES:
        row = rows[one, "beyond_chance"]
        told = f"{spread(row)} more than luck gives"
        if row["low"] > CLEARLY:
            found.append(f"The {one} society divides its work: {told}.")
        elif row["low"] > 0:
            found.append(f"The {one} society hardly divides its work: {told}.")
        else:
            found.append(f"The {one} society does not divide its work: {told}.")
    most = sorted(plans, key=lambda plan: -plans[plan])
    found.append(
        "What the learned mind does: "
        + listed(f"{plan} {percent(plans[plan])}" for plan in most)
        + " of its choices."
    )
    told = listed(
        f"{cogniton} {'for' if weight > 0 else 'against'} {plan} ({weight:+g})".replace("-", "−")
        for cogniton, plan, weight in links
    )
    found.append(
        f"The distilled scheme has {len(links)} influence links: {told}. Its choices overlap with "
        f"those of the mind by {number(overlap)}, and the most probable plan is the same in "
        f"{percent(same)} of the states."
    )
    for one, words in (("distilled", "the distilled society"), ("written", "the written society")):
        found.append(against(differences, farmers.MEASURED, words, "the learned one", society=one))
    return found


# All of it ----------------------------------------------------------------------------------------


def summary(
    table: pd.DataFrame, differences: pd.DataFrame, village: pd.DataFrame, overlap: float
) -> list[str]:
    """What a reader takes home.

    Args:
        table: means of the robots by `society` and `condition`.
        differences: between them.
        village: means of the farmers by `society`.
        overlap: of the distilled scheme's choices with those of the mind.
    """
    shocks = [one for one in CONDITIONS if CONDITIONS[one].parameter]
    settled = {
        one: {
            condition: one_of(table, "settled", society=one, condition=condition)["mean"]
            for condition in CONDITIONS
        }
        for one in SOCIETIES
    }
    calmly = [one for one, shares in settled.items() if shares["undisturbed"] >= MOST]
    robust = [one for one, shares in settled.items() if min(shares.values()) >= MOST]
    found = []
    if calmly:
        found.append(
            f"Undisturbed, {titled(calmly)} settle{'s' if len(calmly) == 1 else ''} within one "
            f"robot of the wanted split in {percent(MOST)} of the worlds or more."
        )
    else:
        found.append(f"No society settles in {percent(MOST)} of undisturbed worlds.")
    if robust:
        settle = "settles" if len(robust) == 1 else "settle"
        found.append(f"In as many {titled(robust)} {settle} again after each of the shocks.")
    else:
        found.append(f"After every one of the {len(shocks)} shocks no society does so.")
    for name in ("last_distance", "settled_after", "changes"):
        sides = {
            condition: side(
                one_of(differences, name, society="programmed", reference="learned",
                       condition=condition)
            )
            for condition in CONDITIONS
        }  # fmt: skip
        found.append(overall(MEASURED[name], sides))
    beyond = {one: one_of(village, "beyond_chance", society=one) for one in farmers.SOCIETIES}
    gains = {one: one_of(village, "prosperity", society=one)["mean"] for one in farmers.SOCIETIES}
    divided = [one for one, row in beyond.items() if row["low"] > CLEARLY]
    rich = max(gains, key=lambda one: gains[one])
    who = {0: "none divides its work", 1: f"the {listed(divided)} one divides its work"}.get(
        len(divided), f"the {listed(divided)} ones divide their work"
    )
    found.append(
        f"Of the societies of farmers and artisans {who}; the most wheat has the {rich} one. The "
        "scheme distilled from the learned mind chooses as that does, with an overlap of "
        f"{number(overlap)}."
    )
    return found


def overall(measured: Measured, sides: Mapping[str, int]) -> str:
    """Say how the programmed society differs from the learned one over all conditions.

    Args:
        measured: in what.
        sides: by condition, on which side the difference is.

    >>> overall(MEASURED["settled_after"], {"undisturbed": 1, "turned": 1})
    'Whatever happens, the programmed society takes longer to settle than the learned one.'
    """
    clauses = []
    for sign, words in ((1, measured.more), (-1, measured.less)):
        where = [one for one, found in sides.items() if found == sign]
        if len(where) == len(sides):
            return f"Whatever happens, the programmed society {words} than the learned one."
        if where:
            place = listed(CONDITIONS[one].title for one in where)
            clauses.append(f"{words} than the learned one ({place})")
    if not clauses:
        return f"There is no clear difference in the {measured.noun}, whatever happens."
    rest = "" if all(sides.values()) else "; else there is no clear difference"
    return f"The programmed society {listed(clauses)}{rest}."
