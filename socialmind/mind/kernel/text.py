"""The compiled module of a hierarchy, as text: how its arrays are reached, and its evaluation.

The text depends on the mind's programs alone: its programmed functions, regulations, drive, and how
many cogniton schemes it has. Skills, links, networks and genomes are data.
"""

from __future__ import annotations

from coglogo_py.arrays import MindArrays, SchemeArrays
from socialmind.language.layout import ENGINE_ARRAYS, dtype_text
from socialmind.language.loop import HEAD as RULES_HEAD
from socialmind.language.loop import runtime_names
from socialmind.language.lowering import lowered
from socialmind.language.program import Program
from socialmind.mind.kernel.record import SCHEME_LISTS, mind_dtype
from socialmind.mind.programs import MindProgram

HEAD = '''import math as _math
from socialmind.mind.kernel import flow as _flow
from socialmind.mind.kernel import reach as _reach
from socialmind.mind.kernel import signals as _signals
from socialmind.mind.kernel import variables as _variables
from numba import cfunc
from socialmind.language.memory import call_at as _call
from socialmind.mind.kernel.layout import NETWORK as _NETWORK
from socialmind.mind.kernel.layout import PROGRAM as _PROGRAM
from socialmind.mind.kernel.layout import SENSORS as _SENSORS
from socialmind.mind.kernel.layout import SKILLS as _SKILLS
from socialmind.mind.kernel.layout import VARIABLES as _VARIABLES
from socialmind.mind.kernel.networks import run_network as _run_network
from socialmind.mind.kernel.record import state_at as _state_at
from socialmind.mind.kernel.record import structure_at as _structure_at
from socialmind.mind.regulation import REGULATED as _REGULATED

RESTARTED, NEW_BORN = -2, -1


@_inner
def _held(value):
    """A value of the modeller's function, held to [0, 1]."""
    if _math.isnan(value):
        raise ValueError("a function of the mind gave a value that is not a number")
    return min(max(float(value), 0.0), 1.0)'''

# Entries are called through their addresses, by Python and by compiled models alike, so that the
# evaluation is compiled once. No error can pass such a call: 1 says that there was one.
_EVALUATE = """@cfunc("int64(int64, int64, int64)", cache=True)
def evaluate(address, first, end):
    \"\"\"Evaluate blocks of agents; return 0, or 1 when it failed.\"\"\"
    mind = _at(address)
    structure = _structure_NAME(mind)
    state = _state_NAME(mind)
    try:
        for block in range(first, end):
            lanes = min(state.fresh.shape[1], mind.agents - block * state.fresh.shape[1])
            _signals.sense(structure, state, block, lanes)
            _variables.vary(structure, state, block, lanes)
            REGULATE
            _signals.present_variables(structure, state, block, lanes)
            DRIVE
            for skill in range(structure.sizes[_SKILLS]):
                if _flow.receive(structure, state, block, lanes, skill):
                    kind = structure.skill_kind[skill]
                    if kind == _NETWORK:
                        _run_network(structure, state, block, lanes, skill)
                    elif kind == _PROGRAM:
                        _program_NAME(mind, structure, state, block, lanes, skill)
                    else:
                        _scheme_NAME(mind, structure, state, block, lanes, skill)
                    _flow.transmit(structure, state, block, lanes, skill)
            _flow.act(structure, state, block, lanes)
    except Exception:
        return 1
    return 0"""

_RENEW = """@cfunc("int64(int64, int64, int64)", cache=True)
def renew(address, agent, parent):
    \"\"\"Put an agent back, or let a new one begin.\"\"\"
    mind = _at(address)
    structure = _structure_NAME(mind)
    state = _state_NAME(mind)
    if parent == RESTARTED:
        lanes = state.fresh.shape[1]
        _flow.start_lane(structure, state, agent // lanes, agent % lanes)
    elif parent == NEW_BORN:
        _flow.born_lane(structure, state, agent)
    else:
        _flow.copy_lane(state, parent, agent)
    SCHEMES
    return 0"""

_METHODS = """@_inner
def _record_NAME(_model):
    return carray(_as_pointer(_model._NAME_hierarchy), (1,), MIND_NAME)[0]


@_inner
def _hierarchy_evaluate_NAME(_model, agent):
    mind = _record_NAME(_model)
    _state_NAME(mind).now[0] = _model._tick
    if _call(mind.evaluate, _model._NAME_hierarchy, agent, agent + 1) != 0:
        raise ValueError("a hierarchy could not be evaluated")


@_inner
def _hierarchy_restart_NAME(_model, agent):
    _call(_record_NAME(_model).renew, _model._NAME_hierarchy, agent, RESTARTED)


@_inner
def _begin_hierarchy_NAME(_model, agent):
    _call(_record_NAME(_model).renew, _model._NAME_hierarchy, agent, NEW_BORN)


@_inner
def _copy_hierarchy_NAME(_model, parent, child):
    _call(_record_NAME(_model).renew, _model._NAME_hierarchy, child, parent)"""

