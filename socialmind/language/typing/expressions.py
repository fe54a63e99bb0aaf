"""Typing of expressions: what each one is, and the same expression as both speeds run it."""

from __future__ import annotations

import ast
import types as python_types
from collections.abc import Callable
from typing import Any, NoReturn

import numpy as np

from socialmind.errors import ModelError, nearest
from socialmind.language import types
from socialmind.language.nodes import Typed, call, constant, marked, written_number
from socialmind.language.refusals import MODULES, NAMES, REFUSED
from socialmind.language.shape import ModelShape
from socialmind.language.source import RuleSource
from socialmind.language.typing import hints, operators, tables
from socialmind.language.typing.attributes import typed_attribute
from socialmind.language.typing.calls import neighbours
from socialmind.language.typing.calls.built_in import BUILT_IN
from socialmind.language.typing.calls.dispatch import typed_call
from socialmind.language.typing.comparisons import typed_comparison

_CONSTANTS: tuple[tuple[Callable[[Any], Any], tuple[type, ...]], ...] = (
    (bool, (bool, np.bool_)),
    (int, (int, np.integer)),
    (float, (float, np.floating)),
    (str, (str,)),
)
"""What a constant of an author's file may be; NumPy's numbers become Python's."""
_WRITTEN_NUMBERS = tuple(types.TextType(text) for text in ("inf", "-inf", "nan"))


