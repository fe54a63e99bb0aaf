"""The arrays of a plane: how the two engines find bodies, obstacles and rays.

The rows of bodies and obstacles are those of the model's populations; an engine sees, from the
column `x` on, the columns that `Body` and `Obstacle` declare. All of them are eight bytes wide.
"""

from __future__ import annotations

import numpy as np

BODY = np.dtype(
    [(name, "f8") for name in (
        "x", "y", "heading", "angle", "vx", "vy", "spin", "push_x", "push_y", "torque",
    )]
    + [(name, "i8") for name in ("contact", "carrier_kind", "carrier")]
)  # fmt: skip
"""A body from its column `x` on; see `socialmind.worlds.plane.bodies.Body`."""

OBSTACLE = np.dtype(
    [(name, "f8") for name in ("x", "y", "heading", "angle", "half_width")] + [("round", "i8")]
)
"""An obstacle from its column `x` on."""

KIND = np.dtype(
    [(name, "i8") for name in ("rows", "stride", "capacity", "alive", "seen", "meets")]
    + [(name, "f8") for name in (
        "radius", "mass", "moment", "linear_damping", "angular_damping", "restitution",
    )]
)  # fmt: skip
"""A population of bodies: the address of the column `x` of its first row, the bytes from one row to
the next, how many slots there are, the address of the truth values that say which slots live,
whether range finders see it, the kinds that it collides with as bits (bit k for kind k), and what
its bodies are made of."""

PLANE = np.dtype(
    [(name, "f8") for name in ("half_width", "dt", "reach", "left", "bottom", "cell")]
    + [(name, "i8") for name in (
        "kinds", "kind_count",
        "obstacles", "obstacle_stride", "obstacle_capacity", "obstacle_alive",
        "stones", "stone_count", "cells", "cell_begin", "cell_stones", "cell_room",
        "best", "state",
    )]
)  # fmt: skip
"""A plane.

`half_width` of the arena, 0 for one without borders; `dt` seconds a tick; `reach`, how far from its
centre a body meets or sees anything; `kinds` the address of its records of kinds. Obstacles as for
kinds.

What `build` works out from them: `stones`, the address of (`stone_count`, `STONE_COLUMNS`)
numbers, a row for each living obstacle; and a table of `cells` × `cells` square cells of side
`cell`, from (`left`, `bottom`) on, row by row, that lists for each cell the stones that a body in
it can meet or see: `cell_begin`, (`cells`² + 1) 32-bit numbers, and `cell_stones`, room for
`cell_room` of them. Nothing that stands outside the table can meet a stone. A negative `cell` says
that there is no table, and every stone has to be looked at.

Room to work in: `best`, a number for each lane of the eyes with most lanes, and `state`, one for
each slot of all kinds."""

STONE_X, STONE_Y, STONE_RADIUS, STONE_COS, STONE_SIN, STONE_HALF_WIDTH, STONE_ROUND = range(7)
"""Columns of a stone. The radius is that of the circle about it; the last is 1 for round ones,
whose half-width is the radius."""
STONE_COLUMNS = 8
"""Numbers from one stone to the next: each has a cache line of its own."""

RAY = np.dtype([(name, "f8") for name in ("x", "y", "cos", "sin", "reach")] + [("sensor", "i8")])
"""A ray of a range finder: where it starts and points in the body's frame, how far it reaches, and
the number of its sensor among the body's sensors. A sensor's rays reach equally far."""

EYES = np.dtype([(name, "i8") for name in (
    "kind", "lanes", "lane_count", "sensors", "sensor_count", "depth", "readings",
)])  # fmt: skip
"""What a kind sees with: its number; the address of (5, `lane_count`) numbers, the rays' columns x,
y, cos, sin and reach; the address of the numbers of the sensors; how many sensors there are, and
how many rays each; and the bytes from the column `x` of a row to the first of its readings. Ray j
of sensor i is lane j · `sensor_count` + i. Lanes are filled up to a multiple of `LANES`."""

LANES = 8
"""Rays that are worked out together."""
FASTEST = 60.0
"""Units a second that no body exceeds (Box2D's limit, two units a step of 1/30 s)."""
SETTLING = 1.0
"""Units a second: slower impacts do not bounce (Box2D's velocity threshold)."""
FARTHEST = 1e9
"""Units: what is farther away, or larger, is nowhere; its distances are no numbers any more."""
TOUCHING = 1e-9
"""Units: bodies overlap that are deeper in each other, so that what rests against something does
not overlap it by rounding."""
MOST_ROUNDS = 32
"""How often in a tick overlaps are resolved, each of which may bring about others."""
