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
_MAY_BE_NOTHING = "return COUNT, FOUND"
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
    default = next((one.value for one in node.keywords if one.arg == "default"), None)
    others = [one.arg for one in node.keywords if one.arg != "default"]
    if len(node.args) > 1 or others or (default is not None and name not in ("min", "max")):
        wanted = ", default=…" if name in ("min", "max") else ""
        typer.refuse(
            node,
            f"{name}() of a generator expression like this",
            f"write {name}(value for one in several if condition{wanted})",
        )
    source = _written_out(typer, node.args[0], name, default)
    given = [
        typer.expression(ast.copy_location(ast.Name(one, ast.Load()), node))
        for one in source.parameters
    ]
    symbol, result = typer.program.specialised(
        source, tuple(kind for _, kind in given), typer, node
    )
    held = [
        value for value, kind in given if not isinstance(kind, types.TextType | types.TableType)
    ]
    made: ast.expr = marked(call(symbol, held, node), ("helper", symbol))
    if not isinstance(result, types.TupleType):
        return made, result
    kind = result.items[1]
    return call("_mean_of" if name == "mean" else "_found_in", [made], node), kind


def _written_out(
    typer: Typer, written: ast.expr, name: str, default: ast.expr | None
) -> RuleSource:
    """Return the function that a generator expression stands for, written once for each."""
    known: RuleSource | None = getattr(written, "written_out", None)
    if known is not None:
        return known
    value, generators = _parts(written)
    if any(generator.is_async for generator in generators):
        typer.refuse(written, "async for in a rule", "write a plain for")
    names = {one.id for one in ast.walk(written) if isinstance(one, ast.Name)}
    names |= {one.id for one in ast.walk(default or written) if isinstance(one, ast.Name)}
    targets = {
        one.id
        for generator in generators
        for one in ast.walk(generator.target)
        if isinstance(one, ast.Name)
    }
    before, inside, behind = _BODIES[name]
    if not behind:
        behind = _MAY_BE_NOTHING if default is None else _OR_DEFAULT
    parts = {"VALUE": value} if default is None else {"VALUE": value, "DEFAULT": default}
    free = {mark: _free(mark.lower(), names) for mark in ("FOUND", "COUNT", "NEXT")}
    body = _block(inside, parts, free, written)
    for generator in reversed(generators):
        for condition in reversed(generator.ifs):
            body = [ast.copy_location(ast.If(condition, body, []), written)]
        target = copy.deepcopy(generator.target)
        body = [ast.copy_location(ast.For(target, generator.iter, body, []), written)]
    body = [*_block(before, parts, free, written), *body, *_block(behind, parts, free, written)]
    taken = [one for one in typer.variables if one in names and one not in targets]
    arguments = ast.arguments([], [ast.arg(one) for one in taken], None, [], [], None, [])
    title = f"{name}_in_{typer.source.name}"
    tree = ast.FunctionDef(title, arguments, body, [], None, None)
    ast.fix_missing_locations(ast.copy_location(tree, written))
    around = typer.source
    # What tells functions of a program apart is the expression itself: it has no function of its
    # own, and two of them in one rule are two.
    key: Any = written
    made = RuleSource(key, title, around.file, written.lineno, tree, around.names, around.state)
    written.written_out = made  # type: ignore[attr-defined]  # typing walks a rule several times
    return made


def _parts(written: ast.expr) -> tuple[ast.expr, list[ast.comprehension]]:
    """Return what is yielded for what; each value itself where something else is written."""
    if isinstance(written, ast.GeneratorExp):
        return written.elt, written.generators
    one = ast.copy_location(ast.Name("one", ast.Load()), written)
    target = ast.copy_location(ast.Name("one", ast.Store()), written)
    return one, [ast.comprehension(target, written, [], 0)]


def _free(name: str, taken: set[str]) -> str:
    while name in taken:
        name += "_"
    return name


def _block(
    text: str, parts: dict[str, ast.expr], names: dict[str, str], near: ast.expr
) -> list[ast.stmt]:
    """Return lines with the author's expressions in their places."""

    class Filling(ast.NodeTransformer):
        def visit_Name(self, node: ast.Name) -> ast.expr:
            return parts.get(node.id) or ast.Name(names.get(node.id, node.id), node.ctx)

    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.stmt | ast.expr):
            ast.copy_location(node, near)
    filled = [Filling().visit(one) for one in tree.body]
    for one in filled:
        ast.fix_missing_locations(one)
    return filled
