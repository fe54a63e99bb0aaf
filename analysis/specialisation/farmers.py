"""The other way round: farmers by a written scheme, by a learned mind, by a distilled scheme."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pandas as pd

from socialmind.catalogue import load_file, load_model, model_folder
from socialmind.work.side_by_side import side_by_side

from .societies import Size
from .tables import Measured

SOCIETIES = {
    "written": "the scheme that somebody wrote",
    "learned": "a perceptron that was taught for wheat, and reads the same cognitons",
    "distilled": "a scheme of few links that was distilled from the perceptron",
}
DISTILLED = "distilled.yaml"
"""The file of the scheme that is distilled."""
EVERY = 500
"""Ticks between two records."""
MEASURED = {
    one.name: one
    for one in (
        Measured(
            "prosperity", "Wheat of a person", "comfortable stocks",
            "The mean stock of wheat at the end, over the one that leaves no need.",
        ),
        Measured(
            "specialised", "Specialised agents", "share of agents",
            "As for robots; a piece of work is what an agent is seen doing at a record.",
        ),
        Measured(
            "agents_to_tasks", "Division of labour", "I / H(tasks)", "As for robots.",
        ),
        Measured(
            "role_changes", "Role changes", "an agent and 10,000 ticks",
            "While settled: within one agent of 20 farmers and 5 artisans, which is what the "
            "thesis found.",
        ),
        Measured(
            "last_distance", "Distance to 20 : 5", "agents, last quarter",
            "As for robots, to 20 farmers and 5 artisans.",
        ),
        Measured(
            "delivered", "Tools to others", "tools",
            "Tools that an agent sold less those that it bought, of agents that sold more.", 0,
        ),
    )
}  # fmt: skip


@dataclass(frozen=True)
class Found:
    """What was found of the three societies.

    Attributes:
        worlds: `society`, `seed` and measures.
        course: `society`, `seed`, `tick`, `artisans` and `specialised`.
    """

    worlds: pd.DataFrame
    course: pd.DataFrame


def _study() -> Any:
    return load_file(Path(__file__).parents[1] / "farmer_artisan" / "learned.py")


def lived(
    society: str, seed: int, ticks: int, scheme: str
) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Run a society, and return its measures and its course.

    Args:
        society: its name.
        seed: of every draw.
        ticks: how long.
        scheme: the file of the distilled scheme.
    """
    study = _study()
    if society == "learned":
        model = load_model("farmer_artisan_learned")(seed=seed)
    else:
        options = {"scheme": scheme} if society == "distilled" else {}
        model = load_model("farmer_artisan")(seed=seed, **options)
    course = study.lived(model, ticks, EVERY)
    row = {"society": society, "seed": seed, **study.measures(model, course)}
    split = course.split
    artisans = split["artisan"] if "artisan" in split else pd.Series(0, split.index)
    over_time = pd.DataFrame({"artisans": artisans, "specialised": course.specialised})
    return row, [
        {"society": society, "seed": seed, **one}
        for one in over_time.reset_index().to_dict("records")
    ]


def found(size: Size, home: Path, workers: int | None = None) -> Found:
    """Distil a scheme from the learned mind, and run the three societies on the same seeds.

    Args:
        size: of the study.
        home: where the distilled scheme is written.
        workers: processes; one for each processor by default.
    """
    distillation, _ = _study().distil(model_folder("farmer_artisan_learned") / "mind")
    home.mkdir(parents=True, exist_ok=True)
    file = home / DISTILLED
    distillation.scheme.save(file)
    calls = [
        (society, seed, size.farmers_ticks, str(file))
        for society in SOCIETIES
        for seed in range(size.farmers)
    ]
    answers: Sequence[Any] = list(side_by_side(lived, calls, workers))
    return Found(
        worlds=pd.DataFrame([row for row, _ in answers]),
        course=pd.DataFrame([one for _, several in answers for one in several]),
    )
