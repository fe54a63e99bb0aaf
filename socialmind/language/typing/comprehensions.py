"""Typing of generator expressions: `sum(s.energy for s in model.flock if s.fat)` and its like.

Each becomes a function of the program: a loop, which takes what it uses of the rule around it. So
it is typed and compiled as if it stood written out in the author's file, and it runs when Python
would run it, be it in the middle of a condition.
"""

from __future__ import annotations

import ast
import copy
from typing import TYPE_CHECKING, Any

from socialmind.language import types
from socialmind.language.nodes import Typed, call, marked
from socialmind.language.source import RuleSource
from socialmind.language.typing.calls.neighbours import agent_there

if TYPE_CHECKING:
    from socialmind.language.typer import Typer

_LEAST = """NEXT = +VALUE
if COUNT == 0 or NEXT < FOUND:
    FOUND = NEXT
COUNT = 1"""
_BODIES = {
    "sum": ("FOUND = 0", "FOUND = FOUND + VALUE", "return FOUND"),
    "any": ("", "if VALUE:\n    return True", "return False"),
    "all": ("", "if not VALUE:\n    return False", "return True"),
    "mean": ("FOUND = 0.0\nCOUNT = 0", "FOUND = FOUND + VALUE\nCOUNT = COUNT + 1", ""),
    "min": ("FOUND = 0\nCOUNT = 0", _LEAST, ""),
    "max": ("FOUND = 0\nCOUNT = 0", _LEAST.replace("<", ">"), ""),
}
"""What stands before the loop, what is done for each value, and what stands behind the loop."""
_BEST = """ONE = VALUE
NEXT = +KEY
if COUNT == 0 or NEXT < LEAST:
    LEAST = NEXT
    FOUND = ONE
COUNT = 1"""
_BY_KEY = {"min": _BEST, "max": _BEST.replace("<", ">")}
_ANY_ONE = """COUNT = COUNT + 1
if STREAM.integers(COUNT) == 0:
    FOUND = VALUE"""
"""What is done for each agent or patch, of which that of the least key, or any, is looked for."""
_AMONG_AGENTS = ("FOUND = None\nLEAST = 0\nCOUNT = 0", "return FOUND")
_AMONG_PATCHES = (
    "FOUND = WORLD.patch(WORLD.low_x, WORLD.low_y)\nLEAST = 0\nCOUNT = 0",
    "return COUNT, FOUND",
)
_OR_DEFAULT = "if COUNT == 0:\n    return DEFAULT\nreturn FOUND"

REDUCTIONS = frozenset(_BODIES)
"""What may be asked of a generator expression."""


def reduced(typer: Typer, node: ast.Call, name: str) -> Typed:
    """Return the sum, the mean, the least … of what a generator expression yields.

    Args:
        typer: of the rule in which it stands.
        node: the call, whose first argument is the generator expression, an array field or a set.
        name: one of `REDUCTIONS`.
    """
    settings = {str(one.arg): one.value for one in node.keywords}
    known = {"key", "default"} if name in _BY_KEY else set()
    if len(node.args) > 1 or not settings.keys() <= known:
        wanted = ", default=…, key=…" if known else ""
        typer.refuse(
            node,
            f"{name}() of a generator expression like this",
            f"write {name}(value for one in several if condition{wanted})",
        )
    if "key" in settings:
        return _best(typer, node, name, settings)
    before, inside, behind = _BODIES[name]
    parts = {}
    if not behind:
        behind = "return COUNT, FOUND"
    if "default" in settings:
        parts, behind = {"DEFAULT": settings["default"]}, _OR_DEFAULT
    made, result = _called(typer, node, name, (before, inside, behind), parts)
    if not isinstance(result, types.TupleType):
        return made, result
    kind = result.items[1]
    return call("_mean_of" if name == "mean" else "_found_in", [made], node), kind


