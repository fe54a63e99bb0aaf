"""What the page says in words: each claim with the check on its tables that it stands or falls by.

`claims.md` is written by hand, a section for each part of the page and a claim a line:

    - [at least 0.9 within programmed turned] Programmed robots settle: {within programmed turned}.

In square brackets stand checks, parted by semicolons; in braces numbers that are filled in. Where a
check does not hold, in another run or with other seeds, the page says so in the claim's place.

| check | holds where |
|---|---|
| `at least X MEASURE SOCIETY CONDITION` | the mean is X or more |
| `at most X MEASURE SOCIETY CONDITION` | the mean is X or less |
| `worst at least X MEASURE SOCIETY CONDITION` | that of the attempt with the least is X or more |
| `worst at most X …` | it is X or less |
| `best at least X …`, `best at most X …` | the same of the attempt with the most |
| `more MEASURE SOCIETY CONDITION` | all of the interval is more than in the programmed society |
| `less MEASURE SOCIETY CONDITION` | all of it is less |
| `untold MEASURE SOCIETY CONDITION` | the interval of the difference holds 0, or all but does |
| `more MEASURE SOCIETY CONDITION than OTHER`, … | the same beside another society |
| `unchecked` | always: it tells of the study, not of its tables |

Numbers are `MEASURE SOCIETY CONDITION`, a mean with its interval; `worst …` and `best …`, those of
the attempts with the least and the most; `difference …`, from the programmed society, or `… than
OTHER`, and `lack …`, how much less it is; `attempts SOCIETY`; `ticks SOCIETY`, the median
attempt's; `shares CHOICE`, how many shares in further worlds there are of what was chosen in
bodies, for all attempts and conditions, and `unsure X CHOICE`, of how many the interval holds less
than X. The condition `farmers` stands for
the societies of farmers and artisans, which are compared with the learned one; `kinds`, with a
condition in the place of the society, for
programmed robots less learned ones of one society.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from socialmind.errors import SocialmindError
from socialmind.experiments import html
from socialmind.experiments.measures.intervals import Interval

from . import farmers
from .reading import unsure
from .societies import FULL, REFERENCE, Size
from .tables import FURTHER, MEASURED
from .words import number, percent, shares, spread

FILE = Path(__file__).with_name("claims.md")
_LINE = re.compile(r"- \[(?P<checks>[^\]]+)\] (?P<text>.+)")
UNCHECKED = "unchecked"
NOT_SO = "Said of the study as it was kept, and not so in this run:"
_CHECK = re.compile(
    r"(?:(?:(?P<which>worst|best) )?at (?P<side>least|most) (?P<bound>[\d.]+)|"
    r"(?P<way>more|less|untold)) "
    r"(?P<place>.+)"
)


@dataclass(frozen=True)
class Claim:
    """A sentence or two, and what they stand or fall by.

    Attributes:
        checks: as the file has them.
        text: with numbers in braces.
    """

    checks: tuple[str, ...]
    text: str


@dataclass(frozen=True)
class Told:
    """A claim as the page has it.

    Attributes:
        text: with its numbers.
        holds: whether all its checks do.
    """

    text: str
    holds: bool


def claims_of(section: str, file: Path = FILE) -> list[Claim]:
    """Return the claims about a part of the page.

    Raises:
        SocialmindError: there is no such section, or a line that is not a claim.
    """
    parts = file.read_text(encoding="utf-8").split(f"\n## {section}\n", 1)
    if len(parts) < 2:
        raise SocialmindError(f"{file.name} has no section {section!r}")
    found = []
    for line in filter(None, parts[1].split("\n## ", 1)[0].splitlines()):
        match = _LINE.fullmatch(line)
        if match is None:
            raise SocialmindError(f"{file.name}: {line!r}; expected - [checks] text")
        found.append(Claim(tuple(match["checks"].split("; ")), match["text"]))
    return found


def found(section: str, tables: Mapping[str, pd.DataFrame], size: Size) -> str:
    """Return what is said about a part of the page, as a list; of a small study nothing is."""
    if size != FULL:
        return ""
    lines = []
    for claim in claims_of(section):
        one = told(claim, tables)
        lines.append(one.text if one.holds else f"{NOT_SO} {one.text}")
    return html.bullets(lines)


def told(claim: Claim, tables: Mapping[str, pd.DataFrame]) -> Told:
    """Return a claim with its numbers, and whether it holds of tables."""
    text = re.sub(r"\{([^}]+)\}", lambda found: _number(found[1], tables), claim.text)
    return Told(text, all(holds(check, tables) for check in claim.checks))


def holds(check: str, tables: Mapping[str, pd.DataFrame]) -> bool:
    """Return whether a check holds of tables; what is unknown does not.

    Raises:
        SocialmindError: it is none, or is about what the tables do not have.
    """
    if check == UNCHECKED:
        return True
    match = _CHECK.fullmatch(check)
    if match is None:
        raise SocialmindError(f"the check {check!r}; see the table in claims.py")
    if match["way"]:
        row = _difference(match["place"], tables)
        found = Interval(*(float(row[name]) for name in ("difference", "low", "high")))
        known = math.isfinite(found.low)
        return known and found.beyond() == {"more": 1, "less": -1, "untold": 0}[match["way"]]
    row = _row(tables, _MEANS, *_place(match["place"]))
    least, bound = match["side"] == "least", float(match["bound"])
    value = float(row[{None: "mean", "worst": "least", "best": "most"}[match["which"]]])
    return value >= bound if least else value <= bound


_MEANS = {"farmers": "farmers-means", "": "means"}
_DIFFERENCES = {"farmers": "farmers-differences", "kinds": "mixed-kinds-differences",
                "": "differences"}  # fmt: skip


def _place(text: str) -> tuple[str, str, str]:
    words = text.split()
    if len(words) != 3:
        raise SocialmindError(f"{text!r} in a claim; expected measure, society, condition")
    measure, society, condition = words
    return measure, society, condition


def _difference(text: str, tables: Mapping[str, pd.DataFrame]) -> Mapping[str, Any]:
    """The row of `MEASURE SOCIETY CONDITION`, or of that `than OTHER`."""
    text, _, other = text.partition(" than ")
    measure, society, condition = _place(text)
    if other or condition not in _DIFFERENCES:
        tables = {**tables, "differences": _beside(tables["differences"], other or REFERENCE)}
    return _row(tables, _DIFFERENCES, measure, society, condition)


def _beside(table: pd.DataFrame, reference: str) -> pd.DataFrame:
    return table[table["reference"] == reference]


def _row(
    tables: Mapping[str, pd.DataFrame], names: Mapping[str, str], measure: str, society: str,
    condition: str,
) -> Mapping[str, Any]:  # fmt: skip
    table = tables[names.get(condition, names[""])]
    where = {"measure": measure, "society": society, "condition": condition}
    if condition == "farmers":
        del where["condition"]
    if condition == "kinds":
        where = {"measure": measure, "condition": society}
    for name, value in where.items():
        table = table[table[name] == value]
    if len(table) != 1:
        raise SocialmindError(f"a claim about {measure} {society} {condition}, which is in no row")
    return {str(name): value for name, value in table.iloc[0].items()}


def _number(text: str, tables: Mapping[str, pd.DataFrame]) -> str:
    """A number of a claim, as a text has it."""
    first, _, rest = text.partition(" ")
    if first == "attempts":
        means = tables["means"]
        return str(int(means.loc[means["society"] == rest, "attempts"].iloc[0]))
    if first == "ticks":
        budgets = tables["budgets"].set_index("society")
        return number(float(budgets.loc[rest, "median"]), 1)
    if first in ("unsure", "shares"):
        return _counted(rest, tables)
    if first in ("worst", "best", "difference", "lack"):
        text = rest
    measure, society, condition = _place(text.partition(" than ")[0])
    share = measure == "within"
    known = farmers.MEASURED if condition == "farmers" else MEASURED
    digits = known[measure].digits if measure in known else 2
    if first in ("difference", "lack"):
        row = _difference(text, tables)
        away = {"mean": row["difference"], "low": row["low"], "high": row["high"]}
        if first == "lack":
            away = {"mean": -away["mean"], "low": -away["high"], "high": -away["low"]}
        return spread(away, digits)
    row = _row(tables, _MEANS, measure, society, condition)
    if first in ("worst", "best"):
        value = float(row["least" if first == "worst" else "most"])
        return percent(value) if share else number(value, digits)
    if not share:
        return spread(row, digits)
    return shares(row)


def _counted(text: str, tables: Mapping[str, pd.DataFrame]) -> str:
    """Of the shares of a choice in further worlds, how many there are, or may be below a bound."""
    *bound, choice = text.split()
    own = tables["chosen"][tables["chosen"]["choice"] == choice]
    found = own[[name for name in own if name.endswith("_reported")]].to_numpy(float).ravel()
    if not bound:
        return str(len(found))
    means = tables["means"]
    worlds = int(means.loc[means["society"] == FURTHER.format(choice), "worlds"].iloc[0])
    return str(sum(unsure(one, float(bound[0]), worlds) for one in found))
