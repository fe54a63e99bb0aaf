"""Typing of who and what is near: sets of agents and of patches, one of them, the nearest."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from socialmind.language import types
from socialmind.language.nodes import Typed, call, constant, marked

if TYPE_CHECKING:
    from socialmind.language.typer import Typer

AGENTS = {
    "near": ("near(who, radius)", ("radius",)),
    "on": ("on(who)", ()),
    "neighbours": ("neighbours(who, steps)", ("steps",)),
    "neighbours4": ("neighbours4(who)", ()),
    "nearest": ("nearest(who)` or `nearest(who, radius)", ("radius",)),
}
"""What populations are asked: how it is written, and what may stand behind the agent."""
PATCHES = {
    "in_radius": ("in_radius(who, radius)", ("radius",)),
    "neighbours": ("neighbours(who, steps)", ("steps",)),
    "neighbours4": ("neighbours4(who)", ()),
}
"""What the world is asked for."""
_NUMBERS: dict[str, types.Type] = {"radius": types.FLOAT, "steps": types.INT}


def agents_found(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.PopulationType, name: str
) -> Typed:
    """Return the agents of a population that are near somebody, or the nearest, and the type."""
    world = typer.shape.world
    population = kind.population
    if not world.extent:
        typer.refuse(
            node,
            f"{name}() of {kind} in a world without places",
            "declare a world: `world = Torus(33)`",
        )
    if name in ("on", "neighbours", "neighbours4") and world.patch is None:
        typer.refuse(
            node, f"{name}() in a world without patches", f"write model.{population}.near(…)"
        )
    who, asker, numbers = _asked(typer, node, f"model.{population}", *AGENTS[name])
    if asker == population:
        asker = "own"
    elif asker != "patch":
        asker = "other"
    typer.program.seeks(population, name)
    made = call(f"_agents_{name}", [base, who, *numbers], node)
    if name == "nearest":
        return marked(made, ("nearest", population, asker)), types.MaybeRowType(population)
    return marked(made, ("found", population, name, asker)), types.FoundType(population)


def patches_found(typer: Typer, node: ast.Call, base: ast.expr, name: str) -> Typed:
    """Return the patches around somebody, and their type."""
    who, asker, numbers = _asked(typer, node, "model.world", *PATCHES[name])
    typer.program.patches_sought = True
    mark = ("patches_found", name, "patch" if asker == "patch" else "agent")
    func = ast.copy_location(ast.Attribute(base, name, ast.Load()), node)
    made = ast.copy_location(ast.Call(func, [who, *numbers], []), node)
    return marked(made, mark), types.PatchesType()


def _asked(
    typer: Typer, node: ast.Call, owner: str, written: str, names: tuple[str, ...]
) -> tuple[ast.expr, str, list[ast.expr]]:
    """Return who is asked about, the population or "patch", and the numbers behind."""
    advice = f"write `{owner}.{written}`"
    given = dict(zip(("who", *names), node.args, strict=False))
    for keyword in node.keywords:
        if keyword.arg not in names or keyword.arg in given:
            typer.refuse(node, f"{owner}.{_name(node)}() with {keyword.arg}=", advice)
        given[str(keyword.arg)] = keyword.value
    optional = _name(node) == "nearest" or names == ("steps",)
    if len(node.args) > 1 + len(names) or len(given) < 1 + (len(names) and not optional):
        typer.refuse(node, f"{len(node.args)} arguments for {owner}.{_name(node)}()", advice)
    who, kind = typer.expression(given["who"])
    if isinstance(kind, types.MaybeRowType):
        who, kind = agent_there(who, kind)
    if isinstance(kind, types.RowType):
        asker = kind.population
    elif isinstance(kind, types.PatchType):
        asker = "patch"
    else:
        typer.refuse(
            node, f"{owner}.{_name(node)}() of {kind}", f"{advice}: of an agent or a patch"
        )
    numbers = [
        typer.fitted(given[one], _NUMBERS[one], f"the {one}") for one in names if one in given
    ]
    if names == ("steps",) and not numbers:
        numbers = [constant(1, node)]
    return who, asker, numbers


def _name(node: ast.Call) -> str:
    assert isinstance(node.func, ast.Attribute)  # a method was called
    return node.func.attr


def one_found(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.FoundType | types.PatchesType
) -> Typed:
    """Return one of a set, drawn at random: an agent or None, or a patch."""
    kinds = [typer.expression(argument) for argument in node.args]
    if [found for _, found in kinds] != [types.RNG] or node.keywords:
        typer.refuse(node, "one_of() without the random stream", "write ….one_of(rng)")
    arguments = [base, kinds[0][0]]
    if isinstance(kind, types.PatchesType):
        return marked(call("_one_patch", arguments, node), ("one_patch",)), types.PatchType()
    made = marked(call("_one_found", arguments, node), ("one_found", kind.population, kind.by))
    return made, types.MaybeRowType(kind.population)


def how_many(base: ast.expr, kind: types.AnyType, node: ast.Call) -> Typed:
    """Return the number of those in a set."""
    made = call("_how_many", [base], node)
    if isinstance(kind, types.FoundType):
        return marked(made, ("count_found", kind.population, kind.by)), types.INT
    return marked(made, ("count_patches",)), types.INT


def agent_there(value: ast.expr, kind: types.MaybeRowType) -> Typed:
    """Return an agent that may be None as one; None raises when the rule runs."""
    made = marked(call("_agent_there", [value], value), ("agent_there", kind.population))
    return made, types.RowType(kind.population)


def perhaps(value: ast.expr, kind: types.AnyType) -> ast.expr:
    """Return an agent, or None, as an agent that may be None."""
    if isinstance(kind, types.RowType):
        return marked(call("_perhaps", [value], value), ("perhaps",))
    return value
