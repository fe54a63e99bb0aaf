"""Typing of Python's built-in functions and of `math`."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import TYPE_CHECKING

from socialmind.errors import nearest
from socialmind.language import types
from socialmind.language.nodes import Typed, call, constant, marked
from socialmind.language.refusals import MATH_REMEDIES, NAMES
from socialmind.language.typing import tables
from socialmind.language.typing.comprehensions import REDUCTIONS, reduced
from socialmind.language.typing.neighbours import how_many
from socialmind.language.typing.operators import typed_power
from socialmind.language.typing.signatures import MATH, WRITTEN, Signature

if TYPE_CHECKING:
    from socialmind.language.typer import Typer


def built_in(typer: Typer, node: ast.Call, name: str) -> Typed:
    """Return the call of a built-in function as both speeds run it."""
    keyed = name in ("min", "max") and any(one.arg == "key" for one in node.keywords)
    several = node.args and isinstance(node.args[0], ast.GeneratorExp)
    if (name in REDUCTIONS and several) or (keyed and len(node.args) == 1):
        return reduced(typer, node, name)
    without_keywords(typer, node, name)
    return BUILT_IN[name](typer, node)


def without_keywords(typer: Typer, node: ast.Call, name: str) -> None:
    """Refuse a call with keywords."""
    if node.keywords:
        advice = f"write the values in their order, without names: {name}({WRITTEN.get(name, '…')})"
        if node.keywords[0].arg == "key":
            advice = f"write {name}(model.flock, key=lambda one: one.energy)"
        typer.refuse(node, f"{name}() with {node.keywords[0].arg}=", advice)


def fitted(typer: Typer, node: ast.Call, name: str, signature: Signature) -> list[ast.expr]:
    """Return the arguments of a call as the types that its signature wants."""
    wanted = signature.arguments
    if len(node.args) != len(wanted):
        advice = "see the table of calls in docs/rules.md"
        if name in WRITTEN:
            advice = f"write {name}({WRITTEN[name]})"
        typer.refuse(node, f"{len(node.args)} arguments for {name}()", advice, f"{len(wanted)}")
    return [
        typer.fitted(argument, kind, f"{name}()")
        for argument, kind in zip(node.args, wanted, strict=True)
        if isinstance(kind, types.Type)
    ]


def math_function(typer: Typer, node: ast.Call, name: str) -> Typed:
    """Return the call of a function of `math` as both speeds run it."""
    if name == "pow" and len(node.args) == 2:
        base, exponent = (
            (typer.to_float(*typer.number(argument)), types.FLOAT) for argument in node.args
        )
        return typed_power(typer, node, base, exponent)
    if name == "log" and len(node.args) == 2:
        typer.refuse(node, "math.log() to a base", "write math.log(x) / math.log(base)")
    if name not in MATH:
        remedy = MATH_REMEDIES.get(name) or nearest(name, [*MATH, "pow"])
        typer.refuse(node, f"math.{name}()", remedy)
    without_keywords(typer, node, f"math.{name}")
    signature = MATH[name]
    return call(f"_{name}", fitted(typer, node, f"math.{name}", signature), node), signature.result


def _only(typer: Typer, node: ast.Call, name: str) -> ast.expr:
    if len(node.args) != 1:
        typer.refuse(node, f"{name}() of {len(node.args)} values", f"write {name}(x)", "one value")
    return node.args[0]


def _abs(typer: Typer, node: ast.Call) -> Typed:
    value, kind = typer.number(_only(typer, node, "abs"))
    return call("_absolute_int" if kind == types.INT else "_abs", [value], node), kind


def _int(typer: Typer, node: ast.Call) -> Typed:
    value, kind = typer.number(_only(typer, node, "int"))
    return (value if kind == types.INT else call("_to_int", [value], node)), types.INT


def _float(typer: Typer, node: ast.Call) -> Typed:
    return typer.to_float(*typer.number(_only(typer, node, "float"))), types.FLOAT


def _bool(typer: Typer, node: ast.Call) -> Typed:
    return typer.truth_value(_only(typer, node, "bool"))


def _round(typer: Typer, node: ast.Call) -> Typed:
    if len(node.args) == 2:
        typer.refuse(
            node,
            "round() to decimals",
            "round when you print or plot; rules keep full precision",
        )
    value, kind = typer.number(_only(typer, node, "round"))
    return (value if kind == types.INT else call("_round_half_even", [value], node)), types.INT


def _extreme(name: str) -> Callable[[Typer, ast.Call], Typed]:
    def typed(typer: Typer, node: ast.Call) -> Typed:
        if len(node.args) == 1:
            value, kind = typer.several(node.args[0])
            if isinstance(kind, types.TableType) and isinstance(kind.item, types.Type):
                return call(f"_{name}_of", [value], node), kind.item
            if not isinstance(kind, types.ArrayType):
                typer.refuse(
                    node,
                    f"the smallest or largest of {kind}",
                    "give two or more values, or an array field",
                )
            made = call(f"_{name}_of", [value], node)
            return marked(made, ("element", kind.of == types.BOOL)), kind.of
        if not node.args:
            typer.refuse(node, "no values", "give two or more values, or an array field")
        numbers = [typer.number(argument) for argument in node.args]
        if any(kind == types.FLOAT for _, kind in numbers):
            numbers = [(typer.to_float(value, kind), types.FLOAT) for value, kind in numbers]
        result = numbers[0][0]
        for value, _ in numbers[1:]:
            result = call(f"_{name}", [result, value], node)
        return result, numbers[0][1]

    return typed


def _sum(typer: Typer, node: ast.Call) -> Typed:
    value, kind = typer.several(_only(typer, node, "sum"))
    if not isinstance(kind, types.TableType | types.ArrayType):
        typer.refuse(node, f"the sum of {kind}", "add up in a for loop")
    of = kind.item if isinstance(kind, types.TableType) else kind.of
    if of not in types.NUMBERS:
        typer.refuse(node, f"the sum of {kind}", "add up in a for loop")
    if of == types.FLOAT:
        return call("_total", [value, constant(0.0, node)], node), types.FLOAT
    if isinstance(kind, types.TableType):
        value = tables.written(tuple(map(int, kind.values)), node)
    return call("_total_int", [value], node), types.INT


def _len(typer: Typer, node: ast.Call) -> Typed:
    value, kind = typer.several(_only(typer, node, "len"))
    if isinstance(kind, types.TableType):
        return constant(len(kind.values), node), types.INT
    if isinstance(kind, types.ArrayType):
        return constant(kind.size, node), types.INT
    if isinstance(kind, types.PopulationType):
        return marked(call("_len", [value], node), ("count", kind.population)), types.INT
    if isinstance(kind, types.FoundType | types.PatchesType):
        return how_many(value, kind, node)
    return typer.refuse(node, f"the length of {kind}", "count populations and array fields")


def _range(typer: Typer, node: ast.Call) -> Typed:
    return typer.refuse(node, "range() as a value", "write `for i in range(…):`")


def _of_truths(name: str) -> Callable[[Typer, ast.Call], Typed]:
    def typed(typer: Typer, node: ast.Call) -> Typed:
        _only(typer, node, name)
        return reduced(typer, node, name)

    return typed


def _print(typer: Typer, node: ast.Call) -> Typed:
    if typer.program.compiled:
        typer.refuse(node, f"print() in the rule {typer.source.name!r}", NAMES["print"])
    values = [typer.expression(argument)[0] for argument in node.args]
    return call("_print", values, node), types.NONE


def _breakpoint(typer: Typer, node: ast.Call) -> Typed:
    if typer.program.compiled:
        typer.refuse(
            node, "breakpoint() in a compiled run", "run with --interpreted to step through"
        )
    return call("_breakpoint", [], node), types.NONE


BUILT_IN: dict[str, Callable[[Typer, ast.Call], Typed]] = {
    "abs": _abs,
    "int": _int,
    "float": _float,
    "bool": _bool,
    "round": _round,
    "min": _extreme("least"),
    "max": _extreme("greatest"),
    "sum": _sum,
    "any": _of_truths("any"),
    "all": _of_truths("all"),
    "len": _len,
    "range": _range,
    "print": _print,
    "breakpoint": _breakpoint,
}
"""The built-in functions that rules may call."""