_METHOD = """@_inner
def _hierarchy_METHOD_NAME(_model, agentARGUMENTS):
    mind = _record_NAME(_model)
    structure = _structure_NAME(mind)
    state = _state_NAME(mind)
    lanes = state.fresh.shape[1]
    block, lane = agent // lanes, agent % lanes
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
        "_reach.join(structure, state, block, lane, group, instance, part)",
    ),
    "leave_group": ("group", "_reach.join(structure, state, block, lane, group, -1, 1.0)"),
}
"""What rules and drives do with a hierarchy, but to evaluate it: arguments, and the body."""


def methods_text(name: str, evaluating: bool) -> str:
    """Return the functions by which compiled rules reach the hierarchy of an agent.

    Args:
        name: the population's name.
        evaluating: whether rules may evaluate it; a drive may not.
    """
    parts = [
        _METHOD.replace("METHOD", method)
        .replace("ARGUMENTS", f", {arguments}")
        .replace("BODY", body)
        for method, (arguments, body) in METHODS.items()
    ]
    return "\n\n\n".join([*parts, _METHODS] if evaluating else parts).replace("NAME", name)


_REGULATE_LOOP = """for variable in range(structure.sizes[_VARIABLES]):
                if structure.regulation[variable] == _REGULATED:
                    _regulate_NAME(mind, structure, state, block, lanes, variable)"""

_REGULATION = """@_inner
def _regulate_NAME(_model, structure, state, block, lanes, variable):
    row = _variables.take_commands(structure, state, block, lanes, variable)
    number = structure.regulation_number[variable]
    for lane in range(lanes):
        commanded = not _math.isnan(row[lane])
        if commanded:
            state.command[block, variable, lane] = row[lane]
        command = state.command[block, variable, lane]
        if _math.isnan(command):
            command = 0.0
        value = state.values[block, variable, lane]
        memory = state.memory[block, variable, lane]
BRANCHES        state.values[block, variable, lane] = _held(value)
        state.memory[block, variable, lane] = memory"""

_SCHEME = """@_inner
def _scheme_NAME(mind, structure, state, block, lanes, skill):
    nodes = state.nodes[0]
    number = structure.skill_number[skill]
    first = structure.output_node[skill]
    inputs = structure.input_begin[skill + 1] - structure.input_begin[skill]
    outputs = structure.entry_begin[skill + 1] - structure.entry_begin[skill]
    for lane in range(lanes):
        slot = block * state.sensors.shape[2] + lane
        for output in range(outputs):
            nodes[first + output, lane] = 0.0
BRANCHES"""

_ONE_SCHEME = """        if number == NUMBER:
            scheme, minds = _scheme_NAME_NUMBER(mind), _minds_NAME_NUMBER(mind)
            cogniton, plan_output = _cogniton_NAME_NUMBER(mind), _plan_output_NAME_NUMBER(mind)
            for i in range(inputs):
                _kernel.set_cogniton_value(minds, slot, cogniton[i], nodes[i, lane])
            plan = _kernel.choose_next_plan(
                scheme, minds, slot, _weights_NAME_NUMBER(mind), _plans_NAME_NUMBER(mind)
            )
            if plan >= 0:
                nodes[first + plan_output[plan], lane] = 1.0
"""

# The next decisions draw new numbers: an agent put back does not live through its luck again.
_SCHEME_RENEW = """minds_NUMBER = _minds_NAME_NUMBER(mind)
    _kernel.leave_all_groups(minds_NUMBER, agent)
    for i in range(minds_NUMBER.values.shape[1]):
        if parent >= 0:
            minds_NUMBER.values[agent, i] = minds_NUMBER.values[parent, i]
        else:
            minds_NUMBER.values[agent, i] = _scheme_NAME_NUMBER(mind).start[i]"""


def record_text(name: str, schemes: int) -> str:
    """Return the record of a mind, and what reaches its arrays, for a module."""
    return f"""MIND_{name} = {dtype_text(mind_dtype(schemes))}


@_inner
def _structure_{name}(mind):
    return _structure_at(mind.itself)


