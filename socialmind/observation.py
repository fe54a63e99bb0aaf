"""Observation as columns: of minds, cognitons, weights, influence; of networks, degrees."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from socialmind.society.table import Table


def mind_columns(table: Table) -> dict[str, NDArray[Any]]:
    """Return the minds of a population's living as columns.

    Args:
        table: a population whose agents have minds.

    Returns:
        For every cogniton `cogniton_<Name>`, its value, and for every plan `weight_<Plan>`, its
        weight by equation 3.2, or as the hierarchy weighed it at the agent's last decision; NaN
        where the cogniton is inactive or the plan unavailable. Rows are in order of birth.
    """
    society = table.society
    if society is None:
        return {}
    table.heed_conditions()
    scheme, arrays, minds = society.scheme, society.arrays, society.minds
    slots = table.columns["_mind"][table.slots]
    values = minds.values[slots]
    columns = {
        f"cogniton_{one.name}": values[:, place] for place, one in enumerate(scheme.cognitons)
    }
    weights = np.zeros((len(slots), len(scheme.plans)))
    opened = np.zeros(weights.shape, np.bool_)
    for place in range(values.shape[1]):
        active = ~np.isnan(values[:, place])
        value = np.where(active, values[:, place], 0.0)
        weights += value[:, None] * arrays.influence[place]
        opened |= active[:, None] & arrays.conditional[place]
    for group in range(len(scheme.groups)):
        _add_culturons(society, slots, group, weights, opened)
    if table.weighing is not None and table.minds is not None:
        commands = table.minds.state.actuators[table.slots, :, 0]
        reach = table.weighing.weighing_plans[0]
        weights = (2.0 * commands[:, table.weighing.weighing_actuator] - 1.0) * reach
    weights[~opened] = np.nan
    for place, plan in enumerate(scheme.plans):
        columns[f"weight_{plan}"] = weights[:, place]
    return columns


def hierarchy_columns(table: Table) -> dict[str, NDArray[Any]]:
    """Return the hierarchies of skills of a population's living as columns.

    Args:
        table: a population whose agents have hierarchies.

    Returns:
        For every skill `influence_<Skill>`, the influence that it received in the agent's last
        evaluation, for every variable `variable_<Name>` its value and for every actuator
        `command_<Name>` its command. Rows are in order of birth.
    """
    if table.minds is None:
        return {}
    assembly, state, slots = table.minds.assembly, table.minds.state, table.slots
    description = assembly.description
    parts = {
        "influence": (assembly.skills, state.totals),
        "variable": (description.variables, state.values),
        "command": (description.actuators, state.actuators),
    }
    return {
        f"{part}_{name}": array[slots, place, 0]
        for part, (names, array) in parts.items()
        for place, name in enumerate(names)
    }


def network_columns(table: Table) -> dict[str, NDArray[Any]]:
    """Return what the networks of a model say of a population's living as columns.

    Args:
        table: a population.

    Returns:
        For every network that links its agents `degree_<network>`, how many links each has; where
        links lead from one to another `out_degree_<network>` and `in_degree_<network>`, as far as
        its agents are at these ends; and `component_<network>`, the number of its component. Rows
        are in order of birth.
    """
    columns: dict[str, NDArray[Any]] = {}
    name = table.shape.name
    for network in table._networks:
        joins, called = network.joins, network.shape.name
        columns[f"degree_{called}"] = network.degrees(name)
        if joins.directed and joins.source == name:
            columns[f"out_degree_{called}"] = network.out_degrees()
        if joins.directed and joins.target == name:
            columns[f"in_degree_{called}"] = network.in_degrees()
        columns[f"component_{called}"] = network.components(name)
    return columns


def _add_culturons(
    society: Any, slots: NDArray[np.int64], group: int, weights: Any, opened: Any
) -> None:
    """Add what the culturons of the minds' roles in a group bring to plans."""
    arrays, minds = society.arrays, society.minds
    own = len(arrays.start)
    row = minds.group_slot[slots, group]
    role = minds.role[slots, group]
    member = row >= 0
    begin, end = arrays.group_culturons[group]
    for culturon in range(begin, end):
        holds = np.zeros(len(slots), np.bool_)
        holds[member] = arrays.role_culturons[role[member], culturon]
        value = np.zeros(len(slots))
        value[holds] = minds.culturons[row[holds], culturon]
        value *= minds.participation[slots, group]
        weights += value[:, None] * arrays.influence[own + culturon]
        opened |= holds[:, None] & arrays.conditional[own + culturon]
