"""Task partitioning on a slope and on flat ground: evolved from primitives, and programmed."""

from __future__ import annotations

from pathlib import Path

from socialmind.experiments.studies import Study, Way

QUICK_WORLDS = 4


def partitioning(way: Way, out: Path) -> list[Path]:
    """Judge every attempt and every programmed group on either ground.

    Args:
        way: how the trainings are come by.
        out: the folder.
    """
    from .groups import REPORTED
    from .report import write_partitioning
    from .trainings import PLANS

    trainings = {name: PLANS.training(name, way, out) for name in PLANS}
    worlds = REPORTED[:QUICK_WORLDS] if way is Way.QUICK else REPORTED
    return write_partitioning(trainings, way, worlds, out)


studies = (
    Study.of_trainings(
        "task-partitioning", "robots that divide the way down a slope, evolved", partitioning
    ),
)
