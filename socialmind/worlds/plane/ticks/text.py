"""The stages of a tick on a plane as text, for the compiled module of a model."""

from __future__ import annotations

from socialmind.compiling.layout import view_function_text
from socialmind.worlds.plane.steering import OUTSIDE
from socialmind.worlds.plane.ticks.stages import PLACED, Call, PlaneProgram, Seek, Stage

HEAD = """import math as _math
from coglogo_py.compiled.machine_code import kept_callback as _kept_callback
from socialmind.compiling.memory import call_at as _call
from socialmind.worlds.plane.devices import relative as _relative

_mounted = _inner(_relative.mounted)
_bearing_of = _inner(_relative.bearing_of)
_bounded = _inner(_relative.bounded)
_counted = _inner(_relative.counted)


@_inner
def _settings(_model):
    return carray(_as_pointer(_model._settings), (_model._settings_0,), np.float64)"""

_NEAREST = """@_inner
def _nearest_NAME(_model, x, y, reach, own, carrier, kind, free):
    rows = _rows_NAME(_model)
    alive = _alive_NAME(_model)
    nearest = -1
    least = reach * reach
    for slot in range(len(rows)):
        if not alive[slot] or slot == own:
            continue
        row = rows[slot]
        CARRIEDdx = row.x - x
        dy = row.y - y
        away = dx * dx + dy * dy
        if away < least or (nearest < 0 and away <= least):
            nearest = slot
            least = away
    return nearest"""

_CARRIED = """if row.carrier_kind >= 0:
            if free or row.carrier != carrier or row.carrier_kind != kind:
                continue
        """

_MINDS = """@_inner
def _inform_NAME(_model):
    state = _state_NAME(_record_NAME(_model))
    lanes = state.fresh.shape[1]
    rows = _rows_NAME(_model)
    alive = _alive_NAME(_model)
    senses = _senses_NAME(_model)
    for slot in range(len(rows)):
        number = _model._NAME_first + slot
        if alive[slot]:
            readings = rows[slot].readings
            for place in range(len(senses)):
                state.sensors[number // lanes, place, number % lanes] = readings[senses[place]]
        else:
            for shared in range(state.group.shape[1]):  # the dead are in no group
                state.group[number // lanes, shared, number % lanes] = -1


@_inner
def _obey_NAME(_model):
    state = _state_NAME(_record_NAME(_model))
    lanes = state.fresh.shape[1]
    rows = _rows_NAME(_model)
    alive = _alive_NAME(_model)
    motors = _motors_NAME(_model)
    in_hand = -1 - _model._NAME_steered
    for slot in range(len(rows)):
        if alive[slot] and rows[slot]._id != in_hand:
            commands = rows[slot].commands
            number = _model._NAME_first + slot
            for place in range(len(motors)):
                if motors[place] >= 0:
                    commands[place] = state.actuators[
                        number // lanes, motors[place], number % lanes
                    ]


@_inner
def _think_NAME(_model):
    mind = _record_NAME(_model)
    state = _state_NAME(mind)
    state.now[0] = _model._tick
    alive = _alive_NAME(_model)
    first = 0
    while first < len(alive):
        end = first
        while end < len(alive) and alive[end]:
            end += 1
        if end > first and _call(mind.evaluate, _model._NAME_hierarchy, first, end) != 0:
            raise ValueError("a hierarchy could not be evaluated")
        first = end + 1"""

_TICK = """@_inner
def _before_minds(_model, rng):
    if _model._outside == 0:
        if _call(_model._move, _model._plane, 0, 0) != 0:
            raise ValueError("the motion of a body is not finite")
LISTINGSTAGES
INFORM
    return


@_inner
def _after_minds(_model, rng):
OBEY
PHASESBUILD    return"""


BUILD = """    if _call(_model._build, _model._plane, 0, 0) < 0:
        raise ValueError("an obstacle with a place, angle or half-width out of range")
"""
"""The look at where the obstacles are. More of them than the table has room for are found without
it, slowly."""


