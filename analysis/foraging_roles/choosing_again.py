"""Which mind of each attempt at `like_bodies` counts, chosen again with twice as many worlds.

python -m analysis.foraging_roles.choosing_again           # judges what is not judged yet
python -m analysis.foraging_roles.choosing_again report    # then the attempts' minds in new worlds

All of this was written before a mind was looked at in `FURTHER`, and knowing what the first choice
comes to in worlds for reporting; it is the same for all attempts. Attempts and trainings are those
of `choosing`.

1. Of each attempt the `FINALISTS` best by the first choosing, of those with a share in each
   condition, are judged in as many further worlds for choosing, the best first. One is judged no
   further once its share of all worlds in a condition is below the least share of one that was
   judged in all. Where there is one alone nothing is to be chosen, and it is judged last.
2. The attempt's mind is the one with the greatest least share of all worlds, twice `WORLDS`; of
   equals that with the greater sum, then the later one.

To judge what the first choosing had left out as well, as another of the same training had enough,
was begun with trainings 2 and 16 and given up, as time would not do for all; it counts for nothing.

A row of `results/chosen_again.csv` is a mind in the further worlds: in how many of them it settles
under each condition. A row of `results/chosen_again_reported.csv` is an attempt's mind in
`FURTHER`, forty worlds for reporting in which nothing else was run: the share that settles.

`results/chosen_again.csv` is kept as the program of commit 631ba9b0 made it, which took
fewer than three robots away where fewer were in A. By today's, shares with robots taken away are
others (of the winner of training 2 0.92, not 0.86), and so may be who is chosen. To make it again
check that commit out and delete the table; rows that today's program adds are of another rule.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from socialmind.learning import Training
from socialmind.mind import MindDescription

from . import choosing
from .choosing import CONDITIONS, KEYS, PLANS, TRAINED, WORLDS, Candidate
from .worlds import CHOOSING, REPORTED

NAME = "chosen_again"
OUT = choosing.OUT.with_name(f"{NAME}.csv")
REPORT = OUT.with_name(f"{NAME}_reported.csv")
FIRST_LOOK, BEFORE = OUT.with_name("chosen_reported_before.csv"), 20
"""What was chosen in 12 worlds, of twelve trainings, came to in as many worlds for reporting."""
FINALISTS = 4
SECOND = CHOOSING[WORLDS : 2 * WORLDS]
FURTHER = REPORTED[100:140]
"""Worlds of the report, behind all others."""
NAMES = list(CONDITIONS)


def judge(path: Path = OUT) -> pd.DataFrame:
    """Judge all finalists that are not judged yet, and keep what comes of it after each.

    Returns:
        A row for each: how many worlds settle by condition, unknown where it was judged no further.
    """
    trainings = Training(PLANS.kept / TRAINED)
    firsts = [first_of(own) for own in choosing.trainings_of(choosing.read()).values()]
    for first in sorted(firsts, key=lambda own: len(finalists(own)) == 1):
        for one in finalists(first):
            known = read(path).set_index(KEYS)[NAMES]
            if one in known.index:
                continue
            least = totals(first, known)[NAMES].min(axis=1).max()
            enough = {name: least - first.loc[one, name] for name in NAMES}
            found = settled(choosing.candidates(trainings, one[0])[one], enough)
            known.loc[one, NAMES] = [found[name] for name in NAMES]
            table = known.rename_axis(KEYS).reset_index().sort_values(KEYS)
            table.to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
            print(*one, *found.values(), file=sys.stderr, flush=True)
    return read(path)


def settled(mind: MindDescription, enough: Mapping[str, float]) -> dict[str, float]:
    """Return how many worlds settle by condition, those behind one with too few being unknown.

    Args:
        mind: the robots'.
        enough: by condition; where it is unknown any number is enough.
    """
    found = dict.fromkeys(CONDITIONS, np.nan)
    for name, given in CONDITIONS.items():
        found[name] = round(choosing.settles(mind, given, SECOND) * len(SECOND))
        if found[name] < enough[name]:
            break
    return found


def read(path: Path = OUT) -> pd.DataFrame:
    """Return what is kept, or an empty table."""
    if not path.is_file():
        return pd.DataFrame(columns=[*KEYS, *NAMES])
    return pd.read_csv(path)


def first_of(own: Sequence[int]) -> pd.DataFrame:
    """Return in how many of the first choosing's worlds the minds of trainings settle, by mind."""
    table = choosing.minds_among(choosing.read(), own).set_index(KEYS)[NAMES]
    return (table * WORLDS).round()


