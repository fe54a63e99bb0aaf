"""Explaining a decision after the fact: the run is repeated up to it, from its seed."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from socialmind.engine.ticks import run_tick
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from coglogo_py.receipts.receipt import Receipt
    from socialmind.agents.running import Running


Reached = Callable[[int, bool], "Running"]
"""Gives the society at a tick, as it comes there or, if told so, as it leaves it."""


def explained(model: Running, agent: int, tick: int, reached: Reached | None = None) -> Receipt:
    """Explain the decision that was in force at a tick: an agent's last one up to it.

    Args:
        model: one with schemes; it stays as it is.
        agent: the agent's identity, in the first population with minds.
        tick: 1 or more.
        reached: gives the society at a tick, anew; by default where its rules alone bring it.

    Raises:
        SocialmindError: there is no such agent at that tick, or it has not decided yet.
    """
    if not model.schemes:
        steered = next(iter(model.assemblies), None)
        if steered is not None:
            raise SocialmindError(
                f"the agents of {model.name} have hierarchies of skills and no schemes; explain "
                f"what steers one: advance to the tick, then society.{steered}[{agent}].hierarchy"
                ".influence(SKILL), .actuator(NAME) and .variable(NAME), or draw it"
            )
        raise SocialmindError(f"the agents of {model.name} have no minds")
    population = next(iter(model.schemes))
    if model.populations[population].weighing is not None:
        raise SocialmindError(
            f"the hierarchies of {population!r} in {model.name} weigh the plans, not the "
            "cognitons; look at what they command: agent.hierarchy, agent.mind.plan_weights()"
        )
    reached = reached or _alone(model)
    seen = reached(tick, False)
    table = seen.tables[population]
    if not table.contains(agent):
        living = table.id
        known = f"{living[0]} … {living[-1]}" if len(living) else "none"
        raise SocialmindError(f"no agent {agent} lives at tick {tick}; the living are {known}")
    decided = table.columns["_decided"].item(table[agent]._slot)
    if decided < 0:
        raise SocialmindError(f"agent {agent} has taken no decision up to tick {tick}")
    again = reached(decided, True)
    again.watch = (population, agent)
    run_tick(again, again.engine.functions)
    if again.watched is None:
        raise SocialmindError(f"agent {agent} took no decision in tick {decided}")
    return again.watched


def _alone(model: Running) -> Reached:
    def reached(tick: int, _leaving: bool) -> Running:
        society = model.fresh()
        society.engine.advance(tick)
        return society

    return reached
