"""Typing of operators: arithmetic, signs, powers, `and` and `or`, `a if condition else b`."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from socialmind.language.nodes import Typed, call, constant, written_number
from socialmind.language.refusals import OPERATORS
from socialmind.language.types import BOOL, FLOAT, INT, TextType, unified

if TYPE_CHECKING:
    from socialmind.language.typer import Typer

_INT_OPERATORS = {
    ast.Add: "add_int",
    ast.Sub: "subtract_int",
    ast.Mult: "multiply_int",
    ast.FloorDiv: "floor_divide_int",
    ast.Mod: "modulo_int",
}
_LARGEST_WHOLE_EXPONENT = 16


def typed_sign(typer: Typer, node: ast.UnaryOp) -> Typed:
    """Return a signed number, or a `not`, as both speeds run it."""
    if isinstance(node.op, ast.Not):
        return typer.truth_value(node)
    if isinstance(node.op, ast.Invert):
        typer.refuse(node, "~", "write `not`")
    value, kind = typer.number(node.operand)
    if isinstance(value, ast.Constant):
        number = written_number(value)
        return constant(-number if isinstance(node.op, ast.USub) else number, node), kind
    if isinstance(node.op, ast.USub) and kind == INT:
        return call("_subtract_int", [constant(0, node), value], node), INT
    return ast.copy_location(ast.UnaryOp(node.op, value), node), kind


def typed_operation(typer: Typer, node: ast.BinOp) -> Typed:
    """Return an operation on two numbers as both speeds run it."""
    if type(node.op) in OPERATORS:
        typer.refuse(
            node,
            f"the operator {OPERATORS[type(node.op)]}",
            "write `and`, `or`, `not` for truth values; numbers have + - * / // % **",
        )
    left, right = typer.number(node.left), typer.number(node.right)
    if isinstance(node.op, ast.Pow):
        return typed_power(typer, node, left, right)
    if left[1] == right[1] == INT and type(node.op) in _INT_OPERATORS:
        return call(f"_{_INT_OPERATORS[type(node.op)]}", [left[0], right[0]], node), INT
    made = ast.BinOp(typer.to_float(*left), node.op, typer.to_float(*right))
    return ast.copy_location(made, node), FLOAT


def typed_power(typer: Typer, node: ast.expr, left: Typed, right: Typed) -> Typed:
    """Return a power by the one definition that both speeds share."""
    (base, base_kind), (exponent, kind) = left, right
    written = written_number(exponent) if isinstance(exponent, ast.Constant) else None
    if base_kind == INT and kind == INT and (written is None or written >= 0):
        return call("_power_int", [base, exponent], node), INT
    base = typer.to_float(base, base_kind)
    if written == 2:
        return call("_square", [base], node), FLOAT
    if written is not None and abs(written) <= _LARGEST_WHOLE_EXPONENT and written == int(written):
        return call("_power_whole", [base, constant(int(written), node)], node), FLOAT
    if written == 0.5:
        return call("_sqrt", [base], node), FLOAT
    return call("_power", [base, typer.to_float(exponent, kind)], node), FLOAT


def typed_logic(typer: Typer, node: ast.BoolOp) -> Typed:
    """Return `and` or `or` of truth values as both speeds run it."""
    parts = []
    for value in node.values:
        part, kind = typer.expression(value)
        if kind != BOOL:
            typer.refuse(
                value,
                f"{kind} in `and`/`or` whose value is used",
                "write `a if condition else b`, or comparisons",
            )
        parts.append(part)
    return ast.copy_location(ast.BoolOp(node.op, parts), node), BOOL


def typed_choice(typer: Typer, node: ast.IfExp) -> Typed:
    """Return `a if condition else b` as both speeds run it."""
    test = typer.truth(node.test)
    yes, yes_kind = typer.there(node.body)
    no, no_kind = typer.there(node.orelse)
    kind = unified(yes_kind, no_kind)
    if isinstance(yes_kind, TextType) or isinstance(no_kind, TextType):
        typer.refuse(node, "a text that depends on a condition", "write if … else with two lines")
    if kind is None:
        typer.refuse(node, f"{yes_kind} or {no_kind}", "give both the same type")
    yes = typer.converted(yes, yes_kind, kind, "this value", node.body)
    no = typer.converted(no, no_kind, kind, "this value", node.orelse)
    return ast.copy_location(ast.IfExp(test, yes, no), node), kind
