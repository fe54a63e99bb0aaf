"""Lessons, and minds chosen in bodies, in forty worlds that had no part in any design.

python -m analysis.foraging_roles.further_worlds                     # runs what is not run yet
python -m analysis.foraging_roles.further_worlds delivered_anew      # of some ways alone
python -m analysis.foraging_roles.further_worlds table               # then the table of it

That minds of the economy fail in bodies was seen in the worlds of `analysis/specialisation`, and
the lesson `like_bodies` was made because of it: there it has an advantage that is luck's. In these
worlds, in which nothing was looked at before but what was chosen again, all stand alike. Of
`like_bodies` all trainings are here, as their last lesson left them: those that had been replaced,
as another one was better, count too. So are the scheme and both kinds of thresholds.

A row of `results/further_worlds.csv` is a way, an attempt (of `like_bodies` a training) and a
condition, a column a world: 1 where nine robots stay within one of the wanted split all through the
last quarter, by what they bring home.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file
from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.measures.crossed import crossed_interval
from socialmind.experiments.measures.intervals import Interval, share_interval

from . import choosing, choosing_again
from .minds import attempts_at, decided_by
from .threshold_scan import CONTROLLERS
from .told_intervals import held_against
from .trainings import MODEL

THRESHOLDS = load_file(MODEL / "thresholds.py").ForagingByThresholds
OUT = Path(__file__).parent / "results" / "further_worlds.csv"
WORLDS = choosing_again.FURTHER
CONDITIONS = tuple(reversed(choosing.CONDITIONS))
KEYS = ["way", "attempt", "condition"]
WAYS: Mapping[str, str] = {
    "delivered_anew": "by deliveries",
    "chosen_again": "by deliveries like bodies, chosen in bodies",
    "like_bodies": "by deliveries like bodies, every training, nothing chosen",
    "supervised_role": "supervised",
    "programmed": "the written scheme",
    "evolved_scheme": "the scheme, evolved",
    "fixed_thresholds": "fixed thresholds",
    "reinforced_thresholds": "reinforced thresholds",
}
"""What they are called in the table."""
UNLEARNED: Mapping[str, Mapping[str, float]] = {"programmed": {"programmed": 1.0}, **CONTROLLERS}
"""Parameters of the ways that nobody learned, by name."""
LEARNED = ("delivered_anew", "chosen_again", "like_bodies", "supervised_role")
COMPARED = (
    *product((*LEARNED, "evolved_scheme"), ("programmed",)),
    *product(LEARNED, ("fixed_thresholds", "reinforced_thresholds")),
    ("chosen_again", "delivered_anew"),
    ("like_bodies", "delivered_anew"),
    ("delivered_anew", "supervised_role"),
)
"""Ways, and those that they are held against."""


def run(ways: Iterable[str], path: Path = OUT) -> None:
    """Run what is not run yet, and keep each row as it comes."""
    for way in ways:
        if way not in WAYS:
            raise SocialmindError(f"no way called {way!r}; {nearest(way, WAYS)}")
        for attempt in _attempts(way):
            own, mind = decided_by(way, attempt) if attempt else (UNLEARNED[way], None)
            for condition in CONDITIONS:
                if (way, attempt, condition) in read(path).index:
                    continue
                given = {**own, **choosing.CONDITIONS[condition]}
                rules = THRESHOLDS if way in CONTROLLERS else choosing.RULES.ForagingByDeliveries
                within = choosing.each_settles(mind, given, WORLDS, rules=rules)
                row = ",".join([way, str(attempt), condition, *map(str, within.astype(int))])
                begun = path.is_file()
                with path.open("a", encoding="utf-8", newline="") as file:
                    if not begun:
                        file.write(",".join([*KEYS, *map(str, WORLDS)]) + "\n")
                    file.write(row + "\n")
                print(way, attempt, condition, within.mean(), file=sys.stderr, flush=True)


def _attempts(way: str) -> list[int]:
    """Return the numbers of a way's attempts; 0 where nobody learned."""
    return [0] if way in UNLEARNED else attempts_at(way)


def read(path: Path = OUT) -> pd.DataFrame:
    """Return what is kept, by way, attempt and condition, a column a world."""
    if not path.is_file():
        return pd.DataFrame(index=pd.MultiIndex.from_tuples([], names=KEYS))
    return pd.read_csv(path).set_index(KEYS).sort_index()


def complete(table: pd.DataFrame) -> list[str]:
    """Return the ways of which all attempts were run."""
    known = set(table.index)
    return [
        way
        for way in WAYS
        if known.issuperset(product([way], _attempts(way), CONDITIONS)) and _attempts(way)
    ]


def within(table: pd.DataFrame, way: str, condition: str) -> np.ndarray:
    """Return what became of each attempt in each world, (attempts, worlds)."""
    return table.xs((way, condition), level=("way", "condition")).to_numpy(float)


def means(table: pd.DataFrame) -> pd.DataFrame:
    """Return shares of worlds with their intervals over attempts and worlds.

    Returns:
        A row for each way and condition: `attempts`, `mean`, `low`, `high`, `least`, `most`.
    """
    rows = []
    for way in complete(table):
        for condition in CONDITIONS:
            each = within(table, way, condition)
            shares = each.mean(axis=1)
            rows.append(
                {
                    "way": way, "condition": condition, "attempts": len(each),
                    **vars(_interval(each)), "least": shares.min(), "most": shares.max(),
                }
            )  # fmt: skip
    return pd.DataFrame(rows)


def differences(table: pd.DataFrame) -> pd.DataFrame:
    """Return how much more of the worlds one way comes to than another, in the same worlds."""
    rows, known = [], complete(table)
    for way, other in (pair for pair in COMPARED if {*pair} <= {*known}):
        for condition in CONDITIONS:
            one, two = (within(table, name, condition) for name in (way, other))
            found = held_against(one, two)
            rows.append({"way": way, "than": other, "condition": condition, **vars(found)})
    return pd.DataFrame(rows)


def _interval(each: np.ndarray) -> Interval:
    """Return the mean with its interval: over attempts and worlds, or worlds where one way is."""
    return crossed_interval(each) if len(each) > 1 else share_interval(each[0])


if __name__ == "__main__":
    asked = sys.argv[1:] or list(WAYS)
    if asked == ["table"]:
        read().reset_index().to_csv(OUT, index=False, lineterminator="\n")
        print(means(read()).to_string(), differences(read()).to_string(), sep="\n")
    else:
        run(asked)
