"""Typing of comparisons: numbers, truth values, plans, agents and `is None`."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from socialmind.errors import nearest
from socialmind.language import types
from socialmind.language.nodes import Typed, constant, marked
from socialmind.language.typing import tables
from socialmind.language.typing.neighbours import perhaps

if TYPE_CHECKING:
    from socialmind.language.typer import Typer

_SAMENESS: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Is: ast.Eq,
    ast.Eq: ast.Eq,
    ast.IsNot: ast.NotEq,
    ast.NotEq: ast.NotEq,
}


def typed_comparison(typer: Typer, node: ast.Compare) -> Typed:
    """Return a comparison as both speeds run it; its type is a truth value."""
    sides = [node.left, *node.comparators]
    if any(isinstance(op, ast.Is | ast.IsNot | ast.In | ast.NotIn) for op in node.ops) or any(
        isinstance(side, ast.Constant) and side.value is None for side in sides
    ):
        return _identity(typer, node)
    typed = [typer.expression(side) for side in sides]
    kinds = [kind for _, kind in typed]
    if any(isinstance(kind, types.ChoiceType) for kind in kinds):
        return _choices(typer, node, typed)
    if any(isinstance(kind, types.PlanType | types.TextType) for kind in kinds):
        return _plans(typer, node, typed)
    if any(isinstance(kind, types.TupleType | types.TableType) for kind in kinds):
        advice = "compare them one by one: `x == 0 and y == 1`"
        typer.refuse(node, "several values in a comparison", advice)
    if any(isinstance(kind, types.RowType | types.MaybeRowType) for kind in kinds):
        return _agents(typer, node, typed)
    if len(typed) == 2 and kinds[0] == kinds[1] == types.BOOL:
        return _compare(node, [value for value, _ in typed]), types.BOOL
    numbers = [
        typer.as_number(value, kind, side) for (value, kind), side in zip(typed, sides, strict=True)
    ]
    if any(kind == types.FLOAT for _, kind in numbers):
        return _compare(node, [typer.to_float(*number) for number in numbers]), types.BOOL
    return _compare(node, [value for value, _ in numbers]), types.BOOL


def _compare(node: ast.Compare, values: list[ast.expr]) -> ast.expr:
    return ast.copy_location(ast.Compare(values[0], node.ops, values[1:]), node)


def _identity(typer: Typer, node: ast.Compare) -> Typed:
    """Type `is None`, `is not None` and `is` between agents."""
    operator = node.ops[0]
    if len(node.ops) > 1:
        typer.refuse(node, "a chain with `is` or `in`", "write two comparisons joined by `and`")
    if isinstance(operator, ast.In | ast.NotIn):
        return _one_of_several(typer, node, operator)
    other = node.comparators[0]
    if isinstance(node.left, ast.Constant) and node.left.value is None:
        typer.refuse(node, "None on the left of a comparison", "write `x is None`")
    left, kind = typer.expression(node.left)
    if isinstance(other, ast.Constant) and other.value is None:
        if not isinstance(operator, ast.Is | ast.IsNot):
            typer.refuse(node, "None compared by its value", "write `is None` or `is not None`")
        if isinstance(kind, types.MaybeRowType) or kind == types.NOBODY:
            new = _compare(node, [left, constant(None, other)])
            return marked(new, ("none_agent", isinstance(operator, ast.IsNot))), types.BOOL
        if not isinstance(kind, types.OptionalType | types.PlanType):
            typer.refuse(
                node,
                f"`is None` on {kind}, which is never None",
                "leave the question out, or declare the field as `… | None`",
            )
        negated = isinstance(operator, ast.IsNot)
        new = _compare(node, [left, constant(None, other)])
        return marked(new, ("none", negated, isinstance(kind, types.PlanType))), types.BOOL
    right = typer.expression(other)
    agents = types.RowType | types.MaybeRowType
    if isinstance(kind, agents) and isinstance(right[1], agents):
        return _agents(typer, node, [(left, kind), right])
    return typer.refuse(node, "`is` between values", "write `==`; `is` is for None and agents")


def _one_of_several(typer: Typer, node: ast.Compare, operator: ast.cmpop) -> Typed:
    """Type `x in (1, 2)` as `x == 1 or x == 2`, where asking again changes nothing."""
    several = node.comparators[0]
    if isinstance(several, ast.Name | ast.Attribute):
        kind = typer.expression(several)[1]
        if isinstance(kind, types.TableType) and not isinstance(kind.item, types.TupleType):
            several = tables.written(kind.values, several)
        if isinstance(kind, types.TableType) and isinstance(kind.item, types.TupleType):
            names = "abcdefgh"[: len(kind.item.items)]
            parts = node.left.elts if isinstance(node.left, ast.Tuple) else []
            sought = [ast.unparse(one) for one in parts] or ["…"] * len(names)
            question = " and ".join(f"{a} == {b}" for a, b in zip(names, sought, strict=False))
            advice = (
                f"ask in a loop: `found = False`, then `for {', '.join(names)} in "
                f"{ast.unparse(several)}:` with `if {question}: found = True`"
            )
            typer.refuse(node, "`in` a tuple of pairs", advice)
    if not isinstance(several, ast.Tuple | ast.List | ast.Set) or not several.elts:
        typer.refuse(node, "`in` without written values", "write `x in (1, 2)`, or a for loop")
    assert isinstance(several, ast.Tuple | ast.List | ast.Set)  # refused above
    for part in (node.left, *several.elts):
        if any(isinstance(inner, ast.Call | ast.Subscript) for inner in ast.walk(part)):
            typer.refuse(part, "a call or a place of an array beside `in`", "give it a name before")
    negated = isinstance(operator, ast.NotIn)
    questions: list[ast.expr] = []
    for value in several.elts:
        same: ast.cmpop = ast.NotEq() if negated else ast.Eq()
        questions.append(ast.copy_location(ast.Compare(node.left, [same], [value]), value))
    joined = ast.BoolOp(ast.And() if negated else ast.Or(), questions)
    if len(questions) == 1:
        return typer.expression(questions[0])
    return typer.expression(ast.copy_location(joined, node))


def _agents(typer: Typer, node: ast.Compare, typed: list[Typed]) -> Typed:
    """Type the question whether two agents are the same one."""
    (left, kind), (right, other) = typed[0], typed[-1]
    operator = _SAMENESS.get(type(node.ops[0]))
    if len(typed) != 2 or operator is None:
        typer.refuse(node, "agents in a comparison of size", "compare their fields")
    if types.unified(kind, other) is None:
        typer.refuse(
            node,
            f"{kind} compared with {other}",
            "compare two agents of one population, or their fields",
        )
    if kind != other or isinstance(kind, types.MaybeRowType):
        sides = [perhaps(side, one) for side, one in typed]
        return ast.copy_location(ast.Compare(sides[0], [operator()], sides[1:]), node), types.BOOL
    ids = [
        marked(ast.copy_location(ast.Attribute(side, "id", ast.Load()), node), ("id",))
        for side in (left, right)
    ]
    return ast.copy_location(ast.Compare(ids[0], [operator()], [ids[1]]), node), types.BOOL


def _choices(typer: Typer, node: ast.Compare, typed: list[Typed]) -> Typed:
    """Type `model.trade == "barter"`; compiled, a choice is its place among the texts."""
    if len(typed) != 2 or not isinstance(node.ops[0], ast.Eq | ast.NotEq):
        typer.refuse(node, "choices in a comparison of size", "compare them with == or !=")
    values = []
    for (value, kind), (_, other) in zip(typed, reversed(typed), strict=True):
        if isinstance(kind, types.TextType) and isinstance(other, types.ChoiceType):
            if kind.value not in other.texts:
                typer.refuse(
                    node, f"{kind}, which is none of the choices", nearest(kind.value, other.texts)
                )
            place = other.texts.index(kind.value)
            values.append(marked(constant(kind.value, node), ("choice", place)))
        elif isinstance(kind, types.ChoiceType) and (
            kind == other or isinstance(other, types.TextType)
        ):
            values.append(value)
        else:
            typer.refuse(node, f"{kind} compared with {other}", "compare a choice with a text")
    return _compare(node, values), types.BOOL


def _plans(typer: Typer, node: ast.Compare, typed: list[Typed]) -> Typed:
    """Type `human.plan == "GrowWheat"`."""
    if len(typed) != 2 or not isinstance(node.ops[0], ast.Eq | ast.NotEq):
        typer.refuse(node, "plans in a comparison of size", "compare them with == or !=")
    values = []
    for (value, kind), (_, other) in zip(typed, reversed(typed), strict=True):
        if isinstance(kind, types.PlanType) and (
            kind == other or isinstance(other, types.TextType)
        ):
            values.append(value)
        elif isinstance(kind, types.TextType) and isinstance(other, types.PlanType):
            values.append(typer.plan_name(value, kind, other.population))
        else:
            advice = "compare a plan with a plan's name, or with a plan of the same population"
            if not isinstance(kind, types.PlanType) and not isinstance(other, types.PlanType):
                advice = (
                    "texts name plans (agent.plan == 'GrowWheat') and nothing else; "
                    "keep a choice among few as a whole number: `RED = 0` at the top of the file"
                )
            typer.refuse(node, f"{kind} compared with {other}", advice)
    return _compare(node, values), types.BOOL
