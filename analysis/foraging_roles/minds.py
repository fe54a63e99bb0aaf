"""The minds that lessons came to, every attempt that is kept."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from socialmind.learning import Training
from socialmind.mind import MindDescription

from . import choosing, choosing_again, scheme_evolution
from .role_trainings import PLANS
from .trainings import kept, mind_of

CHOICES: Mapping[str, Any] = {one.NAME: one for one in (choosing, choosing_again)}


@cache
def minds_of(lesson: str) -> Mapping[int, MindDescription]:
    """Return the minds of a lesson's attempts by their numbers; none where none is kept.

    Args:
        lesson: a plan of `role_trainings`; or of `trainings`, whose genomes are kept as a table; or
            `chosen_in_bodies` and `chosen_again`, what was chosen of each attempt at `like_bodies`.
    """
    if lesson in CHOICES:
        return CHOICES[lesson].minds()
    if lesson not in PLANS:
        genomes = kept().get(lesson, [])
        return {attempt: mind_of(lesson, genome) for attempt, genome in enumerate(genomes, 1)}
    if not (PLANS.kept / lesson).is_dir():
        return {}
    training = Training(PLANS.kept / lesson)
    return {attempt: training.mind(attempt) for attempt in training.finished}


def attempts_at(lesson: str) -> list[int]:
    """Return the numbers of the attempts at a lesson, or at fitting the scheme, that are kept."""
    return sorted(scheme_evolution.kept() if lesson == scheme_evolution.NAME else minds_of(lesson))


def decided_by(lesson: str, attempt: int) -> tuple[dict[str, Any], MindDescription | None]:
    """Return by what robots of an attempt decide.

    Args:
        lesson: as that of `minds_of`, or `evolved_scheme`.
        attempt: its number.

    Returns:
        Parameters of the model, and the mind; None where a scheme decides.
    """
    if lesson == scheme_evolution.NAME:
        return scheme_evolution.programmed(scheme_evolution.kept()[attempt]), None
    return {}, minds_of(lesson)[attempt]


def command_for(lesson: str) -> str:
    """Return the command that makes a lesson's minds."""
    if lesson == scheme_evolution.NAME:
        return "python -m analysis.foraging_roles.scheme_evolution"
    if lesson in CHOICES:
        return f"python -m analysis.foraging_roles.{CHOICES[lesson].__name__.rpartition('.')[2]}"
    trained = "role_trainings" if lesson in PLANS else "trainings"
    return f"python -m analysis.foraging_roles.{trained} {lesson}"
