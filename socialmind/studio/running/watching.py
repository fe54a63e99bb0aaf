"""The agent watcher: all that an agent is at a moment, its body, its mind, its groups."""

from __future__ import annotations

import math
from typing import Any

from coglogo_py.receipts.receipt import Receipt
from socialmind.errors import SocialmindError
from socialmind.mind.evaluation.agent_state import AgentState
from socialmind.model import Model
from socialmind.studio.running.hierarchies import values_in


def watched(society: Model, population: str, identity: int) -> dict[str, Any]:
    """Return an agent as data: fields, mind with the receipt of its next decision, groups, skills.

    Nothing is drawn or changed.

    Args:
        society: as it is.
        population: of the agent.
        identity: of the agent.

    Raises:
        SocialmindError: there is no such agent alive.
    """
    table = society.tables.get(population)
    if table is None or not table.contains(identity):
        raise SocialmindError(f"no living agent of {population!r} has the identity {identity}")
    agent = table[identity]
    seen: dict[str, Any] = {
        "population": population,
        "id": identity,
        "tick": society.tick,
        "fields": {
            name: _plain(getattr(agent, name))
            for name, one in table.shape.fields.items()
            if one.size is None and not name.startswith("_")
        },
    }
    if table.society is not None:
        mind = agent.mind
        seen["plan"] = agent.plan
        seen["cognitons"] = mind.cognitons()
        seen["links"] = _links(society.schemes[population])
        seen["groups"] = _groups(table, mind)
        if not table.shape.weighed:
            receipt = mind.explain()
            seen["receipt"] = receipt.to_dict()
            seen["words"] = _words(receipt)
    if table.minds is not None:
        seen["skills"] = values_in(AgentState(table.minds, agent._slot))
    return seen


def _links(scheme: Any) -> list[dict[str, Any]]:
    """Return the links of a scheme's cognitons, with their kinds."""
    found: list[dict[str, Any]] = []
    for one in scheme.cognitons:
        for kind in ("influence", "reinforcement"):
            for plan, weight in getattr(one, kind).items():
                found.append({"from": one.name, "to": plan, "kind": kind, "weight": weight})
        found += [{"from": one.name, "to": plan, "kind": "conditional"} for plan in one.conditional]
    return found


def _groups(table: Any, mind: Any) -> list[dict[str, Any]]:
    """Return the groups that a mind is in, with its role there and their culturons."""
    names, minds, slot = table.society.names, table.society.minds, mind.slot
    found = []
    for group, place in names.groups.items():
        row = int(minds.group_slot[slot, place])
        if row < 0:
            continue
        at = int(minds.role[slot, place])
        found.append(
            {
                "group": group,
                "instance": int(minds.instance_id[row]),
                "role": next((r for r, p in names.roles[group].items() if p == at), None),
                "participation": float(minds.participation[slot, place]),
                "members": int(minds.members[row]),
                "culturons": {
                    name: float(minds.culturons[row, column])
                    for name, column in names.culturons[group].items()
                },
            }
        )
    return found


def _words(receipt: Receipt) -> list[str]:
    """Say what spoke for and against the plan of a receipt, and what would have turned it."""
    names = [plan.name for plan in receipt.plans]
    if receipt.choice is None:
        return ["No plan is available."]
    at = names.index(receipt.choice)
    parts = [(one, one.contributions[at]) for one in receipt.influences if one.contributions[at]]
    parts.sort(key=lambda part: -abs(part[1]))
    said = [f"The next decision is {receipt.choice}, chosen by {receipt.decision_maker}."]
    for word, sign in (("For", 1), ("Against", -1)):
        some = [f"{one.name} {part:+.3g}" for one, part in parts if part * sign > 0]
        if some:
            said.append(f"{word} it: {', '.join(some)}.")
    change = receipt.smallest_change
    if change is not None:
        line = str(receipt).rstrip().splitlines()[-1]
        said.append(line)
    return said


def _plain(value: Any) -> Any:
    """Return a value as JSON has it: whatever is no number or text becomes one, or None."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, list | tuple):
        return [_plain(one) for one in value]
    if value is None or isinstance(value, bool | int | float | str):
        return value
    return str(value)
