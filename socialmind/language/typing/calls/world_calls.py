"""Typing of what rules ask of their world that is no rule: steps over fields, free patches."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import TYPE_CHECKING

from socialmind.errors import nearest
from socialmind.fields import Field
from socialmind.language import types
from socialmind.language.aggregates import number_fields
from socialmind.language.nodes import Typed, constant
from socialmind.language.shape import AGENT, FIELD
from socialmind.language.typing.calls.minds import method_call

if TYPE_CHECKING:
    from socialmind.language.typer import Typer


def world_call(typer: Typer, node: ast.Call, base: ast.expr, name: str) -> Typed:
    """Return a call of the world's as both speeds run it, and the type of its result."""
    wanted = typer.shape.world.calls[name]
    if name in (typer.shape.world.patch or {}):
        typer.refuse(
            node, f"world.{name}() where patches have a field {name!r}", "rename the field"
        )
    if len(node.args) != len(wanted.arguments) or node.keywords:
        typer.refuse(node, f"world.{name}() like this", f"write model.world.{wanted.written}")
    arguments: list[ast.expr] = []
    keys: list[str] = []
    result = wanted.result
    for argument, one in zip(node.args, wanted.arguments, strict=True):
        if one == FIELD:
            field = number_field(
                typer, argument, typer.shape.world.patch or {}, "the patches", wanted.kinds
            )
            arguments.append(constant(field.name, argument))
            keys.append(field.name)
            result = of_field(field) if result == FIELD else result
        elif one == AGENT:
            value, kind = typer.expression(argument)
            if not isinstance(kind, types.RowType):
                typer.refuse(argument, f"{kind} for world.{name}()", "give it an agent", AGENT)
            arguments.append(value)
            keys.append(kind.population)
            typer.program.effects.changes(kind.population)
        elif isinstance(one, types.Type) and one in types.NUMBERS:
            arguments.append(typer.fitted(argument, one, f"world.{name}()"))
        else:
            value, kind = typer.expression(argument)
            if kind != one:
                typer.refuse(argument, f"{kind} for world.{name}()", f"write {wanted.written}")
            arguments.append(value)
    assert not isinstance(result, str)  # FIELD is among its arguments
    typer.program.calls_world(name, *keys)
    return method_call(node, base, name, arguments, ("world_call", name, *keys)), result


def population_aggregate(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.PopulationType, name: str
) -> Typed:
    """Return the sum, mean, smallest or largest of a field of a population, and its type."""
    population = kind.population
    if name in typer.shape.populations[population].fields:
        typer.refuse(node, f"{name}() of {kind}, with a field {name!r}", "rename the field")
    if len(node.args) != 1 or node.keywords:
        typer.refuse(node, f"{name}() like this", f'write model.{population}.{name}("field")')
    kinds = (float, int, bool) if name in ("sum", "mean") else (float, int)
    fields = typer.shape.populations[population].fields
    field = number_field(typer, node.args[0], fields, f"agents of {population!r}", kinds)
    typer.program.sums_up(population, name, field)
    argument = constant(field.name, node.args[0])
    made = method_call(node, base, name, [argument], ("aggregate", population, name, field.name))
    return made, types.FLOAT if name == "mean" else of_field(field)


def number_field(
    typer: Typer, node: ast.expr, fields: Mapping[str, Field], whose: str, kinds: tuple[type, ...]
) -> Field:
    """Return the field whose name is written, which must hold one number."""
    _, kind = typer.expression(node)
    if not isinstance(kind, types.TextType):
        typer.refuse(node, f"{kind} as the name of a field", "write the field's name as a text")
    known = number_fields(fields, kinds)
    if kind.value not in known:
        named = " or ".join(one.__name__ for one in kinds)
        typer.refuse(
            node,
            f"{kind.value!r} as a field of {whose}",
            nearest(kind.value, known),
            f"the name of a field of the type {named}",
        )
    return known[kind.value]


def of_field(field: Field) -> types.Type:
    """Return the type of the numbers of a field."""
    return types.FLOAT if field.kind is float else types.INT
