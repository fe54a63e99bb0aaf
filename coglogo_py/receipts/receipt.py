"""The receipt of a decision: all that a mind's next decision is made of, as data and as a table."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from html import escape
from itertools import groupby
from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py import kernel
from coglogo_py.arrays import Floats
from coglogo_py.receipts.counterfactual import Change, Line, smallest_change

if TYPE_CHECKING:  # a circle for types alone: a mind gives its receipt
    from coglogo_py.mind import Mind

WIDTH = 100
"""Characters of a line of a receipt's table."""


@dataclass(frozen=True)
class Influence:
    """What one cogniton or culturon does to the plans."""

    name: str
    group: str | None
    """The group of a culturon, None for a cogniton."""
    value: float | None
    """None: an inactive cogniton, or a culturon of a group that the mind is not in."""
    participation: float | None
    """The mind's participation in the culturon's group, None outside it and for cognitons."""
    acts: bool
    """Whether it counts: an active cogniton, or a culturon of the role that the mind plays."""
    contributions: tuple[float, ...]
    """To the weight of each plan, in the order of the receipt's plans; 0 when it does not act."""
    opens: tuple[str, ...]
    """The plans that its conditional links lead to."""

    def __str__(self) -> str:
        if self.group is None:
            return f"cogniton {self.name!r}"
        return f"culturon {self.name!r} of group {self.group!r}"


@dataclass(frozen=True)
class PlanPart:
    """What one plan's part in the decision is."""

    name: str
    weight: float | None
    """None: the plan is not available."""
    probability: float
    """Exact, under the scheme's decision maker; 0 when the plan is not available."""
    opened_by: tuple[str, ...]
    """The cognitons and culturons that make it available."""
    would_open: tuple[str, ...]
    """When it is not available: the cognitons and culturons that would open it if they acted."""

    @property
    def available(self) -> bool:
        """Whether the plan can be chosen."""
        return self.weight is not None


@dataclass(frozen=True)
class Receipt:
    """What a mind's next decision is made of; `Mind.explain` gives it and `str` prints a table.

    >>> from coglogo_py import CognitiveScheme, Cogniton, Society
    >>> a = Cogniton("A", start_value=3, influence={"Plan 1": 4, "Plan 2": -1},
    ...              conditional=("Plan 1", "Plan 2"))
    >>> b = Cogniton("B", start_value=2, influence={"Plan 2": 6})
    >>> receipt = Society(CognitiveScheme("figure 3.1", (a, b)), seed=1).new_mind().explain()
    >>> [(plan.name, plan.weight) for plan in receipt.plans]
    [('Plan 1', 12.0), ('Plan 2', 9.0)]
    >>> print(receipt)
    Decision 1 of mind 0, scheme 'figure 3.1', MaximumWeight
                 value  Plan 1  Plan 2
    A                3     +12      -3
    B                2       .     +12
    weight                  12       9
    probability              1       0
    draw: 0.505928, choice: Plan 1
    Smallest change: B from 2 to just beyond 2.5 (+0.5) makes Plan 2 the most probable.
    """

    scheme: str
    mind: int
    decision: int
    """Which decision of the mind it is, counted from 1."""
    decision_maker: str
    bias: float | None
    """None where the decision maker has none."""
    plans: tuple[PlanPart, ...]
    """Every plan of the scheme, in its order."""
    influences: tuple[Influence, ...]
    """Every cogniton in the scheme's order, then every culturon by group."""
    draw: float
    """The random number in [0, 1); MaximumWeight does without it."""
    choice: str | None
    """The plan that the draw falls on; None when none is available."""
    smallest_change: Change | None
    """Of one active cogniton's value, so that another plan is the most probable; None: there is
    none."""

    def __str__(self) -> str:
        return _table(self)

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"

    def to_dict(self) -> dict[str, Any]:
        """Return the receipt as dictionaries, lists, strings and numbers, ready for JSON."""
        data = asdict(self)
        names = [plan.name for plan in self.plans]
        for part, plan in zip(data["plans"], self.plans, strict=True):
            part["available"] = plan.available
            part["opened_by"] = list(plan.opened_by)
            part["would_open"] = list(plan.would_open)
        for row in data["influences"]:
            row["contributions"] = dict(zip(names, row["contributions"], strict=True))
            row["opens"] = list(row["opens"])
        data["plans"] = list(data["plans"])
        data["influences"] = list(data["influences"])
        if self.smallest_change is not None:
            data["smallest_change"]["change"] = self.smallest_change.change
        return data