def plane_text(plane: PlaneProgram, looked_for: tuple[str, ...] = ()) -> str:
    """Return the functions of a plane's tick.

    Args:
        plane: the typed devices.
        looked_for: the populations whose agents rules and devices look for.

    Returns:
        The text; PHASES stands for the calls of the phases of the schedule.
    """
    parts = [HEAD]
    sought = sorted({s.of for one in plane.stages.values() for t in one.values() for s in t.seeks})
    for name in sought:
        carried = _CARRIED if name in plane.shape.bodies else ""
        parts.append(_NEAREST.replace("CARRIED", carried).replace("NAME", name))
    minded = []
    for name, stages in plane.stages.items():
        parts += [_stage_text(stage) for stage in stages.values()]
        if plane.shape.robots[name].hierarchy:
            minded.append(name)
            parts += [view_function_text(name, one, "int64", 1) for one in ("senses", "motors")]
            parts.append(_MINDS.replace("NAME", name))
    parts += [_settling_text(stage) for stage in plane.settling.values()]
    settling = [f"    _settling_{name}(_model, rng, ended)" for name in plane.settling]
    parts.append("\n".join(["@_inner\ndef _settle_rewards(_model, rng, ended):", *settling, _END]))
    names = list(plane.stages)
    lines = [f"    _rewards_{name}(_model, rng)" for name in names]
    lines += [f"    _interruptions_{name}(_model, rng)" for name in names]
    for name in names:
        lines += ["    if _model._over == 0:", f"        _actuators_{name}(_model, rng)"]
    lines += [f"    _sensors_{name}(_model, rng)" for name in names]
    lines += ["    if _model._over != 0:", "        return"]
    listing = "".join(f"    _near_list_{name}(_model)\n" for name in looked_for)
    tick = _TICK.replace("LISTING", listing).replace("STAGES", "\n".join(lines))
    tick = tick.replace("INFORM", _unsteered("inform", minded))
    tick = tick.replace("OBEY", _unsteered("obey", minded))
    parts.append(tick.replace("BUILD", BUILD if plane.shifting else ""))
    think = _unsteered("think", minded)
    parts.append(f"@_inner\ndef _think(_model):\n{think}\n    return")
    return "\n\n\n".join(parts)


_END = "    return"

TICK = """    over = _model._over
    if over == 0:
        _before_minds(_model, rng)
        if _model._over == 0:
            _think(_model)
            _after_minds(_model, rng)
    _settle_rewards(_model, rng, _model._over != over)
"""
"""The body of a tick on a plane, in place of the phases of the schedule."""


def _unsteered(what: str, minded: list[str]) -> str:
    """Return the calls of a function of each population whose minds are asked."""
    return "\n".join(
        f"    if _model._{name}_steered != {OUTSIDE}:\n        _{what}_{name}(_model)"
        for name in minded
    )


def _stage_text(stage: Stage) -> str:
    """Return a stage as a function that all robots of a population go through in it."""
    name = stage.robots.name
    lines = [
        f"@_inner\ndef _{stage.name}_{name}(_model, rng):",
        f"    rows = _rows_{name}(_model)",
        f"    alive = _alive_{name}(_model)",
        "    settings = _settings(_model)",
    ]
    if stage.name == "sensors":
        lines += [
            f"    if _model._{name}_eyes != 0:",
            f"        _call(_model._look, _model._plane, _model._{name}_eyes, 0)",
        ]
    lines += [
        "    for slot in range(len(rows)):",
        "        if not alive[slot]:",
        "            continue",
        "        agent = rows[slot]",
    ]
    return "\n".join(lines + _of_one(stage))


def _settling_text(stage: Stage) -> str:
    """Return as a function what the robots that died in a tick are still paid, or all at the end.

    Where nothing is due, 0 is added, which leaves reward and score as they are. What the dead have
    scored is added up.
    """
    name = stage.robots.name
    lines = [
        f"@_inner\ndef _settling_{name}(_model, rng, ended):",
        f"    counters = _counters_{name}(_model)",
        "    entries = counters[_bookkeeping.ENTRIES]",
        "    if not ended and counters[_bookkeeping.ALIVE] == entries:",
        "        return",
        f"    rows = _rows_{name}(_model)",
        f"    alive = _alive_{name}(_model)",
        f"    order = _order_{name}(_model)",
        "    settings = _settings(_model)",
        "    for place in range(entries):",
        "        slot = order[place]",
        "        if not ended and alive[slot]:",
        "            continue",
        "        agent = rows[slot]",
    ]
    return "\n".join(lines + _of_one(stage))


def _of_one(stage: Stage) -> list[str]:
    """Return what one robot goes through in a stage, as the lines of a loop."""
    lines = _prelude(stage)
    for number, seek in enumerate(stage.seeks):
        lines += _seek_lines(stage, number, seek)
    for call in stage.calls:
        lines += _call_lines(stage, call)
    return [f"        {line}" for line in lines + _coda(stage)]


