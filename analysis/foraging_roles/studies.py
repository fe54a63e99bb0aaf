"""Section 8.2 of the thesis: roles that collapse and are drawn again, and roles that settle."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from socialmind.experiments.studies import Study

QUICK_WORLDS = 2


def collapse(out: Path, quick: bool = False, kept: bool = False) -> list[Path]:
    """Figures 8.6 and 8.7: nine robots whose roles were learned by the counts alone."""
    from .results import genomes, pictures

    weights = genomes(["counts"], out, quick, kept)["counts"][0]
    return pictures("counts", weights, 6000 if quick else 60_000, out)


def lessons(out: Path, quick: bool = False, kept: bool = False) -> list[Path]:
    """What each way to learn a role comes to, and the model's mind, in the economy."""
    from socialmind.mind import MindDescription

    from .contestants import PICKED
    from .results import OTHERS, WORLDS, genomes, judged, write_table
    from .trainings import LESSONS, MODEL, PLANS, mind_of

    worlds = slice(16 if quick else None)
    rows = []
    for name, several in genomes(list(PLANS), out, quick, kept).items():
        rows += judged(name, mind_of(name), several, WORLDS[worlds])
    picked = MindDescription.load(MODEL / "mind")
    weights = picked.skill(LESSONS.ROLE).genome
    rows += judged(PICKED, picked, [weights], OTHERS[worlds])
    return write_table("roles-lessons", rows, out)


def settling(out: Path, quick: bool = False, kept: bool = False) -> list[Path]:
    """The model's own mind in bodies: calm, after shocks, and in groups of other sizes."""
    from .results import conditions, write_table

    rows = conditions(QUICK_WORLDS if quick else 100)
    return write_table("roles-settling", rows, out)


studies = tuple(
    Study(
        name, about, make, quick=partial(make, quick=True),
        kept=partial(make, kept=True) if trains else None,
    )
    for name, about, make, trains in (
        ("figure-8.6", "roles learned by the counts alone, over time", collapse, True),
        ("roles-lessons", "what ways to learn a role come to, without bodies", lessons, True),
        ("roles-settling", "the learned roles in bodies: shocks, other sizes", settling, False),
    )
)  # fmt: skip
