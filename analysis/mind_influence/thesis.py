"""What the thesis reports of influence while going round an obstacle (6.1.3), beside ours."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.judging import MOST, NO_SAY, Finding, looked_through
from socialmind.experiments.overview import Result, row_of

KEPT = Path(__file__).parent / "results"


def sent(step: int, skill: str) -> float:
    """Return the influence of a skill in a step."""
    return float(row_of(KEPT / "figure-6.6.csv", step=str(step))[skill])


def avoiding(step: int) -> float:
    """Return Avoid's part of what GoToObject and Avoid receive in a step."""
    total = sent(step, "GoToObject") + sent(step, "Avoid")
    return sent(step, "Avoid") / total if total else 0.0


def found_by() -> str:
    """Return how the run of the figure was come by."""
    from .trained import ALONE, LASTS, SEEDS, SHARED

    run = looked_through(SEEDS, int(row_of(KEPT / "figure-6.6.csv", step="1")["seed"]))
    return (
        f"runs were searched for one in which, on the way to an object, Avoid's part is {SHARED:g} "
        f"or less, then {ALONE:g} or more for {LASTS} ticks at least, then {SHARED:g} or less "
        f"again: {run}"
    )


def steps() -> list[Finding]:
    parts = [avoiding(step) for step in range(1, 5)]
    turns = [turning(step) for step in (3, 4)]
    late = sent(5, "Avoid") / sum(sent(5, one) for one in ("GoToObject", "GoToDropZone", "Avoid"))
    zone, goal = sent(5, "GoToDropZone+Avoid"), sent(5, "GoToObject+Avoid")
    return [
        Finding(
            "step 1, approaching: the influence goes to GoToObject",
            "exclusively",
            f"Avoid's part is {parts[0]:.2f}; {found_by()}",
            parts[0] <= NO_SAY,
            why="this robot keeps Avoid beside GoToObject, where it adds to moveForward "
            f"({sent(1, 'moveForward'):.2f}) and hardly turns ({sent(1, 'turnLeft'):.2f}): its "
            "training asked for no more",
        ),
        Finding(
            "step 2, too close to the obstacle: it goes to Avoid",
            "exclusively",
            f"Avoid's part is {parts[1]:.2f}",
            apart="the run was searched for one in which it does, as told in step 1",
        ),
        Finding(
            "step 3, distance recovered: GoToObject's influence grows, and is small at first",
            "GoToObject 0.16, Avoid much more",
            f"GoToObject's part goes from {1 - parts[1]:.2f} to {1 - parts[2]:.2f}",
            NO_SAY < 1 - parts[2] < 1 - MOST,
            why="beside GoToObject this robot gives Avoid at once as much as in step 1",
        ),
        Finding(
            "step 4, front clear: Avoid lowers its influence to moveForward, so that the turn "
            "counts for more",
            "a slight curve becomes a deliberate turn",
            f"turning has {turns[0]:.2f} of what the four constant skills receive in step 3, "
            f"{turns[1]:.2f} in step 4; Avoid's part stays at {parts[3]:.2f}",
            turns[1] > turns[0],
            why="this robot turns as much as it drives from step 3 on, and no more in step 4",
        ),
        Finding(
            "step 5, object picked up: Collect sends all to GoToDropZone+Avoid",
            "exclusively",
            f"GoToDropZone+Avoid {zone:.2f}, GoToObject+Avoid {goal:.2f}: a part of "
            f"{zone / (zone + goal):.2f}",
            zone >= (1 - NO_SAY) * (zone + goal),
            why="another training, in which most was as good as all",
        ),
        Finding(
            "and it keeps Avoid active where GoToObject+Avoid would not",
            "shown",
            f"Avoid's part is {late:.2f}, {parts[0]:.2f} in step 1",
            late > max(parts[0], NO_SAY),
            why="another training: what this robot's GoToDropZone+Avoid does beside obstacles is "
            "its own",
        ),
    ]


def turning(step: int) -> float:
    """Return the part of those that turn in what the constant skills receive in a step."""
    turn = sent(step, "turnLeft") + sent(step, "turnRight")
    return turn / (turn + sent(step, "moveForward") + sent(step, "moveBackwards"))


results = (
    Result("figure 6.6", "a robot on constant base skills goes round an obstacle", "figure-6.6",
           steps, "not told", lambda: "one training, not compared with others; how it was trained "
           "is not kept", unkept="its training is not kept"),
)  # fmt: skip
