"""Typing of calls: helpers, `math`, built-ins, and what agents, minds and the world can do."""

from __future__ import annotations

import ast
import types as python_types
from typing import TYPE_CHECKING, Any

from socialmind.language.nodes import Typed, call, constant, marked, nearest
from socialmind.language.refusals import METHODS, MODULES, NAMES
from socialmind.language.signatures import CHOSEN, MATH, MIND, RNG, Signature
from socialmind.language.types import (
    BOOL,
    FLOAT,
    INT,
    MODEL,
    NONE,
    RNG as RNG_TYPE,
    AnyType,
    ArrayType,
    MindType,
    OptionalType,
    PatchType,
    PlanType,
    PopulationType,
    RowType,
    TextType,
    Type,
    WorldType,
)
from socialmind.worlds import torus

if TYPE_CHECKING:
    from socialmind.language.expressions import ExpressionTyper


def typed_call(typer: ExpressionTyper, node: ast.Call) -> Typed:
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


def _called_by_name(typer: ExpressionTyper, node: ast.Call, name: str) -> Typed:
    if name in typer.variables:
        typer.refuse(
            node, f"a call of {name!r}, which is {typer.variables[name]}", "call a function"
        )
    value = typer.source.names.get(name)
    if value is not None:
        return _called_value(typer, node, name, value)
    if name in BUILTINS:
        _without_keywords(typer, node, name)
        return BUILTINS[name](typer, node)
    if name in NAMES:
        typer.refuse(node, f"{name}() in the rule {typer.source.name!r}", NAMES[name])
    return typer.refuse(
        node, f"the unknown function {name!r}", nearest(name, [*BUILTINS, *typer.source.names])
    )


def _called_in_module(
    typer: ExpressionTyper, node: ast.Call, module: python_types.ModuleType, name: str
) -> Typed:
    full = f"{module.__name__}.{name}"
    if module.__name__ in MODULES:
        typer.refuse(node, f"{full}() in a rule", MODULES[module.__name__])
    if module.__name__ != "math" and not hasattr(module, name):
        typer.refuse(node, f"the unknown function {full!r}", nearest(name, dir(module)))
    return _called_value(typer, node, full, getattr(module, name, None))


def _called_value(typer: ExpressionTyper, node: ast.Call, name: str, value: Any) -> Typed:
    if isinstance(value, python_types.FunctionType):
        return helper(typer, node, value)
    module = getattr(value, "__module__", None)
    if isinstance(value, python_types.BuiltinFunctionType) and module == "math":
        return _math(typer, node, value.__name__)
    if value is None and name.startswith("math."):
        return _math(typer, node, name.removeprefix("math."))
    root = (module or "").split(".")[0]
    if root in MODULES:
        typer.refuse(node, f"{name}() in a rule", MODULES[root])
    return typer.refuse(
        node, f"a call of {name!r}", "call a plain function of the file or of `math`"
    )


def helper(
    typer: ExpressionTyper, node: ast.Call, function: Any, first: list[Typed] | None = None
) -> Typed:
    """Type the call of a plain function of the author's (or of ours), itself part of the program."""
    source = typer.program.source(function)
    typed = list(first or [])
    typed += [typer.expression(argument) for argument in node.args]
    names = source.parameters
    if len(typed) > len(names):
        typer.refuse(
            node,
            f"{len(typed)} arguments for {source.name}()",
            "see its parameters",
            f"{len(names)}",
        )
    given = dict(zip(names, typed, strict=False))
    for keyword in node.keywords:
        if keyword.arg not in names or keyword.arg in given:
            typer.refuse(
                node,
                f"the argument {keyword.arg!r} of {source.name}()",
                nearest(str(keyword.arg), [name for name in names if name not in given]),
            )
        given[str(keyword.arg)] = typer.expression(keyword.value)
    defaults = source.tree.args.defaults
    for name, default in zip(names[len(names) - len(defaults) :], defaults, strict=True):
        if name not in given:
            given[name] = typer.expression(default)
    missing = [name for name in names if name not in given]
    if missing:
        typer.refuse(
            node, f"{source.name}() without {', '.join(missing)}", "give each parameter a value"
        )
    arguments: list[ast.expr] = []
    kinds: list[AnyType] = []
    for name in names:
        value, kind = given[name]
        if isinstance(kind, OptionalType):
            value, kind = typer.present(value, kind)
        kinds.append(kind)
        # A text is part of which function this is, not an argument of it.
        if not isinstance(kind, TextType):
            arguments.append(value)
    symbol, result = typer.program.specialised(source, tuple(kinds), typer, node)
    return marked(call(symbol, arguments, node), ("helper", symbol)), result


