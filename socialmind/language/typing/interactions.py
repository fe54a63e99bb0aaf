"""Typing of the outcomes of interactions."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any

from socialmind.errors import nearest
from socialmind.language import types
from socialmind.language.nodes import Typed
from socialmind.language.typing.minds import method_call

if TYPE_CHECKING:
    from socialmind.language.typer import Typer


def interaction_call(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.InteractionType, name: str
) -> Typed:
    """Return the drawing of an outcome as both speeds run it; it is one of several texts."""
    interaction = typer.shape.interactions[kind.interaction]
    sides = ["instigator", "recipient", *(["location"] if interaction.location else [])]
    written = f"model.{kind.interaction}.outcome({', '.join([*sides, 'rng'])})"
    if name != "outcome":
        typer.refuse(node, f"{name}() of {kind}", f"write {written}")
    values = [typer.expression(argument) for argument in node.args]
    kinds = [found for _, found in values]
    if len(kinds) != len(sides) + 1 or node.keywords or kinds[-1] != types.RNG:
        typer.refuse(node, f"outcome() of {kind} like this", f"write {written}")
    for place, (side, found) in enumerate(zip(sides, kinds, strict=False)):
        _check_side(typer, node.args[place], interaction, side, found)
    patches = tuple(isinstance(found, types.PatchType) for found in kinds[:-1])
    mark = ("outcome", kind.interaction, patches)
    made = method_call(node, base, name, [value for value, _ in values], mark)
    return made, types.ChoiceType(interaction.outcomes)


def _check_side(
    typer: Typer, node: ast.expr, interaction: Any, side: str, found: types.AnyType
) -> None:
    """Refuse what has not the abilities of a side."""
    if isinstance(found, types.RowType):
        fields = typer.shape.populations[found.population].fields
    elif isinstance(found, types.PatchType) and side == "location":
        fields = typer.shape.world.patch or {}
    else:
        expected = "a patch or an agent" if side == "location" else "an agent"
        typer.refuse(node, f"{found} as the {side}", f"give it {expected}", expected)
    for ability in getattr(interaction, side):
        one = fields.get(ability)
        if one is None or one.size is not None or one.optional or one.choices:
            what, remedy = "which is not one number", f"declare it as `{ability}: float = 0.0`"
            if one is None:
                what, remedy = "which it does not have", nearest(ability, fields)
            typer.refuse(
                node, f"{found} as the {side} with the ability {ability!r}, {what}", remedy
            )
