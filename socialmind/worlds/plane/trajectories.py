"""What a run on a plane records of its robots unless the model says otherwise."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from socialmind.agents.agent_columns import OWN, one_table
from socialmind.fields import class_fields
from socialmind.worlds.plane.bodies import Robot

if TYPE_CHECKING:
    from socialmind.agents.running import Running

RECORDED = ("x", "y", "angle", "speed", "carrying", "battery", "collisions", "score")
"""Of every robot: where it is and how fast, what it carries, and how it fares."""


def trajectories(model: Running) -> dict[str, Any]:
    """Return the columns of the robots' table at a tick: `RECORDED` and the fields of their class.

    Args:
        model: a running model on a plane with robots.

    Returns:
        A sequence for each column, over the living robots. Several populations stand one after
        another, and a column says which; what one of them does not have is None.
    """
    names = list(model.shape.world.robots)
    engines = set(class_fields(Robot))
    parts: dict[str, dict[str, Any]] = {}
    for name in names:
        table: Any = model.tables[name]
        part: dict[str, Any] = {"agent": table.id}
        if table.shape.minded:
            part["plan"] = model.plans(table)
        if table.shape.steps is not None:
            part["plan_step"] = table.plan_steps(table.slots)
        for column in RECORDED:
            part[column] = (
                np.hypot(table.vx, table.vy) if column == "speed" else getattr(table, column)
            )
        for field in model.populations[name].shape.fields.values():
            if field.name not in engines and field.size is None:
                alone = len(names) == 1 or field.name not in OWN
                part[field.name if alone else f"{name}.{field.name}"] = getattr(table, field.name)
        parts[name] = part
    columns = one_table(parts)
    # On planes the identity has always come before the population.
    return {"agent": columns.pop("agent"), **columns}