# Built-in functions -------------------------------------------------------------------------------


def _without_keywords(typer: ExpressionTyper, node: ast.Call, name: str) -> None:
    if node.keywords:
        typer.refuse(node, f"{name}() with {node.keywords[0].arg}=", f"write {name}() without it")


def _only(typer: ExpressionTyper, node: ast.Call, name: str) -> ast.expr:
    if len(node.args) != 1:
        typer.refuse(node, f"{name}() of {len(node.args)} values", f"write {name}(x)", "one value")
    return node.args[0]


def _abs(typer: ExpressionTyper, node: ast.Call) -> Typed:
    value, kind = typer.number(_only(typer, node, "abs"))
    return (call("_absolute_int" if kind == INT else "_abs", [value], node)), kind


def _int(typer: ExpressionTyper, node: ast.Call) -> Typed:
    value, kind = typer.number(_only(typer, node, "int"))
    return (value if kind == INT else call("_to_int", [value], node)), INT


def _float(typer: ExpressionTyper, node: ast.Call) -> Typed:
    return typer.to_float(*typer.number(_only(typer, node, "float"))), FLOAT


def _bool(typer: ExpressionTyper, node: ast.Call) -> Typed:
    return typer.truth(_only(typer, node, "bool")), BOOL


def _round(typer: ExpressionTyper, node: ast.Call) -> Typed:
    if len(node.args) == 2:
        typer.refuse(
            node,
            "round() to decimals",
            "round when you print or plot; rules keep full precision",
        )
    value, kind = typer.number(_only(typer, node, "round"))
    return (value if kind == INT else call("_round_half_even", [value], node)), INT


def _extreme(name: str) -> Any:
    def typed(typer: ExpressionTyper, node: ast.Call) -> Typed:
        if len(node.args) == 1:
            value, kind = typer.expression(node.args[0])
            if not isinstance(kind, ArrayType):
                typer.refuse(
                    node, f"the extreme of {kind}", "give two or more values, or an array field"
                )
            assert isinstance(kind, ArrayType)  # refused above
            return call(f"_{name}_of", [value], node), kind.of
        if not node.args:
            typer.refuse(node, "no values", "give two or more values, or an array field")
        numbers = [typer.number(argument) for argument in node.args]
        if any(kind == FLOAT for _, kind in numbers):
            numbers = [(typer.to_float(value, kind), FLOAT) for value, kind in numbers]
        result = numbers[0][0]
        for value, _ in numbers[1:]:
            result = call(f"_{name}", [result, value], node)
        return result, numbers[0][1]

    return typed


def _sum(typer: ExpressionTyper, node: ast.Call) -> Typed:
    value, kind = typer.expression(_only(typer, node, "sum"))
    if not isinstance(kind, ArrayType):
        return typer.refuse(node, f"the sum of {kind}", "add up in a for loop")
    if kind.of == FLOAT:
        return call("_total", [value, constant(0.0, node)], node), FLOAT
    return call("_total_int", [value], node), INT


def _len(typer: ExpressionTyper, node: ast.Call) -> Typed:
    value, kind = typer.expression(_only(typer, node, "len"))
    if isinstance(kind, ArrayType):
        return constant(kind.size, node), INT
    if isinstance(kind, PopulationType):
        return marked(call("_len", [value], node), ("count", kind.population)), INT
    return typer.refuse(node, f"the length of {kind}", "count populations and array fields")


def _range(typer: ExpressionTyper, node: ast.Call) -> Typed:
    return typer.refuse(node, "range() as a value", "write `for i in range(…):`")


def _print(typer: ExpressionTyper, node: ast.Call) -> Typed:
    if typer.program.compiled:
        return typer.refuse(node, f"print() in the rule {typer.source.name!r}", NAMES["print"])
    values = []
    for argument in node.args:
        value, _ = typer.expression(argument)
        values.append(value)
    return call("_print", values, node), NONE


def _breakpoint(typer: ExpressionTyper, node: ast.Call) -> Typed:
    if typer.program.compiled:
        return typer.refuse(
            node, "breakpoint() in a compiled run", "run with --interpreted to step through"
        )
    return call("_breakpoint", [], node), NONE


