"""What figures 6.2 to 6.5 of the thesis say of learning skills, beside ours."""

from __future__ import annotations

from socialmind.experiments.judging import (
    MOST,
    Finding,
    above,
    counted,
    covers,
    share_of,
)
from socialmind.experiments.overview import rows_of

from .kept_cells import BASE_SKILLS, KEPT, scores


def attempts(figure: str, lesson: str) -> list[dict[str, str]]:
    """Return the rows of a lesson's attempts."""
    return [row for row in rows_of(KEPT / f"{figure}-attempts.csv") if row["lesson"] == lesson]


def successful(figure: str, lesson: str) -> tuple[int, int]:
    """Return how many attempts did not fall short by their finals, and of how many."""
    from .figures import short_of

    failed = short_of([float(row["finals"]) for row in attempts(figure, lesson)])
    return len(failed) - sum(failed), len(failed)


def where_it_failed(lesson: str) -> str:
    """Return what is known of why attempts at the hierarchy fell short at a lesson."""
    from .figures import FELL_SHORT

    finals = scores("hierarchy")
    median = finals.median()
    shares = finals / median
    failed = list(shares.index[shares[lesson] < FELL_SHORT])
    told = []
    for attempt in failed:
        own = shares.loc[attempt]
        first = next(name for name in shares.columns if own[name] < FELL_SHORT)
        told.append(
            f"attempt {attempt} falls short at {first} first ({finals.at[attempt, first]:.2f}, the "
            f"median is {median[first]:.2f})"
        )
        if first not in BASE_SKILLS:
            share, weakest = min((own[name], name) for name in BASE_SKILLS)
            told[-1] += (
                f"; the weakest of its base skills, {weakest}, has {share:.0%} of the median"
            )
    told += [
        f"attempt {other}, whose {name} has {shares.at[other, name]:.0%}, comes to "
        f"{shares.at[other, lesson]:.0%} here"
        for name in BASE_SKILLS
        for other in shares.index[shares[name] < FELL_SHORT]
        if other not in failed
    ]
    return (
        f"unknown: {'; '.join(told)}. The thesis goes on with successful base skills alone, ours "
        "with each attempt's own"
    )


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
        found.append(
            Finding(
                f"{lesson}: attempts without a satisfactory result, by their finals",
                "1 of 10",
                f"{counted(all_of - good, all_of)} below {FELL_SHORT:.0%} of the median",
                covers(share_of(all_of - good, all_of), 0.1),
            )
        )
    return found


def succeeding(figure: str, lesson: str, about: str, after: str = "") -> Finding:
    """Return whether as many attempts succeed as in the thesis, where all do.

    Args:
        figure: whose attempts.
        lesson: at which they succeed.
        about: what is compared.
        after: of which ours are.
    """
    from .figures import FELL_SHORT

    good, all_of = successful(figure, lesson)
    return Finding(
        about,
        "10 of 10",
        f"{counted(good, all_of)} have {FELL_SHORT:.0%} of the median or more by their "
        f"finals{after}",
        covers(share_of(good, all_of), 1.0),
        why="unknown" if good == all_of else where_it_failed(lesson),
    )


def avoiding() -> list[Finding]:
    own = attempts("figure-6.3", "Avoid")
    longer = [row for row in own if int(row["generations"]) > 100]
    late = [row for row in own if int(row["near_end_from"]) > 500]
    gain = sum(float(row["end"]) for row in longer) / sum(float(row["half"]) for row in longer) - 1
    most = max(int(row["generations"]) for row in own)
    return [
        Finding(
            "attempts that go on to improve past generation 500",
            "most of 10",
            f"{len(late)} of {len(own)}; the longest has {most}",
            apart=f"ours have {most} generations at most, the thesis's 2,500",
        ),
        Finding(
            "what more generations add",
            "10 % from 1,000 to 2,500",
            f"{gain:+.1%} in the second half of {len(longer)} longer attempts",
            apart="other numbers of generations",
        ),
        succeeding("figure-6.3", "Avoid", "attempts that come to something acceptable"),
    ]


def complex_skills() -> list[Finding]:
    names = ("GoToObject+Avoid", "GoToDropZone+Avoid")
    finals = [
        [float(row["finals"]) for row in attempts("figure-6.4", lesson)] for lesson in names
    ]  # fmt: skip
    means = [sum(each) / len(each) for each in finals]
    return [
        *(succeeding("figure-6.4", name, f"{name}: attempts that succeed") for name in names),
        Finding(
            "GoToObject+Avoid is the more difficult",
            "slightly",
            f"finals of {means[0]:.2f} against {means[1]:.2f}",
            apart="finals of two lessons with targets of their own do not say which is harder; "
            "without Avoid they differ likewise",
        ),
    ]


def collecting() -> list[Finding]:
    about = "attempts that succeed in under ten generations"
    return [succeeding("figure-6.5", "Collect", about, ", after ten")]
