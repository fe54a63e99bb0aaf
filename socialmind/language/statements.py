"""Typing of statements: assignments, conditions, loops, and which variables have a value where."""

from __future__ import annotations

import ast
from typing import Any

from socialmind.fields import Field
from socialmind.language.expressions import ExpressionTyper
from socialmind.language.nodes import Typed, call, constant, marked
from socialmind.language.source import RuleSource
from socialmind.language.types import (

    FLOAT,
    INT,

    NONE,

    AnyType,
    ArrayType,
    OptionalType,
    PatchType,
    PlanType,
    PopulationType,
    RowType,
    TextType,
    TupleType,
    WorldType,
    unified,
)


class FunctionTyper:
    """Types one function for given types of its parameters.

    Variables may be met before their final type is known (`total = 0`, then `total += 0.5`), so
    the body is walked again until no type changes; the last walk gives the tree.

    Args:
        program: the program that the function becomes part of.
        source: the function.
        kinds: the types of its parameters.
    """

    def __init__(self, program: Any, source: RuleSource, kinds: tuple[AnyType, ...]) -> None:
        self.program = program
        self.source = source
        self.parameters = dict(zip(source.parameters, kinds, strict=True))
        self.kinds: dict[str, AnyType] = dict(self.parameters)
        self.result: AnyType | None = None

    def typed(self) -> tuple[list[ast.stmt], AnyType]:
        """Return the body as both speeds run it, and the type of what it returns."""
        while True:
            before = (dict(self.kinds), self.result)
            self.typer = ExpressionTyper(self.program, self.source)
            self.typer.variables = self.kinds
            self.typer.assigned = set(self.parameters)
            self.loops: list[set[str] | None] = []
            self.counters: set[str] = set()
            self.fell_through = False
            body = self.block(_without_docstring(self.source.tree.body))
            if self.typer.assigned is not NOWHERE:
                self.fell_through = True
            if before == (self.kinds, self.result):
                break
        body = self.promoted() + body
        if self.result is None:
            return body, NONE
        if self.fell_through and self.result != NONE:
            self.typer.refuse(
                self.source.tree,
                f"the function {self.source.name!r}, which returns a value on some ways only",
                "end every way with `return value`",
            )
        return body, self.result

    def promoted(self) -> list[ast.stmt]:
        """Return the lines that turn whole-number arguments into the numbers they become later."""
        lines: list[ast.stmt] = []
        for name, kind in self.parameters.items():
            if self.kinds[name] != kind:
                value = call("_as_float", [ast.Name(name, ast.Load())], self.source.tree)
                line = ast.Assign([ast.Name(name, ast.Store())], value)
                lines.append(ast.fix_missing_locations(ast.copy_location(line, self.source.tree)))
        return lines

    # Blocks -----------------------------------------------------------------------------------

    def block(self, statements: list[ast.stmt]) -> list[ast.stmt]:
        """Return statements as both speeds run them."""
        result: list[ast.stmt] = []
        for statement in statements:
            handler = getattr(self, f"on_{type(statement).__name__.lower()}", None)
            if handler is None:
                self.typer.refuse_syntax(statement)
            made = handler(statement)
            result.extend(made if isinstance(made, list) else [made])
            if self.typer.assigned is NOWHERE:
                break  # what follows a return, break or continue never runs
        return result or [ast.Pass()]

    def on_pass(self, node: ast.Pass) -> ast.stmt:
        return ast.copy_location(ast.Pass(), node)

    def on_expr(self, node: ast.Expr) -> ast.stmt:
        if isinstance(node.value, ast.Constant):
            return ast.copy_location(ast.Pass(), node)
        value, _ = self.typer.expression(node.value)
        if not isinstance(value, ast.Call):
            self.typer.refuse(node, "a value that is not used", "assign it, or remove the line")
        return ast.copy_location(ast.Expr(value), node)

    def on_return(self, node: ast.Return) -> ast.stmt:
        empty = node.value is None or (
            isinstance(node.value, ast.Constant) and node.value.value is None
        )
        kind: AnyType = NONE
        value: ast.expr | None = None
        if not empty:
            assert node.value is not None  # not empty
            value, kind = self.typer.expression(node.value)
            if isinstance(kind, OptionalType):
                value, kind = self.typer.present(value, kind)
        wanted = kind if self.result is None else unified(self.result, kind)
        if wanted is None:
            self.typer.refuse(
                node,
                f"{kind} returned, where another line returns {self.result}",
                "return the same type everywhere (-1 for 'none' among whole numbers)",
            )
        self.result = wanted
        if value is not None and wanted is not None:
            assert node.value is not None  # it has a value
            value = self.typer.converted(value, kind, wanted, "the result", node.value)
        self.typer.assigned = NOWHERE
        return ast.copy_location(ast.Return(value), node)

    # Assignments ------------------------------------------------------------------------------

    def on_assign(self, node: ast.Assign) -> ast.stmt | list[ast.stmt]:
        if len(node.targets) > 1:
            self.typer.refuse(node, "a = b = …", "write two assignments")
        return self.assignment(node.targets[0], node.value, node)

    def on_annassign(self, node: ast.AnnAssign) -> ast.stmt | list[ast.stmt]:
        if node.value is None:
            self.typer.refuse(node, "a declaration without a value", "give it a value")
        assert node.value is not None  # refused above
        annotation = ast.unparse(node.annotation)
        if annotation == "float" and isinstance(node.target, ast.Name):
            number = ast.copy_location(ast.Call(ast.Name("float"), [node.value], []), node)
            return self.assignment(node.target, ast.fix_missing_locations(number), node)
        return self.assignment(node.target, node.value, node)

    def on_augassign(self, node: ast.AugAssign) -> ast.stmt | list[ast.stmt]:
        reading = _as_read(node.target)
        value = ast.copy_location(ast.BinOp(reading, node.op, node.value), node)
        return self.assignment(node.target, value, node)

    def assignment(self, target: ast.expr, value: ast.expr, node: ast.stmt) -> ast.stmt:
        """Return one assignment."""
        if isinstance(target, ast.Name):
            typed, kind = self.typer.expression(value)
            if isinstance(kind, OptionalType):
                typed, kind = self.typer.present(typed, kind)
            typed = self.bound(target.id, typed, kind, node)
            place: ast.expr = ast.copy_location(ast.Name(target.id, ast.Store()), target)
            return ast.copy_location(ast.Assign([place], typed), node)
        if isinstance(target, ast.Tuple):
            return self.several(target, value, node)
        place, kind, what = self.place(target)
        return self.stored(place, kind, what, value, node)

    def bound(self, name: str, value: ast.expr, kind: AnyType, node: ast.stmt) -> ast.expr:
        """Give a variable a value; its type is one that holds all its values."""
        if kind == NONE:
            self.typer.refuse(node, f"{name!r} from a call that returns nothing", "call it on its own line")
        if isinstance(kind, TextType | TupleType | ArrayType):
            self.typer.refuse(
                node, f"{kind} as the variable {name!r}", "write it where it is used, or use a field"
            )
        if name.startswith("_") and name != "_":
            self.typer.refuse(node, f"the variable {name!r}", "leave the leading underscore out")
        if name in self.counters:
            self.typer.refuse(node, f"a new value for {name!r}, which counts in a for loop", "use another name")
        before = self.kinds.get(name)
        wanted = kind if before is None else unified(before, kind)
        if wanted is None:
            self.typer.refuse(
                node, f"{kind} for {name!r}, which is {before} elsewhere", "use another name"
            )
            return value
        self.kinds[name] = wanted
        self.typer.assigned = self.typer.assigned | {name}
        return self.typer.converted(value, kind, wanted, f"the variable {name!r}", node)

    def several(self, target: ast.Tuple, value: ast.expr, node: ast.stmt) -> ast.stmt:
        """Return `x, y = y, x`, or the taking apart of what a function returns."""
        typed, kind = self.typer.expression(value)
        if not isinstance(kind, TupleType) or len(kind.items) != len(target.elts):
            self.typer.refuse(node, f"{kind} for {len(target.elts)} variables", "count them")
        assert isinstance(kind, TupleType)  # refused above
        places: list[ast.expr] = []
        wanted: list[AnyType] = []
        for place, item in zip(target.elts, kind.items, strict=True):
            if not isinstance(place, ast.Name):
                self.typer.refuse(node, "fields on the left of several assignments", "assign them one by one")
            assert isinstance(place, ast.Name)  # refused above
            self.bound(place.id, constant(0, node), item, node)
            wanted.append(self.kinds[place.id])
            places.append(ast.copy_location(ast.Name(place.id, ast.Store()), place))
        if isinstance(typed, ast.Tuple):
            typed = self.typer.converted(typed, kind, TupleType(tuple(wanted)), "these", node)
        elif tuple(wanted) != kind.items:
            self.typer.refuse(
                node, "a function's whole number for a variable that is a number elsewhere",
                "let the function return float(…)",
            )
        left = ast.copy_location(ast.Tuple(places, ast.Store()), target)
        return ast.copy_location(ast.Assign([left], typed), node)

    def place(self, target: ast.expr) -> tuple[ast.expr, AnyType, str]:
        """Return where a field or an element is stored, its type and what to call it."""
        if not isinstance(target, ast.Attribute | ast.Subscript):
            self.typer.refuse_syntax(target)
        reading, kind = self.typer.expression(_as_read(target))
        if isinstance(reading, ast.Attribute):
            mark = getattr(reading, "mark", ("other",))
            if mark[0] == "model" and reading.attr in self.program.shape.parameters:
                self.typer.refuse(
                    target,
                    f"a new value for the parameter {reading.attr!r}",
                    "parameters stay as they are in a run; declare a variable of the model",
                )
            if mark[0] not in ("agent", "model", "patch", "plan"):
                self.typer.refuse(target, f"a new value for {reading.attr!r}", "it cannot be set")
            if isinstance(kind, ArrayType):
                self.typer.refuse(target, f"a new value for the whole array {reading.attr!r}", "set its places one by one")
            reading.ctx = ast.Store()
            return reading, kind, f"the field {reading.attr!r}"
        if not isinstance(reading, ast.Subscript) or isinstance(kind, RowType):
            self.typer.refuse(target, "this on the left of =", "assign to a variable or a field")
        assert isinstance(reading, ast.Subscript)  # refused above
        reading.ctx = ast.Store()
        return reading, kind, "the array"

    def stored(
        self, place: ast.expr, kind: AnyType, what: str, value: ast.expr, node: ast.stmt
    ) -> ast.stmt:
        """Return the storing of a value in a field or an element."""
        none = isinstance(value, ast.Constant) and value.value is None
        mark = getattr(place, "mark", ("other",))
        made: ast.expr
        if isinstance(kind, PlanType):
            made = self.plan_value(kind, value, what, none)
        elif none:
            if not isinstance(kind, OptionalType):
                self.typer.refuse(
                    node, f"None for {what}, which is {kind}", "declare it as `… | None`, or give it a number"
                )
            made = constant(None, value)
        else:
            target = kind.of if isinstance(kind, OptionalType) else kind
            made = self.typer.fitted(value, target, what)
            field = mark[-1] if isinstance(mark[-1], Field) else None
            if field is not None and field.limits is not None:
                low, high = field.limits
                made = call("_fitting", [made, constant(low, node), constant(high, node)], node)
        new = ast.copy_location(ast.Assign([place], made), node)
        return marked(new, ("store", none))

    def plan_value(self, kind: PlanType, value: ast.expr, what: str, none: bool) -> ast.expr:
        """Return what may be stored as an agent's plan: a plan, a plan's name or None."""
        if none:
            return marked(constant(None, value), ("no_plan",))
        made, found = self.typer.expression(value)
        if isinstance(found, TextType):
            return self.typer.plan_name(made, kind.population)
        if found != kind:
            self.typer.refuse(value, f"{found} for {what}", "give it a plan's name, or what a mind chose")
        return made

    # Conditions and loops ---------------------------------------------------------------------

    def on_if(self, node: ast.If) -> ast.stmt:
        test = self.typer.truth(node.test)
        before = self.typer.assigned
        body = self.block(node.body)
        after_body = self.typer.assigned
        self.typer.assigned = before
        orelse = self.block(node.orelse) if node.orelse else []
        self.typer.assigned = _both(after_body, self.typer.assigned)
        return ast.copy_location(ast.If(test, body, orelse), node)

    def on_while(self, node: ast.While) -> ast.stmt:
        test = self.typer.truth(node.test)
        endless = isinstance(node.test, ast.Constant) and bool(node.test.value)
        body = self.loop(node.body)
        breaks = self.loops.pop()
        if endless:
            self.typer.assigned = NOWHERE if breaks is None else breaks
        orelse = self.block(node.orelse) if node.orelse else []
        return ast.copy_location(ast.While(test, body, orelse), node)

    def loop(self, body: list[ast.stmt]) -> list[ast.stmt]:
        """Return the body of a loop, which may run not once."""
        before = self.typer.assigned
        self.loops.append(None)
        made = self.block(body)
        self.typer.assigned = before
        return made

    def on_break(self, node: ast.Break) -> ast.stmt:
        met = self.loops[-1]
        self.loops[-1] = _both(NOWHERE if met is None else met, self.typer.assigned)
        self.typer.assigned = NOWHERE
        return ast.copy_location(ast.Break(), node)

    def on_continue(self, node: ast.Continue) -> ast.stmt:
        self.typer.assigned = NOWHERE
        return ast.copy_location(ast.Continue(), node)

    def on_for(self, node: ast.For) -> ast.stmt:
        if not isinstance(node.target, ast.Name):
            self.typer.refuse(node, "several variables in a for loop", "loop over one")
        assert isinstance(node.target, ast.Name)  # refused above
        name = node.target.id
        iterated, kind, mark = self.iterated(node.iter)
        if name in self.counters or name in self.parameters:
            self.typer.refuse(node, f"{name!r} as the variable of a loop inside its own", "use another name")
        before = self.typer.assigned
        self.bound(name, constant(0, node), kind, node)
        if self.kinds[name] != kind:
            self.typer.refuse(
                node, f"{name!r}, which is {self.kinds[name]} elsewhere, as {kind}", "use another name"
            )
        self.counters.add(name)
        body = self.loop(node.body)
        self.loops.pop()
        self.counters.discard(name)
        # Not one round may have run.
        self.typer.assigned = before
        orelse = self.block(node.orelse) if node.orelse else []
        target = ast.copy_location(ast.Name(name, ast.Store()), node.target)
        return marked(ast.copy_location(ast.For(target, iterated, body, orelse), node), mark)

    def iterated(self, node: ast.expr) -> tuple[ast.expr, AnyType, tuple[Any, ...]]:
        """Return what a for loop runs over, the type of its variable and a mark."""
        typer = self.typer
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "range":
            if node.keywords or not 1 <= len(node.args) <= 3:
                typer.refuse(node, "range() like this", "write range(stop) or range(start, stop, step)")
            bounds = [typer.fitted(argument, INT, "range()") for argument in node.args]
            return call("_range", bounds, node), INT, ("range",)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            base, kind = self.owner(node.func.value)
            if isinstance(kind, WorldType) and node.func.attr == "in_radius":
                if len(node.args) != 2 or node.keywords:
                    typer.refuse(node, "in_radius() like this", "write in_radius(agent, radius)")
                agent, agent_kind = typer.expression(node.args[0])
                if not isinstance(agent_kind, RowType | PatchType):
                    typer.refuse(node, f"in_radius() of {agent_kind}", "give it an agent or a patch")
                radius = typer.fitted(node.args[1], FLOAT, "the radius")
                x, y = (self.coordinate(node.args[0], axis) for axis in "xy")
                return call("_in_radius", [base, x, y, radius], node), PatchType(), ("patches",)
        if isinstance(node, ast.Attribute) and node.attr == "patches":
            base, kind = self.owner(node.value)
            if isinstance(kind, WorldType):
                return call("_all_patches", [base], node), PatchType(), ("patches",)
        value, kind = typer.expression(node)
        if isinstance(kind, PopulationType):
            return value, RowType(kind.population), ("agents", kind.population)
        if isinstance(kind, ArrayType):
            return value, kind.of, ("elements",)
        return typer.refuse(
            node, f"a for loop over {kind}", "loop over range(…), a population, an array field or patches"
        )

    def owner(self, node: ast.expr) -> Typed:
        """Return the owner of a method or attribute, if it is a value at all."""
        if isinstance(node, ast.Name) and node.id not in self.kinds:
            return node, NONE
        return self.typer.expression(node)

    def coordinate(self, node: ast.expr, axis: str) -> ast.expr:
        """Return an agent's or a patch's coordinate as a number."""
        reading = ast.copy_location(ast.Attribute(node, axis, ast.Load()), node)
        return self.typer.fitted(reading, FLOAT, f"the coordinate {axis}")


NOWHERE: Any = frozenset({"(every name)"})
"""What is assigned after a return, break or continue: nothing can be read there any more."""


def _both(one: Any, other: Any) -> Any:
    if one is NOWHERE:
        return other
    return one if other is NOWHERE else one & other


def _as_read(target: ast.expr) -> Any:
    """Return the reading of what an assignment writes."""
    made = ast.parse(ast.unparse(target), mode="eval").body
    for node in ast.walk(made):
        if isinstance(node, ast.expr):
            ast.copy_location(node, target)
    return made


def _without_docstring(body: list[ast.stmt]) -> list[ast.stmt]:
    first = body[0]
    documented = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    return body[1:] if documented and isinstance(first.value.value, str) else body  # type: ignore[attr-defined]  # an Expr


