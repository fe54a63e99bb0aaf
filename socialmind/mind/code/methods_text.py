"""What rules and drives do with an agent's hierarchy, as text for a compiled module."""

from __future__ import annotations

_METHODS = """@_inner
def _record_NAME(_model):
    return carray(_as_pointer(_model._NAME_hierarchy), (1,), MIND_NAME)[0]


@_inner
def _hierarchy_evaluate_NAME(_model, agent):
    mind = _record_NAME(_model)
    _state_NAME(mind).now[0] = _model._tick
    if _call(mind.evaluate, _model._NAME_hierarchy, FIRSTagent, FIRSTagent + 1) != 0:
        raise ValueError("a hierarchy could not be evaluated")


@_inner
def _hierarchy_restart_NAME(_model, agent):
    _call(_record_NAME(_model).renew, _model._NAME_hierarchy, FIRSTagent, RESTARTED)


@_inner
def _begin_hierarchy_NAME(_model, agent):
    _call(_record_NAME(_model).renew, _model._NAME_hierarchy, FIRSTagent, NEW_BORN)


@_inner
def _copy_hierarchy_NAME(_model, parent, child):
    _call(_record_NAME(_model).renew, _model._NAME_hierarchy, FIRSTchild, FIRSTparent)"""

_METHOD = """@_inner
def _hierarchy_METHOD_NAME(_model, agentARGUMENTS):
    mind = _record_NAME(_model)
    structure = _structure_NAME(mind)
    state = _state_NAME(mind)
    lanes = state.fresh.shape[1]
    number = FIRSTagent
    block, lane = number // lanes, number % lanes
    BODY"""

METHODS: dict[str, tuple[str, str]] = {
    "sensor": ("place", "return state.sensors[block, place, lane]"),
    "set_sensor": ("place, value", "_reach.set_sensor(state, block, lane, place, value)"),
    "actuator": ("place", "return state.actuators[block, place, lane]"),
    "variable": ("place", "return state.values[block, place, lane]"),
    "set_variable": (
        "place, value",
        "_reach.set_variable(structure, state, block, lane, place, value)",
    ),
    "override": (
        "place, value",
        "_reach.set_variable(structure, state, block, lane, place, value)\n"
        "    _reach.override(structure, state, block, lane, place, value)",
    ),
    "influence": ("place", "return state.totals[block, place, lane]"),
    "add_influence": ("place, value", "_reach.add_influence(state, block, lane, place, value)"),
    "command": (
        "place, value, weight",
        "_reach.command(structure, state, block, lane, True, place, value, weight)",
    ),
    "command_variable": (
        "place, value, weight",
        "_reach.command(structure, state, block, lane, False, place, value, weight)",
    ),
    "join_group": (
        "group, instance, part",
        "own = _reach.instance_of(state, number, instance, mind.agents, mind.worlds)\n"
        "    _reach.join(structure, state, block, lane, group, own, part)",
    ),
    "leave_group": ("group", "_reach.join(structure, state, block, lane, group, -1, 1.0)"),
}
"""What rules and drives do with a hierarchy, but to evaluate it: arguments, and the body."""


def methods_text(name: str, evaluating: bool, first: str = "") -> str:
    """Return the functions by which compiled rules reach the hierarchy of an agent.

    Args:
        name: the population's name.
        evaluating: whether rules may evaluate it; a drive may not.
        first: what is added to an agent's place, as text, where several worlds share the arrays.
    """
    parts = [
        _METHOD.replace("METHOD", method)
        .replace("ARGUMENTS", f", {arguments}")
        .replace("BODY", body)
        for method, (arguments, body) in METHODS.items()
    ]
    text = "\n\n\n".join([*parts, _METHODS] if evaluating else parts)
    return text.replace("FIRST", first).replace("NAME", name)
