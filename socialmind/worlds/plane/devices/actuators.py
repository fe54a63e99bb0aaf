"""The actuators of robots: what a command, 0 … 1, makes a body do."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from socialmind.worlds.plane.devices.device import Act, is_point
from socialmind.worlds.plane.devices.given import counts, numbers
from socialmind.worlds.plane.devices.sensors import in_box


def wheel(at: tuple[float, float], force: float = 80.0) -> Act:
    """A wheel: pushes ahead with (2c − 1) · `force` at a place of the body, c the command.

    Args:
        at: its place, x ahead and y to the left of the centre; a left wheel that pushes turns the
            body to the right.
        force: at a command of 1; 0.5 is none, 0 the same backwards.
    """
    numbers("wheel", force=force)
    return Act(push, at=at, settings={"force": force, "left": at[1] if is_point(at) else 0.0})


def push(robot: Any, command: float, force: float, left: float) -> None:
    """Push a body along its direction, `left` of its centre."""
    strength = (2.0 * command - 1.0) * force
    robot.push_x += strength * math.cos(robot.angle)
    robot.push_y += strength * math.sin(robot.angle)
    robot.torque -= left * strength


def claw(of: str, half: float = 2.0, ahead: float = 2.5) -> Act:
    """A claw: closes when its command rises above 0.5, opens below 0.5, at 0.5 stays as it is.

    Closing, it grips the nearest of those objects that nobody carries and whose centres are within
    a square of sides 2·`half`, its centre `ahead` of the body's (as `in_claw` senses). What it
    holds is carried just ahead of the body until it opens. A claw that closed on nothing grips
    only when its command rises again, from 0.5 or less.
    """
    numbers("claw", least=0.0, half=half)
    numbers("claw", ahead=ahead)
    return Act(grip, of=of, at=(ahead, 0.0), settings={"half": half, "ahead": ahead})


def grip(
    robot: Any,
    members: Any,
    kind: int,
    slot: int,
    command: float,
    before: float,
    half: float,
    ahead: float,
) -> None:
    """Close or open the claw."""
    if command < 0.5:
        robot.closed = False
        robot.carrying = -1
        for one in members:
            if one.carrier_kind == kind and one.carrier == slot:
                one.carrier_kind = -1
                one.carrier = -1
    elif command > 0.5 and before <= 0.5:
        robot.closed = True
        if robot.carrying == -1:
            found = -1
            best = math.inf
            x = robot.x + ahead * math.cos(robot.angle)
            y = robot.y + ahead * math.sin(robot.angle)
            for one in members:
                if one.carrier_kind == -1 and in_box(robot, one.x, one.y, half, ahead):
                    distance = math.hypot(one.x - x, one.y - y)
                    if distance < best:
                        best = distance
                        found = one.id
            if found != -1:
                gripped = members[found]
                gripped.carrier_kind = kind
                gripped.carrier = slot
                robot.carrying = found


def emitter(channel: int = 0) -> Act:
    """A signal emitter: what it is told is heard on a channel while it is above 0.5.

    The robot's class declares `signal: list[float] = [0.0]`, a number for each channel; sensors
    hear it by `signal_orientation` and `signal_distance`.
    """
    counts("emitter", 0, channel=channel)
    return Act(emit, settings={"channel": channel})


def emit(robot: Any, command: float, channel: float) -> None:
    """Write a command as the robot's signal."""
    robot.signal[int(channel)] = command


ACTUATORS: dict[str, Callable[..., Act]] = {one.__name__: one for one in (wheel, claw, emitter)}
"""What makes actuators, by name."""