BUILTINS: dict[str, Any] = {
    "abs": _abs,
    "int": _int,
    "float": _float,
    "bool": _bool,
    "round": _round,
    "min": _extreme("least"),
    "max": _extreme("greatest"),
    "sum": _sum,
    "len": _len,
    "range": _range,
    "print": _print,
    "breakpoint": _breakpoint,
}


def _math(typer: ExpressionTyper, node: ast.Call, name: str) -> Typed:
    if name == "pow" and len(node.args) == 2:
        return typer.expression(
            ast.copy_location(ast.BinOp(node.args[0], ast.Pow(), node.args[1]), node)
        )
    if name == "log" and len(node.args) == 2:
        typer.refuse(node, "math.log() to a base", "write math.log(x) / math.log(base)")
    if name not in MATH:
        typer.refuse(node, f"math.{name}()", nearest(name, [*MATH, "pow"]))
    _without_keywords(typer, node, f"math.{name}")
    signature = MATH[name]
    arguments = _fitted(typer, node, f"math.{name}", signature)
    return call(f"_{name}", arguments, node), signature.result


def _fitted(
    typer: ExpressionTyper, node: ast.Call, name: str, signature: Signature
) -> list[ast.expr]:
    wanted = signature.arguments
    if len(node.args) != len(wanted):
        typer.refuse(
            node, f"{len(node.args)} arguments for {name}()", "see docs/rules.md", f"{len(wanted)}"
        )
    return [
        typer.fitted(argument, kind, f"{name}()")
        for argument, kind in zip(node.args, wanted, strict=True)
        if isinstance(kind, Type)
    ]


# Methods ------------------------------------------------------------------------------------------


def _method(typer: ExpressionTyper, node: ast.Call, func: ast.Attribute) -> Typed:
    base, kind = typer.expression(func.value)
    name = func.attr
    if kind == RNG_TYPE:
        return _draw(typer, node, base, name)
    if isinstance(kind, MindType):
        return _mind(typer, node, base, kind, name)
    if isinstance(kind, RowType):
        return _agent(typer, node, base, kind, name)
    if isinstance(kind, PopulationType):
        return _population(typer, node, base, kind, name)
    if isinstance(kind, WorldType):
        return _world(typer, node, base, kind, name)
    if name in METHODS:
        typer.refuse(node, f".{name}() in a rule", METHODS[name])
    return typer.refuse(node, f"{name}() of {kind}", "see docs/rules.md for what can be called")


def _made(node: ast.Call, base: ast.expr, name: str, arguments: list[ast.expr], mark: Any) -> Any:
    func = ast.copy_location(ast.Attribute(base, name, ast.Load()), node)
    return marked(ast.copy_location(ast.Call(func, arguments, []), node), mark)


def _draw(typer: ExpressionTyper, node: ast.Call, base: ast.expr, name: str) -> Typed:
    if name not in RNG:
        typer.refuse(node, f"rng.{name}()", METHODS.get(name) or nearest(name, RNG))
    _without_keywords(typer, node, f"rng.{name}")
    fitting = [one for one in RNG[name] if len(one.arguments) == len(node.args)]
    signature = fitting[0] if fitting else RNG[name][-1]
    arguments = _fitted(typer, node, f"rng.{name}", signature)
    return _made(node, base, name, arguments, ("draw", name, len(arguments))), signature.result


def _mind(
    typer: ExpressionTyper, node: ast.Call, base: ast.expr, kind: MindType, name: str
) -> Typed:
    if name not in MIND:
        typer.refuse(node, f"the mind's {name}()", nearest(name, MIND))
    _without_keywords(typer, node, f"mind.{name}")
    signature = MIND[name]
    if len(node.args) != len(signature.arguments):
        typer.refuse(
            node,
            f"{len(node.args)} arguments for mind.{name}()",
            "see docs/coglogo_py.md",
            f"{len(signature.arguments)}",
        )
    arguments: list[ast.expr] = []
    places: list[int | None] = []
    group = ""
    for argument, wanted in zip(node.args, signature.arguments, strict=True):
        if isinstance(wanted, Type):
            arguments.append(typer.fitted(argument, wanted, f"mind.{name}()"))
            places.append(None)
            continue
        value, found = typer.expression(argument)
        if wanted.part == "plan" and isinstance(found, PlanType):
            arguments.append(value)
            places.append(None)
            continue
        if not isinstance(found, TextType):
            typer.refuse(
                argument,
                f"{found} as the name of a {wanted.part}",
                f"write the {wanted.part}'s name as a text",
            )
        assert isinstance(found, TextType)  # refused above
        group = found.value if wanted.part == "group" else group
        keys = (group, found.value) if wanted.part in ("role", "culturon") else (found.value,)
        arguments.append(constant(found.value, argument))
        places.append(typer.name(argument, kind.population, wanted.part, keys))
    result: AnyType = signature.result
    if result == CHOSEN:
        result = PlanType(kind.population)
    return _made(
        node, base, name, arguments, ("mind", kind.population, name, tuple(places))
    ), result


