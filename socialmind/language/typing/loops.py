"""Typing of loops: what a for loop may run over, and which variables have a value behind a loop."""

from __future__ import annotations

import ast
import copy
from typing import TYPE_CHECKING, Any

from socialmind.language import types
from socialmind.language.nodes import call, constant, marked
from socialmind.language.refusals import NAMES
from socialmind.language.typing.calls.draws import permutation

if TYPE_CHECKING:
    from socialmind.language.typing.statements import FunctionTyper

NOWHERE: Any = frozenset({"(every name)"})
"""What is assigned after a return, break or continue: nothing can be read there any more."""
Iterated = tuple[list[ast.stmt], ast.expr, types.AnyType, tuple[Any, ...]]
"""What goes before a for loop, what it runs over, the type of its variable, and a mark."""


def both(one: Any, other: Any) -> Any:
    """Return the variables that have a value on two ways that meet."""
    if one is NOWHERE:
        return other
    return one if other is NOWHERE else one & other


def while_loop(function: FunctionTyper, node: ast.While) -> ast.stmt:
    """Return a while loop as both speeds run it."""
    typer = function.typer
    test = typer.truth(node.test)
    endless = isinstance(node.test, ast.Constant) and bool(node.test.value)
    body, at_breaks = _body(function, node.body)
    if endless:
        typer.assigned = at_breaks
        return ast.copy_location(ast.While(test, body, []), node)
    orelse = function.block(node.orelse) if node.orelse else []
    typer.assigned = both(typer.assigned, at_breaks)
    return ast.copy_location(ast.While(test, body, orelse), node)


def for_loop(function: FunctionTyper, node: ast.For) -> list[ast.stmt]:
    """Return a for loop as both speeds run it."""
    typer = function.typer
    called = node.iter.func if isinstance(node.iter, ast.Call) else None
    if not isinstance(node.target, ast.Name):
        advice = NAMES.get(called.id) if isinstance(called, ast.Name) else None
        if advice is not None:
            typer.refuse(node, "several variables in a for loop", advice)
    names = _names(node.target)
    for name in names:
        if name != "_" and (name in function.counters or name in function.parameters):
            typer.refuse(
                node, f"{name!r} as the variable of a loop inside its own", "use another name"
            )
    before, iterated, kind, mark = _iterated(function, node.iter)
    kinds = [kind] if isinstance(node.target, ast.Name) else list(getattr(kind, "items", ()))
    if not names:
        typer.refuse(node, "a field in the place of a loop's variable", "write `for name in …:`")
    if isinstance(node.target, ast.Name) and isinstance(kind, types.TupleType):
        advice = f"write `for {', '.join('xyzuvw'[: len(kind.items)])} in …:`"
        typer.refuse(node, f"{kind} for one variable in a for loop", advice)
    if len(kinds) != len(names):
        advice = f"write {len(kinds)} variables" if len(kinds) > 1 else "loop over one"
        typer.refuse(node, f"{kind} for {len(names)} variables in a for loop", advice)
    assigned = typer.assigned
    outer = function.counters
    function.counters = outer - set(names)
    for name, one in zip(names, kinds, strict=True):
        function.bound(name, constant(0, node), one, node)
        if function.kinds[name] != one:
            typer.refuse(
                node,
                f"{name!r}, which is {function.kinds[name]} elsewhere, as {one}",
                "use another name",
            )
    function.counters = outer | set(names)
    body, at_breaks = _body(function, node.body)
    function.counters = outer
    # Not one round may have run.
    typer.assigned = assigned
    orelse = function.block(node.orelse) if node.orelse else []
    typer.assigned = both(typer.assigned, at_breaks)
    target = copy.deepcopy(node.target)
    return [
        *before,
        marked(ast.copy_location(ast.For(target, iterated, body, orelse), node), mark),
    ]


def _names(target: ast.expr) -> list[str]:
    """Return the variables of a for loop; none where something else is written there."""
    parts = target.elts if isinstance(target, ast.Tuple | ast.List) else [target]
    names = [part.id for part in parts if isinstance(part, ast.Name)]
    return names if len(names) == len(parts) else []


def _body(function: FunctionTyper, body: list[ast.stmt]) -> tuple[list[ast.stmt], Any]:
    """Return the body of a loop, which may run not once, and what is assigned at its breaks."""
    before = function.typer.assigned
    function.breaks.append(NOWHERE)
    made = function.block(body)
    function.typer.assigned = before
    return made, function.breaks.pop()


