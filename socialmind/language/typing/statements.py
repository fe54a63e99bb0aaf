"""Typing of statements: assignments, conditions, loops, and which variables have a value where."""

from __future__ import annotations

import ast
from collections.abc import Callable
from typing import Any

from socialmind.fields import Field
from socialmind.language import types
from socialmind.language.nodes import call, constant, marked
from socialmind.language.source import RuleSource
from socialmind.language.typing.expressions import ExpressionTyper
from socialmind.language.typing.loops import NOWHERE, both, for_loop, while_loop


class FunctionTyper:
    """Types one function for given types of its parameters.

    Variables may be met before their final type is known (`total = 0`, then `total += 0.5`), so
    the body is walked again until no type changes; the last walk gives the tree.

    Args:
        program: the program that the function becomes part of.
        source: the function.
        kinds: the types of its parameters.
    """

    def __init__(self, program: Any, source: RuleSource, kinds: tuple[types.AnyType, ...]) -> None:
        self.program = program
        self.source = source
        self.parameters = dict(zip(source.parameters, kinds, strict=True))
        self.kinds: dict[str, types.AnyType] = dict(self.parameters)
        self.result: types.AnyType | None = None
        self.in_any_order: frozenset[ast.AST] = getattr(source.tree, "in_any_order", frozenset())

    def typed(self) -> tuple[list[ast.stmt], types.AnyType]:
        """Return the body as both speeds run it, and the type of what it returns."""
        while True:
            before = (dict(self.kinds), self.result)
            self.typer = ExpressionTyper(self.program, self.source)
            self.typer.variables = self.kinds
            self.typer.assigned = set(self.parameters)
            self.breaks: list[Any] = []
            self.counters: frozenset[str] = frozenset()
            self.keeps = 0
            self.nobodies: dict[str, ast.expr] = {}
            body = self.block(_without_docstring(self.source.tree.body))
            fell_through = self.typer.assigned is not NOWHERE
            if before == (self.kinds, self.result):
                break
        for name, node in self.nobodies.items():
            if self.kinds[name] == types.NOBODY:
                self.typer.expression(node)  # refuses None where no agent may be
        body = self.promoted() + body
        if self.result is None:
            return body, types.NONE
        if fell_through and self.result != types.NONE:
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
            handler: Callable[[ast.stmt], ast.stmt | list[ast.stmt]] | None = getattr(
                self, f"_on_{type(statement).__name__.lower()}", None
            )
            if handler is None:
                self.typer.refuse_syntax(statement)
            made = handler(statement)
            result.extend(made if isinstance(made, list) else [made])
            if self.typer.assigned is NOWHERE:
                break  # what follows a return, break or continue never runs
        return result or [ast.Pass()]

    def _on_pass(self, node: ast.Pass) -> ast.stmt:
        return ast.copy_location(ast.Pass(), node)

    def _on_expr(self, node: ast.Expr) -> ast.stmt:
        if isinstance(node.value, ast.Constant):
            return ast.copy_location(ast.Pass(), node)
        value, _ = self.typer.expression(node.value)
        if not (isinstance(node.value, ast.Call) and isinstance(value, ast.Call)):
            self.typer.refuse(node, "a value that is not used", "assign it, or remove the line")
        return ast.copy_location(ast.Expr(value), node)

    def _on_return(self, node: ast.Return) -> ast.stmt:
        written = node.value
        if written is None or _is_none(written):
            none = None
            if isinstance(self.returned(types.NONE, node), types.MaybeRowType):
                none = marked(constant(None, node), ("nobody",))
            return ast.copy_location(ast.Return(none), node)
        value, kind = self.typer.there(written)
        if isinstance(kind, types.TableType):
            self.typer.refuse(node, f"{kind} returned", "use the constant where it is needed")
        if isinstance(kind, types.TextType) or (
            isinstance(kind, types.TupleType)
            and any(isinstance(item, types.TextType) for item in kind.items)
        ):
            self.typer.refuse(node, "a text returned", "set the plan where it is chosen")
        wanted = self.returned(kind, node)
        value = self.typer.converted(value, kind, wanted, "the result", written)
        return ast.copy_location(ast.Return(value), node)

    def returned(self, kind: types.AnyType, node: ast.Return) -> types.AnyType:
        """Note that the function returns a type; return the one that holds all it returns."""
        wanted = kind if self.result is None else types.unified(self.result, kind)
        if wanted is None:
            self.typer.refuse(
                node,
                f"{kind} returned, where another line returns {self.result}",
                "return the same type everywhere (-1 for 'none' among whole numbers)",
            )
        self.result = wanted
        self.typer.assigned = NOWHERE
        return wanted

    # Assignments ------------------------------------------------------------------------------

    def _on_assign(self, node: ast.Assign) -> ast.stmt | list[ast.stmt]:
        if len(node.targets) == 1:
            return self.assignment(node.targets[0], node.value, node)
        before, value = self.kept(node.value)
        return [*before, *(self.assignment(target, value, node) for target in node.targets)]

    def _on_annassign(self, node: ast.AnnAssign) -> ast.stmt | list[ast.stmt]:
        if node.value is None:
            self.typer.refuse(node, "a declaration without a value", "give it a value")
        wanted = _ANNOTATIONS.get(ast.unparse(node.annotation))
        if wanted is None or not isinstance(node.target, ast.Name):
            return self.assignment(node.target, node.value, node)
        value = self.typer.fitted(node.value, wanted, f"a variable declared as {wanted}")
        return self.stored_in_variable(node.target, value, wanted, node)

    def _on_augassign(self, node: ast.AugAssign) -> ast.stmt | list[ast.stmt]:
        before, target = self.steadied(node.target)
        value = ast.copy_location(ast.BinOp(target, node.op, node.value), node)
        return [*before, self.assignment(target, value, node)]

    def steadied(self, place: ast.expr) -> tuple[list[ast.stmt], ast.expr]:
        """Return a place whose parts are found once, and the lines that find them before.

        `model.humans.one_of(rng).wheat += 1` reads and writes the same agent, and draws one number.
        """
        if isinstance(place, ast.Name | ast.Constant):
            return [], place
        if isinstance(place, ast.Attribute):
            before, owner = self.steadied(place.value)
            return before, ast.copy_location(ast.Attribute(owner, place.attr, ast.Load()), place)
        if isinstance(place, ast.Subscript) and not isinstance(place.slice, ast.Slice):
            before, owner = self.steadied(place.value)
            if isinstance(self.typer.expression(owner)[1], types.ArrayType):
                more, index = self.kept(place.slice)
                new = ast.copy_location(ast.Subscript(owner, index, ast.Load()), place)
                return before + more, new
        return self.kept(place)

    def kept(self, value: ast.expr) -> tuple[list[ast.stmt], ast.expr]:
        """Return a value that is found once, and the line that keeps it in a variable."""
        if isinstance(value, ast.Name | ast.Constant):
            return [], value
        typed, kind = self.typer.there(value)
        self.keeps += 1
        name = f"_kept_{self.keeps}"
        self.kinds[name] = kind
        self.typer.assigned = self.typer.assigned | {name}
        line = ast.Assign([ast.Name(name, ast.Store())], typed)
        kept = ast.copy_location(ast.Name(name, ast.Load()), value)
        return [ast.fix_missing_locations(ast.copy_location(line, value))], kept

    def assignment(self, target: ast.expr, value: ast.expr, node: ast.stmt) -> ast.stmt:
        """Return one assignment."""
        if isinstance(target, ast.Name) and _is_none(value):
            if self.kinds.get(target.id, types.NOBODY) in types.NUMBERS:
                self.typer.expression(value)  # refuses it
            self.nobodies[target.id] = value
            made = marked(constant(None, value), ("nobody",))
            return self.stored_in_variable(target, made, types.NOBODY, node)
        if isinstance(target, ast.Name):
            return self.stored_in_variable(target, *self.typer.there(value), node)
        if isinstance(target, ast.Tuple):
            return self.several(target, value, node)
        place, kind, what = self.place(target)
        return self.stored(place, kind, what, value, node)

    def stored_in_variable(
        self, target: ast.Name, value: ast.expr, kind: types.AnyType, node: ast.stmt
    ) -> ast.stmt:
        """Return the assignment of a typed value to a variable."""
        value = self.bound(target.id, value, kind, node)
        place = ast.copy_location(ast.Name(target.id, ast.Store()), target)
        return ast.copy_location(ast.Assign([place], value), node)

    def bound(self, name: str, value: ast.expr, kind: types.AnyType, node: ast.stmt) -> ast.expr:
        """Give a variable a value; its type is one that holds all its values."""
        if kind == types.NONE:
            self.typer.refuse(
                node, f"{name!r} from a call that returns nothing", "call it on its own line"
            )
        if isinstance(kind, types.FoundType | types.PatchesType):
            self.typer.refuse(
                node,
                f"{kind} as the variable {name!r}",
                "write it where it is used: `for other in …`, `len(…)`, `….one_of(rng)`",
            )
        if isinstance(kind, types.TextType | types.TupleType | types.ArrayType | types.TableType):
            self.typer.refuse(
                node,
                f"{kind} as the variable {name!r}",
                "take it apart: `x, y = …`"
                if isinstance(kind, types.TupleType)
                else "write it where it is used, or use a field",
            )
        if name.startswith("_") and name != "_":
            self.typer.refuse(node, f"the variable {name!r}", "leave the leading underscore out")
        if name in self.counters:
            self.typer.refuse(
                node, f"a new value for {name!r}, which counts in a for loop", "use another name"
            )
        before = self.kinds.get(name)
        wanted = kind if before is None else types.unified(before, kind)
        if wanted is None and name in self.nobodies:
            self.typer.expression(self.nobodies[name])  # refuses None beside numbers
        if wanted is None:
            self.typer.refuse(
                node, f"{kind} for {name!r}, which is {before} elsewhere", "use another name"
            )
        self.kinds[name] = wanted
        self.typer.assigned = self.typer.assigned | {name}
        return self.typer.converted(value, kind, wanted, f"the variable {name!r}", node)

    def several(self, target: ast.Tuple, value: ast.expr, node: ast.stmt) -> ast.stmt:
        """Return `x, y = y, x`, or the taking apart of what a function returns."""
        typed, kind = self.typer.expression(value)
        if not isinstance(kind, types.TupleType) or len(kind.items) != len(target.elts):
            self.typer.refuse(
                node,
                f"{kind} for {len(target.elts)} variables",
                "give each variable one value",
            )
        places: list[ast.expr] = []
        wanted: list[types.AnyType] = []
        for place, item in zip(target.elts, kind.items, strict=True):
            if not isinstance(place, ast.Name):
                self.typer.refuse(
                    node, "fields on the left of several assignments", "assign them one by one"
                )
            self.bound(place.id, constant(0, node), item, node)
            wanted.append(self.kinds[place.id])
            places.append(ast.copy_location(ast.Name(place.id, ast.Store()), place))
        typed = self.typer.converted(typed, kind, types.TupleType(tuple(wanted)), "these", node)
        left = ast.copy_location(ast.Tuple(places, ast.Store()), target)
        return ast.copy_location(ast.Assign([left], typed), node)

    def place(self, target: ast.expr) -> tuple[ast.expr, types.AnyType, str]:
        """Return where a field or an element is stored, its type and what to call it."""
        if not isinstance(target, ast.Attribute | ast.Subscript):
            self.typer.refuse_syntax(target)
        if isinstance(target, ast.Subscript):
            _, held = self.typer.several(target.value)
            if isinstance(held, types.TableType | types.TupleType):
                advice = "constants stay as they are; declare an array field for what changes"
                self.typer.refuse(target, f"a new value for a place of {held}", advice)
        reading, kind = self.typer.expression(target)
        if isinstance(reading, ast.Attribute):
            mark: tuple[str, ...] = getattr(reading, "mark", ("other",))
            if mark[0] == "model" and reading.attr in self.program.shape.parameters:
                self.typer.refuse(
                    target,
                    f"a new value for the parameter {reading.attr!r}",
                    "parameters stay as they are in a run; declare a variable of the model",
                )
            if mark[0] not in ("agent", "model", "patch", "plan"):
                self.typer.refuse(target, f"a new value for {reading.attr!r}", "it cannot be set")
            if isinstance(kind, types.ArrayType):
                self.typer.refuse(
                    target,
                    f"a new value for the whole array {reading.attr!r}",
                    "set its places one by one",
                )
            if mark[0] == "agent":
                self.program.effects.changes(mark[1])
                instead = self.program.shape.world.instead_of_setting(mark[1], reading.attr)
                if instead is not None:
                    self.typer.refuse(target, f"a new value for {reading.attr!r} alone", instead)
            reading.ctx = ast.Store()
            return reading, kind, f"the field {reading.attr!r}"
        if not isinstance(reading, ast.Subscript) or isinstance(kind, types.RowType):
            self.typer.refuse(target, "this on the left of =", "assign to a variable or a field")
        reading.ctx = ast.Store()
        return reading, kind, "the array"

    def stored(
        self, place: ast.expr, kind: types.AnyType, what: str, value: ast.expr, node: ast.stmt
    ) -> ast.stmt:
        """Return the storing of a value in a field or an element."""
        none = isinstance(value, ast.Constant) and value.value is None
        mark = getattr(place, "mark", ("other",))
        made: ast.expr
        if isinstance(kind, types.PlanType):
            made = self.plan_value(kind, value, what, none)
        elif none:
            if not isinstance(kind, types.OptionalType):
                self.typer.refuse(
                    node,
                    f"None for {what}, which is {kind}",
                    "declare it as `… | None`, or give it a number",
                )
            made = constant(None, value)
        else:
            target = kind.of if isinstance(kind, types.OptionalType) else kind
            made = self.typer.fitted(value, target, what)
            field = mark[-1] if isinstance(mark[-1], Field) else None
            if field is not None and field.limits is not None:
                low, high = field.limits
                made = call("_fitting", [made, constant(low, node), constant(high, node)], node)
        new = ast.copy_location(ast.Assign([place], made), node)
        return marked(new, ("store", none))

    def plan_value(self, kind: types.PlanType, value: ast.expr, what: str, none: bool) -> ast.expr:
        """Return what may be stored as an agent's plan: a plan, a plan's name or None."""
        if none:
            return marked(constant(None, value), ("no_plan",))
        made, found = self.typer.expression(value)
        if isinstance(found, types.TextType):
            return self.typer.plan_name(value, found, kind.population)
        if found != kind:
            self.typer.refuse(
                value, f"{found} for {what}", "give it a plan's name, or what a mind chose"
            )
        return made

    # Conditions and loops ---------------------------------------------------------------------

    def _on_if(self, node: ast.If) -> ast.stmt:
        test = self.typer.truth(node.test)
        before = self.typer.assigned
        body = self.block(node.body)
        after_body = self.typer.assigned
        self.typer.assigned = before
        orelse = self.block(node.orelse) if node.orelse else []
        self.typer.assigned = both(after_body, self.typer.assigned)
        return ast.copy_location(ast.If(test, body, orelse), node)

    _on_while = while_loop
    _on_for = for_loop

    def _on_break(self, node: ast.Break) -> ast.stmt:
        self.breaks[-1] = both(self.breaks[-1], self.typer.assigned)
        self.typer.assigned = NOWHERE
        return ast.copy_location(ast.Break(), node)

    def _on_continue(self, node: ast.Continue) -> ast.stmt:
        self.typer.assigned = NOWHERE
        return ast.copy_location(ast.Continue(), node)


_ANNOTATIONS: dict[str, types.AnyType] = {
    "float": types.FLOAT,
    "int": types.INT,
    "bool": types.BOOL,
}
"""The annotations of variables that are heeded; others say nothing to the typing."""


def _is_none(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None


def _without_docstring(body: list[ast.stmt]) -> list[ast.stmt]:
    first = body[0]
    if isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant):
        return body[1:] if isinstance(first.value.value, str) else body
    return body
