"""How an agent goes on in a plan that is a tree, for both speeds; `language.plans` lays it out.

The agent's row holds the step at which its plan goes on: -1 once the plan has ended, 0 before it
has begun. In a tick it carries out one action. What comes before the action, conditions and
counts, costs no tick; what comes behind it is followed as far as no function is asked, so that a
plan has ended with its last action.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba.extending import register_jitable

from socialmind.language.plans import (
    ACT,
    AGAIN,
    BACK,
    CALL,
    COUNT,
    DEPTH,
    END,
    JUMP,
    KIND,
    TARGET,
    TIMES,
    UNTIL,
    PlanSteps,
)

ENDED = -1
BEGUN = 0
"""The step of an agent whose plan has ended, and of one whose plan begins."""


@register_jitable
def followed(steps: Any, step: int, rounds: Any, idle: bool) -> int:
    """Return the step, from one on, that calls a function; `ENDED` behind the last one.

    Where a round of `until` has done nothing (`idle`), it is the step behind that round.
    """
    while True:
        kind = steps[step, KIND]
        if kind == END:
            return ENDED
        if kind == JUMP:
            step = steps[step, TARGET]
        elif kind == COUNT:
            rounds[steps[step, DEPTH]] = steps[step, CALL]
            step = step + 1 if steps[step, CALL] > 0 else steps[step, TARGET]
        elif kind == AGAIN:
            rounds[steps[step, DEPTH]] -= 1
            step = steps[step, TARGET] if rounds[steps[step, DEPTH]] > 0 else step + 1
        elif kind == BACK and not idle:
            step = steps[step, TARGET]
        else:
            return step


@register_jitable
def answered(steps: Any, step: int, rounds: Any, answer: int) -> int:
    """Return the step behind one whose function has answered.

    Args:
        steps: the population's.
        step: the one that called.
        rounds: how many rounds of each `repeat` around it are left.
        answer: 1 or 0 for True or False (1 of an action that returns nothing), or how many times.
    """
    kind = steps[step, KIND]
    if kind == ACT:
        return step + 1 if answer != 0 else step
    if kind == TIMES:
        rounds[steps[step, DEPTH]] = answer
        return step + 1 if answer > 0 else steps[step, TARGET]
    goes_in = answer == 0 if kind == UNTIL else answer != 0
    return step + 1 if goes_in else steps[step, TARGET]


def carry_on(plans: PlanSteps, plan: str, agent: Any, called: Callable[[int], int]) -> None:
    """Carry out the next action of an agent's plan (`engine.access` writes the compiled twin).

    Args:
        plans: those of its population.
        plan: the agent's.
        agent: its row.
        called: calls a function by its number, and gives its answer.
    """
    columns, slot = agent._table.columns, agent._slot
    steps, rounds = plans.array, columns["_rounds"][slot]
    step = columns["_step"].item(slot)
    if step < 0:
        return
    if step == BEGUN:
        step = plans.entries[plan]
    acted = idle = False
    while True:
        step = columns["_step"][slot] = int(followed(steps, step, rounds, idle))
        if step < 0 or acted or steps[step, KIND] == BACK:
            return
        answer = called(steps[step, CALL])
        # It may have brought births, for which there are new arrays now.
        columns, rounds = agent._table.columns, agent._table.columns["_rounds"][slot]
        if columns["_step"].item(slot) != step:  # it took up another plan, or gave this one up
            return
        kind = steps[step, KIND]
        acted = bool(kind == ACT)
        idle = idle or bool(kind == UNTIL and answer == 0)
        step = int(answered(steps, step, rounds, answer))


@register_jitable
def outweighed(weights: Any, plans: Any, count: int, plan: int, factor: float) -> bool:
    """Say whether an available plan weighs more than so many times the one that goes on.

    A plan that is not available any more gives way to any; one of negative weight to any heavier.

    Args:
        weights: of the available plans.
        plans: these plans.
        count: how many there are.
        plan: the one that goes on.
        factor: 1 or more.
    """
    found = -1
    for place in range(count):
        if plans[place] == plan:
            found = place
    if found < 0:
        return count > 0
    least = max(weights[found], factor * weights[found])
    heavier = False
    for place in range(count):
        heavier = heavier or weights[place] > least
    return heavier
