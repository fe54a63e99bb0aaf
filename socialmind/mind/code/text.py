"""The compiled module of a hierarchy, as text: how its arrays are reached, and its evaluation.

The text depends on the mind's programs alone: its programmed functions, regulations, drive, and how
many cogniton schemes it has. Skills, links, networks and genomes are data.
"""

from __future__ import annotations

from coglogo_py.arrays import MindArrays, SchemeArrays
from coglogo_py.laying_out import ENGINE_ARRAYS
from socialmind.compiling.layout import dtype_text
from socialmind.compiling.lowering import lowered
from socialmind.compiling.prelude import HEAD as RULES_HEAD
from socialmind.compiling.prelude import runtime_names
from socialmind.language.program import Program
from socialmind.mind.code.methods_text import methods_text
from socialmind.mind.code.programs import MindProgram
from socialmind.mind.kernel.record import SCHEME_LISTS, mind_dtype

HEAD = '''import math as _math
from socialmind.mind.kernel import flow as _flow
from socialmind.mind.kernel import reach as _reach
from socialmind.mind.kernel import signals as _signals
from socialmind.mind.kernel import variables as _variables
from coglogo_py.compiled.machine_code import kept_callback as _kept_callback
from socialmind.compiling.memory import call_at as _call
from socialmind.mind.kernel.layout import NETWORK as _NETWORK
from socialmind.mind.kernel.layout import PROGRAM as _PROGRAM
from socialmind.mind.kernel.layout import SENSORS as _SENSORS
from socialmind.mind.kernel.layout import SKILLS as _SKILLS
from socialmind.mind.kernel.layout import VARIABLES as _VARIABLES
from socialmind.mind.kernel.networks import run_network as _run_network
from socialmind.mind.kernel.record import state_at as _state_at
from socialmind.mind.kernel.record import structure_at as _structure_at
from socialmind.mind.regulation import REGULATED as _REGULATED

NEW_WORLD, RESTARTED, NEW_BORN = -3, -2, -1
NO_SKILL, A_REGULATION = -1, -2


@_inner
def _held(value):
    """A value of the modeller's function, held to [0, 1]."""
    number = 1.0 * value  # also of what is true or false
    if _math.isnan(number):
        raise ValueError("a function of the mind gave a value that is not a number")
    return min(max(number, 0.0), 1.0)


@_inner
def _keys(mind):
    return carray(_as_pointer(mind.keys), (mind.agents, 2), np.int64)'''

# Entries are called through their addresses, by Python and by compiled models alike, so that the
# evaluation is compiled once. No error can pass such a call: 1 says that there was one.
_EVALUATE = """@_inner
def _evaluate_NAME(address, first, end):
    mind = _at(address)
    structure = _structure_NAME(mind)
    state = _state_NAME(mind)
    mind.failed_skill = NO_SKILL
    mind.failed_agent = -1
    for block in range(first, end):
        lanes = min(state.fresh.shape[1], mind.agents - block * state.fresh.shape[1])
        _signals.check_sensors(structure, state, block, lanes)
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


@_kept_callback(__name__, "int64(int64, int64, int64)")
def evaluate(address, first, end):
    \"\"\"Evaluate blocks of agents; return 0, or 1 when it failed.\"\"\"
    # One call alone: numba for Python 3.12 loses errors out of loops inside a `try`.
    try:
        _evaluate_NAME(address, first, end)
    except Exception:
        return 1
    return 0"""

_RENEW = """@_kept_callback(__name__, "int64(int64, int64, int64)")
def renew(address, agent, parent):
    \"\"\"Put an agent back, or let a new one begin.\"\"\"
    mind = _at(address)
    structure = _structure_NAME(mind)
    state = _state_NAME(mind)
    if parent == RESTARTED:
        lanes = state.fresh.shape[1]
        _flow.start_lane(structure, state, agent // lanes, agent % lanes)
    elif parent < 0:
        _flow.born_lane(structure, state, agent, mind.keys == 0)
    else:
        _flow.copy_lane(state, parent, agent)
    SCHEMES
    return 0"""

