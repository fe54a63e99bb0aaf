"""Typing of attributes: fields of agents, patches and the model, and constants of modules."""

from __future__ import annotations

import ast
import types as python_types
from typing import TYPE_CHECKING, Any

from socialmind.errors import nearest
from socialmind.fields import Field
from socialmind.language import types
from socialmind.language.nodes import Typed, marked
from socialmind.language.refusals import MODULES
from socialmind.language.typing import hints
from socialmind.language.typing.calls import neighbours
from socialmind.language.typing.calls.networks import link_attribute
from socialmind.language.typing.signatures import MATH_CONSTANTS

if TYPE_CHECKING:
    from socialmind.language.typer import Typer


def typed_attribute(typer: Typer, node: ast.Attribute) -> Typed:
    """Return what stands after a dot: a field, a constant of a module, a part of the model."""
    if isinstance(node.value, ast.Name) and node.value.id not in typer.variables:
        module = typer.source.names.get(node.value.id)
        if isinstance(module, python_types.ModuleType):
            return _of_module(typer, node, module)
    base, kind = typer.expression(node.value)
    if isinstance(kind, types.MaybeRowType):
        base, kind = neighbours.agent_there(base, kind)
    new = ast.copy_location(ast.Attribute(base, node.attr, ast.Load()), node)
    if kind == types.MODEL:
        return _of_model(typer, new)
    if isinstance(kind, types.RowType):
        return _of_agent(typer, new, kind)
    if isinstance(kind, types.PatchType):
        if node.attr in ("x", "y"):
            return marked(new, ("patch_place", node.attr)), types.INT
        return _field(typer, new, typer.shape.world.patch, kind, ("patch",))
    if isinstance(kind, types.WorldType):
        numbers = typer.shape.world.numbers
        if node.attr in numbers:
            return marked(new, ("world_number", node.attr)), types.INT
        remedy = hints.for_world(typer, node.attr, tuple(numbers))
        if node.attr == "patches":
            remedy = "write `for patch in model.world.patches:`"
        typer.refuse(node, f"the world's {node.attr!r} as a value", remedy)
    if isinstance(kind, types.PopulationType):
        advice = hints.for_population(typer, kind.population, node.attr)
        typer.refuse(node, f"{node.attr!r} of {kind}", advice)
    return typer.refuse(
        node, f"{node.attr!r} of {kind}", "only agents, patches and the model have fields"
    )


def _of_module(typer: Typer, node: ast.Attribute, module: python_types.ModuleType) -> Typed:
    """Return a constant of `math`, or one of the author's own modules."""
    name = f"{module.__name__}.{node.attr}"
    names = typer.program.module_names(module)
    if node.attr not in names:
        typer.refuse(node, f"the unknown name {name!r}", nearest(node.attr, dir(module)))
    if module.__name__ == "math" and node.attr not in MATH_CONSTANTS:
        typer.refuse(node, f"{name!r} as a value", f"call it: {name}(…)")
    root = module.__name__.split(".")[0]
    if root in MODULES:
        typer.refuse(node, f"{name!r} in a rule", MODULES[root])
    return typer.module_value(node, name, names[node.attr])


def _of_model(typer: Typer, node: ast.Attribute) -> Typed:
    """Return what the model has."""
    name = node.attr
    if name == "tick":
        return marked(node, ("tick",)), types.INT
    if name in typer.shape.populations:
        return marked(node, ("population", name)), types.PopulationType(name)
    if name in typer.shape.interactions:
        return marked(node, ("interaction", name)), types.InteractionType(name)
    if name == "world" and typer.shape.world.commands:
        return marked(node, ("world",)), types.WorldType()
    fields = {**typer.shape.parameters, **typer.shape.variables}
    if name not in fields:
        found = f"the model's {name!r}, which it does not declare"
        typer.refuse(node, found, hints.for_model(typer, name))
    return _field(typer, node, fields, types.MODEL, ("model",))


def _of_agent(typer: Typer, node: ast.Attribute, kind: types.RowType) -> Typed:
    """Return what an agent, or a link, has."""
    shape = typer.shape.populations[kind.population]
    if node.attr == "id":
        return marked(node, ("id",)), types.INT
    if node.attr == "mind" and shape.minded:
        return marked(node, ("mind", shape.name)), types.MindType(shape.name)
    if node.attr == "plan" and shape.minded:
        steps = None if shape.steps is None else shape.name
        return marked(node, ("plan", steps)), types.PlanType(shape.name)
    if node.attr == "plan_ended" and shape.minded:
        if shape.steps is None:
            typer.refuse(
                node,
                f"plan_ended of {kind}, whose plans are rules of one tick",
                "leave it out, or make a plan of several parts: sequence(sow, reap)",
            )
        return marked(node, ("plan_ended",)), types.BOOL
    if node.attr == "hierarchy" and shape.hierarchy:
        return marked(node, ("hierarchy", shape.name)), types.HierarchyType(shape.name)
    if node.attr == "hierarchy":
        typer.refuse(
            node,
            f"the hierarchy of {kind}",
            "give the population one: Population(…, hierarchy='mind', master='Collect')",
        )
    end = None if shape.links is None else link_attribute(node, shape.links, shape.name)
    if end is not None:
        return end
    if node.attr in ("mind", "plan"):
        typer.refuse(
            node,
            f"the {node.attr} of {kind}",
            "give the population a mind: Population(…, mind='scheme.yaml')",
        )
    return _field(typer, node, shape.fields, kind, ("agent", shape.name))


def _field(
    typer: Typer, node: ast.Attribute, fields: Any, owner: types.AnyType, mark: tuple[Any, ...]
) -> Typed:
    """Return the reading of a declared field."""
    found: Field | None = fields.get(node.attr)
    if found is None:
        if isinstance(owner, types.RowType):
            advice = hints.for_agent(typer, node, owner.population)
        else:
            advice = hints.declaring(node.attr, fields, "the class of the patches", typer)
        typer.refuse(node, f"the unknown field {node.attr!r} of {owner}", advice)
    kind: types.AnyType = types.SCALARS[found.kind]
    if found.size is not None:
        kind = types.ArrayType(types.SCALARS[found.kind], found.size)
    elif found.optional:
        kind = types.OptionalType(types.SCALARS[found.kind])
    elif found.choices:
        kind = types.ChoiceType(found.choices)
    return marked(node, (*mark, found)), kind
