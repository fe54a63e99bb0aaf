"""Hierarchies of skills as pages draw them: laid out once, with values at moments, and traced.

Nodes are called as in `socialmind.mind.views`: ``SK:Avoid``, ``SE:S1``, ``VA:ROLE``, ``MO:MotL``.
"""

from __future__ import annotations

from typing import Any

from socialmind.errors import SocialmindError
from socialmind.mind.evaluation.agent_state import AgentState, Readings
from socialmind.model import Model
from socialmind.studio.running.live_run import LiveRun

TRACED = 2000
"""Ticks that are traced back at most."""


def laid_out(society: Model, population: str) -> dict[str, Any]:
    """Return where the nodes and links of a population's hierarchy are drawn.

    It takes a tenth of a second, and is the same for all agents at all times.

    Args:
        society: the society.
        population: one whose agents have a hierarchy.
    """
    from socialmind.mind.views.plan import planned

    minds: Any = society.tables[population].minds
    plan = planned(AgentState(minds, 0), key=False, known=True)
    return {
        "width": plan.width,
        "height": plan.height,
        "boxes": [
            {
                "name": name,
                "x": box.x,
                "y": box.y,
                "width": box.width,
                "height": box.height,
                **_labels(plan.lines[name]),
            }
            for name, box in plan.boxes.items()
        ],
        "links": [
            {"from": one, "to": other, "curve": _flat(curve)}
            for (one, other), curve in plan.routes.items()
        ],
        "readings": [
            {"from": one, "to": other, "curve": _flat(curve)}
            for (one, other), curve in plan.readings.items()
        ],
    }


def _labels(lines: Any) -> dict[str, Any]:
    """Return the lines of a name without the value that stands below it, or behind it."""
    if len(lines) == 1:
        return {"lines": [lines[0].rpartition(" ")[0]], "flat": True}
    return {"lines": list(lines[:-1]), "flat": False}


def _flat(curve: Any) -> list[float]:
    return [round(coordinate, 3) for point in curve for coordinate in point]


def values_in(hierarchy: Readings) -> dict[str, Any] | None:
    """Return what the last evaluation of an agent's hierarchy came to; None before the first.

    Returns:
        ``values``: of each node: influence received, command, reading, value; and of each link, by
        skill and output, what it ``sent`` and what its function ``gave``.
    """
    if not hierarchy.tick:
        return None
    return {
        "values": node_values(hierarchy),
        "sent": {f"{skill} {to}": value for (skill, to), value in hierarchy.links().items()},
        "gave": {f"{skill} {to}": value for (skill, to), value in hierarchy.outputs().items()},
    }


def node_values(hierarchy: Readings) -> dict[str, float]:
    """Return the value of each node at the last evaluation."""
    tables = {
        "SK": hierarchy.influences(),
        "MO": hierarchy.actuators(),
        "SE": hierarchy.sensors(),
        "VA": hierarchy.variables(),
    }
    return {f"{code}:{name}": one for code, table in tables.items() for name, one in table.items()}


def traced(run: LiveRun, population: str, identity: int, ticks: int) -> dict[str, Any]:
    """Return how the nodes of an agent's hierarchy went in the last ticks, by repeating them.

    Args:
        run: at the tick up to which it is traced; it stays there.
        population: the agent's.
        identity: the agent's.
        ticks: for how many, `TRACED` at most; fewer where it was born later.

    Returns:
        ``tick``, and by node a list of ``values`` of the same length.

    Raises:
        SocialmindError: there is no such agent alive, or it has no hierarchy.
    """
    own = run.society.tables.get(population)
    if own is None or not own.contains(identity) or own.minds is None:
        raise SocialmindError(
            f"no living agent {identity} of {population!r} has a hierarchy to be traced"
        )
    now = run.tick
    since = max(0, now - max(0, min(int(ticks), TRACED)))
    past = run.before(since) if since < now else run
    found: dict[str, Any] = {"tick": [], "values": {}}
    while True:
        table: Any = past.society.tables[population]
        if table.contains(identity):
            state = AgentState(table.minds, table[identity]._slot)
            if state.tick:
                found["tick"].append(past.tick)
                for name, value in node_values(state).items():
                    found["values"].setdefault(name, []).append(value)
        if past.tick >= now:
            return found
        past.advance(1)