class ExpressionTyper:
    """Types the expressions of one function; `calls` and `statements` add theirs.

    Args:
        program: the program that the function belongs to; it holds the model's shape.
        source: the function.
    """

    def __init__(self, program: Any, source: RuleSource) -> None:
        self.program = program
        self.shape: ModelShape = program.shape
        self.source = source
        self.variables: dict[str, types.AnyType] = {}
        self.assigned: set[str] = set()
        self.guessed: set[str] = set()
        self.stored = {
            node.id
            for node in ast.walk(source.tree)
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
        }

    # Refusals ---------------------------------------------------------------------------------

    def refuse(
        self, node: ast.AST, found: str, remedy: str, expected: str | None = None
    ) -> NoReturn:
        """Raise the error that names the place, what was found and what to write instead."""
        line = getattr(node, "lineno", self.source.line)
        raise ModelError(found, expected, remedy, self.source.file, line)

    def refuse_syntax(self, node: ast.AST) -> NoReturn:
        """Refuse a construct that the language leaves out."""
        found, remedy = REFUSED.get(
            type(node), (f"{type(node).__name__.lower()} in a rule", "see docs/rules.md")
        )
        self.refuse(node, f"{found} in the rule {self.source.name!r}", remedy)

    # Entry points -----------------------------------------------------------------------------

    def expression(self, node: ast.expr) -> Typed:
        """Return an expression as both speeds run it, and its type."""
        handler: Callable[[ast.expr], Typed] | None = getattr(
            self, f"_on_{type(node).__name__.lower()}", None
        )
        if handler is None:
            self.refuse_syntax(node)
        return handler(node)

    def number(self, node: ast.expr) -> Typed:
        """Return an expression that must be a number (truth values count as 0 and 1)."""
        value, kind = self.expression(node)
        return self.as_number(value, kind, node)

    def as_number(self, value: ast.expr, kind: types.AnyType, near: ast.AST) -> Typed:
        """Return a typed expression as a whole number or a number."""
        if isinstance(kind, types.OptionalType):
            value, kind = self.present(value, kind)
        if kind == types.BOOL:
            return call("_as_int", [value], near), types.INT
        if not isinstance(kind, types.Type) or kind not in types.NUMBERS:
            written = "math.inf or math.nan" if kind in _WRITTEN_NUMBERS else "a number or a field"
            self.refuse(near, f"{kind} where a number is needed", f"write {written}")
        return value, kind

    def present(self, value: ast.expr, kind: types.OptionalType) -> Typed:
        """Return an optional value that is known to be there; None raises when the rule runs."""
        return marked(call("_present", [value], value), ("present",)), kind.of

    def there(self, node: ast.expr) -> Typed:
        """Return an expression whose value, if it may be None, must be there."""
        value, kind = self.expression(node)
        return self.present(value, kind) if isinstance(kind, types.OptionalType) else (value, kind)

    def to_float(self, value: ast.expr, kind: types.AnyType) -> ast.expr:
        """Return a numeric expression as a float."""
        if kind == types.FLOAT:
            return value
        if isinstance(value, ast.Constant):
            return constant(float(written_number(value)), value)
        return call("_as_float", [value], value)

    def fitted(self, node: ast.expr, target: types.AnyType, what: str) -> ast.expr:
        """Return an expression as the type that its place needs, or refuse it."""
        value, kind = self.expression(node)
        return self.converted(value, kind, target, what, node)

    def converted(
        self, value: ast.expr, kind: types.AnyType, target: types.AnyType, what: str, near: ast.AST
    ) -> ast.expr:
        """Return a typed expression as another type, or refuse."""
        if kind == target:
            return value
        if isinstance(target, types.MaybeRowType) and (
            kind == types.NOBODY or getattr(kind, "population", None) == target.population
        ):
            return neighbours.perhaps(value, kind)
        if isinstance(kind, types.MaybeRowType) and isinstance(target, types.RowType):
            value, kind = neighbours.agent_there(value, kind)
            return self.converted(value, kind, target, what, near)
        if isinstance(kind, types.OptionalType) and target in types.NUMBERS:
            value, kind = self.present(value, kind)
            return self.converted(value, kind, target, what, near)
        if target == types.FLOAT and kind in types.NUMBERS:
            value, kind = self.as_number(value, kind, near)
            return self.to_float(value, kind)
        if isinstance(target, types.ChoiceType) and isinstance(kind, types.TextType):
            if kind.value not in target.texts:
                advice = nearest(kind.value, target.texts)
                self.refuse(near, f"{kind} for {what}", advice, str(target))
            place = target.texts.index(kind.value)
            return marked(constant(kind.value, near), ("choice", place))
        if target == types.INT and kind == types.BOOL:
            return call("_as_int", [value], near)
        if target == types.INT and kind == types.FLOAT:
            self.refuse(
                near,
                f"a number with a fraction for {what}",
                "write int(…) to cut, round(…) to round, or declare it as float",
                "a whole number",
            )
        if target == types.BOOL and kind in types.NUMBERS:
            self.refuse(
                near, f"{kind} for {what}", "write a comparison, as `x != 0`", "True or False"
            )
        if isinstance(target, types.TupleType) and isinstance(kind, types.TupleType):
            if not isinstance(value, ast.Tuple):
                self.refuse(
                    near,
                    "whole numbers of a function, where numbers with fractions are needed",
                    "let the function return float(…); in a tuple of constants write 1.0",
                )
            value.elts = [
                self.converted(item, of, to, what, near)
                for item, of, to in zip(value.elts, kind.items, target.items, strict=True)
            ]
            return value
        if isinstance(kind, types.RowType) and target in types.NUMBERS:
            advice = (
                f"keep its identity, `….id`; `model.{kind.population}[identity]` finds it again"
            )
            self.refuse(near, f"{kind} for {what}", advice, str(target))
        return self.refuse(near, f"{kind} for {what}", f"give it {target}", str(target))

    def truth(self, node: ast.expr) -> ast.expr:
        """Return an expression as a condition."""
        if isinstance(node, ast.BoolOp):
            parts = [self.truth(value) for value in node.values]
            return ast.copy_location(ast.BoolOp(node.op, parts), node)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            return ast.copy_location(ast.UnaryOp(ast.Not(), self.truth(node.operand)), node)
        value, kind = self.expression(node)
        if kind == types.BOOL:
            return value
        if kind in (types.INT, types.FLOAT):
            zero = constant(0 if kind == types.INT else 0.0, node)
            return ast.copy_location(ast.Compare(value, [ast.NotEq()], [zero]), node)
        if isinstance(kind, types.FoundType | types.PatchesType):
            self.refuse(node, f"{kind} as a condition", "write `len(…) > 0`")
        if isinstance(kind, types.OptionalType | types.PlanType | types.MaybeRowType):
            self.refuse(
                node,
                "a value that may be None as a condition",
                "write `is not None`, or compare it",
            )
        if isinstance(kind, types.PopulationType):
            advice = f"write `len(model.{kind.population}) > 0`"
            self.refuse(node, f"{kind} as a condition", advice)
        return self.refuse(node, f"{kind} as a condition", "write a comparison")

    def truth_value(self, node: ast.expr) -> Typed:
        """Return an expression as True or False, and the type of these."""
        return self.truth(node), types.BOOL

    # Names and constants ----------------------------------------------------------------------

    def _on_constant(self, node: ast.Constant) -> Typed:
        value = node.value
        if isinstance(value, int) and not -(2**63) <= value < 2**63:
            self.refuse(node, f"the number {value}", "write it as a float", "at most 64 bits")
        if isinstance(value, bool | int | float):
            return constant(value, node), types.SCALARS[type(value)]
        if isinstance(value, str):
            return constant(value, node), types.TextType(value)
        if value is None:
            self.refuse(
                node,
                "None as a value",
                "only fields declared as `int | None`, `float | None` and a plan may be None; "
                "a variable begins with a number, as -1 for none",
            )
        return self.refuse(node, f"{value!r}", "write a number")

    def _on_name(self, node: ast.Name) -> Typed:
        name = node.id
        if name in self.variables or name in self.stored:
            if name not in self.assigned:
                self.refuse(
                    node,
                    f"{name!r}, which not every way to this line has given a value",
                    f"give {name!r} a value before the if or the loop",
                )
            kind = self.variables[name]
            if kind == types.NOBODY:
                kind = self.variables[name] = self.agent_or_none(name)
            if isinstance(kind, types.TextType):
                # A text is part of which function this is, not an argument of it.
                return constant(kind.value, node), kind
            if isinstance(kind, types.TableType):
                return tables.written(kind.values, node), kind
            return ast.copy_location(ast.Name(name, ast.Load()), node), kind
        if name in self.source.names:
            return self.module_value(node, name, self.source.names[name])
        if name in NAMES:
            self.refuse(node, f"{name}() in the rule {self.source.name!r}", NAMES[name])
        if name in BUILT_IN:
            self.refuse(node, f"the function {name!r} as a value", f"call it: {name}(…)")
        return self.refuse(node, f"the unknown name {name!r}", hints.for_name(self, name))

    def agent_or_none(self, name: str) -> types.AnyType:
        """Return what a variable may hold that was None so far, by what is assigned elsewhere."""
        if name in self.guessed:
            return types.NOBODY
        self.guessed.add(name)
        for node in ast.walk(self.source.tree):
            value = node.value if isinstance(node, ast.Assign) else None
            if value is None or isinstance(value, ast.Constant) or not _is_for(node, name):
                continue
            try:
                _, kind = self.expression(value)
            except ModelError:  # something in it is not known yet
                continue
            if isinstance(kind, types.RowType | types.MaybeRowType):
                self.guessed.discard(name)
                return types.MaybeRowType(kind.population)
        self.guessed.discard(name)
        return types.NOBODY

    def module_value(self, node: ast.expr, name: str, value: Any) -> Typed:
        """Return a constant of the author's file (or of `math`), written in its place."""
        for plain, kinds in _CONSTANTS:
            if isinstance(value, kinds):
                return self._on_constant(ast.copy_location(ast.Constant(plain(value)), node))
        if isinstance(value, tuple):
            return self.table(node, name, value)
        if isinstance(value, python_types.FunctionType):
            self.refuse(node, f"the function {name!r} as a value", f"call it: {name}(…)")
        if isinstance(value, python_types.ModuleType):
            remedy = MODULES.get(value.__name__.split(".")[0], "only `math` is for rules")
            self.refuse(node, f"the module {value.__name__!r} in a rule", remedy)
        if value is None:
            self.refuse(node, f"{name!r}, which is None", "write a number, or `is None` on a field")
        return self.refuse(
            node,
            f"{name!r}, which is of the type {type(value).__name__}",
            "only numbers, plan names, tuples of these and plain functions of the file are for "
            "rules; write a table as a tuple, what changes as an array field",
        )

    def table(self, node: ast.expr, name: str, values: tuple[Any, ...]) -> Typed:
        """Return a tuple of constants, written in its place."""
        try:
            kind = tables.table(values)
        except tables.NoTableError as error:
            self.refuse(
                node,
                f"the tuple {name!r}: {error}",
                "write numbers of one kind, or tuples of equal length; "
                "larger tables belong into array fields",
            )
        return tables.written(kind.values, node), kind

    def several(self, node: ast.expr) -> Typed:
        """Return an expression; constants written as a tuple are a table."""
        if isinstance(node, ast.Tuple) and node.elts:
            try:
                values = ast.literal_eval(node)
            except ValueError:
                return self.expression(node)
            return self.table(node, "(…)", values)
        return self.expression(node)

    # Places in arrays and populations ---------------------------------------------------------

    def _on_subscript(self, node: ast.Subscript) -> Typed:
        base, kind = self.several(node.value)
        if isinstance(node.slice, ast.Slice):
            self.refuse_syntax(node.slice)
        if isinstance(kind, types.TableType | types.TupleType):
            return self.place_in_tuple(node, base, kind)
        if isinstance(kind, types.PopulationType):
            index = self.fitted(node.slice, types.INT, "the identity of an agent")
            new = ast.copy_location(ast.Subscript(base, index, ast.Load()), node)
            return marked(new, ("agent_of", kind.population)), types.RowType(kind.population)
        if isinstance(kind, types.ArrayType):
            index = self.fitted(node.slice, types.INT, "the place in the array")
            checked = call("_position", [index, constant(kind.size, node)], node)
            new = ast.copy_location(ast.Subscript(base, checked, ast.Load()), node)
            return marked(new, ("element", kind.of == types.BOOL)), kind.of
        if isinstance(kind, types.RowType) or kind == types.MODEL:
            self.refuse(node, f"[…] on {kind}", "write the name of the field after a dot")
        if isinstance(kind, types.WorldType):
            self.refuse(node, f"[…] on {kind}", "write model.world.patch(x, y)")
        return self.refuse(node, f"[…] on {kind}", "only array fields and populations have places")

    def place_in_tuple(
        self, node: ast.Subscript, base: ast.expr, kind: types.TableType | types.TupleType
    ) -> Typed:
        """Return a place of a tuple: of constants by any index, of others by a written one."""
        size = len(kind.values if isinstance(kind, types.TableType) else kind.items)
        index = self.fitted(node.slice, types.INT, "the place in the tuple")
        written = index.value if isinstance(index, ast.Constant) else None
        if isinstance(written, int) and not -size <= written < size:
            self.refuse(node, f"the place {written} of {kind}", f"write 0 … {size - 1}")
        if isinstance(kind, types.TupleType):
            if not isinstance(written, int):
                self.refuse(
                    node, f"a place of {kind} that depends", "take them apart: `x, y = PAIRS[k]`"
                )
            new = ast.copy_location(ast.Subscript(base, index, ast.Load()), node)
            return new, kind.items[written]
        if kind.item is None:
            self.refuse(node, "a place in a tuple of texts", "write if … elif … with the texts")
        checked = call("_position", [index, constant(size, node)], node)
        return ast.copy_location(ast.Subscript(base, checked, ast.Load()), node), kind.item

    def _on_tuple(self, node: ast.Tuple) -> Typed:
        items = [self.there(item) for item in node.elts]
        new = ast.copy_location(ast.Tuple([value for value, _ in items], ast.Load()), node)
        return new, types.TupleType(tuple(kind for _, kind in items))

    # Attributes, operators, calls, names of a scheme -------------------------------------------

    _on_attribute = typed_attribute
    _on_unaryop = operators.typed_sign
    _on_binop = operators.typed_operation
    _on_boolop = operators.typed_logic
    _on_ifexp = operators.typed_choice
    _on_compare = typed_comparison
    _on_call = typed_call

    def plan_name(self, near: ast.expr, text: types.TextType, population: str) -> ast.expr:
        """Return a written text as the name of a plan of a population's scheme."""
        place = self.name(near, population, "plan", (text.value,))
        return marked(constant(text.value, near), ("name", population, place))

    def name(self, node: ast.expr, population: str, part: str, keys: tuple[str, ...]) -> int:
        """Return the place in the population's table of names of a written name."""
        place: int = self.program.name(population, part, keys, self.source.file, node.lineno)
        return place


def _is_for(node: Any, name: str) -> bool:
    """Say whether an assignment is to a variable of this name."""
    return any(isinstance(target, ast.Name) and target.id == name for target in node.targets)
