"""Rewards: what a robot gets for a tick, in units of its score."""

from __future__ import annotations

import math
from typing import Any

from socialmind.worlds.plane.devices import Reward


def closing(of: str, gain: float = 0.001) -> Reward:
    """For coming nearer to the nearest of a kind: `gain` for each unit, negative for going away.

    Nothing when another one has become the nearest, nor in the tick in which rewards start anew.
    """
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


def collision_cost(gain: float) -> Reward:
    """−`gain` in each tick in contact with a border, an obstacle or a body."""
    return Reward(cost_of_contact, settings={"gain": gain})


def cost_of_contact(robot: Any, gain: float) -> float:
    """Return the cost of a contact."""
    return -gain if robot.contact == 1 else 0.0