@_inner
def _state_{name}(mind):
    return _state_at(mind.itself)"""


def evaluation_text(name: str, programs: MindProgram) -> str:
    """Return the functions that evaluate a hierarchy, for a compiled module.

    Args:
        name: the population's name, which ends the functions' names.
        programs: the typed programs; their functions stand in the module already.
    """
    parts = []
    for number in range(programs.schemes):
        parts += _scheme_views(name, number)
    parts.append(_programs_text(name, programs))
    schemes = range(programs.schemes)
    branches = "".join(_ONE_SCHEME.replace("NUMBER", str(number)) for number in schemes)
    parts.append(_SCHEME.replace("BRANCHES", branches or "        pass\n").replace("NAME", name))
    if programs.regulations:
        text = "".join(_regulation_branch(*one) for one in enumerate(programs.regulations))
        parts.append(_REGULATION.replace("BRANCHES", text).replace("NAME", name))
    renewed = "\n    ".join(_SCHEME_RENEW.replace("NUMBER", str(number)) for number in schemes)
    parts.append(_RENEW.replace("SCHEMES", renewed or "pass").replace("NAME", name))
    fills = {
        "REGULATE": _REGULATE_LOOP if programs.regulations else "pass",
        "DRIVE": _drive_text(programs.drive),
    }
    text = _EVALUATE
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    parts.append(text.replace("NAME", name))
    return "\n\n\n".join(parts)


def _drive_text(drive: str | None) -> str:
    if drive is None:
        return "pass"
    lane = "block * state.fresh.shape[1] + lane"
    return f"for lane in range(lanes):\n                {drive}(mind, {lane})"


def _view(array: str, kind: str, dimensions: int) -> str:
    shape = "".join(f"mind.{array}_{axis}, " for axis in range(dimensions))
    return f"carray(_as_pointer(mind.{array}), ({shape}), np.{kind})"


def _scheme_views(name: str, number: int) -> list[str]:
    parts = []
    for prefix, cls in (("scheme", SchemeArrays), ("minds", MindArrays)):
        views = "".join(
            f"        {_view(f'nested_{number}_{prefix}_{array}', *ENGINE_ARRAYS[array])},\n"
            for array in cls._fields
        )
        head = f"@_inner\ndef _{prefix}_{name}_{number}(mind):\n"
        parts.append(f"{head}    return _{cls.__name__}(\n{views}    )")
    for array, (kind, dimensions) in SCHEME_LISTS.items():
        view = _view(f"nested_{number}_{array}", kind, dimensions)
        parts.append(f"@_inner\ndef _{array}_{name}_{number}(mind):\n    return {view}")
    return parts


def _programs_text(name: str, programs: MindProgram) -> str:
    lines = [
        f"@_inner\ndef _program_{name}(_model, structure, state, block, lanes, skill):",
        "    nodes = state.nodes[0]",
        "    number = structure.skill_number[skill]",
        "    _model.failed_skill = skill",
    ]
    for number, (symbol, inputs, outputs, takes_array) in enumerate(programs.programs):
        read = ", ".join(f"nodes[{i}, lane]" for i in range(inputs))
        read = f"nodes[:{inputs}, lane]" if takes_array else read
        results = ", ".join(f"out_{i}" for i in range(outputs))
        lines += [
            f"    if number == {number}:",
            "        for lane in range(lanes):",
            "            _model.failed_agent = block * state.fresh.shape[1] + lane",
            f"            {results} = {symbol}(_model{', ' if read else ''}{read})",
        ]
        for i in range(outputs):
            lines.append(f"            nodes[{inputs + i}, lane] = _held(out_{i})")
    return "\n".join([*lines, "    _model.failed_skill = -1"])


def _regulation_branch(number: int, one: tuple[str, tuple[str, ...], bool]) -> str:
    symbol, takes, remembers = one
    results = "value, memory" if remembers else "value"
    arguments = ", ".join(["_model", *takes])
    return f"        if number == {number}:\n            {results} = {symbol}({arguments})\n"


def population_text(name: str) -> str:
    """Return how a model's compiled rules reach the hierarchies of a population."""
    return "\n\n\n".join([record_text(name, 0), methods_text(name, evaluating=True)])


