"""Lowering: the tree that both speeds share, rewritten for numba.

Agents become records, patches whole numbers, the model one record; names of plans and cognitons
become look-ups in tables, so that a scheme stays data. Every function takes the model's record,
`_model`, before its own parameters.
"""

from __future__ import annotations

import ast
import copy
import itertools
from typing import Any

from socialmind.compiling.aggregates import aggregate_name
from socialmind.compiling.lowering_loops import LOOPS
from socialmind.compiling.pieces import call_of, expression, name_of
from socialmind.fields import Field, presence
from socialmind.language.program import Program, TypedFunction
from socialmind.language.shape import ModelShape

PLACES = ("x", "y")
"""The fields of an agent that are kept in the world wherever they are set."""
SPACE = ("low_x", "low_y", "width", "height", "wraps_x", "wraps_y")
"""The numbers of a world with patches that say where these are."""


def lowered(
    function: TypedFunction, shape: ModelShape | None = None, program: Program | None = None
) -> str:
    """Return the source of a function for numba.

    Args:
        function: the function.
        shape: the model's, on which it depends what is brought back where places are set.
        program: the model's typed rules, without which nobody is looked for.
    """
    tree = copy.deepcopy(function.tree)
    _note_once(tree)
    tree = _Lowering(shape, program).visit(tree)
    tree.args.args.insert(0, ast.arg("_model"))
    return ast.unparse(ast.fix_missing_locations(tree))


def _note_once(tree: ast.AST) -> None:
    """Mark the first of two assignments, to x and then y of one agent, or the other way round.

    The second begins at once and asks nobody, so it is enough that the index is told after it.
    """
    for block in ast.walk(tree):
        body = getattr(block, "body", None)
        for one, other in itertools.pairwise(body if isinstance(body, list) else ()):
            if isinstance(one, ast.Assign) and isinstance(other, ast.Assign):
                first: Any = one.targets[0]
                calls = any(isinstance(part, ast.Call) for part in ast.walk(other.value))
                if not calls and _moves(first) is not None:
                    first.goes_on = _moves(first) == _moves(other.targets[0])


def _moves(place: ast.expr) -> str | None:
    """Return the name of the agent whose x or y is stored, or None."""
    if not isinstance(place, ast.Attribute) or place.attr not in PLACES:
        return None
    own = getattr(place, "mark", ("",))[0] == "agent"
    return place.value.id if own and isinstance(place.value, ast.Name) else None


def _once(node: ast.expr) -> bool:
    """Say whether an expression may be written twice without being found twice."""
    if isinstance(node, ast.Subscript):  # a patch: `_patches(_model)[place]`
        return isinstance(node.slice, ast.Name)
    return isinstance(node, ast.Name)


