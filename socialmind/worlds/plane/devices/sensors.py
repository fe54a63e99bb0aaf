"""The sensors of robots: range finders, and functions of what the robot is and sees.

All read 0 … 1. Those that say yes or no read `high` and `low`, 1 and 0 unless told otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_whole
from socialmind.errors import ModelError, called_at
from socialmind.worlds.plane.devices.device import Sense, is_point
from socialmind.worlds.plane.devices.given import counts, numbers, whole
from socialmind.worlds.plane.layout import RAY

HALF_ANGLE = math.radians(6.0)
"""Half the cone of a range finder."""


@dataclass(frozen=True)
class RangeFinder:
    """A range finder: how near something is in a narrow cone, over its reach; 1 for nothing.

    It sees borders, obstacles and bodies that are made to be seen, never the robot itself or what
    is carried, and reads the smallest of its rays.

    Attributes:
        angle: its direction on the body, radians counterclockwise.
        reach: how far it sees, from its place on.
        half_angle: half the cone, radians.
        rays: how many rays, spread over the cone from one side to the other.
        at: its place on the body, x ahead and y to the left; None for the rim, at its angle.

    Raises:
        ModelError: a number outside its range.

    >>> RangeFinder(angle=0.0, half_angle=0.0, rays=1).lines(radius=1.0, sensor=2)["x"].tolist()
    [1.0]
    """

    angle: float = 0.0
    reach: float = 12.0
    half_angle: float = HALF_ANGLE
    rays: int = 3
    at: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        half, at = self.half_angle, self.at
        checks = (
            ("angle", "radians", is_number(self.angle)),
            ("reach", "a number above 0", is_number(self.reach) and self.reach > 0),
            ("half_angle", "radians, 0 … pi", is_number(half) and 0 <= half <= math.pi),
            ("rays", "a whole number, 1 or more", is_whole(self.rays) and self.rays >= 1),
            ("at", "two numbers, or None for the rim", at is None or is_point(at)),
        )
        for name, expected, fits in checks:
            if not fits:
                found = f"{name}={shown(getattr(self, name))} of a range finder"
                raise ModelError(found, expected, None, *called_at())

    def place(self, radius: float) -> tuple[float, float]:
        """Return where it sits on a body of some radius."""
        if self.at is not None:
            return self.at
        return radius * math.cos(self.angle), radius * math.sin(self.angle)

    @property
    def directions(self) -> tuple[float, ...]:
        """The directions of its rays on the body, radians, from right to left."""
        if self.rays == 1:
            return (self.angle,)
        step = 2 * self.half_angle / (self.rays - 1)
        return tuple(self.angle - self.half_angle + step * ray for ray in range(self.rays))

    def lines(self, radius: float, sensor: int) -> NDArray[np.void]:
        """Return its rays as the engines see them, `layout.RAY`.

        Args:
            radius: the radius of the body.
            sensor: the sensor's number among those of the body.
        """
        x, y = self.place(radius)
        made = np.zeros(self.rays, RAY)
        made["x"], made["y"], made["reach"], made["sensor"] = x, y, self.reach, sensor
        made["cos"] = [math.cos(direction) for direction in self.directions]
        made["sin"] = [math.sin(direction) for direction in self.directions]
        return made


# What is seen ---------------------------------------------------------------------------------


def orientation(of: str, reach: float | str = math.inf) -> Sense:
    """Where the nearest of a kind is: 0.5 − angle / 2π, 0.5 ahead, less to the left.

    A reach, here and below, is a number or the name of a parameter of the model.

    Where there is none within reach it reads 0.5. For the nearest team mate, `of` is the robot's
    own population.
    """
    return Sense(turn_to, of=of, reach=reach)


def turn_to(bearing: float) -> float:
    """Return a bearing as a sensor reads it.

    >>> turn_to(math.pi / 2)
    0.25
    """
    return 0.5 - bearing / math.tau


def distance_to(of: str, reach: float | str = 100.0) -> Sense:
    """How far the nearest of a kind is, over the reach; 1 where there is none within reach."""
    return Sense(share_of_reach, of=of, reach=reach, settings={"largest": reach})


def share_of_reach(distance: float, found: bool, largest: float) -> float:
    """Return a distance over the largest one, at most 1."""
    return min(distance / largest, 1.0) if found and largest > 0.0 else 1.0


def active(of: str, reach: float | str = math.inf, low: float = 0.0, high: float = 1.0) -> Sense:
    """Whether there is one of a kind within reach."""
    return Sense(is_there, of=of, reach=reach, settings=_truth(low, high))


def is_there(found: bool, low: float, high: float) -> float:
    """Return `high` if something was found."""
    return high if found else low


def in_claw(
    of: str, half: float = 2.0, ahead: float = 2.5, low: float = 0.0, high: float = 1.0
) -> Sense:
    """Whether an object is where the claw grips, or in the claw.

    That is, whether the centre of one that nobody else carries is within a square of sides
    2·`half`, whose centre is `ahead` of the body's centre and which turns with the body.
    """
    numbers("in_claw", least=0.0, half=half)
    numbers("in_claw", ahead=ahead)
    return Sense(can_grip, of=of, settings={"half": half, "ahead": ahead, **_truth(low, high)})


def can_grip(
    robot: Any,
    members: Any,
    kind: int,
    slot: int,
    half: float,
    ahead: float,
    low: float,
    high: float,
) -> float:
    """Return `high` if the robot carries a member, or could."""
    farthest = abs(ahead) + 2.0 * half  # beyond which nothing is in the box, however it is turned
    for one in members:
        if one.carrier_kind == -1:
            near = abs(one.x - robot.x) <= farthest and abs(one.y - robot.y) <= farthest
            if near and in_box(robot, one.x, one.y, half, ahead):
                return high
        elif one.carrier_kind == kind and one.carrier == slot:
            return high
    return low


def in_box(robot: Any, x: float, y: float, half: float, ahead: float) -> bool:
    """Return whether a point is in a square ahead of a robot."""
    cos = math.cos(robot.angle)
    sin = math.sin(robot.angle)
    along = cos * (x - robot.x) + sin * (y - robot.y) - ahead
    aside = cos * (y - robot.y) - sin * (x - robot.x)
    return abs(along) <= half and abs(aside) <= half


def inside(of: str, low: float = 0.0, high: float = 1.0) -> Sense:
    """Whether the body's centre is in one of the zones of a population."""
    return Sense(is_inside, of=of, settings=_truth(low, high))


