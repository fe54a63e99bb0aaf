"""Typing of calls: the author's functions, and what agents, minds and the world can do."""

from __future__ import annotations

import ast
import statistics
import types as python_types
from typing import TYPE_CHECKING, Any

from socialmind.errors import close, nearest
from socialmind.language import types
from socialmind.language.aggregates import AGGREGATES
from socialmind.language.nodes import Typed, call, constant, marked
from socialmind.language.refusals import METHODS, MODULES, NAMES
from socialmind.language.typing import hints
from socialmind.language.typing.calls import groups, neighbours
from socialmind.language.typing.calls.built_in import (
    BUILT_IN,
    built_in,
    fitted,
    math_function,
    without_keywords,
)
from socialmind.language.typing.calls.draws import typed_draw
from socialmind.language.typing.calls.interactions import interaction_call
from socialmind.language.typing.calls.minds import hierarchy_call, method_call, mind_call
from socialmind.language.typing.calls.networks import link_call, network_call, one_linked
from socialmind.language.typing.calls.world_calls import population_aggregate, world_call
from socialmind.language.typing.comprehensions import reduced
from socialmind.language.typing.signatures import Signature

if TYPE_CHECKING:
    from socialmind.language.typer import Typer

MEANS = (statistics.mean, statistics.fmean)
"""What rules call for a mean: the sum, added from the first to the last, by how many there are."""


def typed_call(typer: Typer, node: ast.Call) -> Typed:
    """Return a call as both speeds run it, and the type of its result."""
    for argument in node.args:
        if isinstance(argument, ast.Starred):
            typer.refuse_syntax(argument)
    if any(keyword.arg is None for keyword in node.keywords):
        typer.refuse(node, "** in a call", "write the arguments out")
    if isinstance(node.func, ast.Name):
        return _called_by_name(typer, node, node.func.id)
    if isinstance(node.func, ast.Attribute):
        owner = node.func.value
        if isinstance(owner, ast.Name) and owner.id not in typer.variables:
            module = typer.source.names.get(owner.id)
            if isinstance(module, python_types.ModuleType):
                return _called_in_module(typer, node, module, node.func.attr)
        return _method(typer, node, node.func)
    return typer.refuse(node, "a call of something without a name", "call a function by its name")


def _called_by_name(typer: Typer, node: ast.Call, name: str) -> Typed:
    if name in typer.variables:
        typer.refuse(
            node, f"a call of {name!r}, which is {typer.variables[name]}", "call a function"
        )
    value = typer.source.names.get(name)
    if value is not None:
        return _called_value(typer, node, name, value)
    if name in BUILT_IN:
        return built_in(typer, node, name)
    if name in NAMES:
        typer.refuse(node, f"{name}() in the rule {typer.source.name!r}", NAMES[name])
    advice = hints.for_function(typer, name, BUILT_IN)
    return typer.refuse(node, f"the unknown function {name!r}", advice)


def _called_in_module(
    typer: Typer, node: ast.Call, module: python_types.ModuleType, name: str
) -> Typed:
    full = f"{module.__name__}.{name}"
    root = module.__name__.split(".")[0]
    if root in MODULES:
        typer.refuse(node, f"{full}() in a rule", MODULES[root])
    names = typer.program.module_names(module)
    if module.__name__ != "math" and name not in names:
        typer.refuse(node, f"the unknown function {full!r}", nearest(name, dir(module)))
    return _called_value(typer, node, full, names.get(name))


def _called_value(typer: Typer, node: ast.Call, name: str, value: Any) -> Typed:
    if value in MEANS and len(node.args) == 1:
        return reduced(typer, node, "mean")
    if isinstance(value, python_types.FunctionType):
        return helper(typer, node, value)
    module = _module_of(value)
    if isinstance(value, python_types.BuiltinFunctionType) and module == "math":
        return math_function(typer, node, value.__name__)
    if value is None and name.startswith("math."):
        return math_function(typer, node, name.removeprefix("math."))
    if module in MODULES:
        typer.refuse(node, f"{name}() in a rule", MODULES[module])
    if isinstance(value, type):
        typer.refuse(
            node,
            f"{name}(), which makes an object",
            "agents are born by `model.humans.create()` or `agent.hatch()`; a rule holds numbers",
        )
    return typer.refuse(
        node, f"a call of {name!r}", "call a plain function of the file or of `math`"
    )


