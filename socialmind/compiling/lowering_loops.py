"""Lowering of loops: over populations, patches, messages, links, and what is found around somebody.

Each is a loop of numba's over places in tables; agents may be born and die meanwhile.
"""

from __future__ import annotations

import ast
import copy
from collections.abc import Callable, Mapping
from typing import Any, Protocol

from socialmind.compiling.counting import counted, counting_on_patches
from socialmind.compiling.pieces import name_of
from socialmind.language.syntax import parsed


class Lowering(Protocol):
    """What rewrites the rest of a rule, and knows which loops are open.

    Attributes:
        program: the model's typed rules.
        world: what the model's world says of itself.
        loops: how many loops there were until now, by which names differ.
        open: the loops over what was found that are open, from the outermost.
    """

    program: Any
    world: Any
    loops: int
    open: list[tuple[str, str, str]]

    def visit(self, node: ast.AST) -> Any:
        """Rewrite a node."""

    def generic_visit(self, node: ast.AST) -> ast.AST:
        """Rewrite what is below a node."""

    def block(self, statements: list[ast.stmt]) -> list[ast.stmt]:
        """Return statements for numba."""

    def space(self) -> list[ast.expr]:
        """Return the numbers of a world that say where its patches are."""

    def world_number(self, name: str) -> Any:
        """Return one of them."""

    def patches_asked(self, node: Any) -> tuple[str, str, list[ast.expr]]:
        """Return what patches are around whom, by whom it is asked, and with what."""


def agents(lowering: Lowering, node: ast.For, mark: tuple[Any, ...]) -> ast.For:
    """Lower a loop over a population: of its entries those that live."""
    population = mark[1]
    lowering.loops += 1
    place = f"_place_{lowering.loops}"
    head: Any = parsed(
        f"for {place} in _range(_entries_{population}(_model)):\n"
        f"    if not _is_living_{population}(_model, {place}):\n"
        f"        continue\n"
        f"    {ast.unparse(node.target)} = _entry_{population}(_model, {place})\n"
    ).body[0]
    lowering.generic_visit(node)
    head.body += node.body
    head.orelse = node.orelse
    return head


def elements(lowering: Lowering, node: ast.For, mark: tuple[Any, ...]) -> ast.For:
    """Lower a loop over a list of numbers; yes and no are kept as bytes."""
    lowering.generic_visit(node)
    if mark[1]:
        lowering.loops += 1
        byte = f"_byte_{lowering.loops}"
        value = ast.Compare(name_of(byte), [ast.NotEq()], [ast.Constant(0)])
        node.body.insert(0, ast.Assign([node.target], value))
        node.target = ast.Name(byte, ast.Store())
    return node


def patches(lowering: Lowering, node: ast.For, mark: tuple[Any, ...]) -> ast.For:
    """Lower a loop over patches: all, or those in a radius, as whole numbers."""
    lowering.generic_visit(node)
    call: Any = node.iter
    if call.func.id == "_all_patches":
        width, height = lowering.world_number("width"), lowering.world_number("height")
        node.iter = ast.Call(name_of("_range"), [ast.BinOp(width, ast.Mult(), height)], [])
    else:
        arguments = [*call.args[1:], *lowering.space()]
        node.iter = ast.Call(name_of("_patches_in_radius"), arguments, [])
    return node


def mailbox(lowering: Lowering, node: Any, mark: tuple[Any, ...]) -> list[ast.stmt]:
    """Lower a loop over messages: from the first that waits to the next, those that are alive."""
    population = mark[1]
    lowering.loops += 1
    ahead, slot = f"_ahead_{lowering.loops}", f"_message_{lowering.loops}"
    first = ast.Attribute(lowering.visit(node.iter.args[0]), f"_first_{population}", ast.Load())
    head: Any = parsed(
        f"while {ahead} >= 0:\n"
        f"    {slot} = {ahead}\n"
        f"    {ahead} = _rows_{population}(_model)[{slot}]._next\n"
        f"    if not _alive_{population}(_model)[{slot}]:\n"
        f"        continue\n"
        f"    {ast.unparse(node.target)} = _rows_{population}(_model)[{slot}]\n"
    ).body[0]
    node.iter = ast.Constant(0)
    lowering.generic_visit(node)
    head.body += node.body
    head.orelse = node.orelse
    return [ast.Assign([ast.Name(ahead, ast.Store())], first), head]