def is_inside(robot: Any, members: Any, low: float, high: float) -> float:
    """Return `high` if the robot's centre is in a zone."""
    for zone in members:
        if in_zone(zone, robot.x, robot.y):
            return high
    return low


def in_zone(zone: Any, x: float, y: float) -> bool:
    """Return whether a point is in a zone, a square turned by its angle; rules may call it."""
    cos = math.cos(zone.angle)
    sin = math.sin(zone.angle)
    along = cos * (x - zone.x) + sin * (y - zone.y)
    aside = cos * (y - zone.y) - sin * (x - zone.x)
    return abs(along) <= zone.half_width and abs(aside) <= zone.half_width


# What is heard ---------------------------------------------------------------------------------


def signal_orientation(of: str, channel: int = 0, reach: float | str = math.inf) -> Sense:
    """Where the nearest robot that emits a signal is; as `orientation`.

    Args:
        of: the population of the robots that are heard; the robot never hears itself. Its class
            declares `signal: list[float] = [0.0]`, a number for each channel.
        channel: the channel that an `emitter` writes.
        reach: how far a signal is heard.
    """
    counts("signal_orientation", 0, channel=channel)
    return Sense(heard_from, of=of, settings={"channel": channel, "farthest": reach})


def heard_from(robot: Any, members: Any, own: bool, channel: float, farthest: float) -> float:
    """Return where the nearest signal comes from."""
    best = farthest
    reading = 0.5
    for one in members:
        if one.signal[int(channel)] > 0.5 and not (own and one.id == robot.id):
            dx = one.x - robot.x
            dy = one.y - robot.y
            distance = math.hypot(dx, dy)
            if distance <= best:
                best = distance
                cos = math.cos(robot.angle)
                sin = math.sin(robot.angle)
                reading = turn_to(math.atan2(cos * dy - sin * dx, cos * dx + sin * dy))
    return reading


def signal_distance(of: str, channel: int = 0, reach: float | str = 100.0) -> Sense:
    """How far the nearest robot that emits a signal is, over the reach; 1 when none is heard.

    Args:
        of: as for `signal_orientation`.
        channel: likewise.
        reach: likewise.
    """
    counts("signal_distance", 0, channel=channel)
    return Sense(heard_at, of=of, settings={"channel": channel, "farthest": reach})


def heard_at(robot: Any, members: Any, own: bool, channel: float, farthest: float) -> float:
    """Return the distance of the nearest signal over the range."""
    best = farthest
    for one in members:
        if one.signal[int(channel)] > 0.5 and not (own and one.id == robot.id):
            best = min(best, math.hypot(one.x - robot.x, one.y - robot.y))
    return best / farthest if farthest > 0.0 else 1.0


def signal_active(
    of: str,
    channel: int = 0,
    reach: float | str = math.inf,
    low: float = 0.0,
    high: float = 1.0,
) -> Sense:
    """Whether a robot that emits a signal is heard.

    Args:
        of: as for `signal_orientation`.
        channel: likewise.
        reach: likewise.
        low: what it reads when none is heard.
        high: what it reads when one is.
    """
    counts("signal_active", 0, channel=channel)
    told = {"channel": channel, "farthest": reach, **_truth(low, high)}
    return Sense(hears, of=of, settings=told)


