"""Typing of what a rule or a drive does with a hierarchy of skills."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from socialmind.errors import nearest
from socialmind.language.nodes import Typed, constant, marked
from socialmind.language.types import HierarchyType, TextType, Type
from socialmind.language.typing.signatures import BETWEEN_EVALUATIONS, HIERARCHY, LEFT_OUT

if TYPE_CHECKING:
    from socialmind.language.typer import Typer


def hierarchy_call(
    typer: Typer, node: ast.Call, base: ast.expr, kind: HierarchyType, name: str
) -> Typed:
    """Return a call of a hierarchy's method as both speeds run it, and the type of its result."""
    called = "mind" if kind.driven else "hierarchy"
    known = [one for one in HIERARCHY if not (kind.driven and one in BETWEEN_EVALUATIONS)]
    if name not in known:
        typer.refuse(node, f"the {called}'s {name}()", nearest(name, known))
    if name == "evaluate" and typer.shape.populations[kind.population].evaluated_by_world:
        typer.refuse(
            node,
            f"evaluate() of {kind.population!r}, whose hierarchies the world evaluates",
            "leave it out: each tick evaluates them once, after the sensors",
        )
    if node.keywords:
        typer.refuse(
            node, f"{name}() with {node.keywords[0].arg}=", f"write {name}() without the name"
        )
    wanted = HIERARCHY[name].arguments
    written = list(node.args)
    if name in LEFT_OUT and len(written) == len(wanted) - 1:
        written.append(constant(LEFT_OUT[name], node))
    if len(written) != len(wanted):
        typer.refuse(
            node,
            f"{len(written)} arguments for {called}.{name}()",
            "see docs/minds.md",
            f"{len(wanted)}",
        )
    arguments: list[ast.expr] = []
    places: list[int | None] = []
    for argument, one in zip(written, wanted, strict=True):
        if isinstance(one, Type):
            arguments.append(typer.fitted(argument, one, f"{called}.{name}()"))
            places.append(None)
            continue
        _, found = typer.expression(argument)
        if not isinstance(found, TextType):
            typer.refuse(
                argument,
                f"{found} as the name of a {one.part}",
                f"write the {one.part}'s name as a text",
            )
        arguments.append(constant(found.value, argument))
        places.append(typer.name(argument, kind.population, one.part, (found.value,)))
    method = "override" if kind.driven and name == "set_variable" else name
    func = ast.copy_location(ast.Attribute(base, name, ast.Load()), node)
    made = ast.copy_location(ast.Call(func, arguments, []), node)
    mark = ("hierarchy", kind.population, method, tuple(places))
    return marked(made, mark), HIERARCHY[name].result
