"""What table 6.1 of the thesis says of hierarchy and monolith, beside ours."""

from __future__ import annotations

from collections.abc import Callable

from socialmind.experiments.judging import (
    Finding,
    above,
    in_brackets,
    not_so,
)
from socialmind.experiments.measures.intervals import Interval, interval_of
from socialmind.experiments.overview import rows_of

from .curricula import EVEN_MORE
from .kept_cells import (
    ENDS,
    GOES_ON,
    KEPT,
    KINDS,
    LEVEL,
    after_what,
    by_attempt,
    form,
    measured,
    more,
    reported,
    scores,
    told,
    unfinished,
    untold,
    with_equal_ticks,
    with_seeds,
)


def structures() -> list[Finding]:
    return [
        ahead("monolithic", "objects", ENDS),
        ahead("hierarchical", "objects", GOES_ON),
        ahead("monolithic", "survived", ENDS),
        *(by_lessons(kind, where) for where in (ENDS, GOES_ON) for kind in KINDS),
        *(share for kind in KINDS for share in shares(kind)),
        *(number for kind in KINDS for number in objects(kind)),
    ]


def ahead(kind: str, measure: str, benchmark: str) -> Finding:
    """Return whether the structure that is ahead in the thesis is so here, with equal ticks.

    Args:
        kind: that is ahead in the thesis.
        measure: in which it is.
        benchmark: where.
    """
    (other,) = set(KINDS) - {kind}
    here, there = f"{kind}, curriculum", f"{other}, curriculum"
    level = more(LEVEL, there, here, measure, benchmark)
    own = more("table-6.1", there, here, measure, benchmark)
    signed = form(measure, signed=True)
    verb = "collects more" if measure == "objects" else "survives for longer"
    return Finding(
        f"{benchmark}, equal ticks in each lesson: the {KINDS[kind]} {verb} than the "
        f"{KINDS[other]}",
        f"{reported('table-6.1', here, measure, benchmark)} against "
        f"{reported('table-6.1', there, measure, benchmark)}",
        f"{in_brackets(level, signed)} after {after_what(here)}; with the curriculum's own ticks, "
        f"in attempts of the same seeds, {in_brackets(own, signed)}",
        above(level),
        why=f"{not_so(level)}{still_learning(benchmark) if measure == 'objects' else ''}",
        apart=unfinished(*KINDS),
    )


def still_learning(benchmark: str) -> str:
    """Return what may keep one network behind with equal ticks."""
    each = by_attempt(LEVEL, "monolithic, curriculum", "objects", benchmark).values()
    gains = " and ".join(
        f"{in_brackets(late_gain(f'{plan}_level'), '+.1%')} to the {plan}'s scores"
        for plan in reversed(KINDS.values())
    )
    return (
        f"; the monolith's attempts lie between {min(each):.1f} and {max(each):.1f} objects; the "
        f"last quarter of the last lesson adds {gains}; {further(benchmark)}; how long the "
        "thesis's learned each lesson it does not tell"
    )


def further(benchmark: str) -> str:
    """Return what the monolith comes to with a lesson more than the hierarchy has."""
    name = f"monolithic, with {EVEN_MORE}"
    apart = more(LEVEL, "hierarchical, curriculum", name, "objects", benchmark)
    return (
        f"with {EVEN_MORE}, which the hierarchy has no equal of, the monolith comes to "
        f"{told(LEVEL, name, 'objects', benchmark)}, {in_brackets(apart, '+.2f')} beside the "
        "hierarchy"
    )


def late_gain(training: str) -> Interval:
    """Return what the last quarter of a training's last lesson added, over attempts."""
    import numpy as np

    from .equal_ticks import gained as late

    own = [r for r in rows_of(KEPT / "figure-6.5-equal-ticks.csv") if r["training"] == training]
    last = max(row["lesson"] for row in own)
    curves: dict[str, list[float]] = {}
    for row in own:
        if row["lesson"] == last:
            curves.setdefault(row["attempt"], []).append(float(row["score"]))
    return interval_of([late(np.array(one)) for one in curves.values()])


def by_lessons(kind: str, benchmark: str) -> Finding:
    """Return whether a structure collects more by the curriculum than by the final task alone."""
    given = f"{kind}, curriculum", f"{kind}, final task only"
    difference = more("table-6.1", given[1], given[0], "objects", benchmark)
    ours, thesis = (
        [of("table-6.1", one, "objects", benchmark) for one in given] for of in (told, reported)
    )
    return Finding(
        f"{benchmark}: the {KINDS[kind]} collects more by the curriculum than by the final task "
        "alone",
        " against ".join(thesis),
        f"{' against '.join(ours)}: {in_brackets(difference, '+.2f')}",
        above(difference),
        why=not_so(difference),
    )


def shares(kind: str) -> list[Finding]:
    """Return what a structure survives of a run that a collision ends, in each training."""
    name, here = KINDS[kind], f"{kind}, curriculum"
    return [
        measured("survived", "table-6.1", here, f"{name} by curriculum"),
        measured(
            "survived",
            LEVEL,
            here,
            f"{name} by curriculum, equal ticks in each lesson",
            f"{with_equal_ticks(kind, 'survived')}; {with_seeds(kind)}",
        ),
        measured("survived", "table-6.1", f"{kind}, final task only", f"{name}, final task only"),
    ]


def objects(kind: str) -> list[Finding]:
    """Return how many objects a structure collects in both benchmarks, in each training."""
    name, here, alone = KINDS[kind], f"{kind}, curriculum", f"{kind}, final task only"
    reason = untold(ENDS)
    what = "objects, if a collision ends the run and if none does"

    def both(of: Callable[[str], str]) -> str:
        return " and ".join(of(benchmark) for benchmark in (ENDS, GOES_ON))

    thesis, level = (
        both(lambda where: reported("table-6.1", here, "objects", where)),
        both(lambda where: with_equal_ticks(kind, "objects", where)),
    )
    return [
        Finding(
            f"{name} by curriculum: {what}",
            thesis,
            both(lambda where: told("table-6.1", here, "objects", where)),
            apart=reason,
        ),
        Finding(
            f"{name} by curriculum, equal ticks in each lesson: {what}",
            thesis,
            f"{level}; {with_seeds(kind)}",
            apart=reason,
        ),
        Finding(
            f"{name}, final task only: {what}",
            both(lambda where: reported("table-6.1", alone, "objects", where)),
            both(lambda where: told("table-6.1", alone, "objects", where)),
            apart=reason,
        ),
    ]


def same_seeds() -> list[str]:
    """Return that attempts with equal ticks are not independent of those with other ticks."""
    told = []
    for plan in KINDS.values():
        one, other = scores(plan), scores(f"{plan}_level")
        both = [number for number in one.index if number in other.index]
        same = [
            lesson
            for lesson in one.columns
            if lesson in other and (one.loc[both, lesson] == other.loc[both, lesson]).all()
        ]
        told.append(
            f"in all {len(both)} attempts `{plan}_level` has the same finals as `{plan}` at "
            f"{' and '.join(same) or 'no lesson'}"
        )
    return [
        "Attempts with equal ticks have the seeds of those with the curriculum's own ticks, so "
        f"rows of the two are not independent: {', '.join(told)}."
    ]
