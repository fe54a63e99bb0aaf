"""Within a tick: the society after some of its agents have had their turn."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from typing import Any

from socialmind.engine.ticks import run_tick
from socialmind.errors import SocialmindError
from socialmind.model import Model
from socialmind.worlds.plane.arena import Arena


@dataclass(frozen=True)
class Turn:
    """A turn within a tick.

    Attributes:
        number: 1 for the first of its tick.
        rule: which was followed.
        population: of who had it; None for the whole society's.
        id: of the agent.
    """

    number: int
    rule: str
    population: str | None
    id: int | None


class _Enough(BaseException):
    """As many turns as were asked for are over."""


def turnless(model_class: type[Model]) -> str:
    """Say why the ticks of a model have no turns; nothing where they have."""
    if model_class.declared_world.has_episodes:
        return "On a plane all robots act at once: a tick has no turns."
    if all(phase.population is None for phase in model_class.schedule):
        return "The schedule has no rule of an agent's own: a tick has no turns."
    return ""


def after_turns(society: Model, count: int) -> tuple[Model, Turn] | None:
    """Return a society within its next tick; interpreted, with the result of compiled ticks.

    Args:
        society: which stays as it is.
        count: turns that are over, 1 or more.

    Returns:
        A copy after them, and the last of them; None where the tick has fewer.

    Raises:
        SocialmindError: ticks of the model have no turns; a rule failed.
    """
    if isinstance(society.ground, Arena) or turnless(type(society)):
        raise SocialmindError(turnless(type(society)) or "on a plane a tick has no turns")
    made: Any = copy(society)
    found: list[Turn] = []
    number = 0

    def after(phase: Any, agent: Any) -> None:
        nonlocal number
        number += 1
        if number == count:
            whose = None if agent is None else int(agent.id)
            name = phase.shape.rule.__name__
            found.append(Turn(count, name, phase.shape.population, whose))
            raise _Enough

    try:
        run_tick(made, made.engine.functions, after)
    except _Enough:
        return made, found[0]
    return None