def _best(typer: Typer, node: ast.Call, name: str, settings: dict[str, ast.expr]) -> Typed:
    """Return the agent or patch with the least or the largest key."""
    key = settings["key"]
    one = _free("one", _names_in(node))
    if isinstance(key, ast.Lambda) and len(key.args.args) == 1 and not key.args.defaults:
        value = _filled(key.body, {}, {key.args.args[0].arg: one})
    elif isinstance(key, ast.Name):
        value = ast.copy_location(ast.Call(key, [_name(one, key)], []), key)
    else:
        typer.refuse(node, f"the key {ast.unparse(key)}", "write key=lambda one: one.energy")
    nobody = settings.get("default")
    if nobody is not None and not (isinstance(nobody, ast.Constant) and nobody.value is None):
        typer.refuse(node, f"default={ast.unparse(nobody)} with a key", "write default=None")
    made, kind = _one_among(typer, node, f"{name}_by_key", _BY_KEY[name], {"KEY": value})
    if nobody is None and isinstance(kind, types.MaybeRowType):
        return agent_there(made, kind)
    return made, kind


def any_one(typer: Typer, node: ast.Call, stream: ast.expr) -> Typed:
    """Return one of the agents or patches that a generator expression yields, drawn at random.

    Args:
        typer: of the rule in which it stands.
        node: the call `rng.choice(…)`.
        stream: the random stream, as it is written.
    """
    return _one_among(typer, node, "choice", _ANY_ONE, {"STREAM": stream})


def _one_among(
    typer: Typer, node: ast.Call, name: str, inside: str, parts: dict[str, ast.expr]
) -> Typed:
    """Return an agent or None, or a patch, of a generator expression or a set."""
    value, generators = _parts(node.args[0])
    several = next(
        (
            one.iter
            for one in generators
            if isinstance(value, ast.Name)
            and isinstance(one.target, ast.Name)
            and one.target.id == value.id
        ),
        None,
    )
    world = several
    if isinstance(several, ast.Call):
        world = several.func
    patches = isinstance(world, ast.Attribute) and isinstance(
        typer.expression(world.value)[1], types.WorldType
    )
    if patches and isinstance(world, ast.Attribute):
        before, behind = _AMONG_PATCHES
        parts = {**parts, "WORLD": world.value}
    elif isinstance(world, ast.Attribute) and isinstance(
        typer.expression(several or world)[1], types.PopulationType | types.FoundType
    ):
        before, behind = _AMONG_AGENTS
    else:
        typer.refuse(
            node,
            f"one of {ast.unparse(node.args[0])}",
            "write (one for one in several if condition), of agents or patches",
        )
    made, kind = _called(typer, node, name, (before, inside, behind), parts)
    if isinstance(kind, types.TupleType):
        return call("_found_in", [made], node), kind.items[1]
    return made, kind


def _called(
    typer: Typer,
    node: ast.Call,
    name: str,
    texts: tuple[str, str, str],
    parts: dict[str, ast.expr],
) -> Typed:
    """Return the call of the function that a generator expression stands for."""
    written: Any = node.args[0]
    if not hasattr(written, "written_out"):  # once, though typing walks a rule several times
        written.written_out = _written_out(typer, node, name, texts, parts)
    source: RuleSource = written.written_out
    given = [typer.expression(_name(one, node)) for one in source.parameters]
    symbol, result = typer.program.specialised(
        source, tuple(kind for _, kind in given), typer, node
    )
    held = [
        value for value, kind in given if not isinstance(kind, types.TextType | types.TableType)
    ]
    return marked(call(symbol, held, node), ("helper", symbol)), result


