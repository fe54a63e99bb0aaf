"""What the fields mean that come from the library: places, bodies on a plane, markets."""

from __future__ import annotations

from collections.abc import Mapping

Meaning = tuple[str, str]
"""Unit, and what it means."""

SET = "by the setup"
"""At the start, of what rules put in its place."""
PUT: frozenset[str] = frozenset({"x", "y", "angle", "half_width", "round"})
"""What the rules of the setup set, as a rule; its default says nothing."""

PLACES: Mapping[str, Meaning] = {
    "x": ("patches", "place, to the east"),
    "y": ("patches", "place, to the north"),
    "heading": ("degrees", "direction; 0 is north, clockwise"),
}
"""Of every agent, in a world of patches."""
ON_A_PLANE: Mapping[str, Meaning] = {
    "x": ("units", "place of the middle, to the right"),
    "y": ("units", "place of the middle, upwards"),
    "heading": ("degrees", "`angle` as a heading: 0 is up, clockwise"),
    "angle": ("radians", "direction, counterclockwise from the x axis"),
    "half_width": ("units", "half the side of a square, or the radius of a round obstacle"),
    "round": ("–", "1 for a cylinder, 0 for a square"),
    "vx": ("units a second", "velocity to the right"),
    "vy": ("units a second", "velocity upwards"),
    "spin": ("radians a second", "angular velocity"),
    "push_x": ("force", "what acts on it in the next tick, to the right"),
    "push_y": ("force", "the same, upwards"),
    "torque": ("torque", "the same, turning"),
    "contact": ("–", "1 while it touches a border or an obstacle, 2 while only bodies, else 0"),
    "carrier_kind": ("number", "the population of the robot that carries it, −1 for none"),
    "carrier": ("place", "which of them carries it, −1 for none"),
    "carrying": ("identity", "of the object in the claw, −1 for none"),
    "closed": ("–", "whether the claw is closed"),
    "battery": ("0 … 1", "charge"),
    "touching": ("–", "whether it touches a border or an obstacle"),
    "collisions": ("collisions", "with borders and obstacles so far"),
    "reward": ("rewards", "what its rewards gave in this tick"),
    "score": ("rewards", "their sum so far"),
    "earned": ("rewards", "what rules have it earn, until the reward takes it"),
    "restarted": ("–", "whether its rewards start anew"),
    "readings": ("0 … 1", "what its sensors read"),
    "commands": ("0 … 1", "what its actuators are told"),
    "before": ("0 … 1", "the same, the tick before"),
}
"""Of bodies, obstacles and zones on a plane (`socialmind.worlds.plane.bodies`)."""
