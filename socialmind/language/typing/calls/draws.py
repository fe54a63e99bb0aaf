"""Typing of draws: what a rule may ask of its random stream."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any

from socialmind.errors import nearest
from socialmind.language.nodes import Typed, constant, marked
from socialmind.language.refusals import METHODS
from socialmind.language.types import BOOL, INT, NONE, AnyType, ArrayType, TableType, TupleType
from socialmind.language.typing import tables
from socialmind.language.typing.calls.built_in import fitted, without_keywords
from socialmind.language.typing.comprehensions import any_one
from socialmind.language.typing.signatures import OF_SEVERAL, RNG

if TYPE_CHECKING:
    from socialmind.language.typer import Typer


def typed_draw(typer: Typer, node: ast.Call, stream: ast.expr, name: str) -> Typed:
    """Return a draw as both speeds run it, and the type of what is drawn."""
    if name == "choice" and len(node.args) == 1 and isinstance(node.args[0], ast.GeneratorExp):
        without_keywords(typer, node, "rng.choice")
        assert isinstance(node.func, ast.Attribute)  # it is called as one
        return any_one(typer, node, node.func.value)
    if name == "choice":
        return _choice(typer, node, stream)
    if name == "shuffle":
        return _shuffle(typer, node, stream)
    if name == "permutation":
        typer.refuse(node, "rng.permutation() as a value", "write `for k in rng.permutation(n):`")
    if name not in RNG:
        advice = METHODS.get(name) or nearest(name, [*RNG, *OF_SEVERAL])
        typer.refuse(node, f"rng.{name}()", advice)
    without_keywords(typer, node, f"rng.{name}")
    fitting = [one for one in RNG[name] if len(one.arguments) == len(node.args)]
    signature = fitting[0] if fitting else RNG[name][-1]
    arguments = fitted(typer, node, f"rng.{name}", signature)
    return drawn(node, stream, name, arguments), signature.result


def drawn(node: ast.AST, stream: ast.expr, name: str, arguments: list[ast.expr]) -> ast.expr:
    """Return the call of a draw."""
    func = ast.copy_location(ast.Attribute(stream, name, ast.Load()), node)
    made: Any = ast.copy_location(ast.Call(func, arguments, []), node)
    return marked(made, ("draw", name, len(arguments)))


def permutation(typer: Typer, node: ast.Call, stream: ast.expr) -> ast.expr:
    """Return what a for loop in a random order runs over."""
    without_keywords(typer, node, "rng.permutation")
    if len(node.args) != 1:
        typer.refuse(node, "rng.permutation() like this", "write `for k in rng.permutation(n):`")
    n = typer.fitted(node.args[0], INT, "rng.permutation()")
    return drawn(node, stream, "permutation", [n])


def _shuffle(typer: Typer, node: ast.Call, stream: ast.expr) -> Typed:
    without_keywords(typer, node, "rng.shuffle")
    if len(node.args) != 1:
        typer.refuse(node, "rng.shuffle() like this", "write rng.shuffle(agent.array)")
    value, kind = typer.expression(node.args[0])
    if not isinstance(kind, ArrayType):
        typer.refuse(
            node,
            f"rng.shuffle() of {kind}",
            "give it an array field; agents come in a fresh random order by themselves, and "
            "`for k in rng.permutation(n):` goes through places in a random order",
        )
    mark: tuple[Any, ...] = getattr(value, "mark", ("other",))
    if mark[0] == "agent":
        typer.program.effects.changes(mark[1])
    return drawn(node, stream, "shuffle", [value]), NONE


def _choice(typer: Typer, node: ast.Call, stream: ast.expr) -> Typed:
    """Type `rng.choice(values)` and `rng.choice(values, p=weights)` as a place of the values."""
    named = [one.arg for one in node.keywords]
    if len(node.args) != 1 or named not in ([], ["p"]):
        typer.refuse(
            node,
            "rng.choice() like this",
            "write rng.choice(values) or rng.choice(values, p=weights)",
        )
    value, kind = typer.several(node.args[0])
    size = _size(kind)
    if size is None and kind not in (BOOL, INT):
        typer.refuse(
            node,
            f"rng.choice() of {kind}",
            "give it a tuple of constants, an array field or a whole number; "
            "an agent comes by model.population.one_of(rng)",
        )
    if not node.keywords:
        places = value if size is None else constant(size, node)
        place = drawn(node, stream, "integers", [places])
        return (place, INT) if size is None else _place_in(typer, node, value, kind, place)
    weights, of = typer.several(node.keywords[0].value)
    count = _size(of)
    numbers = isinstance(of, ArrayType) or (
        isinstance(of, TableType) and not isinstance(of.item, TupleType) and of.item is not None
    )
    if count is None or not numbers:
        typer.refuse(
            node, f"{of} as the weights", "give a tuple of constants or an array field of numbers"
        )
    if isinstance(of, TableType):
        weights = tables.written(tuple(map(float, of.values)), node)
    if size is None and not (isinstance(value, ast.Constant) and value.value == count):
        typer.refuse(node, "weights of another number", "write rng.choice(len(weights), p=weights)")
    if size not in (None, count):
        typer.refuse(node, f"{count} weights for {size} values", "give each value one weight")
    place = drawn(node, stream, "weighted", [weights])
    return (place, INT) if size is None else _place_in(typer, node, value, kind, place)


def _size(kind: AnyType) -> int | None:
    if isinstance(kind, ArrayType):
        return kind.size
    return len(kind.values) if isinstance(kind, TableType) else None


def _place_in(
    typer: Typer, node: ast.Call, value: ast.expr, kind: AnyType, place: ast.expr
) -> Typed:
    new = ast.copy_location(ast.Subscript(value, place, ast.Load()), node)
    if isinstance(kind, ArrayType):
        return marked(new, ("element", kind.of == BOOL)), kind.of
    if not isinstance(kind, TableType) or kind.item is None:
        return typer.refuse(
            node, "rng.choice() of texts", "draw a number, and write if … elif … else"
        )
    return new, kind.item
