"""What figures 6.2 to 6.5 of the thesis say of learning skills, beside ours."""

from __future__ import annotations

from socialmind.experiments.judging import (
    MOST,
    Finding,
    above,
    between_shares,
    counted,
    covers,
    in_brackets,
    share_of,
    too_short,
)
from socialmind.experiments.overview import rows_of

from .kept_cells import BASE_SKILLS, KEPT

CHOSEN = "the thesis goes on with successful base skills alone, ours with each attempt's own"


def attempts(figure: str, lesson: str) -> list[dict[str, str]]:
    """Return the rows of a lesson's attempts."""
    return [row for row in rows_of(KEPT / f"{figure}-attempts.csv") if row["lesson"] == lesson]


def successful(figure: str, lesson: str) -> tuple[int, int]:
    """Return of how many attempts the winners did not fall short, and of how many."""
    from .figures import short_of

    failed = short_of([float(row["shared"]) for row in attempts(figure, lesson)])
    return len(failed) - sum(failed), len(failed)


def longest(figure: str, lesson: str) -> int:
    """Return how many generations an attempt has at most."""
    return max(int(row["generations"]) for row in attempts(figure, lesson))


def where_it_failed(lesson: str) -> str:
    """Return what is known of why attempts at the hierarchy fell short at a lesson."""
    import pandas as pd

    from .figures import FELL_SHORT

    rows = rows_of(KEPT / "figure-6.4-lessons.csv")
    order = list(dict.fromkeys(row["lesson"] for row in rows))
    table = pd.DataFrame(rows).astype({"attempt": int, "shared": float})
    scores = table.pivot(index="attempt", columns="lesson", values="shared")[order]
    median = scores.median()
    shares = scores / median
    told = []
    for attempt in shares.index[shares[lesson] < FELL_SHORT]:
        own = shares.loc[attempt]
        first = next(name for name in shares.columns if own[name] < FELL_SHORT)
        told.append(
            f"attempt {attempt} falls short at {first} first ({scores.at[attempt, first]:.2f}, the "
            f"median is {median[first]:.2f})"
        )
        if first not in BASE_SKILLS:
            share, weakest = min((own[name], name) for name in BASE_SKILLS)
            told[-1] += (
                f"; the weakest of its base skills, {weakest}, has {share:.0%} of the median"
            )
    return "; ".join(told)


def spent(figure: str, *lessons: str) -> str:
    """Return the generations and ticks of an attempt."""
    from .figures import length_of

    parts = []
    for lesson in lessons:
        own = attempts(figure, lesson)
        length = length_of([{"generations": int(row["generations"])} for row in own])
        ticks = max(int(row["ticks"]) for row in own) / 1e6
        parts.append(f"{lesson} {length} generations, up to {ticks:,.0f} million ticks")
    return "; ".join(parts)


def base_skills() -> list[Finding]:
    from .figures import EARLY, FELL_SHORT

    found = []
    for lesson in ("GoToObject", "GoToDropZone"):
        near = [int(row["near_end_from"]) for row in attempts("figure-6.2", lesson)]
        early = sum(one <= EARLY for one in near)
        found.append(
            Finding(
                f"{lesson}: attempts at their maximum within {EARLY} generations",
                "most of 10",
                f"{counted(early, len(near))} within 5 % of what they come to in the end",
                above(share_of(early, len(near)), MOST),
                why="that most do cannot be told",
            )
        )
    for lesson in ("GoToObject", "GoToDropZone"):
        good, all_of = successful("figure-6.2", lesson)
        apart = between_shares(all_of - good, all_of, 1, 10)
        found.append(
            Finding(
                f"{lesson}: attempts without a satisfactory result",
                "1 of 10",
                f"{counted(all_of - good, all_of)} below {FELL_SHORT:.0%} of the median, the "
                f"least has {least('figure-6.2', lesson):.0%}; {in_brackets(apart, '+.0%')} to "
                "the thesis's share",
                covers(apart, 0.0),
            )
        )
    return found


def least(figure: str, lesson: str) -> float:
    """Return the least that a winner comes to, in parts of the median."""
    from statistics import median

    scores = [float(row["shared"]) for row in attempts(figure, lesson)]
    return min(scores) / median(scores)


def succeeding(
    figure: str,
    lesson: str,
    about: str,
    thesis_generations: int,
    after: str = "",
    why: str = CHOSEN,
) -> Finding:
    """Return whether as many attempts succeed as in the thesis, where all ten do.

    Args:
        figure: whose attempts.
        lesson: at which they succeed.
        about: what is compared.
        thesis_generations: within which they do there.
        after: of which ours are.
        why: what is known of a difference.
    """
    from .figures import FELL_SHORT

    good, all_of = successful(figure, lesson)
    apart = between_shares(good, all_of, 10, 10)
    failed = "" if good == all_of else f"; {where_it_failed(lesson)}; {CHOSEN}"
    return Finding(
        about,
        "10 of 10",
        f"{counted(good, all_of)} have {FELL_SHORT:.0%} of the median or more{after}; "
        f"{in_brackets(apart, '+.0%')} to the thesis's share{failed}",
        covers(apart, 0.0),
        why=why,
        apart=too_short(longest(figure, lesson), thesis_generations),
    )


def avoiding() -> list[Finding]:
    own = attempts("figure-6.3", "Avoid")
    longer = [row for row in own if int(row["generations"]) > 100]
    late = [row for row in own if int(row["near_end_from"]) > 500]
    gain = sum(float(row["end"]) for row in longer) / sum(float(row["half"]) for row in longer) - 1
    most = longest("figure-6.3", "Avoid")
    return [
        Finding(
            "attempts that go on to improve past generation 500",
            "most of 10",
            f"{len(late)} of {len(own)}; the longest has {most}",
            above(share_of(len(late), len(own)), MOST),
            apart=too_short(most, 2500),
        ),
        Finding(
            "what more generations add",
            "10 % from 1,000 to 2,500",
            f"{gain:+.1%} in the second half of {len(longer)} longer attempts",
            apart=too_short(most, 2500) or "other numbers of generations",
        ),
        succeeding(
            "figure-6.3", "Avoid", "attempts that come to something acceptable", 2500, why="unknown"
        ),
    ]


def complex_skills() -> list[Finding]:
    names = ("GoToObject+Avoid", "GoToDropZone+Avoid")
    scores = [
        [float(row["shared"]) for row in attempts("figure-6.4", lesson)] for lesson in names
    ]  # fmt: skip
    means = [sum(each) / len(each) for each in scores]
    return [
        *(succeeding("figure-6.4", name, f"{name}: attempts that succeed", 1500) for name in names),
        Finding(
            "GoToObject+Avoid is the more difficult",
            "slightly",
            f"winners come to {means[0]:.2f} against {means[1]:.2f}",
            apart="scores of two lessons with targets of their own do not say which is harder; "
            "without Avoid they differ likewise",
        ),
    ]


def collecting() -> list[Finding]:
    about = "attempts that succeed in under ten generations"
    return [succeeding("figure-6.5", "Collect", about, 10, " after ten")]
