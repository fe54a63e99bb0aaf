"""When a result of the thesis counts as reproduced: one criterion for all that it reports.

A topic's ``thesis.py`` makes findings of it. `CRITERION` says to readers what the functions here
do.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from socialmind.experiments.measures.intervals import Interval, share_difference, share_interval

NO_SAY = 0.1
"""Part of the influence up to which a skill is not used; from one less this on it has all."""
ALIKE = 0.25
"""Part of the larger of two means within which their difference leaves them alike."""
MOST = 0.5
"""The share above which it is most."""
ENOUGH = 0.5
"""Part of the thesis's generations from which on the course of learning is compared."""
_ROUNDING = 1e-9
"""What a bound of an interval may be off by its arithmetic."""

CRITERION = (
    "One criterion holds for all rows. A *number* is reproduced if our interval of 95 %, over "
    "attempts or over runs, covers the thesis's (of fewer than six numbers it is Student's t, of "
    "more a bootstrap); counts of attempts on both sides are compared as two shares, and "
    "reproduced if the interval of their difference covers nought. A *direction* (more, longer, "
    "sooner; most, which is more than half) is reproduced if our interval lies wholly on its side; "
    "otherwise it is different, also where ours cannot be told either way, and the row says which. "
    "That two are *alike* is reproduced if the interval of their difference lies within "
    f"{ALIKE:.0%} of the larger one, different if it leaves out nought, and not comparable if it "
    "is too wide for either. A wide interval covers much, so what is reproduced need not be "
    "precise: rows show the intervals.",
    "Where the thesis shows one robot or one run, or what a rule computes, ours is one as well, "
    "and reproduced is what holds of it as the row says; where many runs of ours are known, "
    "whether the thesis's lies among their middle 95 %. That an attempt succeeds means that its "
    "winner comes to 75 % of the median of all attempts, in worlds that all share and that chose "
    "nothing, so it says how alike they are. Numbers are equal as printed. An influence counts by "
    "its part of all that skills receive which command the same, as commands are averaged by it: "
    f"a part of {NO_SAY:g} or less is none, of {1 - NO_SAY:g} or more all.",
    "*Not comparable* is what depends on something that the thesis does not tell, what was learned "
    "otherwise or from other minds than there, and what holds of ours by construction, such as "
    "what a run was searched for. What is said of the course of learning (how many attempts "
    "succeed, what more generations bring) is compared where ours have at least "
    f"{ENOUGH:.0%} of the generations that it is said of; a direction between two trainings is "
    "compared whatever they had. Numbers of objects and shares of a run in tables 6.1 to 6.3 are "
    "not compared, as both depend on how long a run is and the thesis does not tell it there "
    "(6.1.4 and 6.2.3 say nothing, 6.3.2 has “a given time frame”); directions are.",
)
"""The criterion, in paragraphs."""


class Verdict(StrEnum):
    """How ours compares with the thesis's."""

    REPRODUCED = "reproduced"
    DIFFERENT = "different"
    NOT_COMPARABLE = "not comparable"


@dataclass(frozen=True)
class Finding:
    """One thing that the thesis says of a figure or table, and what ours says of it.

    Attributes:
        about: what is compared.
        thesis: what the thesis says.
        ours: what ours says, filled in from kept tables.
        agrees: whether that agrees by the criterion, as checked on the same tables.
        why: where it does not: the reason that was found, or that it is unknown.
        apart: why it cannot be compared, where it cannot.
    """

    about: str
    thesis: str
    ours: str
    agrees: bool = False
    why: str = "unknown"
    apart: str = ""

    @property
    def verdict(self) -> Verdict:
        """How the two compare."""
        if self.apart:
            return Verdict.NOT_COMPARABLE
        return Verdict.REPRODUCED if self.agrees else Verdict.DIFFERENT

    @property
    def reason(self) -> str:
        """Why they do not agree or cannot be compared; nothing where they agree."""
        return self.apart or ("" if self.agrees else self.why)


# The criterion ------------------------------------------------------------------------------------


def covers(interval: Interval, number: float) -> bool:
    """Return whether an interval covers a number of the thesis.

    >>> covers(Interval(0.9, 0.6, 0.98), 0.7), covers(Interval(0.9, 0.6, 0.98), 1.0)
    (True, False)
    """
    return interval.low - _ROUNDING <= number <= interval.high + _ROUNDING