def _module_of(value: Any) -> str:
    """Return the module that a function, a method or a class comes from, up to its first dot."""
    owner = getattr(value, "__self__", None)
    if owner is not None and not isinstance(owner, python_types.ModuleType):
        value = type(owner)  # `random.random` is a method of a hidden generator
    return str(getattr(value, "__module__", None) or "").split(".")[0]


def helper(typer: Typer, node: ast.Call, function: Any, first: list[Typed] | None = None) -> Typed:
    """Type the call of a plain function, which becomes part of the program itself."""
    source = typer.program.source(function)
    names = source.parameters
    written = list(first or [])
    written += [typer.several(argument) for argument in node.args]
    if len(written) > len(names):
        typer.refuse(
            node,
            f"{len(written)} arguments for {source.name}()",
            f"it takes {', '.join(names) or 'none'}",
            f"{len(names)}",
        )
    given = dict(zip(names, written, strict=False))
    for keyword in node.keywords:
        if keyword.arg not in names or keyword.arg in given:
            typer.refuse(
                node,
                f"the argument {keyword.arg!r} of {source.name}()",
                nearest(str(keyword.arg), [name for name in names if name not in given]),
            )
        given[str(keyword.arg)] = typer.several(keyword.value)
    for name, default in source.defaults.items():
        if name not in given:
            given[name] = typer.module_value(node, f"{source.name}({name}=…)", default)
    missing = [name for name in names if name not in given]
    if missing:
        typer.refuse(
            node, f"{source.name}() without {', '.join(missing)}", "give each parameter a value"
        )
    arguments: list[ast.expr] = []
    keywords: list[ast.keyword] = []
    kinds: dict[str, types.AnyType] = {}
    # In the order in which they are written, which is the order in which Python finds their values.
    for place, (name, (value, kind)) in enumerate(given.items()):
        if isinstance(kind, types.OptionalType):
            value, kind = typer.present(value, kind)
        if kind in (types.NONE, types.NOBODY) or isinstance(
            kind, types.TupleType | types.FoundType | types.PatchesType
        ):
            typer.refuse(
                node, f"{kind} for {name!r} of {source.name}()", "give each parameter one value"
            )
        kinds[name] = kind
        if isinstance(kind, types.TextType | types.TableType):
            continue  # a constant is part of which function this is, not an argument of it
        if place < len(written):
            arguments.append(value)
        else:
            keywords.append(ast.keyword(name, value))
    symbol, result = typer.program.specialised(
        source, tuple(kinds[name] for name in names), typer, node
    )
    made = call(symbol, arguments, node)
    made.keywords = keywords
    return marked(ast.fix_missing_locations(made), ("helper", symbol)), result


# Methods ------------------------------------------------------------------------------------------


