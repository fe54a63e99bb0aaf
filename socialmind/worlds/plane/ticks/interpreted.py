"""The stages of a tick on a plane in interpreted Python; the same functions as compiled."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from coglogo_py.border.places import place as place_called
from socialmind.agents.attributes import ArrayField
from socialmind.agents.bookkeeping import ENTRIES, GONE, GONE_SCORE
from socialmind.errors import RuleError, place_of
from socialmind.streams import Stream
from socialmind.worlds.contract import Functions
from socialmind.worlds.plane.devices.relative import bearing_of, bounded, counted, mounted
from socialmind.worlds.plane.kernel.code import kernel
from socialmind.worlds.plane.steering import OUTSIDE, in_hand
from socialmind.worlds.plane.ticks.stages import PLACED, STAGES, Call, Seek, Stage

if TYPE_CHECKING:
    from socialmind.agents.running import Running
    from socialmind.worlds.plane.arena import Arena


def run_tick(arena: Arena, functions: Functions, schedule: Callable[[], None]) -> None:
    """Run a tick on a plane, on which nothing happens any more after an interruption."""
    over = arena.over
    if over is None:
        _before_minds(arena, functions)
    if arena.over is None:
        _think(arena)
        schedule()
        arena.after_compiled_tick()
    settle_rewards(arena, functions, arena.over != over)


def _before_minds(arena: Arena, functions: Functions) -> None:
    """Run a tick up to what the minds are told."""
    model, plan = arena.society, arena.society.program.world
    arena.move()
    for name in STAGES:
        if name != "actuators" or not model.context["_over"]:
            for stages in plan.stages.values():
                _run(model, functions, stages[name])


def settle_rewards(arena: Arena, functions: Functions, ended: bool) -> None:
    """Pay what is due to the robots that died in this tick, or to all where an episode ended."""
    model = arena.society
    for name, stage in model.program.world.settling.items():
        table = model.tables[name]
        for slot in table.order[: int(table.counters[ENTRIES])].tolist():
            if ended or not table.alive[slot]:
                _robot(model, functions, stage, table, slot)
            if not table.alive[slot]:
                table.counters[GONE] += 1
                table.counters.view(np.float64)[GONE_SCORE] += table.rows["score"][slot]


def _think(arena: Arena) -> None:
    """Evaluate the hierarchies of skills, and hand their commands to the actuators."""
    model = arena.society
    for name, senses in arena.senses.items():
        steered = int(model.context[f"_{name}_steered"])
        if steered == OUTSIDE:
            continue
        table = model.tables[name]
        minds: Any = table.minds
        living = np.flatnonzero(table.alive).tolist()
        minds.state.group[~table.alive] = -1  # the dead are in no group
        for slot in living:
            minds.state.sensors[slot, :, 0] = table.rows["readings"][slot][senses]
        for slot in living:
            _evaluate(model, name, slot)
        motors = arena.motors[name]
        known = motors >= 0
        for slot in living:
            if table.rows["_id"][slot] == in_hand(steered):
                continue
            commands = minds.state.actuators[slot, motors[known], 0]
            table.rows["commands"][slot, : len(motors)][known] = commands


def _evaluate(model: Running, population: str, slot: int) -> None:
    """Evaluate one hierarchy; what fails is said with its place."""
    minds: Any = model.tables[population].minds
    try:
        minds.stepping.evaluate(slot)
    except Exception as error:
        identity = model.tables[population].rows["_id"].item(slot)
        who = f"the hierarchy of agent {identity} of {population!r}"
        what = f"{type(error).__name__}: {error}"
        raise RuleError(what, place_of(error, "in a hierarchy"), model.tick, who) from error


def _heeded(model: Running, interruption: Call) -> bool:
    """Return whether an interruption ends what goes on."""
    ignored = int(model.context["_ignored"]) >> interruption.number & 1
    return not model.context["_over"] and not ignored


def _run(model: Running, functions: Functions, stage: Stage) -> None:
    table = model.tables[stage.robots.name]
    if stage.name == "sensors":
        eyes = model.ground.eyes_of(stage.robots.name)
        if eyes:
            kernel().look.ctypes(model.ground.plane_arrays.address, eyes, 0)
    for slot in range(len(table.rows)):
        if table.alive[slot]:
            _robot(model, functions, stage, table, slot)


def _robot(model: Running, functions: Functions, stage: Stage, table: Any, slot: int) -> None:
    robot = table.row_class(table, slot)
    row = table.rows[slot]
    cos, sin = math.cos(robot.angle), math.sin(robot.angle)
    if stage.name == "rewards":
        touches = robot.contact == 1
        robot.collisions += int(touches and not robot.touching)
        robot.touching = touches
        robot.reward = 0.0
        if robot.restarted:
            for call in stage.calls:
                if call.memory:
                    row[call.memory] = 0.0
    if stage.name == "actuators":
        robot.push_x = robot.push_y = robot.torque = 0.0
    seen = [_sought(model, stage, seek, robot, slot, cos, sin) for seek in stage.seeks]
    due = 0.0
    for call in stage.calls:
        due += _call(model, functions, stage, call, robot, slot, seen, (cos, sin))
    if stage.name == "settling":
        robot.reward += due
        robot.score += due
    if stage.name == "rewards":
        robot.score += robot.reward
        robot.restarted = False
    if stage.name == "actuators":
        row["before"] = row["commands"]


def _sought(
    model: Running, stage: Stage, seek: Seek, robot: Any, slot: int, cos: float, sin: float
) -> tuple[Any, bool, float, float]:
    """Return the nearest target, whether there is one, and how far it is away in x and y."""
    settings = model.ground.settings
    ahead, aside, _, reach = settings[seek.settings : seek.settings + PLACED].tolist()
    x = mounted(robot.x, cos, sin, ahead, aside)
    y = mounted(robot.y, sin, -cos, ahead, aside)
    table: Any = model.tables[seek.of]
    nearest, least = -1, reach * reach
    for other in range(len(table.rows)):
        if not table.alive[other] or (seek.same and other == slot):
            continue
        row = table.rows[other]
        if seek.carried and row["carrier_kind"] >= 0:
            own = row["carrier"] == slot and row["carrier_kind"] == stage.robots.kind
            if seek.free or not own:
                continue
        dx, dy = float(row["x"]) - x, float(row["y"]) - y
        away = dx * dx + dy * dy
        if away < least or (nearest < 0 and away <= least):
            nearest, least = other, away
    target: Any = table.row_class(table, max(nearest, 0))
    return target, nearest >= 0, float(target.x) - x, float(target.y) - y


def _call(
    model: Running,
    functions: Functions,
    stage: Stage,
    call: Call,
    robot: Any,
    slot: int,
    seen: list[tuple[Any, bool, float, float]],
    turned: tuple[float, float],
) -> float:
    """Call a device; return what it pays beside the rewards of the tick."""
    device = call.device
    settings = model.ground.settings
    _, _, angle, reach, *numbers = settings[
        call.settings : call.settings + PLACED + len(device.settings)
    ].tolist()
    values: dict[str, Any] = dict(zip(device.settings, numbers, strict=True))
    values |= {"robot": robot, "model": model, "kind": stage.robots.kind, "slot": slot}
    values |= {"restarted": robot.restarted}
    sensors = list(stage.robots.sensors)
    if device.of is not None:
        values["members"] = model.tables[device.of]
        values["own"] = device.of == stage.robots.name
    if call.seek is not None:
        target, found, dx, dy = seen[call.seek]
        values |= {"target": target, "found": found}
        values["distance"] = math.sqrt(dx * dx + dy * dy)
        values["bearing"] = bearing_of(dx, dy, *turned, angle) if found else 0.0
        if not found:
            values["distance"] = reach if math.isfinite(reach) else 0.0
        # Those that another robot carries are left out, so a target that is carried is held.
        carried = stage.seeks[call.seek].carried
        values["held"] = carried and found and target.carrier_kind >= 0
    if device.sensor is not None:
        values["reading"] = robot.readings[sensors.index(device.sensor)]
    if device.sensors:
        first = sensors.index(device.sensors[0])
        row = model.tables[stage.robots.name].rows[slot]
        values["readings"] = ArrayField(row["readings"][first : first + len(device.sensors)])
    if call.memory:
        values["memory"] = getattr(robot, call.memory)
    if stage.name == "actuators":
        values["command"] = robot.commands[call.number]
        values["before"] = robot.before[call.number]
    if "rng" in device.takes:
        values["rng"] = Stream(model.seed)
        values["rng"].begin(call.tag, robot.id, model.tick)
    try:
        result = functions[call.symbol](*(values[one] for one in device.takes))
        if stage.name == "sensors":
            robot.readings[call.number] = bounded(result)
        elif stage.name == "rewards":
            robot.reward += counted(result)
        elif stage.name == "settling":
            return counted(result)
        elif stage.name == "interruptions" and result and _heeded(model, call):
            model.context["_over"] = call.number + 1
    except Exception as error:
        file, line = device.place
        place = place_of(error, place_called(file, line))
        who = f"the {device.word} {call.name!r} of agent {robot.id} of {stage.robots.name!r}"
        raise RuleError(f"{type(error).__name__}: {error}", place, model.tick, who) from error
    return 0.0