def _iterated(function: FunctionTyper, node: ast.expr) -> Iterated:
    typer = function.typer
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "range":
        if "range" not in typer.variables and "range" not in typer.source.names:
            return _range(function, node)
    elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
        if node.func.attr == "to":
            mailbox = _mailbox(function, node, node.func)
            if mailbox is not None:
                return mailbox
        if node.func.attr == "in_radius" and _is(function, node.func.value, types.WorldType()):
            return _in_radius(function, node, node.func.value)
        if node.func.attr == "permutation" and _is(function, node.func.value, types.RNG):
            stream, _ = typer.expression(node.func.value)
            return [], permutation(typer, node, stream), types.INT, ("permutation",)
    elif (
        isinstance(node, ast.Attribute)
        and node.attr == "patches"
        and _is(function, node.value, types.WorldType())
    ):
        base, _ = typer.expression(node.value)
        return [], call("_all_patches", [base], node), types.PatchType(), ("patches",)
    value, kind = typer.several(node)
    if isinstance(kind, types.TableType):
        if kind.item is None:
            advice = "write a line for each text: rules hold no texts"
            typer.refuse(node, "a for loop over texts", advice)
        return [], value, kind.item, ("table",)
    if isinstance(kind, types.PopulationType):
        return [], value, types.RowType(kind.population), ("agents", kind.population)
    if isinstance(kind, types.FoundType) and kind.through is not None:
        return [], value, types.RowType(kind.population), ("linked_loop", kind.population)
    if isinstance(kind, types.FoundType):
        found = call("_still_living", [value], node)
        mark = ("found_loop", kind.population, node not in function.in_any_order, kind.by)
        return [], found, types.RowType(kind.population), mark
    if isinstance(kind, types.PatchesType):
        return [], value, types.PatchType(), ("patches_loop",)
    if isinstance(kind, types.ArrayType):
        return [], value, kind.of, ("elements", kind.of == types.BOOL)
    return typer.refuse(
        node,
        f"a for loop over {kind}",
        "loop over range(…), a population, who is near, an array field or patches",
    )


def _range(function: FunctionTyper, node: ast.Call) -> Iterated:
    typer = function.typer
    if node.keywords or not 1 <= len(node.args) <= 3:
        typer.refuse(node, "range() like this", "write range(stop) or range(start, stop, step)")
    bounds = [typer.fitted(argument, types.INT, "range()") for argument in node.args]
    return [], call("_range", bounds, node), types.INT, ("range",)


def _is(function: FunctionTyper, node: ast.expr, kind: types.AnyType) -> bool:
    if isinstance(node, ast.Name) and node.id not in function.kinds:
        return False
    return function.typer.expression(node)[1] == kind


def _mailbox(function: FunctionTyper, node: ast.Call, func: ast.Attribute) -> Iterated | None:
    """Return the messages that have arrived for an agent; None of what has no messages."""
    typer = function.typer
    base, kind = typer.expression(func.value)
    if not isinstance(kind, types.PopulationType):
        return None
    to = typer.shape.populations[kind.population].messages_to
    if to is None:
        return None
    kinds = [typer.expression(argument) for argument in node.args]
    if [one for _, one in kinds] != [types.RowType(to)] or node.keywords:
        advice = f"write `for message in model.{kind.population}.to({to.rstrip('s')}):`"
        typer.refuse(node, "to() like this", advice, f"an agent of {to!r}")
    made = ast.Call(ast.Attribute(base, "to", ast.Load()), [kinds[0][0]], [])
    made = ast.fix_missing_locations(ast.copy_location(made, node))
    return [], made, types.RowType(kind.population), ("mailbox", kind.population)


def _in_radius(function: FunctionTyper, node: ast.Call, world: ast.expr) -> Iterated:
    typer = function.typer
    if len(node.args) != 2 or node.keywords:
        typer.refuse(node, "in_radius() like this", "write in_radius(agent, radius)")
    base, _ = typer.expression(world)
    before, agent = function.steadied(node.args[0])
    kind = typer.expression(agent)[1]
    if not isinstance(kind, types.RowType | types.PatchType):
        typer.refuse(node, f"in_radius() of {kind}", "give it an agent or a patch")
    radius = typer.fitted(node.args[1], types.FLOAT, "the radius")
    x, y = (
        typer.fitted(
            ast.copy_location(ast.Attribute(agent, axis, ast.Load()), node),
            types.FLOAT,
            f"the coordinate {axis}",
        )
        for axis in "xy"
    )
    return before, call("_in_radius", [base, x, y, radius], node), types.PatchType(), ("patches",)
