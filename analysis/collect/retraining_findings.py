"""What tables 6.2 and 6.3 of the thesis say of learning in context, beside ours."""

from __future__ import annotations

from functools import cache

from socialmind.experiments.judging import Finding, above, are_alike, in_brackets, not_so

from .kept_cells import (
    FLAT,
    TRAININGS,
    cell,
    form,
    gained,
    in_pairs,
    interval,
    measured,
    reported,
    scores,
    told,
    untold,
)

ORIGINAL, RETRAINED = "original Avoid", "all skills in context"
"""The minds on which power management is learned."""
NOT_AVOID = (
    "in place of the thesis's retrained Avoid ours have all five skills below Collect retrained in "
    "context (attempt 2 of `in_context`)"
)


def retraining() -> list[Finding]:
    base, long, context = "Avoid as in the curriculum", "Avoid with more ticks", "Avoid in context"
    longer = gained("table-6.2", base, long, "objects")
    gains = {
        measure: gained("table-6.2", base, context, measure)
        for measure in ("objects", "survived")
    }  # fmt: skip

    def thesis(after: str, measure: str) -> str:
        return " to ".join(reported("table-6.2", one, measure) for one in (base, after))

    best = "all skills in context (best attempt)"
    return [
        Finding(
            "more generations of Avoid bring more objects, if a little",
            thesis(long, "objects"),
            in_pairs(longer, "objects"),
            apart=f"ours are {generations('longer_avoid')} generations of Avoid against "
            f"{generations('hierarchy')}, the thesis's 2,500 against 1,000",
        ),
        Finding(
            "Avoid in context brings more objects",
            thesis(context, "objects"),
            f"{in_pairs(gains['objects'], 'objects')}; all skills in context, on attempt 6, come "
            f"to {told('table-6.2', best, 'objects')}, {told('table-6.2', best, 'survived')} "
            "survived",
            apart=goes_on(),
        ),
        Finding(
            "and lets the robot survive for longer",
            thesis(context, "survived"),
            in_pairs(gains["survived"], "survived"),
            apart="the same",
        ),
        *(
            measured(measure, "table-6.2", one)
            for measure in ("survived", "objects")
            for one in (long, context)
        ),
        Finding(
            "monolithic: objects and share of the run survived",
            " and ".join(reported("table-6.2", "monolithic", one) for one in gains),
            " and ".join(told("table-6.2", "monolithic", one) for one in gains),
            apart=untold("a collision ends the run"),
        ),
    ]


def generations(plan: str, lesson: str = "Avoid") -> str:
    """Return how many generations attempts at a training have of a lesson."""
    from socialmind.learning import Training

    from .figures import length_of

    curve = Training(TRAININGS / plan).curve
    counts = curve[curve["lesson"] == lesson].groupby("attempt").size()
    return length_of([{"generations": int(one)} for one in counts])


@cache
def goes_on() -> str:
    """Return how Avoid is learned in context otherwise than in the thesis."""
    from socialmind.learning import Training

    training = Training(TRAININGS / "hierarchy")
    unchanged = [
        str(attempt)
        for attempt in training.finished
        if (
            training.mind(attempt, "Collect").skill("Avoid").genome
            == training.mind(attempt, "Avoid in context").skill("Avoid").genome
        ).all()
    ]
    return (
        "the thesis retrained Avoid from scratch over 1,500 generations; ours goes on from the "
        f"known one over {generations('hierarchy', 'Avoid in context')}, and that one stays among "
        f"the finalists: attempt {', '.join(unchanged)} keeps it bit for bit"
    )


def power() -> list[Finding]:
    every = [f"{one}, {mind}" for mind in (ORIGINAL, RETRAINED) for one in VARIANTS]
    return [
        *(by_variant(mind) for mind in (RETRAINED, ORIGINAL)),
        *(by_mind(measure) for measure in ("survived", "objects")),
        *(alike(mind) for mind in (ORIGINAL, RETRAINED)),
        *(
            measured(measure, "table-6.3", one, benchmark=FLAT)
            for measure in ("survived", "objects")
            for one in every
        ),
    ]