def found_loop(lowering: Lowering, node: ast.For, mark: tuple[Any, ...]) -> list[ast.stmt]:
    """Lower a loop over what is found, which stands on the stack for as long as it runs."""
    _, population, ordered, by = mark
    lowering.loops += 1
    begin, end, place = (f"_{one}_{lowering.loops}" for one in ("begin", "end", "place"))
    called: Any = node.iter
    value = lowering.visit(called.args[0])
    keep, slot = f"_{by}_keep_{population}(_model, {begin}, {end}, {ordered})", "slot"
    taken = "" if ordered or lowering.world is None else lowering.world.taken_by(population)
    if taken and value.func.id.startswith("_near_patches_"):
        if counting := None if node.orelse else counted(lowering.block(copy.deepcopy(node.body))):
            target = ast.unparse(node.target)
            return counting_on_patches(population, value, target, counting, lowering.loops)
        # In any order, and patches know who stands on them: no places in the order of birth.
        value.func.id = value.func.id.replace("_near_patches_", "_near_slots_", 1)
        keep = f"_near_keep_slots_{population}(_model, {begin}, {end})"
        slot = "slot_as_it_is"
    dead = ""
    if lowering.program is None or lowering.program.effects.may_kill(node.body, population):
        dead = (
            f"    if not _alive_{population}(_model)[_found_{lowering.loops}]:\n        continue\n"
        )
    lines = parsed(
        f"{begin} = _{by}_begin_{population}(_model)\n"
        f"{end} = FOUND\n"
        f"{keep}\n"
        f"for {place} in _range({begin}, {end}):\n"
        f"    _found_{lowering.loops} = _{by}_{slot}_{population}(_model, {place})\n"
        f"{dead}"
        f"    {ast.unparse(node.target)} = "
        f"_rows_{population}(_model)[_index(_found_{lowering.loops})]\n"
        f"_{by}_leave_{population}(_model, {begin})\n"
    ).body
    lines[1].value = value
    lowering.open.append((by, population, begin))
    lines[3].body += lowering.block(node.body)
    lowering.open.pop()
    lines[3].orelse = lowering.block(node.orelse)
    return list(lines)


def linked_loop(lowering: Lowering, node: ast.For, mark: tuple[Any, ...]) -> list[ast.stmt]:
    """Lower a loop over what is linked: a walk from link to link, which may end meanwhile."""
    asked: Any = node.iter
    _, net, side, what = asked.mark
    lowering.loops += 1
    names = ("whose", "at", "last", "born", "over")
    whose, at, last, born, over = (f"_{one}_{lowering.loops}" for one in names)
    lines = parsed(
        f"{whose} = WHO\n"
        f"{at} = {last} = -1\n"
        f"{born} = _network_born_{net}(_model)\n"
        f"{over} = False\n"
        f"while True:\n"
        f"    {at} = _network_step_{net}_{side}(_model, {whose}, {at}, {last}, {born})\n"
        f"    if {at} < 0:\n"
        f"        {over} = True\n"
        f"        break\n"
        f"    {last} = _network_link_at_{net}_{side}(_model, {whose}, {at})\n"
        f"    {ast.unparse(node.target)} = "
        f"_network_{what}_{net}_{side}(_model, {whose}, {at})\n"
        f"if {over}:\n"
        f"    pass\n"
    ).body
    lines[0].value = ast.Attribute(lowering.visit(asked.args[2]), "_slot", ast.Load())
    lines[4].body += lowering.block(node.body)
    lines[5].body += lowering.block(node.orelse)
    return list(lines[: 6 if node.orelse else 5])


def patches_loop(lowering: Lowering, node: ast.For, mark: tuple[Any, ...]) -> list[ast.stmt]:
    """Lower a loop over the patches around somebody, one number after another."""
    _, asker, (who, steps, four) = lowering.patches_asked(node.iter)
    lowering.loops += 1
    whose, reach, number = (f"_{one}_{lowering.loops}" for one in ("who", "steps", "number"))
    lines = parsed(
        f"{whose} = 0\n"
        f"{reach} = 0\n"
        f"for {number} in _range(_patches_count_{asker}(_model, {whose}, {reach}, 0)):\n"
        f"    {ast.unparse(node.target)} = "
        f"_patches_nth_{asker}(_model, {whose}, {reach}, 0, {number})\n"
    ).body
    lines[0].value, lines[1].value = who, steps
    lines[2].iter.args[0].args[3] = four
    lines[2].body[0].value.args[3] = four
    lines[2].body += lowering.block(node.body)
    lines[2].orelse = lowering.block(node.orelse)
    return list(lines)


LOOPS: Mapping[str, Callable[[Lowering, Any, tuple[Any, ...]], Any]] = {
    one.__name__: one
    for one in (agents, elements, patches, mailbox, found_loop, linked_loop, patches_loop)
}
"""By the mark of the loop."""