def _written_out(
    typer: Typer,
    node: ast.Call,
    name: str,
    texts: tuple[str, str, str],
    parts: dict[str, ast.expr],
) -> RuleSource:
    """Return that function, as its author might have written it."""
    value, generators = _parts(node.args[0])
    if any(generator.is_async for generator in generators):
        typer.refuse(node, "async for in a rule", "write a plain for")
    names = _names_in(node)
    marks = {mark: _free(mark.lower(), names) for mark in ("FOUND", "COUNT", "NEXT", "LEAST")}
    marks["ONE"] = _free("one", names)
    in_any_order = _counts(name, value, generators)
    value, generators = _without_branch(name, value, generators)
    before, body, behind = (_block(text, {**parts, "VALUE": value}, marks, node) for text in texts)
    for generator in reversed(generators):
        for condition in reversed(generator.ifs):
            body = [ast.copy_location(ast.If(condition, body, []), node)]
        target = copy.deepcopy(generator.target)
        body = [ast.copy_location(ast.For(target, generator.iter, body, []), node)]
    body = [*before, *body, *behind]
    own = {
        one.id
        for statement in body
        for one in ast.walk(statement)
        if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)
    }
    taken = [one for one in typer.variables if one in names and one not in own]
    arguments = ast.arguments([], [ast.arg(one) for one in taken], None, [], [], None, [])
    title = f"{name}_in_{typer.source.name}"
    tree = ast.FunctionDef(title, arguments, body, [], None, None)
    ast.fix_missing_locations(ast.copy_location(tree, node))
    if in_any_order:
        tree.in_any_order = frozenset(one.iter for one in generators)  # type: ignore[attr-defined]
    around = typer.source
    # What tells functions of a program apart is the expression itself: it has no function of its
    # own, and two of them in one rule are two.
    key: Any = node.args[0]
    return RuleSource(key, title, around.file, node.lineno, tree, around.names, around.state)


def _without_branch(
    name: str, value: ast.expr, generators: list[ast.comprehension]
) -> tuple[ast.expr, list[ast.comprehension]]:
    """Return `sum(1 for … if a == b)` as `sum(int(a == b) for …)`.

    So processors need not guess whether to add.
    """
    last = generators[-1]
    one = isinstance(value, ast.Constant) and value.value == 1 and type(value.value) is int
    if name != "sum" or not one or len(last.ifs) != 1 or not isinstance(last.ifs[0], ast.Compare):
        return value, generators
    added = ast.copy_location(ast.Call(ast.Name("int", ast.Load()), last.ifs, []), value)
    plain = ast.comprehension(last.target, last.iter, [], last.is_async)
    return added, [*generators[:-1], plain]


def _counts(name: str, value: ast.expr, generators: list[ast.comprehension]) -> bool:
    """Say whether what comes out cannot depend on the order, in which whoever is near is met."""
    if name not in ("any", "all") and not (
        name == "sum" and isinstance(value, ast.Constant | ast.Compare)
    ):
        return False
    parts = [value, *(condition for one in generators for condition in one.ifs)]
    return not any(isinstance(node, ast.Call) for part in parts for node in ast.walk(part))


def _parts(written: ast.expr) -> tuple[ast.expr, list[ast.comprehension]]:
    """Return what is yielded for what; each value itself where something else is written."""
    if isinstance(written, ast.GeneratorExp):
        return written.elt, written.generators
    target = ast.copy_location(ast.Name("each", ast.Store()), written)
    return _name("each", written), [ast.comprehension(target, written, [], 0)]


def _name(name: str, near: ast.AST) -> ast.Name:
    return ast.copy_location(ast.Name(name, ast.Load()), near)


def _names_in(node: ast.AST) -> set[str]:
    return {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}


def _free(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name


def _block(
    text: str, parts: dict[str, ast.expr], names: dict[str, str], near: ast.AST
) -> list[ast.stmt]:
    """Return lines with the author's expressions in their places."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.stmt | ast.expr):
            ast.copy_location(node, near)
    return [_filled(one, parts, names) for one in tree.body]


def _filled(tree: Any, parts: dict[str, ast.expr], names: dict[str, str]) -> Any:
    """Return a tree with other expressions, or other names, in the places of some names."""

    class Filling(ast.NodeTransformer):
        def visit_Name(self, node: ast.Name) -> ast.expr:
            part = parts.get(node.id)
            name = ast.Name(names.get(node.id, node.id), node.ctx)
            return ast.copy_location(name, node) if part is None else part

    return ast.fix_missing_locations(Filling().visit(copy.deepcopy(tree)))