VARIANTS = ("Retrained", "Encapsulated")


def by_variant(mind: str) -> Finding:
    """Return whether Encapsulated survives for longer than Retrained on a mind."""
    one, other = (f"{variant}, {mind}" for variant in VARIANTS)
    gain = gained("table-6.3", one, other, "survived", FLAT)
    return Finding(
        f"on {named(mind)}, Encapsulated survives for longer",
        " against ".join(
            reported("table-6.3", each, "survived", FLAT) for each in (other, one)
        ),
        in_pairs(gain, "survived"),
        above(gain),
        why=f"{not_so(gain)}; what an attempt at Retrained comes to is a matter of luck"
        + (f"; {NOT_AVOID}" if mind == RETRAINED else ""),
    )  # fmt: skip


def named(mind: str) -> str:
    """Return a mind as rows name it."""
    return f"the {mind}" if mind == ORIGINAL else f"{mind} (the thesis: on the retrained Avoid)"


def by_mind(measure: str) -> Finding:
    """Return whether what was retrained brings both variants more of a measure."""
    thesis, ours = [], []
    for variant in VARIANTS:
        pair = [f"{variant}, {mind}" for mind in (ORIGINAL, RETRAINED)]
        values = " to ".join(reported("table-6.3", one, measure, FLAT) for one in pair)
        thesis.append(f"{variant} {values}")
        gain = gained("table-6.3", *pair, measure, FLAT)
        ours.append(f"{variant} {in_brackets(gain, form(measure, signed=True))}")
    what = "lets both survive for longer" if measure == "survived" else "brings both more objects"
    return Finding(
        f"the retrained Avoid {what}",
        ", ".join(thesis),
        f"{', '.join(ours)}, attempt by attempt",
        apart=NOT_AVOID,
    )


def alike(mind: str) -> Finding:
    """Return whether both variants collect about as much on a mind."""
    one, other = (f"{variant}, {mind}" for variant in VARIANTS)
    gain = gained("table-6.3", one, other, "objects", FLAT)
    larger = max(interval(cell("table-6.3", each, "objects", FLAT)).mean for each in (one, other))
    agrees = are_alike(gain, larger)
    return Finding(
        f"on {named(mind)}, Encapsulated collects about as much as Retrained",
        " and ".join(reported("table-6.3", each, "objects", FLAT) for each in (other, one)),
        in_pairs(gain, "objects"),
        bool(agrees),
        why=NOT_AVOID if mind == RETRAINED else "unknown",
        apart="" if agrees is not None else "attempts differ too much, and are too few, to say",
    )


def shared_draws() -> list[str]:
    """Return that the attempts of one number in table 6.3 are not independent of each other."""
    told = []
    for suffix, mind in (("", RETRAINED), ("_original", ORIGINAL)):
        one, other = (scores(f"power_{kind}{suffix}") for kind in ("retrained", "encapsulated"))
        same = [name for name in one.columns if (one[name] == other[name]).all()]
        told.append(f"on {mind} both variants have the same finals at {' and '.join(same)}")
    every = [scores(f"power_{kind}{end}") for kind in ("retrained", "encapsulated")
             for end in ("", "_original")]  # fmt: skip
    first = every[0].columns[0]
    if all((one[first] == every[0][first]).all() for one in every):
        told.append(f"at {first} all four have the same")
    finals = scores("in_context")["All in context"]
    return [
        "Attempts of one number share their draws, so all differences are taken attempt by "
        f"attempt: {'; '.join(told)}. They are five, and begin with one mind each, so that "
        "intervals are about learning to look after the battery alone.",
        f"{NOT_AVOID[0].upper()}{NOT_AVOID[1:]}; by its finals ({finals[2]:.2f}) that attempt was "
        f"not the best one, which is attempt {finals.idxmax()} ({finals.max():.2f}).",
    ]
