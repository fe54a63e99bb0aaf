"""Typing of expressions: what each one is, and the same expression as both speeds run it."""

from __future__ import annotations

import ast
import types as python_types
from typing import Any

from socialmind.errors import ModelError
from socialmind.fields import Field
from socialmind.language.calls import typed_call
from socialmind.language.nodes import Typed, call, constant, marked, nearest
from socialmind.language.refusals import MODULES, NAMES, OPERATORS, REFUSED
from socialmind.language.signatures import MATH_CONSTANTS
from socialmind.language.source import RuleSource
from socialmind.language.types import (
    BOOL,
    FLOAT,
    INT,
    MODEL,
    NUMBERS,
    AnyType,
    ArrayType,
    MindType,
    OptionalType,
    PatchType,
    PlanType,
    PopulationType,
    RowType,
    TextType,
    TupleType,
    Type,
    WorldType,
    unified,
)

SCALARS: dict[type, Type] = {float: FLOAT, int: INT, bool: BOOL}
_INT_OPERATORS = {
    ast.Add: "add_int",
    ast.Sub: "subtract_int",
    ast.Mult: "multiply_int",
    ast.FloorDiv: "floor_divide_int",
    ast.Mod: "modulo_int",
}
_LARGEST_WHOLE_EXPONENT = 16