def _method(typer: Typer, node: ast.Call, func: ast.Attribute) -> Typed:
    base, kind = typer.expression(func.value)
    name = func.attr
    if isinstance(kind, types.MaybeRowType):
        base, kind = neighbours.agent_there(base, kind)
    if isinstance(kind, types.FoundType | types.PatchesType):
        if name != "one_of":
            advice = "loop over it, or write len(…) or ….one_of(rng)"
            typer.refuse(node, f"{name}() of {kind}", hints.SETS.get(name, advice))
        if isinstance(kind, types.FoundType) and kind.through is not None:
            return one_linked(typer, node, base, kind)
        return neighbours.one_found(typer, node, base, kind)
    if kind == types.RNG:
        return typed_draw(typer, node, base, name)
    if isinstance(kind, types.MindType):
        return mind_call(typer, node, base, kind, name)
    if isinstance(kind, types.HierarchyType):
        return hierarchy_call(typer, node, base, kind, name)
    if isinstance(kind, types.RowType):
        return _agent(typer, node, base, kind, name)
    if isinstance(kind, types.PopulationType):
        return _population(typer, node, base, kind, name)
    if isinstance(kind, types.WorldType):
        return _world(typer, node, base, kind, name)
    if isinstance(kind, types.InteractionType):
        return interaction_call(typer, node, base, kind, name)
    if name in METHODS:
        typer.refuse(node, f".{name}() in a rule", METHODS[name])
    if kind == types.MODEL:
        advice = f"write it as a function of the file, and call it: {name}(model)"
        if name in hints.MODEL and name not in hints.AGENT:
            advice = hints.for_model(typer, name)
        typer.refuse(node, f"{name}() of the model", advice)
    return typer.refuse(node, f"{name}() of {kind}", "see docs/rules.md for what can be called")


def _agent(typer: Typer, node: ast.Call, base: ast.expr, kind: types.RowType, name: str) -> Typed:
    population = kind.population
    links = typer.shape.populations[population].links
    asked = None if links is None else link_call(typer, node, base, links, population, name)
    if asked is not None:
        return asked
    if name in ("die", "hatch"):
        typer.program.effects.changes(population)
    if name == "die":
        fitted(typer, node, "die", Signature((), types.NONE))
        without_keywords(typer, node, "die")
        typer.program.effects.kills(population)
        return method_call(node, base, name, [], ("die", population)), types.NONE
    if name == "hatch":
        keep = False
        for keyword in node.keywords:
            if keyword.arg != "keep_groups" or not isinstance(keyword.value, ast.Constant):
                typer.refuse(
                    node, f"hatch({keyword.arg}=…)", "write hatch() or hatch(keep_groups=True)"
                )
            else:
                keep = bool(keyword.value.value)
        _alone(typer, node, "hatch", f"{ast.unparse(base)}.hatch()")
        typer.program.bears(population)
        made = method_call(node, base, name, [constant(keep, node)], ("hatch", population, keep))
        return made, kind
    if name == "run_plan":
        if not typer.shape.populations[population].minded:
            typer.refuse(node, f"run_plan() of {kind}", "give the population a mind and plans")
        kinds = [typer.expression(argument) for argument in node.args]
        if [found for _, found in kinds] != [types.MODEL, types.RNG] or node.keywords:
            typer.refuse(
                node, "run_plan() with other arguments", "write agent.run_plan(model, rng)"
            )
        typer.program.runs_plans(population, typer, node)
        return method_call(
            node, base, name, [value for value, _ in kinds], ("run_plan", population)
        ), types.NONE
    if name == "reconsider_plan":
        if not typer.shape.populations[population].minded:
            typer.refuse(node, f"reconsider_plan() of {kind}", "give the population a mind")
        without_keywords(typer, node, "agent.reconsider_plan")
        factor = fitted(typer, node, "agent.reconsider_plan", Signature((types.FLOAT,), types.BOOL))
        typer.program.reconsidered.add(population)
        return method_call(node, base, name, factor, (name, population)), types.BOOL
    if name in typer.shape.populations[population].fields:
        typer.refuse(node, f"a call of the field {name!r}", "read it without ()")
    return typer.refuse(
        node,
        f"{name}() of {kind}",
        hints.for_agents_method(typer, ast.unparse(base), name),
    )


def _alone(typer: Typer, node: ast.Call, name: str, written: str) -> None:
    """Refuse what is given to a birth: how many are born, or with what fields."""
    fields = [one.arg for one in node.keywords if one.arg != "keep_groups"]
    if node.args:
        typer.refuse(
            node,
            f"{name}() of several",
            f"each call is one birth: `for k in range({ast.unparse(node.args[0])}): {written}`",
        )
    if fields:
        advice = f"write `{written}`, then `new.{fields[0]} = …`"
        typer.refuse(node, f"{name}() with {fields[0]}=", advice)


