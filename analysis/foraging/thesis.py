"""What the thesis reports of robots that forage together (8.1), beside ours."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.overview import Finding, Result, row_of, rows_of
from socialmind.experiments.trainings.budgets import budget_of

KEPT = Path(__file__).parent / "results"
BARELY = 0.1
"""Influence up to which a skill is as good as not used."""
MOVING = ("Search+Avoid", "ReachSignal", "Collect", "Idle")


def sent(step: int, skill: str) -> float:
    """Return the influence of a skill in a step."""
    return float(row_of(KEPT / "figure-8.3.csv", step=str(step))[skill])


def first_steps() -> list[Finding]:
    idle = max(sent(step, "Idle") for step in range(1, 9))
    return [
        Finding(
            "step 1, nothing seen or heard: Search+Avoid at its maximum, ReachSignal has no say",
            "maximum intensity; a very low value",
            f"Search+Avoid {sent(1, 'Search+Avoid'):.2f}, Collect {sent(1, 'Collect'):.2f}, "
            f"ReachSignal {sent(1, 'ReachSignal'):.2f}",
            sent(1, "Search+Avoid") > 1 - BARELY and sent(1, "ReachSignal") <= BARELY,
        ),
        Finding(
            "step 2, it sees an object: Collect in majority",
            "Search+Avoid remains partially active",
            f"Collect {sent(2, 'Collect'):.2f}, Search+Avoid {sent(2, 'Search+Avoid'):.2f}",
            sent(2, "Collect") > sent(2, "Search+Avoid") > BARELY,
            why="this robot, another training, stops searching when it sees an object",
        ),
        Finding(
            "step 3, it has gripped it: Collect alone",
            "Search+Avoid disabled",
            f"Collect {sent(3, 'Collect'):.2f}, Search+Avoid {sent(3, 'Search+Avoid'):.2f}",
            sent(3, "Collect") > 0.5 and sent(3, "Search+Avoid") <= BARELY,
        ),
        Finding(
            "step 4, out of sight of the objects: its signal ends, and it goes on home",
            "Collect, without disturbance",
            f"of those that move it Collect alone has influence, if little: "
            f"{sent(4, 'Collect'):.2f}",
            sent(4, "Collect") > max(sent(4, one) for one in MOVING if one != "Collect"),
        ),
        Finding(
            "Idle is not used",
            "not at all",
            f"up to {idle:.2f} of influence in these steps",
            idle <= BARELY,
            why="waiting while it carries the object lets a robot emit its signal for longer "
            "before the cluster is out of its sight; how far robots see and hear in the thesis it "
            "does not say",
        ),
    ]


def last_steps() -> list[Finding]:
    steps = [int(row["tick"]) for row in rows_of(KEPT / "figure-8.3.csv")]
    signals = rows_of(KEPT / "foraging.csv")
    objects = {
        row["robots"]: float(row["mean"])
        for row in signals
        if row["measure"] == "objects" and not row["compared"]
    }
    return [
        Finding(
            "step 5, it has delivered: Collect ends, search and reaching the signal begin",
            "Search+Avoid and ReachSignal enabled",
            f"Collect {sent(5, 'Collect'):.2f}, Search+Avoid {sent(5, 'Search+Avoid'):.2f}, "
            f"ReachSignal {sent(5, 'ReachSignal'):.2f}",
            sent(5, "Collect") < min(sent(5, "Search+Avoid"), sent(5, "ReachSignal")),
            why="this robot, another training, follows the signal alone as long as it hears one",
        ),
        Finding(
            "steps 6 to 8, it turns to a signal, nears it, and sees objects again",
            "shown",
            f"ReachSignal {sent(6, 'ReachSignal'):.2f} and {sent(7, 'ReachSignal'):.2f}; "
            f"{steps[7] - steps[4]:,} ticks from delivery to objects in sight",
            steps == sorted(steps) and min(sent(6, "ReachSignal"), sent(7, "ReachSignal")) > BARELY,
        ),
        Finding(
            "signals are what brings robots together",
            "said",
            f"{objects['foraging together']:.1f} objects, {objects['no signals']:.1f} without "
            "signals",
            objects["foraging together"] > objects["no signals"],
        ),
    ]


def budget() -> str:
    return budget_of(KEPT / "trainings" / "foraging")


results = (
    Result("figure 8.3", "a robot that forages with others, steps 1 to 4", "figure-8.3",
           first_steps, "not told", budget, trainings=("foraging",)),
    Result("figure 8.4", "steps 5 to 8", "figure-8.3", last_steps, "not told", budget,
           trainings=("foraging",)),
)  # fmt: skip
