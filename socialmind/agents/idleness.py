"""Decisions that found no plan available, counted in the record of a society."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

from socialmind.errors import IdleWarning


@dataclass(frozen=True)
class Idle:
    """Decisions that found no plan available: how many, and the first agent and tick of them."""

    count: int
    first_agent: int | None
    first_tick: int | None


def idle_in(context: Any) -> Idle:
    """Return what the record of a society says of such decisions."""
    count = int(context["_idle"])
    if count == 0:
        return Idle(0, None, None)
    return Idle(count, int(context["_idle_agent"]), int(context["_idle_tick"]))


def count_idle(context: Any, agent: int) -> None:
    """Count a decision that found no plan available."""
    if context["_idle"] == 0:
        context["_idle_agent"] = agent
        context["_idle_tick"] = context["_tick"]
    context["_idle"] += 1


def warn_of_first(context: Any, known: int, model: str) -> None:
    """Warn of a society's first such decision.

    Args:
        context: its record.
        known: how many there were before it ran on.
        model: its name.
    """
    idle = idle_in(context)
    if idle.count > known == 0 and idle.first_tick is not None:
        warnings.warn(
            f"agent {idle.first_agent} of {model} found no available plan in tick "
            f"{idle.first_tick} and did nothing; `idle` counts such decisions, "
            f"`explain({idle.first_agent}, {idle.first_tick + 1})` shows why",
            IdleWarning,
            stacklevel=3,
        )