class ExpressionTyper:
    """Types the expressions of one function; `calls` and `statements` add theirs.

    Args:
        program: the program that the function belongs to; it holds the model's shape.
        source: the function.
    """

    def __init__(self, program: Any, source: RuleSource) -> None:
        self.program = program
        self.shape = program.shape
        self.source = source
        self.variables: dict[str, AnyType] = {}
        self.assigned: set[str] = set()

    # Refusals ---------------------------------------------------------------------------------

    def refuse(self, node: ast.AST, found: str, remedy: str, expected: str | None = None) -> Any:
        """Raise the error that names the place, what was found and what to write instead."""
        line = getattr(node, "lineno", self.source.line)
        raise ModelError(found, expected, remedy, self.source.file, line)

    def refuse_syntax(self, node: ast.AST) -> Any:
        """Refuse a construct that the language leaves out."""
        found, remedy = REFUSED.get(
            type(node), (f"{type(node).__name__.lower()} in a rule", "see docs/rules.md")
        )
        return self.refuse(node, f"{found} in the rule {self.source.name!r}", remedy)

    # Entry points -----------------------------------------------------------------------------

    def expression(self, node: ast.expr) -> Typed:
        """Return an expression as both speeds run it, and its type."""
        handler = getattr(self, f"on_{type(node).__name__.lower()}", None)
        if handler is None:
            return self.refuse_syntax(node)
        return handler(node)

    def number(self, node: ast.expr) -> Typed:
        """Return an expression that must be a number (truth values count as 0 and 1)."""
        value, kind = self.expression(node)
        return self.as_number(value, kind, node)

    def as_number(self, value: ast.expr, kind: AnyType, near: ast.AST) -> Typed:
        """Return a typed expression as a whole number or a number."""
        if isinstance(kind, OptionalType):
            value, kind = self.present(value, kind)
        if kind == BOOL:
            return call("_as_int", [value], near), INT
        if kind not in NUMBERS:
            self.refuse(
                near, f"{kind} where a number is needed", "write a number or a numeric field"
            )
        return value, kind

    def present(self, value: ast.expr, kind: OptionalType) -> Typed:
        """Return an optional value that is known to be there; None raises when the rule runs."""
        return marked(call("_present", [value], value), ("present",)), kind.of

    def there(self, node: ast.expr) -> Typed:
        """Return an expression whose value, if it may be None, must be there."""
        value, kind = self.expression(node)
        return self.present(value, kind) if isinstance(kind, OptionalType) else (value, kind)

    def to_float(self, value: ast.expr, kind: AnyType) -> ast.expr:
        """Return a numeric expression as a float."""
        if kind == FLOAT:
            return value
        if isinstance(value, ast.Constant):
            return constant(float(value.value), value)
        return call("_as_float", [value], value)

    def fitted(self, node: ast.expr, target: AnyType, what: str) -> ast.expr:
        """Return an expression as the type that its place needs, or refuse it."""
        value, kind = self.expression(node)
        return self.converted(value, kind, target, what, node)

    def converted(
        self, value: ast.expr, kind: AnyType, target: AnyType, what: str, near: ast.AST
    ) -> ast.expr:
        """Return a typed expression as another type, or refuse."""
        if kind == target:
            return value
        if isinstance(kind, OptionalType) and target in NUMBERS:
            value, kind = self.present(value, kind)
            return self.converted(value, kind, target, what, near)
        if target == FLOAT and kind in NUMBERS:
            value, kind = self.as_number(value, kind, near)
            return self.to_float(value, kind)
        if target == INT and kind == BOOL:
            return call("_as_int", [value], near)
        if target == INT and kind == FLOAT:
            self.refuse(
                near,
                f"a number with a fraction for {what}",
                "write int(…) to cut, round(…) to round, or declare it as float",
                "a whole number",
            )
        if target == BOOL and kind in NUMBERS:
            self.refuse(
                near, f"{kind} for {what}", "write a comparison, as `x != 0`", "True or False"
            )
        if isinstance(target, TupleType) and isinstance(value, ast.Tuple):
            assert isinstance(kind, TupleType)  # a written tuple has a tuple type
            value.elts = [
                self.converted(item, of, to, what, near)
                for item, of, to in zip(value.elts, kind.items, target.items, strict=True)
            ]
            return value
        return self.refuse(near, f"{kind} for {what}", f"give it {target}", str(target))

    def truth(self, node: ast.expr) -> ast.expr:
        """Return an expression as a condition."""
        if isinstance(node, ast.BoolOp):
            parts = [self.truth(value) for value in node.values]
            return ast.copy_location(ast.BoolOp(node.op, parts), node)
        if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            return ast.copy_location(ast.UnaryOp(ast.Not(), self.truth(node.operand)), node)
        value, kind = self.expression(node)
        if kind == BOOL:
            return value
        if kind in (INT, FLOAT):
            zero = constant(0 if kind == INT else 0.0, node)
            return ast.copy_location(ast.Compare(value, [ast.NotEq()], [zero]), node)
        if isinstance(kind, OptionalType) or isinstance(kind, PlanType):
            self.refuse(
                node,
                "a value that may be None as a condition",
                "write `is not None`, or compare it",
            )
        return self.refuse(node, f"{kind} as a condition", "write a comparison")

    # Names and constants ----------------------------------------------------------------------

    def on_constant(self, node: ast.Constant) -> Typed:
        value = node.value
        if isinstance(value, bool):
            return constant(value, node), BOOL
        if isinstance(value, int):
            if not -(2**63) <= value < 2**63:
                self.refuse(node, f"the number {value}", "write it as a float", "at most 64 bits")
            return constant(value, node), INT
        if isinstance(value, float):
            return constant(value, node), FLOAT
        if isinstance(value, str):
            return constant(value, node), TextType(value)
        if value is None:
            self.refuse(
                node,
                "None as a value",
                "only fields declared as `int | None`, `float | None` and a plan may be None",
            )
        return self.refuse(node, f"{value!r}", "write a number")

    def on_name(self, node: ast.Name) -> Typed:
        name = node.id
        if name in self.variables:
            if name not in self.assigned:
                self.refuse(
                    node,
                    f"{name!r}, which not every way to this line has given a value",
                    f"give {name!r} a value before the if or the loop",
                )
            return ast.copy_location(ast.Name(name, ast.Load()), node), self.variables[name]
        if name in self.source.names:
            return self.module_value(node, name, self.source.names[name])
        if name in NAMES:
            self.refuse(node, f"{name}() in the rule {self.source.name!r}", NAMES[name])
        known = [*self.variables, *self.source.names]
        return self.refuse(node, f"the unknown name {name!r}", nearest(name, known))

    def module_value(self, node: ast.expr, name: str, value: Any) -> Typed:
        """Return a constant of the author's file (or of `math`), written in its place."""
        if isinstance(value, bool | int | float | str):
            return self.on_constant(ast.copy_location(ast.Constant(value), node))
        if isinstance(value, python_types.FunctionType):
            self.refuse(node, f"the function {name!r} as a value", f"call it: {name}(…)")
        if isinstance(value, python_types.ModuleType):
            remedy = MODULES.get(value.__name__.split(".")[0], "only `math` is for rules")
            self.refuse(node, f"the module {value.__name__!r} in a rule", remedy)
        return self.refuse(
            node,
            f"{name!r}, which is {type(value).__name__}",
            "only numbers, plan names and plain functions of the file are for rules; "
            "tables belong into array fields or parameters",
        )

    # Attributes -------------------------------------------------------------------------------

    def on_attribute(self, node: ast.Attribute) -> Typed:
        if isinstance(node.value, ast.Name) and node.value.id not in self.variables:
            module = self.source.names.get(node.value.id)
            if isinstance(module, python_types.ModuleType):
                return self.module_attribute(node, module)
        base, kind = self.expression(node.value)
        new = ast.copy_location(ast.Attribute(base, node.attr, ast.Load()), node)
        if kind == MODEL:
            return self.model_attribute(new)
        if isinstance(kind, RowType):
            return self.agent_attribute(new, kind)
        if isinstance(kind, PatchType):
            if node.attr in ("x", "y"):
                return marked(new, ("patch_place", node.attr)), INT
            return self.field(new, self.shape.patch, kind, ("patch",))
        if isinstance(kind, WorldType):
            if node.attr in ("size", "low", "high"):
                return marked(new, ("world_size", node.attr)), INT
            return self.refuse(
                node, f"the world's {node.attr!r}", nearest(node.attr, ("size", "low", "high"))
            )
        return self.refuse(
            node, f"{node.attr!r} of {kind}", "only agents, patches and the model have fields"
        )

    def module_attribute(self, node: ast.Attribute, module: python_types.ModuleType) -> Typed:
        """Return a constant of `math`, or one of the author's own modules."""
        name = f"{module.__name__}.{node.attr}"
        if not hasattr(module, node.attr):
            self.refuse(node, f"the unknown name {name!r}", nearest(node.attr, dir(module)))
        if module.__name__ == "math" and node.attr not in MATH_CONSTANTS:
            self.refuse(node, f"{name!r} as a value", f"call it: {name}(…)")
        if module.__name__ in MODULES:
            self.refuse(node, f"{name!r} in a rule", MODULES[module.__name__])
        return self.module_value(node, name, getattr(module, node.attr))

    def model_attribute(self, node: ast.Attribute) -> Typed:
        name = node.attr
        if name == "tick":
            return marked(node, ("tick",)), INT
        if name in self.shape.populations:
            return marked(node, ("population", name)), PopulationType(name)
        if name == "world" and self.shape.patch is not None:
            return marked(node, ("world",)), WorldType()
        fields = {**self.shape.parameters, **self.shape.variables}
        if name not in fields:
            known = [*fields, *self.shape.populations, "tick"]
            self.refuse(node, f"the model's {name!r}", nearest(name, known))
        return self.field(node, fields, MODEL, ("model",))

    def agent_attribute(self, node: ast.Attribute, kind: RowType) -> Typed:
        shape = self.shape.populations[kind.population]
        if node.attr == "id":
            return marked(node, ("id",)), INT
        if node.attr == "mind" and shape.minded:
            return marked(node, ("mind", shape.name)), MindType(shape.name)
        if node.attr == "plan" and shape.minded:
            return marked(node, ("plan",)), PlanType(shape.name)
        if node.attr in ("mind", "plan"):
            self.refuse(
                node,
                f"the {node.attr} of {kind}",
                f"give the population a mind: Population(…, mind='scheme.yaml')",
            )
        return self.field(node, shape.fields, kind, ("agent", shape.name))

    def field(
        self, node: ast.Attribute, fields: Any, owner: AnyType, mark: tuple[Any, ...]
    ) -> Typed:
        """Return the reading of a declared field."""
        found: Field | None = fields.get(node.attr)
        if found is None:
            return self.refuse(
                node, f"the unknown field {node.attr!r} of {owner}", nearest(node.attr, fields)
            )
        kind: AnyType = SCALARS[found.kind]
        if found.size is not None:
            kind = ArrayType(SCALARS[found.kind], found.size)
        elif found.optional:
            kind = OptionalType(SCALARS[found.kind])
        return marked(node, (*mark, found)), kind

    # Places in arrays and populations ---------------------------------------------------------

    def on_subscript(self, node: ast.Subscript) -> Typed:
        base, kind = self.expression(node.value)
        if isinstance(node.slice, ast.Slice):
            self.refuse_syntax(node.slice)
        if isinstance(kind, PopulationType):
            index = self.fitted(node.slice, INT, "the identity of an agent")
            new = ast.copy_location(ast.Subscript(base, index, ast.Load()), node)
            return marked(new, ("agent_of", kind.population)), RowType(kind.population)
        if isinstance(kind, ArrayType):
            index = self.fitted(node.slice, INT, "the place in the array")
            checked = call("_position", [index, constant(kind.size, node)], node)
            return ast.copy_location(ast.Subscript(base, checked, ast.Load()), node), kind.of
        return self.refuse(node, f"[…] on {kind}", "only array fields and populations have places")

    def on_tuple(self, node: ast.Tuple) -> Typed:
        items = [self.there(item) for item in node.elts]
        new = ast.copy_location(ast.Tuple([value for value, _ in items], ast.Load()), node)
        return new, TupleType(tuple(kind for _, kind in items))

    # Operators --------------------------------------------------------------------------------

    def on_unaryop(self, node: ast.UnaryOp) -> Typed:
        if isinstance(node.op, ast.Not):
            return self.truth(node), BOOL
        if isinstance(node.op, ast.Invert):
            self.refuse(node, "~", "write `not`")
        value, kind = self.number(node.operand)
        if isinstance(value, ast.Constant):
            return constant(
                -value.value if isinstance(node.op, ast.USub) else value.value, node
            ), kind
        if isinstance(node.op, ast.USub) and kind == INT:
            return call("_subtract_int", [constant(0, node), value], node), INT
        return ast.copy_location(ast.UnaryOp(node.op, value), node), kind

    def on_binop(self, node: ast.BinOp) -> Typed:
        if type(node.op) in OPERATORS:
            self.refuse(
                node,
                f"the operator {OPERATORS[type(node.op)]}",
                "write `and`, `or`, `not` for truth values; numbers have + - * / // % **",
            )
        left, left_kind = self.number(node.left)
        right, right_kind = self.number(node.right)
        if isinstance(node.op, ast.Pow):
            return self.power(node, left, left_kind, right, right_kind)
        whole = left_kind == INT and right_kind == INT
        if whole and type(node.op) in _INT_OPERATORS:
            name = "_" + _INT_OPERATORS[type(node.op)]
            return call(name, [left, right], node), INT
        operands = self.to_float(left, left_kind), self.to_float(right, right_kind)
        return ast.copy_location(ast.BinOp(operands[0], node.op, operands[1]), node), FLOAT

    def power(
        self, node: ast.BinOp, base: ast.expr, base_kind: AnyType, exponent: ast.expr, kind: AnyType
    ) -> Typed:
        """Return `**` by the one definition that both speeds share."""
        written = exponent.value if isinstance(exponent, ast.Constant) else None
        if base_kind == INT and kind == INT and (written is None or written >= 0):
            return call("_power_int", [base, exponent], node), INT
        base = self.to_float(base, base_kind)
        if (
            written is not None
            and written == int(written)
            and abs(written) <= _LARGEST_WHOLE_EXPONENT
        ):
            return call("_power_whole", [base, constant(int(written), node)], node), FLOAT
        if written == 0.5:
            return call("_sqrt", [base], node), FLOAT
        return call("_power", [base, self.to_float(exponent, kind)], node), FLOAT

    def on_boolop(self, node: ast.BoolOp) -> Typed:
        for value in node.values:
            _, kind = self.expression(value)
            if kind != BOOL:
                self.refuse(
                    value,
                    f"{kind} in `and`/`or` whose value is used",
                    "write `a if condition else b`, or comparisons",
                )
        return self.truth(node), BOOL

    def on_ifexp(self, node: ast.IfExp) -> Typed:
        test = self.truth(node.test)
        yes, yes_kind = self.there(node.body)
        no, no_kind = self.there(node.orelse)
        kind = unified(yes_kind, no_kind)
        if kind is None:
            return self.refuse(node, f"{yes_kind} or {no_kind}", "give both the same type")
        yes = self.converted(yes, yes_kind, kind, "this value", node.body)
        no = self.converted(no, no_kind, kind, "this value", node.orelse)
        return ast.copy_location(ast.IfExp(test, yes, no), node), kind

    # Comparisons ------------------------------------------------------------------------------

    def on_compare(self, node: ast.Compare) -> Typed:
        sides = [node.left, *node.comparators]
        if any(isinstance(op, ast.Is | ast.IsNot | ast.In | ast.NotIn) for op in node.ops) or any(
            isinstance(side, ast.Constant) and side.value is None for side in sides
        ):
            return self.identity(node)
        typed = [self.expression(side) for side in sides]
        kinds = [kind for _, kind in typed]
        if any(isinstance(kind, PlanType | TextType) for kind in kinds):
            return self.plan_comparison(node, typed)
        if any(isinstance(kind, RowType) for kind in kinds):
            return self.same_agent(node, typed)
        if len(typed) == 2 and kinds[0] == kinds[1] == BOOL:
            return self._compare(node, [value for value, _ in typed]), BOOL
        numbers = [
            self.as_number(value, kind, side)
            for (value, kind), side in zip(typed, sides, strict=True)
        ]
        if any(kind == FLOAT for _, kind in numbers):
            return self._compare(node, [self.to_float(*number) for number in numbers]), BOOL
        return self._compare(node, [value for value, _ in numbers]), BOOL

    def _compare(self, node: ast.Compare, values: list[ast.expr]) -> ast.expr:
        return ast.copy_location(ast.Compare(values[0], node.ops, values[1:]), node)

    def identity(self, node: ast.Compare) -> Typed:
        """Type `is None`, `is not None` and `is` between agents."""
        operator = node.ops[0]
        if len(node.ops) > 1:
            self.refuse(node, "a chain with `is` or `in`", "write two comparisons joined by `and`")
        if isinstance(operator, ast.In | ast.NotIn):
            self.refuse(node, "`in`", "write `x == 1 or x == 2`, or a for loop")
        other = node.comparators[0]
        left, kind = self.expression(node.left)
        if isinstance(other, ast.Constant) and other.value is None:
            if isinstance(operator, ast.Eq | ast.NotEq):
                self.refuse(node, "`== None`", "write `is None`")
            if not (isinstance(kind, OptionalType | PlanType)):
                self.refuse(
                    node,
                    f"`is None` on {kind}, which is never None",
                    "declare the field as `… | None`",
                )
            negated = isinstance(operator, ast.IsNot)
            new = self._compare(node, [left, constant(None, other)])
            return marked(new, ("none", negated, isinstance(kind, PlanType))), BOOL
        right = self.expression(other)
        if isinstance(kind, RowType) and isinstance(right[1], RowType):
            return self.same_agent(node, [(left, kind), right])
        return self.refuse(node, "`is` between values", "write `==`; `is` is for None and agents")

    def same_agent(self, node: ast.Compare, typed: list[Typed]) -> Typed:
        """Type the question whether two agents are the same one."""
        (left, kind), (right, other) = typed[0], typed[-1]
        same = {ast.Is: ast.Eq, ast.Eq: ast.Eq, ast.IsNot: ast.NotEq, ast.NotEq: ast.NotEq}
        operator = same.get(type(node.ops[0]))
        if len(typed) != 2 or operator is None:
            self.refuse(node, "agents in a comparison of size", "compare their fields")
        if kind != other:
            self.refuse(
                node,
                f"{kind} compared with {other}",
                "agents of two populations are never the same",
            )
        ids = [
            marked(ast.copy_location(ast.Attribute(side, "id", ast.Load()), node), ("id",))
            for side in (left, right)
        ]
        assert operator is not None  # refused above
        return ast.copy_location(ast.Compare(ids[0], [operator()], [ids[1]]), node), BOOL

    def plan_comparison(self, node: ast.Compare, typed: list[Typed]) -> Typed:
        """Type `human.plan == "GrowWheat"`."""
        if len(typed) != 2 or not isinstance(node.ops[0], ast.Eq | ast.NotEq):
            self.refuse(node, "plans in a comparison of size", "compare them with == or !=")
        values = []
        for (value, kind), (_, other) in zip(typed, reversed(typed), strict=True):
            if not isinstance(kind, PlanType | TextType) or not isinstance(
                other, PlanType | TextType
            ):
                self.refuse(
                    node, f"{kind} compared with {other}", "compare a plan with a plan's name"
                )
            named = isinstance(kind, TextType) and isinstance(other, PlanType)
            values.append(self.plan_name(value, other.population) if named else value)
        if all(isinstance(kind, TextType) for _, kind in typed):
            self.refuse(node, "two texts compared", "compare a plan with a plan's name")
        return self._compare(node, values), BOOL

    def plan_name(self, node: ast.expr, population: str) -> ast.expr:
        """Mark a written text as the name of a plan of a population's scheme."""
        assert isinstance(node, ast.Constant)  # its type is a text
        return marked(
            node, ("name", population, self.name(node, population, "plan", (node.value,)))
        )

    def name(self, node: ast.AST, population: str, part: str, keys: tuple[str, ...]) -> int:
        """Return the place in the population's table of names of a written name."""
        return self.program.name(population, part, keys, self.source.file, node.lineno)

    # Calls ------------------------------------------------------------------------------------

    def on_call(self, node: ast.Call) -> Typed:
        return typed_call(self, node)
