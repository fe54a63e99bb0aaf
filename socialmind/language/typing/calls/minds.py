"""Typing of what a rule or a drive does with a mind or a hierarchy of skills."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any

from socialmind.errors import nearest
from socialmind.language import types
from socialmind.language.nodes import Typed, constant, marked
from socialmind.language.typing.calls.built_in import without_keywords
from socialmind.language.typing.signatures import (
    BETWEEN_EVALUATIONS,
    CHOSEN,
    HIERARCHY,
    IMITATION,
    LEFT_OUT,
    MIND,
    OTHER,
)

if TYPE_CHECKING:
    from socialmind.language.typer import Typer


def mind_call(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.MindType, name: str
) -> Typed:
    """Return a call of a mind's method as both speeds run it, and the type of its result."""
    if name in IMITATION:
        return _imitation(typer, node, base, kind, name)
    if name not in MIND:
        typer.refuse(node, f"the mind's {name}()", nearest(name, [*MIND, *IMITATION]))
    without_keywords(typer, node, f"mind.{name}")
    signature = MIND[name]
    if len(node.args) != len(signature.arguments):
        typer.refuse(
            node,
            f"{len(node.args)} arguments for mind.{name}()",
            "see docs/coglogo_py.md",
            f"{len(signature.arguments)}",
        )
    population, wanted = kind.population, signature.arguments
    arguments, places = _named(typer, node.args, wanted, population, f"mind.{name}()")
    result: types.AnyType = signature.result
    if result == CHOSEN:
        result = types.PlanType(population)
    called = name
    if OTHER in wanted:
        other = _other_mind(typer, node.args[-1], name)
        typer.program.acts_on_others((population, name, other), typer, node)
        called = f"{name}_{other}"
    return method_call(node, base, name, arguments, ("mind", population, called, places)), result


def _other_mind(typer: Typer, node: ast.expr, name: str) -> str:
    """Return the population of the mind that a command is about."""
    kind = typer.expression(node)[1]
    if not isinstance(kind, types.MindType):
        typer.refuse(node, f"{kind} for mind.{name}()", "write the other's mind, as other.mind")
    return kind.population


def _imitation(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.MindType, name: str
) -> Typed:
    """Return what a mind takes over of another one, which may be of another population."""
    without_keywords(typer, node, f"mind.{name}")
    wanted = IMITATION[name].arguments
    complete = len(node.args) == len(wanted) + 1
    value, whose = typer.expression(node.args[-1]) if complete else (base, None)
    if not isinstance(whose, types.MindType):
        cogniton = '"Fashion", ' if wanted else ""
        advice = f"write agent.mind.{name}({cogniton}other.mind)"
        typer.refuse(node, f"mind.{name}() of something else", advice, "the mind of another agent")
    populations = (kind.population, whose.population)
    arguments: list[ast.expr] = []
    places: list[int | None] = []
    for population in populations:
        arguments, found = _named(typer, node.args[:-1], wanted, population, f"mind.{name}()")
        places += found
    typer.program.imitates(name, *populations)
    mark = ("imitation", name, populations, tuple(places))
    return method_call(node, base, name, [*arguments, value], mark), IMITATION[name].result


def hierarchy_call(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.HierarchyType, name: str
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
    arguments, places = _named(typer, written, wanted, kind.population, f"{called}.{name}()")
    method = "override" if kind.driven and name == "set_variable" else name
    mark = ("hierarchy", kind.population, method, places)
    return method_call(node, base, name, arguments, mark), HIERARCHY[name].result


def _named(
    typer: Typer, written: list[ast.expr], wanted: Any, population: str, call: str
) -> tuple[list[ast.expr], tuple[int | None, ...]]:
    """Return the arguments of a call, and which names of the population those that name are."""
    arguments: list[ast.expr] = []
    places: list[int | None] = []
    group = ""
    for argument, one in zip(written, wanted, strict=True):
        if one == OTHER:
            arguments.append(typer.expression(argument)[0])
            places.append(None)
            continue
        if isinstance(one, types.Type):
            arguments.append(typer.fitted(argument, one, call))
            places.append(None)
            continue
        value, found = typer.expression(argument)
        if one.part == "plan" and isinstance(found, types.PlanType):
            arguments.append(value)
            places.append(None)
            continue
        if not isinstance(found, types.TextType):
            typer.refuse(
                argument,
                f"{found} as the name of a {one.part}",
                f"write the {one.part}'s name as a text",
            )
        group = found.value if one.part == "group" else group
        keys = (
            (group, found.value)
            if one.part in ("role", "culturon", "attribute")
            else (found.value,)
        )
        arguments.append(constant(found.value, argument))
        places.append(typer.name(argument, population, one.part, keys))
    return arguments, tuple(places)


def method_call(
    node: ast.Call, base: ast.expr, name: str, arguments: list[ast.expr], mark: Any
) -> Any:
    """Return a call of a method, marked."""
    func = ast.copy_location(ast.Attribute(base, name, ast.Load()), node)
    return marked(ast.copy_location(ast.Call(func, arguments, []), node), mark)
