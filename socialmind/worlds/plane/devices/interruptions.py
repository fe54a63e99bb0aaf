"""Interruptions: what ends an episode."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from socialmind.worlds.plane.devices.device import Interruption
from socialmind.worlds.plane.devices.given import counts, numbers


def collision() -> Interruption:
    """A robot touches a border or an obstacle; to push an object is no collision."""
    return Interruption(in_contact)


def in_contact(robot: Any) -> bool:
    """Return whether the robot touches a border or an obstacle."""
    return robot.contact == 1


def flat_battery() -> Interruption:
    """A robot's battery is empty."""
    return Interruption(without_charge)


def without_charge(robot: Any) -> bool:
    """Return whether the battery is empty."""
    return robot.battery <= 0.0


def over_threshold(sensor: str, threshold: float = 0.5) -> Interruption:
    """A sensor reads more than a threshold."""
    numbers("over_threshold", threshold=threshold)
    return Interruption(reads_more, sensor=sensor, settings={"threshold": threshold})


def reads_more(reading: float, threshold: float) -> bool:
    """Return whether the reading is above the threshold."""
    return reading > threshold


def under_threshold(sensor: str, threshold: float = 0.5) -> Interruption:
    """A sensor reads less than a threshold."""
    numbers("under_threshold", threshold=threshold)
    return Interruption(reads_less, sensor=sensor, settings={"threshold": threshold})


def reads_less(reading: float, threshold: float) -> bool:
    """Return whether the reading is below the threshold."""
    return reading < threshold


def after(ticks: int) -> Interruption:
    """So many ticks have run, this one included."""
    counts("after", 1, ticks=ticks)
    return Interruption(out_of_time, settings={"ticks": ticks})


def out_of_time(model: Any, ticks: float) -> bool:
    """Return whether the tick is the last."""
    return model.tick + 1 >= ticks


INTERRUPTIONS: dict[str, Callable[..., Interruption]] = {
    one.__name__: one for one in (collision, flat_battery, over_threshold, under_threshold, after)
}
"""What makes interruptions, by name."""
