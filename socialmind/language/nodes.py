"""Building blocks of the trees that the front end writes."""

from __future__ import annotations

import ast
import math
from typing import Any

from socialmind.language.types import AnyType

Typed = tuple[ast.expr, AnyType]
"""An expression as both speeds run it, and its type."""


def marked(node: Any, mark: tuple[Any, ...]) -> Any:
    """Attach to a node what the lowering must know about it."""
    node.mark = mark
    return node


def call(name: str, arguments: list[ast.expr], near: ast.AST) -> ast.Call:
    """Return a call of one of the functions that both speeds share."""
    node = ast.Call(ast.Name(name, ast.Load()), arguments, [])
    return ast.fix_missing_locations(ast.copy_location(node, near))


def constant(value: Any, near: ast.AST) -> ast.expr:
    """Return a written number at the place of a node; NaN has one sign at both speeds."""
    if value != value:
        value = math.nan
    return ast.copy_location(ast.Constant(value), near)


def written_number(node: ast.Constant) -> float | int:
    """Return the value of a written number."""
    if not isinstance(node.value, int | float):
        raise TypeError(f"{node.value!r} was typed as a number")
    return node.value
