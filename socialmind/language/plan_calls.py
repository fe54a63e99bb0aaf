"""The functions that the plans of a population call, typed for its agents."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from typing import Any

from socialmind.errors import ModelError
from socialmind.language import plans
from socialmind.language.types import BOOL, INT, NONE, AnyType

_RETURNS: dict[int, tuple[tuple[AnyType, ...], str, str]] = {
    plans.ACT: ((NONE, BOOL), "action", "nothing, or True once it is done"),
    plans.TIMES: ((INT,), "number of rounds", "a whole number"),
    plans.TEST: ((BOOL,), "condition", "True or False"),
    plans.UNTIL: ((BOOL,), "condition", "True or False"),
}
"""By kind of step: what its function may return, what it is called, and that in words."""


@dataclass(frozen=True)
class PlanCall:
    """A function of a population's plans: its symbol, what it takes and what it returns."""

    symbol: str
    takes: tuple[str, ...]
    result: AnyType


@dataclass(frozen=True)
class TypedPlans:
    """The plans of a population.

    Attributes:
        names: the plans.
        calls: the functions; of plain plans one for each, in their order.
        steps: where plans are trees, how these call the functions.
    """

    names: tuple[str, ...]
    calls: tuple[PlanCall, ...]
    steps: plans.PlanSteps | None


def typed_plans(program: Any, population: str, typer: Any, node: ast.AST) -> TypedPlans:
    """Return the plans of a population, typed.

    Args:
        program: the model's.
        population: whose.
        typer: of the rule that carries them out.
        node: where it does.

    Raises:
        ModelError: there are none, or a function does not fit its place.
    """
    shape = program.shape.populations[population]
    if not shape.plans:
        typer.refuse(
            node,
            f"run_plan() of {population!r}, which has no plans",
            "give the population plans: Population(…, plans={'GrowWheat': grow_wheat})",
        )
    calls = []
    for plan, tree in shape.plans.items():
        if shape.steps is None:
            symbol, takes = program.entry(tree, population)
            made = PlanCall(symbol, takes, NONE)
            _check_ends(program, population, plan, made)
            calls.append(made)
    for call in () if shape.steps is None else shape.steps.calls:
        made = _plan_call(program, call, population)
        owners = [p for p, t in shape.plans.items() if call.function in plans.functions_of(t)]
        _check_ends(program, population, owners[0], made)
        calls.append(made)
    return TypedPlans(tuple(shape.plans), tuple(calls), shape.steps)


def _check_ends(program: Any, population: str, plan: str, call: PlanCall) -> None:
    """Refuse a plan in which an agent carries out its plan."""
    if program.effects.carried_out_by(call.symbol, population):
        source = program.functions[call.symbol].source
        raise ModelError(
            f"the plan {plan!r}, in which an agent carries out its plan",
            "a plan that ends",
            "leave run_plan() to the rule that chooses the plan",
            source.file,
            source.line,
        )


def _plan_call(program: Any, call: plans.Call, population: str) -> PlanCall:
    """Type an action, a condition or a number of rounds of a plan that is a tree."""
    symbol, takes, result = program.called(call.function, population)
    wanted, what, expected = _RETURNS[call.kind]
    if result not in wanted:
        source = program.source(call.function)
        raise ModelError(
            f"the {what} {source.name!r}, which returns {result}",
            f"one that returns {expected}",
            None,
            source.file,
            source.line,
        )
    return PlanCall(symbol, takes, result)
