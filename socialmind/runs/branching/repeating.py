"""A run's society at any moment, found by repeating the run: from its checkpoint or its start."""

from __future__ import annotations

from typing import TYPE_CHECKING

from socialmind.engine.explaining import explained
from socialmind.interventions.following import (
    Intervention,
    advanced,
    after_those_at,
    begun_for,
)
from socialmind.runs import continuing
from socialmind.runs.branching.kept import interventions_of
from socialmind.runs.sources import model_of

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from coglogo_py.receipts.receipt import Receipt
    from socialmind.model import Model
    from socialmind.runs.capsule import Capsule
    from socialmind.runs.checkpoint import Checkpoint

STRETCH = 1000
"""Ticks after which progress is told."""


def explain(
    capsule: Capsule, agent: int, tick: int, trust: bool = False, kept: bool = False
) -> Receipt:
    """Explain the decision of an agent of a run that was in force at a tick.

    Args:
        capsule: the run.
        agent: the agent's identity, in the first population with minds.
        tick: 1 … the ticks done.
        trust: run programs that this user has neither named nor run before.
        kept: take the copies of the model's source that the run keeps.

    Raises:
        SocialmindError: no such agent or decision, or the run cannot be repeated.
    """
    model = model_of(capsule, kept=kept, trust=trust)
    interventions = interventions_of(capsule, trust)

    def reached(ticks: int, leaving: bool) -> Model:
        society = advanced(model.fresh(), ticks, interventions)
        return after_those_at(society, interventions) if leaving else society

    return explained(model, agent, tick, reached)


def society_at(
    model: Model,
    interventions: Sequence[Intervention],
    tick: int,
    checkpoint: Checkpoint | None,
    capsule: Capsule,
    on_progress: Callable[[int, int], None] | None = None,
) -> Model:
    """Return the society of a run as it comes to a tick, before what is done to it there.

    Args:
        model: the run's, at tick 0; it is used.
        interventions: of the run, in order.
        tick: 0 or more.
        checkpoint: the run's, which serves if it is not after the tick.
        capsule: the run.
        on_progress: called with the ticks done and the tick.
    """
    if checkpoint is not None and checkpoint.tick <= tick:
        model = begun_for(model, interventions, checkpoint.tick)
        continuing.restore(model, checkpoint, capsule.checkpoint)
    while model.tick < tick and not model.stopped:
        model = advanced(model, min(STRETCH, tick - model.tick), interventions)
        if on_progress is not None:
            on_progress(model.tick, tick)
    return model