def _population(
    typer: Typer, node: ast.Call, base: ast.expr, kind: types.PopulationType, name: str
) -> Typed:
    row = types.RowType(kind.population)
    links = typer.shape.populations[kind.population].links
    asked = None if links is None else network_call(typer, node, base, links, kind.population)
    if asked is not None:
        return asked
    to = typer.shape.populations[kind.population].messages_to
    if to is not None and name in ("send", "to", "create"):
        return _message(typer, node, base, kind.population, name, to)
    if name == "create":
        _alone(typer, node, "create", f"new = model.{kind.population}.create()")
        typer.program.bears(kind.population)
        typer.program.effects.changes(kind.population)
        return method_call(node, base, name, [], ("create", kind.population)), row
    if name == "one_of":
        kinds = [typer.expression(argument) for argument in node.args]
        if [found for _, found in kinds] != [types.RNG]:
            typer.refuse(node, "one_of() without the random stream", "write model.cows.one_of(rng)")
        return method_call(node, base, name, [kinds[0][0]], ("one_of", kind.population)), row
    if name == "contains":
        index = [typer.fitted(argument, types.INT, "contains()") for argument in node.args]
        if len(index) != 1:
            typer.refuse(node, "contains() of other than one identity", "write contains(id)")
        return method_call(node, base, name, index, ("contains", kind.population)), types.BOOL
    if name in neighbours.AGENTS:
        return neighbours.agents_found(typer, node, base, kind, name)
    if name in groups.SETS:
        return groups.agents_in(typer, node, base, kind, name)
    if name in AGGREGATES:
        return population_aggregate(typer, node, base, kind, name)
    advice = (
        close(name, ("create", "one_of", "contains", *neighbours.AGENTS, *groups.SETS, *AGGREGATES))
        if name not in hints.POPULATION
        else None
    )
    return typer.refuse(
        node,
        f"{name}() of {kind}",
        advice or hints.for_population(typer, kind.population, name),
    )


def _message(
    typer: Typer, node: ast.Call, base: ast.expr, messages: str, name: str, to: str
) -> Typed:
    """Return the sending of a message; reading is a loop."""
    written = [typer.expression(argument) for argument in node.args]
    kinds = [kind for _, kind in written]
    if name == "to":
        typer.refuse(node, "to() as a value", f"write `for message in model.{messages}.to(agent):`")
    wrong = len(kinds) != 2 or node.keywords or not isinstance(kinds[0], types.RowType)
    if name == "create" or wrong or kinds[1] != types.RowType(to):
        typer.refuse(
            node,
            f"{name}() of the messages {messages!r} like this",
            f"write message = model.{messages}.send(sender, recipient)",
            f"an agent that sends, and an agent of {to!r}",
        )
    typer.program.bears(messages)
    typer.program.effects.changes(messages)
    values = [value for value, _ in written]
    return method_call(node, base, name, values, ("send", messages)), types.RowType(messages)


def _world(typer: Typer, node: ast.Call, base: ast.expr, kind: types.WorldType, name: str) -> Typed:
    world = typer.shape.world
    if name == "patch" and world.patch is not None:
        arguments = fitted(typer, node, "patch", Signature((types.FLOAT, types.FLOAT), types.NONE))
        return method_call(node, base, name, arguments, ("patch_at",)), types.PatchType()
    if name in neighbours.PATCHES and world.patch is not None:
        return neighbours.patches_found(typer, node, base, name)
    if name in world.calls:
        return world_call(typer, node, base, name)
    if name in world.commands:
        return helper(typer, node, world.commands[name], first=[(base, kind)])
    if name == "patches":
        typer.refuse(node, "patches as a value", "write `for patch in model.world.patches:`")
    advice = hints.for_world(
        typer,
        name,
        [
            *world.commands,
            *world.calls,
            *(("patch", *neighbours.PATCHES) if world.patch is not None else ()),
        ],
    )
    return typer.refuse(node, f"the world's {name}()", advice)
