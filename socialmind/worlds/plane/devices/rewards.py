"""Rewards: what a robot gets for a tick, in units of its score."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from socialmind.names import several
from socialmind.worlds.plane.devices.device import Reward
from socialmind.worlds.plane.devices.given import numbers, whole


def closing(of: str, gain: float = 0.001) -> Reward:
    """For coming nearer to the nearest of a kind: `gain` for each unit, negative for going away.

    Nothing when another one has become the nearest, nor in the tick in which rewards start anew.
    """
    numbers("closing", gain=gain)
    return Reward(approach, of=of, memory=3, settings={"gain": gain})


def approach(memory: Any, target: Any, found: bool, distance: float, gain: float) -> float:
    """Return the reward for a distance that shrank; the memory knows of whom and how far."""
    if not found:
        memory[0] = 0.0
        return 0.0
    nearer = 0.0
    if memory[0] == 1.0 and memory[1] == target.id:
        nearer = memory[2] - distance
    memory[0] = 1.0
    memory[1] = float(target.id)
    memory[2] = distance
    return gain * nearer


def reached(sensor: str, amount: float, threshold: float = 0.5) -> Reward:
    """`amount` in each tick in which a sensor reads more than `threshold`."""
    numbers("reached", amount=amount, threshold=threshold)
    return Reward(
        amount_above,
        sensor=sensor,
        settings={"amount": amount, "threshold": threshold},
    )


def amount_above(reading: float, threshold: float, amount: float) -> float:
    """Return the amount if the reading is above the threshold."""
    return amount if reading > threshold else 0.0


def forward(gain: float) -> Reward:
    """`gain` in each tick in which the robot moves ahead, −10 · `gain` when it moves backwards."""
    numbers("forward", gain=gain)
    return Reward(heading_on, settings={"gain": gain})


def heading_on(robot: Any, gain: float) -> float:
    """Return the reward for the direction of the motion."""
    ahead = speed_ahead(robot)
    if ahead > 0.0:
        return gain
    return -10.0 * gain if ahead < 0.0 else 0.0


def speed_ahead(robot: Any) -> float:
    """Return the speed along the robot's direction, units a second, negative backwards."""
    return robot.vx * math.cos(robot.angle) + robot.vy * math.sin(robot.angle)


def speed(gain: float) -> Reward:
    """`gain` · v² in each tick, v the speed ahead; nothing for going backwards."""
    numbers("speed", gain=gain)
    return Reward(square_of_speed, settings={"gain": gain})


def square_of_speed(robot: Any, gain: float) -> float:
    """Return the reward for the speed ahead."""
    ahead = max(speed_ahead(robot), 0.0)
    return gain * ahead * ahead


def collision_cost(gain: float) -> Reward:
    """−`gain` in each tick in contact with a border or an obstacle."""
    numbers("collision_cost", gain=gain)
    return Reward(cost_of_contact, settings={"gain": gain})


def cost_of_contact(robot: Any, gain: float) -> float:
    """Return the cost of a contact."""
    return -gain if robot.contact == 1 else 0.0


def exploring(gain: float, side: float = 10.0, cells: int = 14) -> Reward:
    """`gain` for each square of a coarse grid that the robot comes to for the first time.

    The square where it is when rewards start anew is known.

    Args:
        gain: for a square.
        side: of a square.
        cells: how many squares a side of the grid has, whose centre is (0, 0); what lies beyond
            counts as the nearest square.
    """
    numbers("exploring", gain=gain)
    numbers("exploring", above=0.0, side=side)
    whole("exploring", 1, cells=cells)
    return Reward(
        new_cell, memory=cells * cells, settings={"gain": gain, "side": side, "cells": cells}
    )


def new_cell(
    robot: Any, memory: Any, restarted: bool, gain: float, side: float, cells: float
) -> float:
    """Return the reward for a square that the robot has not been to."""
    half = cells / 2
    column = int(max(0.0, min(math.floor(robot.x / side + half), cells - 1)))
    row = int(max(0.0, min(math.floor(robot.y / side + half), cells - 1)))
    place = row * int(cells) + column
    known = memory[place] == 1.0
    memory[place] = 1.0
    return 0.0 if known or restarted else gain


def straight(gain: float, window: int = 30, fastest: float = 2.55) -> Reward:
    """The cost of turning: −`gain` in each tick for turning at full speed all through a window.

    It is `gain` times the mean spin of the last ticks, its sign left out: swinging to and fro about
    a straight path costs little, driving in a circle much.

    Args:
        gain: the cost of a tick at full spin.
        window: so many ticks.
        fastest: the full spin, radians a second; that of a robot whose wheels push against each
            other with all their force.
    """
    numbers("straight", gain=gain)
    numbers("straight", above=0.0, fastest=fastest)
    whole("straight", 1, window=window)
    return Reward(cost_of_turning, memory=1 + window, settings={"gain": gain, "fastest": fastest})


def cost_of_turning(robot: Any, memory: Any, gain: float, fastest: float) -> float:
    """Return the cost of turning; the memory holds the next place, then the spins."""
    window = len(memory) - 1
    place = int(memory[0])
    memory[1 + place] = robot.spin
    memory[0] = float((place + 1) % window)
    total = 0.0
    for i in range(window):
        total += memory[1 + i]
    return -gain * min(abs(total) / window / fastest, 1.0)


def clear(sensors: Sequence[str], threshold: float = 0.5, gain: float = 1.0) -> Reward:
    """For keeping away: `gain` times what range finders read above a threshold, on the mean.

    Below the threshold it is a cost.

    Args:
        sensors: the names of sensors that stand next to each other in the body.
        threshold: what they read at the distance to keep, 0 … 1.
        gain: for reading 1 more than the threshold.
    """
    numbers("clear", threshold=threshold, gain=gain)
    return Reward(
        kept_away,
        sensors=several(sensors, "sensors"),
        settings={"threshold": threshold, "gain": gain},
    )


def kept_away(readings: Any, threshold: float, gain: float) -> float:
    """Return the reward for readings above the threshold."""
    return gain * (sum(readings) / len(readings) - threshold)


def paid(amount: float = 1.0) -> Reward:
    """`amount` for each unit that the model's rules have added to `robot.earned` since last time.

    A rule that sees an object brought home writes `robot.earned += 1`; the reward takes it, in the
    next tick, or at once if the robot dies or its episode ends in this one.
    """
    numbers("paid", amount=amount)
    return Reward(take, settings={"amount": amount}, settles=True)


def take(robot: Any, amount: float) -> float:
    """Return what was earned, and take it."""
    earned = robot.earned
    robot.earned = 0.0
    return amount * earned


REWARDS: dict[str, Callable[..., Reward]] = {
    one.__name__: one
    for one in (
        closing,
        reached,
        forward,
        speed,
        collision_cost,
        exploring,
        straight,
        clear,
        paid,
    )
}
"""What makes rewards, by name."""
