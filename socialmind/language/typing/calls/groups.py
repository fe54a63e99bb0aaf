"""Typing of who is in a group: sets of agents."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from socialmind.language import types
from socialmind.language.nodes import Typed, call, constant, marked

if TYPE_CHECKING:
    from socialmind.language.typer import Typer

SETS = {"members_of": "members", "asking": "asking"}
"""What populations with minds are asked, and which lists answer."""


def agents_in(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.PopulationType, name: str
) -> Typed:
    """Return the agents of a population that are in an instance of a group, and the type."""
    population = kind.population
    if not typer.shape.populations[population].minded:
        typer.refuse(node, f"{name}() of {kind}, which has no minds", "give it a mind with groups")
    if len(node.args) != 2 or node.keywords:
        typer.refuse(
            node,
            f"{name}() like this",
            f'write model.{population}.{name}("village", mind.get_group_id("village"))',
        )
    _, group = typer.expression(node.args[0])
    if not isinstance(group, types.TextType):
        typer.refuse(node.args[0], f"{group} as the name of a group", "write its name as a text")
    place = typer.name(node.args[0], population, "group", (group.value,))
    identity = typer.fitted(node.args[1], types.INT, f"{name}()")
    lists = SETS[name]
    typer.program.gathers(population, lists)
    made = call(f"_agents_{name}", [base, constant(group.value, node), identity], node)
    return marked(made, ("found", population, lists, place)), types.FoundType(population, by=lists)
