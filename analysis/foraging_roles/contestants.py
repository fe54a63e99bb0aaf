"""All robots that are judged: every attempt at every lesson, what is programmed, and the picked."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from socialmind.mind import MindDescription

from . import choosing
from .minds import minds_of
from .role_trainings import PLANS
from .threshold_scan import CONTROLLERS

TICKS = 60_000
PICKED = "the model's mind"


@dataclass(frozen=True)
class Contestant:
    """Robots that are judged.

    Attributes:
        way: how they came to decide as they do.
        attempt: which of several; 0 where nothing was learned.
        mind: theirs; None for that of the model.
        parameters: of `ForagingByThresholds`; a learned mind decides by default.
    """

    way: str
    attempt: int
    mind: MindDescription | None = None
    parameters: Mapping[str, float] = field(default_factory=lambda: {"unlearned": 0})


def contestants() -> Iterator[Contestant]:
    """Yield all that are judged: the model's mind, all attempts kept, and what is programmed.

    Of each attempt at `like_bodies` the mind that was chosen is judged.
    """
    yield Contestant(PICKED, 1)
    for name in (*(one for one in PLANS if one != choosing.TRAINED), choosing.NAME):
        for attempt, mind in minds_of(name).items():
            yield Contestant(name, attempt, mind)
    yield Contestant("programmed", 0, None, {"programmed": 1.0})
    for name, parameters in CONTROLLERS.items():
        yield Contestant(name, 0, None, parameters)
    for code, name in enumerate(("fixed roles", "random roles", "greedy"), 1):
        yield Contestant(name, 0, None, {"unlearned": code})