def module_text(program: Program, programs: MindProgram) -> str:
    """Return the compiled module that evaluates a mind.

    Args:
        program: the typed functions.
        programs: which of them are what.
    """
    parts = [RULES_HEAD, runtime_names(), HEAD, record_text(MIND_NAME, programs.schemes)]
    if program.names[MIND_NAME]:
        parts.append(
            f"@_inner\ndef _names_{MIND_NAME}(_model):\n"
            f"    return carray(_as_pointer(_model.names), (_model.names_0, ), np.int64)"
        )
    record = f"@_inner\ndef _record_{MIND_NAME}(_model):\n    return _model"
    parts += [record, methods_text(MIND_NAME, evaluating=False)]
    parts += [f"@_inner\n{lowered(function)}" for function in program.functions.values()]
    parts += [_AT.replace("NAME", MIND_NAME), evaluation_text(MIND_NAME, programs)]
    return "\n\n\n".join(parts) + "\n"


def steps_text() -> str:
    """Return the compiled module of the steps of an evaluation, which Python calls one by one."""
    parts = [RULES_HEAD, runtime_names(), HEAD, record_text(MIND_NAME, 0)]
    parts += [one.replace("NAME", MIND_NAME) for one in (_AT, _STEPS)]
    return "\n\n\n".join(parts) + "\n"


MIND_NAME = "mind"
"""What the compiled module calls the minds that stand outside any model."""

_AT = """@_inner
def _at(address):
    return carray(_as_pointer(address), (1,), MIND_NAME)[0]"""

_STEPS = """@njit(cache=True)
def restart(address, block):
    \"\"\"Put an agent back to before its first evaluation.\"\"\"
    mind = _at(address)
    _flow.start_lane(_structure_NAME(mind), _state_NAME(mind), block, 0)


@njit(cache=True)
def begin(address, block):
    \"\"\"Steps 1 and 2 but for the modeller's regulations.\"\"\"
    mind = _at(address)
    _signals.sense(_structure_NAME(mind), _state_NAME(mind), block, 1)
    _variables.vary(_structure_NAME(mind), _state_NAME(mind), block, 1)


@njit(cache=True)
def command_of(address, block, variable):
    \"\"\"Take the command that a variable received in the last cycle, NaN for none.\"\"\"
    mind = _at(address)
    return _variables.take_commands(_structure_NAME(mind), _state_NAME(mind), block, 1, variable)[0]


@njit(cache=True)
def show_variables(address, block):
    \"\"\"End step 2.\"\"\"
    mind = _at(address)
    _signals.present_variables(_structure_NAME(mind), _state_NAME(mind), block, 1)


@njit(cache=True)
def override(address, block, variable, value):
    \"\"\"Give a variable a value at once.\"\"\"
    mind = _at(address)
    _reach.override(_structure_NAME(mind), _state_NAME(mind), block, 0, variable, value)


@njit(cache=True)
def set_sensor(address, block, sensor, value):
    \"\"\"Set a sensor.\"\"\"
    _reach.set_sensor(_state_NAME(_at(address)), block, 0, sensor, value)


@njit(cache=True)
def add_influence(address, block, skill, value):
    \"\"\"Let the drive influence a skill.\"\"\"
    _reach.add_influence(_state_NAME(_at(address)), block, 0, skill, value)


@njit(cache=True)
def command(address, block, actuator, place, value, weight):
    \"\"\"Let the drive command an actuator or a variable.\"\"\"
    mind = _at(address)
    _reach.command(
        _structure_NAME(mind), _state_NAME(mind), block, 0, actuator, place, value, weight
    )


@njit(cache=True)
def join(address, block, group, instance, part):
    \"\"\"Make an agent a member of a group's instance.\"\"\"
    mind = _at(address)
    _reach.join(_structure_NAME(mind), _state_NAME(mind), block, 0, group, instance, part)


@njit(cache=True)
def set_variable(address, block, variable, value):
    \"\"\"Set a variable; skills see it in the next evaluation.\"\"\"
    mind = _at(address)
    _reach.set_variable(_structure_NAME(mind), _state_NAME(mind), block, 0, variable, value)


@njit(cache=True)
def receive(address, block, skill):
    \"\"\"Add up a skill's influence, take its inputs and evaluate a network; False: skip it.\"\"\"
    mind = _at(address)
    structure, state = _structure_NAME(mind), _state_NAME(mind)
    needed = _flow.receive(structure, state, block, 1, skill)
    if needed and structure.skill_kind[skill] == _NETWORK:
        _run_network(structure, state, block, 1, skill)
    return needed


@njit(cache=True)
def transmit(address, block, skill):
    \"\"\"Send a skill's outputs.\"\"\"
    mind = _at(address)
    _flow.transmit(_structure_NAME(mind), _state_NAME(mind), block, 1, skill)


@njit(cache=True)
def end(address, block):
    \"\"\"Step 4.\"\"\"
    mind = _at(address)
    _flow.act(_structure_NAME(mind), _state_NAME(mind), block, 1)"""
