"""What the thesis reports of variables (4.3), beside ours."""

from __future__ import annotations

from itertools import pairwise

from socialmind.experiments.judging import Finding
from socialmind.experiments.overview import Result

TOLERANCE = 1e-9


def simple_variable() -> list[Finding]:
    from .records import simple_variable as records

    rows = records()
    wrong, held, kept = 0, 0, 0
    for before, row in pairwise(rows):
        given = before["influence_A"] + before["influence_B"]
        if given:
            asked = sum(before[f"command_{one}"] * before[f"influence_{one}"] for one in "AB")
            wrong += abs(row["value"] - asked / given) > TOLERANCE
        else:
            held += 1
            kept += row["value"] == before["value"]
    return [
        Finding(
            "the value is the mean of the commands by influence",
            "equation 4.3",
            f"in {len(rows) - 1 - held - wrong} of {len(rows) - 1 - held} evaluations",
            not wrong,
        ),
        Finding(
            "without influence the value stays",
            "flat in the figure",
            f"in {kept} of {held} evaluations",
            held > 0 and kept == held,
        ),
    ]


def counter() -> list[Finding]:
    from .records import counter as records

    values = [round(row["value"], 6) for row in records()]
    changes = [now for before, now in pairwise(values) if now != before]
    return [
        Finding(
            "two rising edges, then a falling one",
            "0.1, 0.2, 0.0",
            ", ".join(f"{one:.1f}" for one in changes[:3]),
            changes[:3] == [0.1, 0.2, 0.0],
        )
    ]


def wave() -> list[Finding]:
    from .records import wave_generator as records

    rows = records()
    lengths: dict[float, list[int]] = {}
    since = None
    for place, (before, row) in enumerate(pairwise(rows)):
        if before["input"] != row["input"]:
            since = None
        if (before["value"] < 0.5) != (row["value"] < 0.5):  # twice in each wave
            if since is not None:
                lengths.setdefault(round(row["input"], 3), []).append(2 * (place - since))
            since = place
    means = {given: sum(each) / len(each) for given, each in lengths.items()}
    told = "; ".join(f"{value:.0f} evaluations at {given:g}" for given, value in means.items())
    order = [means[given] for given in sorted(means)]
    return [
        Finding(
            "the input sets the wavelength",
            "the larger, the shorter",
            told,
            len(order) > 1 and order == sorted(order, reverse=True),
        )
    ]


results = (
    Result("figure 4.6", "a simple variable that two skills command", "figure-4.6",
           simple_variable),
    Result("figure 4.7", "a counter: rising edges count, a falling edge resets", "figure-4.7",
           counter),
    Result("figure 4.8", "a wave generator, whose input sets the wavelength", "figure-4.8", wave),
)  # fmt: skip
