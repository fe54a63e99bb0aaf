"""Loops that only count agents on patches around: they count while they look, and guess nothing.

What is found need not be pushed on a stack first, and a condition is added as 0 or 1 rather than
jumped over: whether the next patch is taken, and by whom, is what processors guess wrong.
"""

from __future__ import annotations

import ast
from typing import Any

from socialmind.language.syntax import parsed

WIDENED = "_int64"


def counted(body: list[ast.stmt]) -> tuple[str, ast.expr] | None:
    """Return what a loop's body counts and when, or None where it does anything else.

    Args:
        body: for numba, as `found = _add_int(found, _as_int(condition))` or with 1 in its place.
            The condition calls nothing, so it can be asked of whomever; and no count of agents
            goes beyond 64 bits.
    """
    only = body[0]
    if len(body) != 1 or not isinstance(only, ast.Assign):
        return None
    target, sum_of = only.targets[0], only.value
    if not isinstance(sum_of, ast.Call) or not _calls(sum_of, "_add_int"):
        return None
    before, added = sum_of.args
    if not isinstance(target, ast.Name) or not isinstance(before, ast.Name):
        return None
    if target.id != before.id:
        return None
    if isinstance(added, ast.Constant) and added.value == 1:
        return target.id, ast.Constant(True)
    if not isinstance(added, ast.Call) or not _calls(added, "_as_int"):
        return None
    condition = added.args[0]
    if not isinstance(condition, ast.Compare):
        return None
    for part in ast.walk(condition):
        if isinstance(part, ast.Call) and not _calls(part, WIDENED, "_rows"):
            return None
        # A division may fail; and what is counted may not be what the condition asks.
        if isinstance(part, ast.BinOp) or (isinstance(part, ast.Name) and part.id == target.id):
            return None
    return target.id, condition


def _calls(node: Any, *names: str) -> bool:
    """Say whether a node calls one of some functions."""
    return isinstance(node, ast.Call) and getattr(node.func, "id", None) in names


def counting_on_patches(
    population: str, asked: ast.Call, other: str, what: tuple[str, ast.expr], number: int
) -> list[ast.stmt]:
    """Return the loop that counts agents where patches say who stands on them.

    Args:
        population: whose agents.
        asked: the looking for them, `_near_patches_<population>_<asker>(_model, who, steps, kind)`.
        other: the variable that holds an agent.
        what: as `counted` gives it.
        number: tells the loop's variables from others.
    """
    asker = str(asked.func.id).removeprefix("_near_patches_")  # type: ignore[attr-defined]
    name, condition = what
    who, kind, area, column, row, slot, asked_for = (
        f"_{one}_{number}" for one in ("who", "kind", "area", "column", "row", "found", "asked")
    )
    lines: list[Any] = parsed(
        f"{who} = 0\n"
        f"{kind} = 0\n"
        f"{area} = _near_area_{asker}(_model, {who}, 0)\n"
        f"for {column} in _range({area}[1]):\n"
        f"    for {row} in _range({area}[4]):\n"
        f"        {slot}, {asked_for} = "
        f"_near_standing_{asker}(_model, {who}, {kind}, {area}, {column}, {row})\n"
        # Where nobody stands the condition is asked of anybody: there is nothing to guess.
        f"        {other} = _rows_{population}(_model)[_index({slot})]\n"
        f"        {name} = {name} + ({asked_for} & CONDITION)\n"
    ).body
    lines[0].value, lines[2].value.args[2], lines[1].value = asked.args[1:]
    lines[3].body[0].body[-1].value.right.right = condition
    return lines
