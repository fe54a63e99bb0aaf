"""The receipt of a decision as a table to read."""

from __future__ import annotations

from itertools import groupby
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from coglogo_py.receipts.receipt import Influence, Receipt

WIDTH = 100


def table(receipt: Receipt) -> str:
    """Return the receipt as lines of text: contributions, weights, probabilities, the choice.

    Plans are columns; where they do not fit in 100 characters, they continue in further blocks.
    """
    bias = "" if receipt.bias is None else f" {receipt.bias:g}"
    lines = [
        f"Decision {receipt.decision} of mind {receipt.mind}, scheme {receipt.scheme!r}, "
        f"{receipt.decision_maker}{bias}"
    ]
    first = [["", "value"], *([label, value] for label, value in _rows(receipt))]
    first += [["weight", ""], ["probability", ""]]
    columns = [_column(receipt, position) for position in range(len(receipt.plans))]
    for block in _blocks(first, columns):
        lines += block
    lines += _closed_plans(receipt)
    lines.append(f"draw: {receipt.draw:.6g}, choice: {receipt.choice or 'no plan is available'}")
    lines.append(_change(receipt))
    return "\n".join(lines)


def _rows(receipt: Receipt) -> list[tuple[str, str]]:
    """Return the label and value of every cogniton and culturon, and a heading for each group."""
    rows = []
    for group, influences in groupby(receipt.influences, key=lambda influence: influence.group):
        members = list(influences)
        if group is not None:
            inside = members[0].participation
            state = "not a member" if inside is None else f"participation {inside:g}"
            rows.append((f"{group} ({state})", ""))
        rows += [("  " * (group is not None) + i.name, _value(i)) for i in members]
    return rows


def _value(influence: Influence) -> str:
    if influence.value is None:
        return "inactive" if influence.group is None else "-"
    return f"{influence.value:.6g}" + ("" if influence.acts else " (other role)")


def _column(receipt: Receipt, position: int) -> list[str]:
    """Return the cells of one plan, below its name."""
    plan = receipt.plans[position]
    cells = [plan.name]
    for group, influences in groupby(receipt.influences, key=lambda influence: influence.group):
        cells += [""] * (group is not None)
        for influence in influences:
            contribution = influence.contributions[position]
            cells.append(f"{contribution:+.6g}" if contribution else ".")
    if plan.weight is None:
        return [*cells, "closed", ""]
    return [*cells, f"{plan.weight:.6g}", f"{plan.probability:.4g}"]


def _blocks(first: list[list[str]], columns: list[list[str]]) -> list[list[str]]:
    """Return the aligned lines, in as many blocks as the width needs."""
    labels = max(len(row[0]) for row in first)
    values = max(len(row[1]) for row in first)
    starts = [f"{row[0]:<{labels}}  {row[1]:>{values}}" for row in first]
    blocks = []
    lines = list(starts)
    for column in columns:
        width = max(len(cell) for cell in column)
        if len(lines[0]) + 2 + width > WIDTH and lines != starts:
            blocks.append(lines)
            lines = list(starts)
        lines = [f"{line}  {cell:>{width}}" for line, cell in zip(lines, column, strict=True)]
    blocks.append(lines)
    return [[line.rstrip() for line in block] for block in blocks]


def _closed_plans(receipt: Receipt) -> list[str]:
    """Return, for every plan that is not available, what would open it."""
    lines = []
    for plan in receipt.plans:
        if not plan.available:
            opening = " or ".join(plan.would_open)
            lines.append(
                f"{plan.name} is not available: it takes {opening}"
                if opening
                else f"{plan.name} is not available: no conditional link leads to it"
            )
    return lines


def _change(receipt: Receipt) -> str:
    change = receipt.smallest_change
    if change is None:
        return "No change of one cogniton's value changes the most probable plan."
    search = "" if change.exact else " (found by search: a smaller change may do)"
    shown = f"{change.new_value:.6g}"
    if (change.new_value - float(shown)) * change.change > 0:
        shown = f"just beyond {shown}"
    return (
        f"Smallest change: {change.cogniton} from {change.value:.6g} to {shown} "
        f"({change.change:+.6g}) makes {change.plan} the most probable{search}."
    )