def _is_text(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def _widened(value: ast.expr, field: Field) -> ast.expr:
    """Return the reading of a field; small whole numbers are read as large ones."""
    return value if field.limits is None else ast.Call(name_of("_int64"), [value], [])


class _Lowering(ast.NodeTransformer):
    """Rewrites the marked nodes of a tree, the inner ones first."""

    def __init__(self, shape: ModelShape | None, program: Program | None) -> None:
        self.program = program
        self.indexed = () if program is None else program.indexed
        self.open: list[tuple[str, str, str]] = []
        self.turns = shape is not None
        self.world = None if shape is None else shape.world
        self.loops = 0
        self.kept = 0

    def visit(self, node: ast.AST) -> Any:
        mark = getattr(node, "mark", None)
        if mark is None:
            return super().visit(node)
        if mark[0] in LOOPS:
            return LOOPS[mark[0]](self, node, mark)
        handler = getattr(self, f"lower_{mark[0]}", None)
        return super().visit(node) if handler is None else handler(node, mark)

    # Fields -----------------------------------------------------------------------------------

    def holder(self, node: ast.Attribute, mark: tuple[Any, ...]) -> ast.expr:
        """Return the record that holds a field."""
        base = self.visit(node.value)
        if mark[0] == "model":
            return name_of("_model")
        if mark[0] == "patch":
            return ast.Subscript(call_of("_patches"), base, ast.Load())
        return base

    def lower_field(self, node: ast.Attribute, mark: tuple[Any, ...]) -> ast.expr:
        made = ast.Attribute(self.holder(node, mark), node.attr, ast.Load())
        return _widened(made, mark[-1])

    lower_agent = lower_model = lower_patch = lower_field

    def lower_present(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        place: Any = node.args[0]
        field: Field = place.mark[-1]
        made = ast.Call(name_of(f"_some_{field.name}"), [self.holder(place, place.mark)], [])
        return _widened(made, field)

    def keeping(self) -> str:
        """Return the name of a fresh variable that holds a record."""
        self.kept += 1
        return f"_held_{self.kept}"

    def lower_none(self, node: ast.Compare, mark: tuple[Any, ...]) -> ast.expr:
        _, negated, is_plan = mark
        if is_plan:
            operator = ast.GtE() if negated else ast.Lt()
            return ast.Compare(self.visit(node.left), [operator], [ast.Constant(0)])
        place: Any = node.left
        holder = self.holder(place, place.mark)
        there = ast.Attribute(holder, presence(place.attr), ast.Load())
        return there if negated else ast.UnaryOp(ast.Not(), there)

    def lower_store(self, node: ast.Assign, mark: tuple[Any, ...]) -> list[ast.stmt]:
        place: Any = node.targets[0]
        field = getattr(place, "mark", (None,))[-1]
        value = self.visit(node.value)
        if isinstance(place, ast.Subscript):
            target: Any = self.generic_visit(place)
            return [ast.Assign([target], value)]
        if not isinstance(field, Field):  # a plan, which begins anew where it goes on over ticks
            holder = self.visit(place.value)
            if field is None:
                return [ast.Assign([ast.Attribute(holder, "_plan", ast.Store())], value)]
            return [ast.Expr(ast.Call(name_of(f"_begin_plan_{field}"), [value, holder], []))]
        if place.mark[0] == "agent":
            value = self.kept_within(place.mark[1], field.name, value)
        holder = self.holder(place, place.mark)
        if place.mark[0] == "agent" and place.mark[1] in self.indexed and field.name in PLACES:
            if getattr(place, "goes_on", False):
                return [ast.Assign([ast.Attribute(holder, place.attr, ast.Store())], value)]
            kept = self.keeping()
            return [
                ast.Assign([ast.Name(f"{kept}_value", ast.Store())], value),
                ast.Assign([ast.Name(kept, ast.Store())], holder),
                ast.Assign(
                    [ast.Attribute(name_of(kept), place.attr, ast.Store())],
                    name_of(f"{kept}_value"),
                ),
                ast.Expr(call_of(f"_near_moved_{place.mark[1]}", name_of(kept))),
            ]
        if not field.optional:
            return [ast.Assign([ast.Attribute(holder, place.attr, ast.Store())], value)]
        lines: list[ast.stmt] = []
        if not _once(holder):
            kept = self.keeping()
            # The value is found before the place, as in Python.
            lines = [
                ast.Assign([ast.Name(f"{kept}_value", ast.Store())], value),
                ast.Assign([ast.Name(kept, ast.Store())], holder),
            ]
            holder, value = name_of(kept), name_of(f"{kept}_value")
        if mark[1]:
            value = ast.Constant(field.kind(0))
        there = ast.Attribute(holder, presence(place.attr), ast.Store())
        return [
            *lines,
            ast.Assign([ast.Attribute(holder, place.attr, ast.Store())], value),
            ast.Assign([there], ast.Constant(not mark[1])),
        ]

    def kept_within(self, population: str, name: str, value: ast.expr) -> ast.expr:
        """Return a new place or heading as agents keep it (`rows` has the interpreted twin)."""
        keeping = () if self.world is None else self.world.kept_within(population, name)
        if keeping:
            return ast.Call(name_of(keeping[0]), [value, *map(expression, keeping[1:])], [])
        if self.turns and name == "heading":
            return ast.Call(name_of("_turned"), [value], [])
        return value

    def visit_Constant(self, node: ast.Constant) -> ast.expr:
        is_nan = isinstance(node.value, float) and node.value != node.value
        return name_of("_nan") if is_nan else node

    def lower_choice(self, node: ast.AST, mark: tuple[Any, ...]) -> ast.expr:
        return ast.Constant(mark[1])

    # The model and its world ------------------------------------------------------------------

    def lower_tick(self, node: ast.AST, mark: tuple[Any, ...]) -> ast.expr:
        return expression("_model._tick")

    def lower_population(self, node: ast.AST, mark: tuple[Any, ...]) -> ast.expr:
        return name_of("_model")

    lower_world = lower_population

    def lower_world_number(self, node: ast.AST, mark: tuple[Any, ...]) -> ast.expr:
        return self.world_number(mark[1])

    def world_number(self, name: str) -> Any:
        """Return how compiled code finds a number of the world."""
        return expression(self.world.numbers[name])  # type: ignore[union-attr]  # rules of a world

    def space(self) -> list[ast.expr]:
        """Return where the patches are, as the functions that look for them take it."""
        return [self.world_number(name) for name in SPACE]

    def lower_patch_place(self, node: ast.Attribute, mark: tuple[Any, ...]) -> ast.expr:
        operator: ast.operator = ast.FloorDiv() if mark[1] == "x" else ast.Mod()
        place = ast.BinOp(self.visit(node.value), operator, self.world_number("height"))
        return ast.BinOp(place, ast.Add(), self.world_number(f"low_{mark[1]}"))

    def lower_patch_at(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        arguments = [self.visit(argument) for argument in node.args]
        return ast.Call(name_of("_patch_index"), [*arguments, *self.space()], [])

    def lower_world_call(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        """Lower a call of the world's by a function of its name; texts are part of the name."""
        arguments = [self.visit(one) for one in node.args if not _is_text(one)]
        return call_of("_".join(("_world", *mark[1:])), *arguments)

    def lower_element(self, node: ast.expr, mark: tuple[Any, ...]) -> Any:
        """Lower an element of an array; truth values are bytes there."""
        made: Any = self.generic_visit(node)
        return ast.Compare(made, [ast.NotEq()], [ast.Constant(0)]) if mark[1] else made

    # Agents -----------------------------------------------------------------------------------

    def lower_id(self, node: ast.Attribute, mark: tuple[Any, ...]) -> ast.expr:
        return ast.Attribute(self.visit(node.value), f"_{mark[0]}", ast.Load())

    lower_plan = lower_id

    def lower_plan_ended(self, node: ast.Attribute, mark: tuple[Any, ...]) -> ast.expr:
        step = ast.Attribute(self.visit(node.value), "_step", ast.Load())
        return ast.Compare(step, [ast.Lt()], [ast.Constant(0)])

    def lower_no_plan(self, node: ast.AST, mark: tuple[Any, ...]) -> ast.expr:
        return ast.Constant(-1)

    def lower_name(self, node: ast.AST, mark: tuple[Any, ...]) -> ast.expr:
        return ast.Subscript(call_of(f"_names_{mark[1]}"), ast.Constant(mark[2]), ast.Load())

    def lower_agent_of(self, node: ast.Subscript, mark: tuple[Any, ...]) -> ast.expr:
        return call_of(f"_agent_{mark[1]}", self.visit(node.slice))

    def lower_count(self, node: ast.AST, mark: tuple[Any, ...]) -> ast.expr:
        return call_of(f"_living_{mark[1]}")

    def lower_method(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        """Lower what an agent or a population does by a function of the same name."""
        arguments = [self.visit(argument) for argument in node.args]
        alone = ("create", "one_of", "contains", "send")
        owner = [] if mark[0] in alone else [self.visit(node.func.value)]
        if mark[0] == "run_plan":
            arguments = arguments[1:]  # the model goes first anyway
        return call_of(f"_{mark[0]}_{mark[1]}", *owner, *arguments)

    lower_die = lower_hatch = lower_create = lower_one_of = lower_contains = lower_method
    lower_run_plan = lower_reconsider_plan = lower_send = lower_method

    def lower_network(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        """Lower what a network is asked by a function of the same name."""
        return call_of(f"_network_{mark[2]}_{mark[1]}", *map(self.visit, node.args))

    def lower_count_linked(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        of: Any = node.args[0]
        return call_of(f"_network_degree_{'_'.join(of.mark[1:3])}", self.visit(of.args[2]))

    def lower_one_linked(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        of = node.func.value
        who, rng = self.visit(of.args[2]), self.visit(node.args[0])
        return call_of(f"_network_one_{'_'.join(of.mark[1:])}", who, rng)

    def lower_link_end(self, node: ast.Attribute, mark: tuple[Any, ...]) -> ast.expr:
        return call_of(f"_link_{mark[2]}_{mark[1]}", self.visit(node.value))

    def lower_link_other(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        link, agent = self.visit(node.func.value), self.visit(node.args[0])
        return call_of(f"_link_other_{mark[1]}{mark[2]}", link, agent)

    def lower_aggregate(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        population, what, field = mark[1:]
        return call_of(aggregate_name(population, what, field))

    def lower_mind(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        """Lower a mind or a hierarchy, or what it is asked by a function of the same name."""
        if isinstance(node, ast.Attribute):
            # A hierarchy is reached by the number of its agent.
            agent = self.visit(node.value)
            return ast.Attribute(agent, "_slot", ast.Load()) if mark[0] == "hierarchy" else agent
        kind, population, method, places = mark
        arguments = [
            self.visit(argument)
            if place is None
            else self.lower_name(node, ("name", population, place))
            for argument, place in zip(node.args, places, strict=True)
        ]
        return call_of(f"_{kind}_{method}_{population}", self.visit(node.func.value), *arguments)

    lower_hierarchy = lower_mind

    def lower_imitation(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        _, command, (learner, other), places = mark
        names = [
            self.lower_name(node, ("name", population, place))
            for population, place in zip((learner, other), places, strict=False)
        ]
        agents = self.visit(node.func.value), self.visit(node.args[-1])
        return call_of(f"_{command}_{learner}_{other}", *agents, *names)

    def lower_outcome(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        *sides, stream = (self.visit(argument) for argument in node.args)
        records = [
            ast.Subscript(call_of("_patches"), side, ast.Load()) if patch else side
            for side, patch in zip(sides, mark[2], strict=True)
        ]
        return call_of(f"_outcome_{mark[1]}", *records, stream)

    def lower_draw(self, node: Any, mark: tuple[Any, ...]) -> ast.expr:
        arguments = [self.visit(argument) for argument in node.args]
        if mark[1:] == ("integers", 1):
            arguments.insert(0, ast.Constant(0))
        stream = self.visit(node.func.value)
        return ast.Call(name_of(f"_rng_{mark[1]}"), [stream, *arguments], [])

    def lower_helper(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        made = call_of(mark[1], *[self.visit(argument) for argument in node.args])
        made.keywords = [ast.keyword(one.arg, self.visit(one.value)) for one in node.keywords]
        return made

    # Neighbours -------------------------------------------------------------------------------

    def lower_nobody(self, node: ast.AST, mark: tuple[Any, ...]) -> ast.expr:
        return ast.Constant(-1)

    def lower_perhaps(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        """An agent that may be None is the number of its slot, or −1."""
        return ast.Attribute(self.visit(node.args[0]), "_slot", ast.Load())

    def lower_agent_there(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        return call_of(f"_there_{mark[1]}", self.visit(node.args[0]))

    def lower_none_agent(self, node: ast.Compare, mark: tuple[Any, ...]) -> ast.expr:
        operator = ast.GtE() if mark[1] else ast.Lt()
        return ast.Compare(self.visit(node.left), [operator], [ast.Constant(0)])

    def lower_found(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        """Lower the looking for agents; it gives where they end on the stack of what is found."""
        _, population, what, asker = mark
        if what in ("members", "asking"):
            group = self.lower_name(node, ("name", population, asker))
            return call_of(f"_{what}_of_{population}", group, self.visit(node.args[2]))
        arguments = [self.visit(argument) for argument in node.args[1:]]
        if what == "near":
            return call_of(f"_near_{population}_{asker}", *arguments)
        steps = arguments[1] if what == "neighbours" else ast.Constant(int(what == "neighbours4"))
        kind = ast.Constant({"on": 0, "neighbours": 8, "neighbours4": 4}[what])
        return call_of(f"_near_patches_{population}_{asker}", arguments[0], steps, kind)

    def lower_nearest(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        arguments = [self.visit(argument) for argument in node.args[1:]]
        radius = arguments[1:] or [expression("np.inf")]
        return call_of(f"_near_first_{mark[1]}_{mark[2]}", arguments[0], *radius)

    def lower_count_found(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        return ast.BinOp(
            self.visit(node.args[0]), ast.Sub(), call_of(f"_{mark[2]}_begin_{mark[1]}")
        )

    def lower_one_found(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        return call_of(f"_{mark[2]}_one_{mark[1]}", *[self.visit(one) for one in node.args])

    def block(self, statements: list[ast.stmt]) -> list[ast.stmt]:
        """Return statements for numba."""
        made = ast.Module(statements, [])
        self.generic_visit(made)
        return made.body

    def patches_asked(self, node: Any) -> tuple[str, str, list[ast.expr]]:
        """Return what patches are around whom, by whom it is asked, and with what."""
        _, what, asker = node.mark
        who, *numbers = [self.visit(argument) for argument in node.args]
        if what == "in_radius":
            return what, asker, [who, *numbers]
        four = what == "neighbours4"
        return what, asker, [who, *(numbers or [ast.Constant(1)]), ast.Constant(int(four))]

    def lower_count_patches(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        what, asker, arguments = self.patches_asked(node.args[0])
        name = "within" if what == "in_radius" else "count"
        return call_of(f"_patches_{name}_{asker}", *arguments)

    def lower_one_patch(self, node: ast.Call, mark: tuple[Any, ...]) -> ast.expr:
        what, asker, arguments = self.patches_asked(node.args[0])
        name = "one_within" if what == "in_radius" else "one"
        return call_of(f"_patches_{name}_{asker}", *arguments, self.visit(node.args[1]))

    def visit_Return(self, node: ast.Return) -> Any:
        """Leave the loops over what was found that a function returns from."""
        if not self.open:
            return self.generic_visit(node)
        outermost: dict[tuple[str, str], str] = {}
        for by, population, begin in self.open:
            outermost.setdefault((by, population), begin)
        lines: list[ast.stmt] = []
        value = None if node.value is None else self.visit(node.value)
        if value is not None:
            lines.append(ast.Assign([ast.Name("_result", ast.Store())], value))
            value = name_of("_result")
        for (by, population), begin in outermost.items():
            lines.append(ast.Expr(call_of(f"_{by}_leave_{population}", name_of(begin))))
        return [*lines, ast.Return(value)]