_REGULATE_LOOP = """for variable in range(structure.sizes[_VARIABLES]):
            if structure.regulation[variable] == _REGULATED:
                _regulate_NAME(mind, structure, state, block, lanes, variable)"""

_REGULATION = """@_inner
def _regulate_NAME(_model, structure, state, block, lanes, variable):
    row = _variables.take_commands(structure, state, block, lanes, variable)
    number = structure.regulation_number[variable]
    _model.failed_skill = A_REGULATION - variable
    for lane in range(lanes):
        _model.failed_agent = block * state.fresh.shape[1] + lane
        commanded = not _math.isnan(row[lane])
        if commanded:
            state.command[block, variable, lane] = row[lane]
        command = state.command[block, variable, lane]
        if _math.isnan(command):
            command = 0.0
        value = state.values[block, variable, lane]
        memory = state.memory[block, variable, lane]
BRANCHES        state.values[block, variable, lane] = _held(value)
        state.memory[block, variable, lane] = memory
    _model.failed_skill = NO_SKILL"""

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
            if mind.keys != 0:  # the schemes of many worlds share arrays, but not their luck
                minds.counters[_kernel.SEED_LOW] = _keys(mind)[slot, 0]
                minds.counters[_kernel.SEED_HIGH] = _keys(mind)[slot, 1]
            for i in range(inputs):
                _kernel.set_cogniton_value(minds, slot, cogniton[i], nodes[i, lane])
            plan = _kernel.choose_next_plan(
                scheme, minds, slot, _weights_NAME_NUMBER(mind), _plans_NAME_NUMBER(mind)
            )
            if plan >= 0:
                nodes[first + plan_output[plan], lane] = 1.0
"""

# The next decisions draw new numbers: an agent put back does not live through its luck again, and
# each that is born in a place has 2³² numbers of its own, whatever was evaluated there before.
_SCHEME_RENEW = """minds_NUMBER = _minds_NAME_NUMBER(mind)
    _kernel.leave_all_groups(minds_NUMBER, agent)
    for i in range(minds_NUMBER.values.shape[1]):
        if parent >= 0:
            minds_NUMBER.values[agent, i] = minds_NUMBER.values[parent, i]
        else:
            minds_NUMBER.values[agent, i] = _scheme_NAME_NUMBER(mind).start[i]
    if parent == NEW_WORLD:
        minds_NUMBER.draws[agent] = 0
    elif parent != RESTARTED:
        minds_NUMBER.draws[agent] = ((minds_NUMBER.draws[agent] >> 32) + 1) << 32"""


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
    before = f"for lane in range(lanes):\n            mind.failed_agent = {lane}"
    return f"{before}\n            {drive}(mind, {lane})"


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
    return "\n".join([*lines, "    _model.failed_skill = NO_SKILL"])


def _regulation_branch(number: int, one: tuple[str, tuple[str, ...], bool]) -> str:
    symbol, takes, remembers = one
    results = [f"value_{number}", f"memory_{number}"][: 1 + remembers]
    arguments = ", ".join(["_model", *takes])
    lines = [
        f"        if number == {number}:",
        f"            {', '.join(results)} = {symbol}({arguments})",
        # A function may give whole numbers, or what is true or false.
        *(f"            {result.split('_')[0]} = 1.0 * {result}" for result in results),
    ]
    return "\n".join([*lines, ""])


def population_text(name: str, first: bool = False) -> str:
    """Return how a model's compiled rules reach the hierarchies of a population.

    Args:
        name: the population.
        first: whether the model's record says the number of its first agent among those that are
            evaluated together with it.
    """
    text = methods_text(name, evaluating=True, first=f"_model._{name}_first + " if first else "")
    return "\n\n\n".join([record_text(name, 0), text])


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
    parts += [AT.replace("NAME", MIND_NAME), evaluation_text(MIND_NAME, programs)]
    return "\n\n\n".join(parts) + "\n"


MIND_NAME = "mind"
"""What the compiled module calls the minds that stand outside any model."""

AT = """@_inner
def _at(address):
    return carray(_as_pointer(address), (1,), MIND_NAME)[0]"""