def _agent(
    typer: ExpressionTyper, node: ast.Call, base: ast.expr, kind: RowType, name: str
) -> Typed:
    population = kind.population
    if name == "die":
        _fitted(typer, node, "die", Signature((), NONE))
        _without_keywords(typer, node, "die")
        return _made(node, base, name, [], ("die", population)), NONE
    if name == "hatch":
        keep = False
        for keyword in node.keywords:
            if keyword.arg != "keep_groups" or not isinstance(keyword.value, ast.Constant):
                typer.refuse(
                    node, f"hatch({keyword.arg}=…)", "write hatch() or hatch(keep_groups=True)"
                )
            else:
                keep = bool(keyword.value.value)
        _fitted(typer, node, "hatch", Signature((), NONE))
        made = _made(node, base, name, [constant(keep, node)], ("hatch", population, keep))
        return made, kind
    if name == "run_plan":
        if not typer.shape.populations[population].minded:
            typer.refuse(node, f"run_plan() of {kind}", "give the population a mind and plans")
        kinds = [typer.expression(argument) for argument in node.args]
        if [found for _, found in kinds] != [MODEL, RNG_TYPE] or node.keywords:
            typer.refuse(
                node, "run_plan() with other arguments", "write agent.run_plan(model, rng)"
            )
        typer.program.runs_plans(population, typer, node)
        return _made(
            node, base, name, [value for value, _ in kinds], ("run_plan", population)
        ), NONE
    if name in typer.shape.populations[population].fields:
        typer.refuse(node, f"a call of the field {name!r}", "read it without ()")
    return typer.refuse(
        node,
        f"{name}() of {kind}",
        nearest(name, ("die", "hatch", "run_plan")) + "; or call a function",
    )


def _population(
    typer: ExpressionTyper, node: ast.Call, base: ast.expr, kind: PopulationType, name: str
) -> Typed:
    row = RowType(kind.population)
    if name == "create":
        _fitted(typer, node, "create", Signature((), NONE))
        return _made(node, base, name, [], ("create", kind.population)), row
    if name == "one_of":
        kinds = [typer.expression(argument) for argument in node.args]
        if [found for _, found in kinds] != [RNG_TYPE]:
            typer.refuse(node, "one_of() without the random stream", "write model.cows.one_of(rng)")
        return _made(node, base, name, [kinds[0][0]], ("one_of", kind.population)), row
    if name == "contains":
        index = [typer.fitted(argument, INT, "contains()") for argument in node.args]
        if len(index) != 1:
            typer.refuse(node, "contains() of other than one identity", "write contains(id)")
        return _made(node, base, name, index, ("contains", kind.population)), BOOL
    return typer.refuse(
        node,
        f"{name}() of {kind}",
        nearest(name, ("create", "one_of", "contains")) + "; or write a for loop over it",
    )


def _world(
    typer: ExpressionTyper, node: ast.Call, base: ast.expr, kind: WorldType, name: str
) -> Typed:
    if name == "patch":
        arguments = _fitted(typer, node, "patch", Signature((FLOAT, FLOAT), NONE))
        return _made(node, base, name, arguments, ("patch_at",)), PatchType()
    if name in torus.COMMANDS:
        return helper(typer, node, torus.COMMANDS[name], first=[(base, kind)])
    if name in ("in_radius", "patches"):
        typer.refuse(node, f"{name} as a value", f"write `for patch in model.world.{name}…:`")
    return typer.refuse(
        node, f"the world's {name}()", nearest(name, [*torus.COMMANDS, "patch", "in_radius"])
    )