def above(interval: Interval, least: float = 0.0) -> bool:
    """Return whether an interval lies wholly above a number.

    >>> above(Interval(0.2, -0.1, 0.5)), above(Interval(0.7, 0.55, 0.8), MOST)
    (False, True)
    """
    return interval.low > least + _ROUNDING


def below(interval: Interval, most: float = 0.0) -> bool:
    """Return whether an interval lies wholly below a number."""
    return interval.high < most - _ROUNDING


def are_alike(difference: Interval, larger: float) -> bool | None:
    """Return whether two are alike, by their difference; None where it is too wide to say.

    Args:
        difference: of the two, with its interval.
        larger: the larger one's mean.

    >>> are_alike(Interval(0.1, -0.2, 0.4), 4.0), are_alike(Interval(2.0, 0.5, 3.5), 4.0)
    (True, False)
    >>> are_alike(Interval(2.0, -0.5, 4.5), 4.0)
    >>> are_alike(Interval(2.0, math.nan, math.nan), 4.0)
    """
    if not math.isfinite(difference.low):
        return None
    if max(abs(difference.low), abs(difference.high)) <= ALIKE * abs(larger):
        return True
    return None if covers(difference, 0.0) else False


def too_short(ours: int, thesis: int) -> str:
    """Return that ours had too few generations for the course of learning, or nothing.

    Args:
        ours: generations of our longest attempt.
        thesis: those that the thesis speaks of.

    >>> too_short(206, 2500), too_short(1000, 1000)
    ('ours have 206 generations at most, the thesis speaks of 2,500', '')
    """
    if ours >= ENOUGH * thesis:
        return ""
    return f"ours have {ours:,} generations at most, the thesis speaks of {thesis:,}"


def between_shares(count: int, number: int, other: int, of_other: int) -> Interval:
    """Return by how much one share is more than another, with its interval (`share_difference`).

    Args:
        count: how many do something.
        number: of how many.
        other: how many of those that they are compared with.
        of_other: of how many.

    >>> found = between_shares(9, 10, 10, 10)
    >>> round(found.mean, 2), round(found.low, 2), round(found.high, 2)
    (-0.1, -0.4, 0.19)
    """
    return share_difference(_each(count, number), _each(other, of_other))


# Words --------------------------------------------------------------------------------------------


def share_of(count: int, number: int) -> Interval:
    """Return what share of attempts or runs does something, with its score interval."""
    return share_interval(_each(count, number))


def _each(count: int, number: int) -> list[int]:
    return [1] * count + [0] * (number - count)


def in_brackets(interval: Interval, form: str = ".2f") -> str:
    """Return a mean with its interval.

    >>> in_brackets(Interval(5.4, 5.07, 5.77), ".1f")
    '5.4 (5.1 to 5.8)'
    >>> in_brackets(Interval(-0.2, -0.5, 0.1), "+.0%")
    '-20% (-50% to +10%)'
    """
    mean, low, high = (
        format(one, form) for one in (interval.mean, interval.low, interval.high)
    )  # fmt: skip
    return f"{mean} ({low} to {high})"


def counted(count: int, number: int, what: str = "") -> str:
    """Return how many of how many do something, with the interval of their share.

    >>> counted(9, 10, "runs")
    '9 of 10 runs (60% to 98%)'
    """
    share = share_of(count, number)
    several = f"{number} {what}".rstrip()
    return f"{count} of {several} ({share.low:.0%} to {share.high:.0%})"


def not_so(difference: Interval) -> str:
    """Return how a direction of the thesis is not ours, which is to be above nought.

    >>> not_so(Interval(-2.0, -3.0, -1.0)), not_so(Interval(1.0, -1.0, 3.0))
    ('it is the other way round', 'it cannot be told either way')
    """
    return f"it {'is the other way round' if below(difference) else 'cannot be told either way'}"


def looked_through(seeds: Sequence[int], seed: int) -> str:
    """Return how many runs were looked through until one was found.

    Args:
        seeds: of all that would have been.
        seed: of the one that was found.

    >>> looked_through(range(73, 93), 74)
    'number 2 of the runs looked through (seed 74)'
    """
    return f"number {list(seeds).index(seed) + 1} of the runs looked through (seed {seed})"
