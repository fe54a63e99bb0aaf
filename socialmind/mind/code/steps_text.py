"""The compiled module of the steps of one evaluation, as text: Python calls them one by one."""

from __future__ import annotations

from socialmind.compiling.prelude import HEAD as RULES_HEAD
from socialmind.compiling.prelude import runtime_names
from socialmind.mind.code.text import AT, HEAD, MIND_NAME, record_text


def steps_text() -> str:
    """Return the compiled module of the steps of an evaluation, which Python calls one by one."""
    parts = [RULES_HEAD, runtime_names(), HEAD, record_text(MIND_NAME, 0)]
    parts += [one.replace("NAME", MIND_NAME) for one in (AT, _STEPS)]
    return "\n\n\n".join(parts) + "\n"


_STEPS = """@_kept(__name__)
def restart(address, block):
    \"\"\"Put an agent back to before its first evaluation.\"\"\"
    mind = _at(address)
    _flow.start_lane(_structure_NAME(mind), _state_NAME(mind), block, 0)


@_kept(__name__)
def begin(address, block):
    \"\"\"Steps 1 and 2 but for the modeller's regulations.\"\"\"
    mind = _at(address)
    _signals.check_sensors(_structure_NAME(mind), _state_NAME(mind), block, 1)
    _signals.sense(_structure_NAME(mind), _state_NAME(mind), block, 1)
    _variables.vary(_structure_NAME(mind), _state_NAME(mind), block, 1)


@_kept(__name__)
def command_of(address, block, variable):
    \"\"\"Take the command that a variable received in the last cycle, NaN for none.\"\"\"
    mind = _at(address)
    return _variables.take_commands(_structure_NAME(mind), _state_NAME(mind), block, 1, variable)[0]


@_kept(__name__)
def show_variables(address, block):
    \"\"\"End step 2.\"\"\"
    mind = _at(address)
    _signals.present_variables(_structure_NAME(mind), _state_NAME(mind), block, 1)


@_kept(__name__)
def override(address, block, variable, value):
    \"\"\"Give a variable a value at once.\"\"\"
    mind = _at(address)
    _reach.override(_structure_NAME(mind), _state_NAME(mind), block, 0, variable, value)


@_kept(__name__)
def set_sensor(address, block, sensor, value):
    \"\"\"Set a sensor.\"\"\"
    _reach.set_sensor(_state_NAME(_at(address)), block, 0, sensor, value)


@_kept(__name__)
def add_influence(address, block, skill, value):
    \"\"\"Let the drive influence a skill.\"\"\"
    _reach.add_influence(_state_NAME(_at(address)), block, 0, skill, value)


@_kept(__name__)
def command(address, block, actuator, place, value, weight):
    \"\"\"Let the drive command an actuator or a variable.\"\"\"
    mind = _at(address)
    _reach.command(
        _structure_NAME(mind), _state_NAME(mind), block, 0, actuator, place, value, weight
    )


@_kept(__name__)
def join(address, block, group, instance, part):
    \"\"\"Make an agent a member of a group's instance.\"\"\"
    mind = _at(address)
    _reach.join(_structure_NAME(mind), _state_NAME(mind), block, 0, group, instance, part)


@_kept(__name__)
def set_variable(address, block, variable, value):
    \"\"\"Set a variable; skills see it in the next evaluation.\"\"\"
    mind = _at(address)
    _reach.set_variable(_structure_NAME(mind), _state_NAME(mind), block, 0, variable, value)


@_kept(__name__)
def receive(address, block, skill):
    \"\"\"Add up a skill's influence, take its inputs and evaluate a network; False: skip it.\"\"\"
    mind = _at(address)
    structure, state = _structure_NAME(mind), _state_NAME(mind)
    needed = _flow.receive(structure, state, block, 1, skill)
    if needed and structure.skill_kind[skill] == _NETWORK:
        _run_network(structure, state, block, 1, skill)
    return needed


@_kept(__name__)
def transmit(address, block, skill):
    \"\"\"Send a skill's outputs.\"\"\"
    mind = _at(address)
    _flow.transmit(_structure_NAME(mind), _state_NAME(mind), block, 1, skill)


@_kept(__name__)
def end(address, block):
    \"\"\"Step 4.\"\"\"
    mind = _at(address)
    _flow.act(_structure_NAME(mind), _state_NAME(mind), block, 1)"""