def hears(
    robot: Any,
    members: Any,
    own: bool,
    channel: float,
    farthest: float,
    low: float,
    high: float,
) -> float:
    """Return `high` if a signal is within reach."""
    for one in members:
        emits = one.signal[int(channel)] > 0.5 and not (own and one.id == robot.id)
        if emits and math.hypot(one.x - robot.x, one.y - robot.y) <= farthest:
            return high
    return low


# What is felt ---------------------------------------------------------------------------------


def battery() -> Sense:
    """The charge of the battery, rounded up to 1/100."""
    return Sense(charge)


def charge(robot: Any) -> float:
    """Return the charge, rounded up to hundredths."""
    # A hair less, or a charge of 0.07 would be 0.08: 100 · 0.07 is a hair over 7.
    return max(0.0, min(math.ceil(100.0 * robot.battery - 1e-9) / 100.0, 1.0))


def moved(positions: int = 20, every: int = 20, largest: float = 3.0) -> Sense:
    """How much the robot moves about: the mean distance between its last positions.

    Args:
        positions: how many positions are remembered, 2 or more; while there are fewer, it reads
            the mean over those, and 0 before the second.
        every: ticks from one remembered position to the next.
        largest: the mean distance that reads 1.
    """
    whole("moved", 2, positions=positions)
    counts("moved", 1, every=every)
    numbers("moved", above=0.0, largest=largest)
    return Sense(
        roaming,
        memory=4 + 2 * positions,
        settings={"every": every, "largest": largest},
    )


def roaming(robot: Any, memory: Any, every: float, largest: float) -> float:
    """Return how much the robot moves; the memory holds ticks, count, place and reading first."""
    room = (len(memory) - 4) // 2
    if memory[0] == 0.0:
        place = int(memory[2])
        memory[4 + 2 * place] = robot.x
        memory[5 + 2 * place] = robot.y
        memory[2] = float((place + 1) % room)
        memory[1] = min(memory[1] + 1.0, float(room))
        count = int(memory[1])
        total = 0.0
        for i in range(count):
            for j in range(i):
                dx = memory[4 + 2 * i] - memory[4 + 2 * j]
                dy = memory[5 + 2 * i] - memory[5 + 2 * j]
                total += math.hypot(dx, dy)
        if count > 1:
            memory[3] = min(total / (count * (count - 1) / 2) / largest, 1.0)
    memory[0] = (memory[0] + 1.0) % every
    return memory[3]


def constant(value: float) -> Sense:
    """Always the same, 0 … 1."""
    numbers("constant", value=value)
    return Sense(same, settings={"value": value})


def same(value: float) -> float:
    """Return the value."""
    return value


def identity(robots: int) -> Sense:
    """Which of a population's robots it is: 0, 1 / (n − 1) … 1 for n robots, in order of places."""
    counts("identity", 1, robots=robots)
    return Sense(rank, settings={"robots": robots})


def rank(slot: int, robots: float) -> float:
    """Return the place of a robot among so many, 0 … 1."""
    return min(slot / (robots - 1), 1.0) if robots > 1 else 0.0


def carrying(low: float = 0.0, high: float = 1.0) -> Sense:
    """Whether the claw holds something."""
    return Sense(holds, settings=_truth(low, high))


def holds(robot: Any, low: float, high: float) -> float:
    """Return `high` if the robot carries something."""
    return high if robot.carrying != -1 else low


def noise(every: int = 1) -> Sense:
    """A number drawn uniformly from 0 … 1, anew every so many ticks."""
    counts("noise", 1, every=every)
    return Sense(drawn, memory=2, settings={"every": every})


def drawn(rng: Any, memory: Any, every: float) -> float:
    """Return a random number; the memory holds the ticks since it was drawn, and the number."""
    if memory[0] == 0.0:
        memory[1] = rng.random()
    memory[0] = (memory[0] + 1.0) % every
    return memory[1]


def payoff(scale: float = 1.0) -> Sense:
    """The robot's reward of this tick: 0.5 for none, 1 for `scale` or more, 0 for −`scale`."""
    numbers("payoff", above=0.0, scale=scale)
    return Sense(felt_reward, settings={"scale": scale})


def felt_reward(robot: Any, scale: float) -> float:
    """Return the reward of this tick around 0.5."""
    return max(0.0, min(0.5 + 0.5 * robot.reward / scale, 1.0))


SENSORS: dict[str, Callable[..., Sense]] = {
    one.__name__: one
    for one in (
        orientation,
        distance_to,
        active,
        in_claw,
        inside,
        signal_orientation,
        signal_distance,
        signal_active,
        battery,
        moved,
        constant,
        identity,
        carrying,
        noise,
        payoff,
    )
}
"""What makes sensors, by name; beside them there is the `RangeFinder`."""


def _truth(low: float, high: float) -> dict[str, float | str]:
    return {"low": low, "high": high}
