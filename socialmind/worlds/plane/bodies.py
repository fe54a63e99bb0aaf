"""Bodies on a plane: robots and objects, obstacles, zones; and what they are made of.

They are populations of a model as any other: rows with fields that rules read and write. A body
that moves inherits from `Body`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_truth
from socialmind.agents.agent import Agent
from socialmind.errors import ModelError, called_at
from socialmind.names import several

__all__ = ["BALL", "Body", "Disc", "Obstacle", "Robot", "Zone"]


class Body(Agent):
    """A round body that moves: a robot or an object.

    `angle` is its orientation in radians, counterclockwise from the x axis; `heading` the same in
    degrees clockwise from north, as everywhere else. `vx`, `vy` units a second and `spin` radians a
    second are its motion; `push_x`, `push_y` and `torque` what acts on it in the next tick.
    `contact` is 1 while it touches a border or an obstacle, 2 while it touches nothing but bodies
    that collide with it, else 0.
    `carrier_kind` and `carrier` say who carries it, -1 for nobody: a carried body stays just ahead
    of its carrier and touches nothing.
    """

    angle: float = 0.0
    vx: float = 0.0
    vy: float = 0.0
    spin: float = 0.0
    push_x: float = 0.0
    push_y: float = 0.0
    torque: float = 0.0
    contact: int = 0
    carrier_kind: int = -1
    carrier: int = -1


class Robot(Body):
    """A body with sensors and actuators.

    `carrying` is the identity of what its claw holds, -1 for nothing; `closed` whether the claw is
    closed; `battery` its charge, 0 … 1; `touching` whether it touches a border or an obstacle, and
    `collisions` how often it has run into one; `reward` what its reward functions gave in this
    tick, and `score` their sum. Rules add to `earned` what the reward `paid` then takes.
    `restarted` says that its rewards start anew: they forget what they remember.
    """

    carrying: int = -1
    closed: bool = False
    battery: float = 1.0
    touching: bool = False
    collisions: int = 0
    reward: float = 0.0
    score: float = 0.0
    earned: float = 0.0
    restarted: bool = True


OWN = ("carrying", "closed", "collisions", "reward", "score", "earned", "restarted")
"""What a robot that is hatched does not take from its parent: what the parent holds, and how it
fared."""


class Obstacle(Agent):
    """What stands in the way and never moves.

    It is a square of sides 2·`half_width` turned by `angle` (radians), or a cylinder of that radius
    where `round` is 1.
    """

    angle: float = 0.0
    half_width: float = 1.0
    round: int = 0


class Zone(Agent):
    """A square on the ground of sides 2·`half_width`, turned by `angle` (radians)."""

    angle: float = 0.0
    half_width: float = 5.0


LARGEST = 1e6
"""Beyond it, and below its inverse, what a body is made of gives masses that are no numbers."""


@dataclass(frozen=True)
class Disc:
    """What the bodies of a population are made of.

    Attributes:
        radius: 10⁻⁶ … 10⁶.
        density: likewise; the mass is density · π · radius².
        linear_damping: per second, 0 … 10⁶: v is multiplied by 1 / (1 + dt · damping).
        angular_damping: per second, likewise.
        restitution: 0 … 1000, 0 for impacts without a bounce; of two bodies the larger counts, and
            at borders and obstacles at most 1, or what bounces would never come to rest.
        meets: the names of the populations of bodies that it collides with. Borders and obstacles
            stop every body.
        seen: whether range finders see it.

    The defaults are the robot's of EvoAgents; `BALL` is its target object.

    Raises:
        ModelError: a number outside its range.
    """

    radius: float = 1.0
    density: float = 2.0
    linear_damping: float = 5.0
    angular_damping: float = 20.0
    restitution: float = 0.0
    meets: tuple[str, ...] = ()
    seen: bool = True

    def __post_init__(self) -> None:
        for name in ("radius", "density", "linear_damping", "angular_damping", "restitution"):
            least = 1 / LARGEST if name in ("radius", "density") else 0.0
            high = 1000.0 if name == "restitution" else LARGEST
            value = getattr(self, name)
            if not (is_number(value) and least <= value <= high):
                found = f"{name}={shown(value)} of a body"
                raise ModelError(found, f"a number, {least:g} … {high:g}", None, *called_at())
        if not is_truth(self.seen):
            found = f"seen={shown(self.seen)} of a body"
            raise ModelError(found, "True or False", None, *called_at())
        object.__setattr__(self, "meets", several(self.meets, "meets"))

    @property
    def mass(self) -> float:
        """The mass, density · π · radius²."""
        return self.density * math.pi * self.radius**2

    @property
    def moment(self) -> float:
        """The moment of inertia of a disc, ½ · mass · radius²."""
        return 0.5 * self.mass * self.radius**2


BALL = Disc(linear_damping=0.15, angular_damping=1.5, restitution=1.8, seen=False)
"""The target object of EvoAgents: a ball that robots push about unless they hold it."""
