"""A society that goes on through interventions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

from socialmind.interventions.change import Change
from socialmind.interventions.edit import Edit
from socialmind.interventions.shock import Shock
from socialmind.interventions.steer import Steer
from socialmind.model import Model

Society = TypeVar("Society", bound=Model)
Intervention = Shock | Change | Edit | Steer


def in_order(interventions: Iterable[Intervention]) -> tuple[Intervention, ...]:
    """Return interventions by their ticks; those of one tick stay in their order."""
    return tuple(sorted(interventions, key=lambda one: one.tick))


def after_those_at(society: Society, interventions: Sequence[Intervention]) -> Society:
    """Return a society as it leaves its tick: after the interventions there, if it goes on at all.

    Args:
        society: which has not met them yet; it may be changed.
        interventions: of any ticks.

    Raises:
        SocialmindError: one failed.
    """
    for one in interventions:
        if one.tick == society.tick and not society.stopped:
            society = one.applied(society)
    return society


def next_after(tick: int, interventions: Iterable[Intervention], end: int) -> int:
    """Return the tick of the next intervention after a tick, or an end that comes before it."""
    return min((one.tick for one in interventions if tick < one.tick < end), default=end)


def advanced(society: Society, ticks: int, interventions: Sequence[Intervention] = ()) -> Society:
    """Return a society that has gone on through interventions.

    Args:
        society: at any tick, before the interventions there; it may be changed, and is the one
            returned unless parameters or schemes change.
        ticks: 0 or more; it may stop earlier.
        interventions: of any ticks, in order.

    Raises:
        SocialmindError: a rule or an intervention failed.
    """
    end = society.tick + ticks
    while society.tick < end and not society.stopped:
        society = after_those_at(society, interventions)
        society.advance(next_after(society.tick, interventions, end) - society.tick)
    return society


def begun_for(society: Society, interventions: Iterable[Intervention], tick: int) -> Society:
    """Return a society of the parameters and schemes that hold at a tick, to take its state.

    Args:
        society: at tick 0.
        interventions: in order.
        tick: those before it count.
    """
    for one in interventions:
        if one.tick < tick and isinstance(one, Change):
            society = one.begun(society)
    return society