def _prelude(stage: Stage) -> list[str]:
    lines = []
    if stage.seeks:
        lines += ["cos = _math.cos(agent.angle)", "sin = _math.sin(agent.angle)"]
    if stage.name == "rewards":
        lines += [
            "touches = agent.contact == 1",
            "if touches and not agent.touching:",
            "    agent.collisions += 1",
            "agent.touching = touches",
            "agent.reward = 0.0",
            "if agent.restarted:",
            *(f"    agent.{call.memory}[:] = 0.0" for call in stage.calls if call.memory),
            "    pass",
        ]
    if stage.name == "settling":
        lines.append("due = 0.0")
    if stage.name == "actuators":
        lines += ["agent.push_x = 0.0", "agent.push_y = 0.0", "agent.torque = 0.0"]
    return lines


def _coda(stage: Stage) -> list[str]:
    if stage.name == "rewards":
        return ["agent.score += agent.reward", "agent.restarted = False"]
    if stage.name == "actuators":
        return ["agent.before[:] = agent.commands"]
    if stage.name == "settling":
        return [
            "agent.reward += due",
            "agent.score += due",
            "if not alive[slot]:",
            "    counters[_bookkeeping.GONE] += 1",
            "    counters.view(np.float64)[_bookkeeping.GONE_SCORE] += agent.score",
        ]
    return []


def _seek_lines(stage: Stage, number: int, seek: Seek) -> list[str]:
    at, k = seek.settings, number
    kind = stage.robots.kind
    own = "slot" if seek.same else "-1"
    return [
        f"x_{k} = _mounted(agent.x, cos, sin, settings[{at}], settings[{at + 1}])",
        f"y_{k} = _mounted(agent.y, sin, -cos, settings[{at}], settings[{at + 1}])",
        f"slot_{k} = _nearest_{seek.of}(_model, x_{k}, y_{k}, settings[{at + 3}], {own}, slot, "
        f"{kind}, {seek.free})",
        f"found_{k} = slot_{k} >= 0",
        f"target_{k} = _rows_{seek.of}(_model)[max(slot_{k}, 0)]",
        f"dx_{k} = target_{k}.x - x_{k}",
        f"dy_{k} = target_{k}.y - y_{k}",
    ]


def _call_lines(stage: Stage, call: Call) -> list[str]:
    device, k = call.device, call.seek
    lines = []
    at = call.settings
    named = list(device.settings)
    values = {
        "robot": "agent",
        "model": "_model",
        "rng": "rng",
        "kind": f"{stage.robots.kind}",
        "slot": "slot",
        "members": "_model",
        "own": f"{device.of == stage.robots.name}",
        "restarted": "agent.restarted",
        "command": f"agent.commands[{call.number}]",
        "before": f"agent.before[{call.number}]",
        "memory": f"agent.{call.memory}",
        "target": f"target_{k}",
        "found": f"found_{k}",
        "distance": "distance",
        "bearing": "bearing",
    }
    if k is not None:
        carried = stage.seeks[k].carried
        # Those that another robot carries are left out, so a target that is carried is held.
        values["held"] = f"found_{k} and target_{k}.carrier_kind >= 0" if carried else "False"
    sensors = list(stage.robots.sensors)
    if device.sensor is not None:
        values["reading"] = f"agent.readings[{sensors.index(device.sensor)}]"
    if device.sensors:
        first = sensors.index(device.sensors[0])
        values["readings"] = f"agent.readings[{first} : {first + len(device.sensors)}]"
    for place, name in enumerate(named):
        values[name] = f"settings[{at + PLACED + place}]"
    if "distance" in device.takes:
        lines += [
            f"distance = _math.sqrt(dx_{k} * dx_{k} + dy_{k} * dy_{k})",
            f"if not found_{k}:",
            f"    distance = settings[{at + 3}] if _math.isfinite(settings[{at + 3}]) else 0.0",
        ]
    if "bearing" in device.takes:
        lines += [
            "bearing = 0.0",
            f"if found_{k}:",
            f"    bearing = _bearing_of(dx_{k}, dy_{k}, cos, sin, settings[{at + 2}])",
        ]
    if "rng" in device.takes:
        lines.append(f"_begin(rng, {call.tag}, agent._id, _model._tick)")
    arguments = "".join(f", {values[one]}" for one in device.takes)
    called = f"{call.symbol}(_model{arguments})"
    if stage.name == "sensors":
        lines.append(f"agent.readings[{call.number}] = _bounded({called})")
    elif stage.name == "rewards":
        lines.append(f"agent.reward += _counted({called})")
    elif stage.name == "settling":
        lines.append(f"due += _counted({called})")
    elif stage.name == "interruptions":
        heeded = f"(_model._ignored >> {call.number}) & 1 == 0"
        lines += [
            f"if {called} and _model._over == 0 and {heeded}:",
            f"    _model._over = {call.number + 1}",
        ]
    else:
        lines.append(called)
    return lines