def receipt_of(mind: Mind, within: Mapping[str, tuple[float, float]] | None = None) -> Receipt:
    """Return the receipt of a mind's next decision.

    Args:
        mind: the mind.
        within: the smallest and largest value of cognitons by name, as far as they have such.
    """
    society = mind.society
    scheme = society.scheme
    maker = scheme.decision_maker
    influences = _influences(mind)
    weights = mind.plan_weights()
    chances = mind.plan_probabilities()
    draw, choice = mind.next_choice()
    return Receipt(
        scheme=scheme.name,
        mind=mind.id,
        decision=int(society.minds.draws[mind.slot]) + 1,
        decision_maker=maker.name,
        bias=maker.bias if maker.biased else None,
        plans=tuple(
            PlanPart(
                name=plan,
                weight=weights.get(plan),
                probability=chances.get(plan, 0.0),
                opened_by=tuple(str(i) for i in influences if i.acts and plan in i.opens),
                would_open=()
                if plan in weights
                else tuple(str(i) for i in influences if plan in i.opens),
            )
            for plan in scheme.plans
        ),
        influences=influences,
        draw=draw,
        choice=choice,
        smallest_change=smallest_change(
            maker, tuple(weights), _lines(mind, tuple(weights), within or {})
        ),
    )


def _influences(mind: Mind) -> tuple[Influence, ...]:
    """Return what each cogniton and culturon of the scheme does to the plans of a mind."""
    society = mind.society
    links = society.arrays.influence
    plans = np.array(society.scheme.plans, object)
    conditional = society.arrays.conditional
    rows: list[Influence] = []

    def add(
        row: int, name: str, group: str | None, value: Any, participation: Any, acts: bool
    ) -> None:
        contributions = np.zeros(len(plans))
        if acts:
            contributions = links[row] * (1.0 if participation is None else participation) * value
        acted, opens = tuple((contributions + 0.0).tolist()), tuple(plans[conditional[row]])
        rows.append(Influence(name, group, value, participation, acts, acted, opens))

    for row, (name, value) in enumerate(mind.cognitons().items()):
        add(row, name, None, value, None, value is not None)
    culturons_from = len(society.arrays.start)
    for group, culturons in society.names.culturons.items():
        # By a group of its own that lies in one, perhaps.
        place = society.names.group(group)
        row, role, by = kernel.standing(society.arrays, society.minds, mind.slot, place)
        member = row >= 0
        participation = float(society.minds.participation[mind.slot, by]) if member else None
        for name, position in culturons.items():
            value = mind.get_culturon_value(group, name) if member else None
            acts = member and bool(society.arrays.role_culturons[role, position])
            add(culturons_from + position, name, group, value, participation, acts)
    return tuple(rows)


def _lines(
    mind: Mind, available: tuple[str, ...], within: Mapping[str, tuple[float, float]]
) -> list[Line]:
    """Return how the weights of the available plans depend on each active cogniton."""
    society = mind.society
    columns = [society.names.plan(plan) for plan in available]
    if not columns:
        return []
    acting = [influence for influence in _influences(mind) if influence.acts]
    contributions = np.array([influence.contributions for influence in acting])[:, columns]
    lines = []
    for row, influence in enumerate(acting):
        if influence.group is None and influence.value is not None:
            slopes = society.arrays.influence[society.names.cogniton(influence.name), columns]
            weights_at = _weights_along(contributions, row, slopes)
            bounds = within.get(influence.name, (-math.inf, math.inf))
            lines.append(Line(influence.name, influence.value, slopes, weights_at, *bounds))
    return lines


def _weights_along(contributions: Floats, row: int, slopes: Floats) -> Callable[[float], Floats]:
    """Return the function from the value of one cogniton to the weights, summed as a mind does."""
    terms = contributions.copy()

    def weights_at(value: float) -> Floats:
        with np.errstate(over="ignore", invalid="ignore"):
            terms[row] = slopes * value
            # A running sum adds row after row, in the scheme's order; NumPy's sum may not.
            return np.cumsum(terms, axis=0)[-1]

    return weights_at


# As a table to read --------------------------------------------------------------------------


def _table(receipt: Receipt) -> str:
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
    # The number next to 0 is told as 0.
    shown = "0" if abs(change.new_value) < 1e-300 else f"{change.new_value:.6g}"
    if (change.new_value - float(shown)) * change.change > 0:
        shown = f"just beyond {shown}"
    return (
        f"Smallest change: {change.cogniton} from {change.value:.6g} to {shown} "
        f"({change.change:+.6g}) makes {change.plan} the most probable{search}."
    )