def finalists(first: pd.DataFrame) -> list[Candidate]:
    """Return the best few of an attempt's minds, the best first.

    Args:
        first: in how many of the first worlds they settle.
    """
    order = choosing.ranked(first.dropna().reset_index())
    return [choosing.named(row) for row in order.iloc[::-1][:FINALISTS].to_dict("records")]


def totals(first: pd.DataFrame, second: pd.DataFrame) -> pd.DataFrame:
    """Return in how many of all worlds they settle, of minds that were judged in all.

    >>> first = pd.DataFrame({"removed": [30, 31], "turned": 36, "undisturbed": 36})
    >>> totals(first, pd.DataFrame({"removed": [32], "turned": 30, "undisturbed": 36}))
       removed  turned  undisturbed
    0       62      66           72
    """
    return (first + second).dropna().astype(int)


def chosen(path: Path = OUT) -> pd.DataFrame:
    """Return which mind is each attempt's, by its number.

    Returns:
        A row for each attempt: the mind, in how many `worlds` it was judged, and the share of them
        that settles by condition.
    """
    second, rows = read(path).set_index(KEYS)[NAMES], []
    for attempt, own in choosing.trainings_of(choosing.read()).items():
        first = first_of(own)
        known, worlds = totals(first, second), 2 * WORLDS
        if len(known) == 0 and len(finalists(first)) == 1:
            known, worlds = first.dropna(), WORLDS
        if len(known):
            best = choosing.ranked(known.reset_index()).iloc[-1]
            mind, shares = best[KEYS].to_dict(), (best[NAMES] / worlds).to_dict()
            rows.append({"attempt": attempt, **mind, "worlds": worlds, **shares})
    return pd.DataFrame(rows)


def minds(path: Path = OUT) -> dict[int, MindDescription]:
    """Return the attempts' minds by number; none as long as not all are chosen."""
    choice = chosen(path)
    if len(choice) < choosing.ATTEMPTS:
        return {}
    trainings = Training(PLANS.kept / TRAINED)
    found = {}
    for row in choice.to_dict("records"):
        one = choosing.named(row)
        found[int(row["attempt"])] = choosing.candidates(trainings, one[0])[one]
    return found


def report(path: Path = REPORT) -> pd.DataFrame:
    """Judge the attempts' minds that are not judged yet in worlds for reporting, and keep it."""
    rows = pd.read_csv(path).to_dict("records") if path.is_file() else []
    known = {row["attempt"] for row in rows}
    for attempt, mind in minds().items():
        if attempt in known:
            continue
        shares = {name: choosing.settles(mind, CONDITIONS[name], FURTHER) for name in NAMES}
        rows.append({"attempt": attempt, **shares})
        pd.DataFrame(rows).to_csv(path, index=False, float_format="%.6g", lineterminator="\n")
        print(*rows[-1].values(), file=sys.stderr, flush=True)
    return pd.DataFrame(rows)


def before(path: Path = FIRST_LOOK) -> pd.DataFrame:
    """Return the shares of the first look, in columns as those of `both`."""
    table = pd.read_csv(path).rename(columns={name: f"{name}_reported" for name in NAMES})
    return table.assign(choice="before")


def both(path: Path = OUT) -> pd.DataFrame:
    """Return the first choice and this one beside each other.

    Returns:
        A row for each `choice`, first or again, and attempt: the mind, in how many worlds it was
        judged for it, the share of them that settles by condition, and that of its `reported`
        worlds.
    """
    first = choosing.read().set_index(KEYS)[NAMES]
    at_first = pd.DataFrame(
        [
            {
                "attempt": attempt,
                **dict(zip(KEYS, one, strict=True)),
                "worlds": WORLDS,
                **first.loc[one],
            }
            for attempt, one in choosing.chosen(choosing.read()).items()
        ]
    )
    parts = []
    for choice, table, reported in (
        ("first", at_first, choosing.REPORT),
        ("again", chosen(path), REPORT),
    ):
        whole = table.merge(pd.read_csv(reported), on="attempt", suffixes=("", "_reported"))
        whole.insert(0, "choice", choice)
        parts.append(whole)
    return pd.concat(parts, ignore_index=True)


if __name__ == "__main__":
    print((report() if sys.argv[1:] == ["report"] else judge()).to_string(index=False))
