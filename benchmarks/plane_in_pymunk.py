"""The world of Collect as a modeller would write it on pymunk: a plain Python loop.

Pymunk moves, finds contacts and answers the range finders' queries; the rest is Python, and numpy
where it is faster. It was made quick where Python allows: forces and damping are applied by hand
rather than by callbacks, the robot's angle is kept outside of pymunk (without friction nothing
turns it), all rays are turned in one go, and a ball that is carried is out of the space.
"""

import math
import random
from collections.abc import Callable, Sequence
from itertools import repeat
from operator import mul
from typing import Any

import numpy as np
import pymunk
from numpy.typing import NDArray

DT = 1 / 30
MASS, MOMENT = 2.0 * math.pi, math.pi  # radius 1, density 2
SLOWING, SPIN_SLOWING, BALL_SLOWING = 1 + 5.0 * DT, 1 + 20.0 * DT, 1 + 0.15 * DT
FORCE, BOUNCE = 80.0, 1.8
HALF_WIDTH, SPACING, SIDE, JITTER = 70.0, 18.0, 8, 1.0
ZONE_X, ZONE_Y, ZONE_HALF = -40.0, -40.0, 5.0
CLAW_AHEAD, CLAW_HALF = 2.5, 2.0
ANGLES = (0.0, 22.5, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 337.5)
REACH, HALF_ANGLE = 12.0, 6.0
REMEMBERED, EVERY, LARGEST = (
    20,
    20,
    3.0,
)  # positions, ticks between them, mean distance that reads 1

STILL, ROBOT, BALL = 1, 2, 4
SEEN = pymunk.ShapeFilter(mask=STILL)

Place = tuple[float, float]
Obstacle = tuple[float, float, float, float]  # x, y, angle, half-width
Layers = Sequence[tuple[NDArray[np.float64], NDArray[np.float64]]]  # weights and biases
Network = Callable[[list[float]], list[float]]


# The controller ----------------------------------------------------------------------------------


def network(layers: Layers) -> Network:
    """Return a perceptron: by lists for a few weights, by numpy for many, whichever is faster."""
    if sum(weights.size for weights, _ in layers) < 100:
        return _in_lists(layers)
    *hidden, (last, last_biases) = layers

    def evaluate(values: list[float]) -> list[float]:
        signals = np.array(values)
        for weights, biases in hidden:
            signals = weights.dot(signals)
            signals += biases
            np.maximum(signals, 0.0, out=signals)
        signals = last.dot(signals)
        signals += last_biases
        return [min(max(one, 0.0), 1.0) for one in signals.tolist()]

    return evaluate


def _in_lists(layers: Layers) -> Network:
    *hidden, last = [list(zip(w.tolist(), b.tolist(), strict=True)) for w, b in layers]

    def evaluate(values: list[float]) -> list[float]:
        for layer in hidden:
            values = [max(0.0, sum(map(mul, weights, values), bias)) for weights, bias in layer]
        return [min(1.0, max(0.0, sum(map(mul, weights, values), bias))) for weights, bias in last]

    return evaluate


class Mind:
    """The hierarchy of figure 6.1; only skills that receive influence are evaluated.

    Args:
        layers: of each skill's network.
    """

    def __init__(self, layers: dict[str, Layers]) -> None:
        networks = {name: network(one) for name, one in layers.items()}
        self.go_to_object = networks["GoToObject"]
        self.go_to_zone = networks["GoToDropZone"]
        self.avoid = networks["Avoid"]
        self.object_or_avoid = networks["GoToObject+Avoid"]
        self.zone_or_avoid = networks["GoToDropZone+Avoid"]
        self.collect = networks["Collect"]

    def commands(
        self, near: list[float], to_object: float, to_zone: float, in_reach: float, in_zone: float
    ) -> tuple[float, float, float]:
        """Return what the wheels and the claw are told.

        Args:
            near: ten range finders, movement, the wave.
            to_object: orientation of the object.
            to_zone: orientation of the drop zone.
            in_reach: whether the claw reaches the object.
            in_zone: whether the robot is in the zone.
        """
        first, second, third = self.collect([in_reach, in_zone])
        left = right = total = avoiding = 0.0
        if first > 0.0:
            going, avoided = self.object_or_avoid([*near, to_object])
            avoiding += first * avoided
            if going > 0.0:
                influence = first * going
                one, other = self.go_to_object([to_object])
                left += one * influence
                right += other * influence
                total += influence
        if second > 0.0:
            going, avoided = self.zone_or_avoid([to_zone, *near])
            avoiding += second * avoided
            if going > 0.0:
                influence = second * going
                one, other = self.go_to_zone([to_zone])
                left += one * influence
                right += other * influence
                total += influence
        if avoiding > 0.0:
            one, other = self.avoid(near)
            left += one * avoiding
            right += other * avoiding
            total += avoiding
        claw = 0.5
        if third > 0.0:
            claw = 0.0 if in_zone > 0.5 else 1.0 if in_reach > 0.5 else 0.5
        if total > 0.0:
            return left / total, right / total, claw
        return 0.5, 0.5, claw


# The world ---------------------------------------------------------------------------------------


class Drawn:
    """What is drawn for a world of the standard benchmark.

    Args:
        seed: of the world.
    """

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)
        uniform = self._random.uniform
        self.obstacles: list[Obstacle] = []
        for cell in range(SIDE * SIDE):
            x = (cell // SIDE) * SPACING - HALF_WIDTH + uniform(-JITTER, JITTER)
            y = (cell % SIDE) * SPACING - HALF_WIDTH + uniform(-JITTER, JITTER)
            angle, half = uniform(0.0, math.pi), uniform(1.0, 3.0)
            clear = math.hypot(x, y) >= half + 2.0
            if clear and math.hypot(x - ZONE_X, y - ZONE_Y) >= half + ZONE_HALF:
                self.obstacles.append((x, y, angle, half))
        self.angle = uniform(-math.pi, math.pi)

    def object_place(self) -> Place:
        """Return where the next object is put."""
        while True:
            x, y = (self._random.uniform(-60.0, 60.0) for _ in range(2))
            if math.hypot(x - ZONE_X, y - ZONE_Y) > 50.0 and all(
                math.hypot(x - one[0], y - one[1]) >= one[3] * 1.4143 + 4.0
                for one in self.obstacles
            ):
                return x, y


def _rays() -> NDArray[np.complex128]:
    """Return for each range finder where its rays start and where the three end, on the body."""
    points = []
    for angle in ANGLES:
        start = np.exp(1j * math.radians(angle))
        turns = (angle - HALF_ANGLE, angle, angle + HALF_ANGLE)
        points += [start, *(start + REACH * np.exp(1j * math.radians(turn)) for turn in turns)]
    return np.array(points)


RAYS = _rays()


class World:
    """An episode: it ends where the robot touches a border or an obstacle.

    Args:
        obstacles: x, y, angle and half-width of each.
        angle: of the robot at the start.
        object_place: gives the place of the next object.
        mind: the controller.
    """

    def __init__(
        self,
        obstacles: Sequence[Obstacle],
        angle: float,
        object_place: Callable[[], Place],
        mind: Mind,
    ) -> None:
        self.mind = mind
        self.object_place = object_place
        self.tick = self.delivered = 0
        self.angle, self.spin = angle, 0.0
        self.left = self.right = self.claw = self.before = 0.5
        self.carrying = self.lifted = self.collided = False
        self.push = self.torque = self.moved = self.apart = 0.0
        self.positions: list[Place] = []
        self.space = space = pymunk.Space()
        self._build(obstacles)
        self.robot, self.robot_shape = self._disc(ROBOT, 1.0)
        self.ball, self.ball_shape = self._disc(BALL, BOUNCE)
        self.ball.position = object_place()
        space.add(self.robot, self.robot_shape, self.ball, self.ball_shape)
        space.on_collision(ROBOT, STILL, begin=self._collide)

    def _build(self, obstacles: Sequence[Obstacle]) -> None:
        ground, end = self.space.static_body, HALF_WIDTH + 2.0
        line = HALF_WIDTH + 1.0
        shapes: list[pymunk.Shape] = [
            pymunk.Segment(ground, start, stop, 1.0)
            for start, stop in (
                ((line, -end), (line, end)), ((-line, -end), (-line, end)),
                ((-end, line), (end, line)), ((-end, -line), (end, -line)),
            )
        ]  # fmt: skip
        for x, y, angle, half in obstacles:
            a, b = half * math.cos(angle), half * math.sin(angle)
            corners = [(a - b, b + a), (-a - b, -b + a), (-a + b, -b - a), (a + b, b - a)]
            shapes.append(pymunk.Poly(ground, [(x + dx, y + dy) for dx, dy in corners]))
        for shape in shapes:
            shape.filter = pymunk.ShapeFilter(categories=STILL)
            shape.collision_type = STILL
            shape.elasticity = 1.0 / BOUNCE  # pymunk multiplies: a ball bounces by 1 at most
        self.space.add(*shapes)

    def _disc(self, kind: int, elasticity: float) -> tuple[pymunk.Body, pymunk.Shape]:
        body = pymunk.Body(MASS, math.inf)
        shape = pymunk.Circle(body, 1.0)
        shape.filter = pymunk.ShapeFilter(categories=kind)
        shape.collision_type = kind
        shape.elasticity = elasticity
        return body, shape

    def _collide(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: object) -> None:
        self.collided = True

    def run(self, ticks: int) -> None:
        """Run so many ticks at most."""
        for _ in repeat(None, ticks):
            if self.collided:
                return
            self.step()

    def step(self) -> None:
        """Run a tick: motion, actuators, sensors, mind, and what the world does."""
        self.tick += 1
        self._move()
        if self.collided:
            return
        x, y = self.robot.position
        turn = complex(math.cos(self.angle), math.sin(self.angle))
        free, ahead = not self.carrying, 0j
        if free:
            ball_x, ball_y = self.ball.position
            ahead = complex(ball_x - x, ball_y - y) * turn.conjugate()
        in_reach = (
            abs(ahead.real - CLAW_AHEAD) <= CLAW_HALF and abs(ahead.imag) <= CLAW_HALF
            if free
            else True
        )
        self.push = ((2.0 * self.left - 1.0) + (2.0 * self.right - 1.0)) * FORCE
        self.torque = (2.0 * self.right - 2.0 * self.left) * FORCE
        if self.claw < 0.5 and self.carrying:
            self._let_go(x, y, turn)
            ahead = 2.0 + 0j  # it is just ahead
        elif self.claw > 0.5 >= self.before and free and in_reach:
            self.carrying = True
            self.space.remove(self.ball, self.ball_shape)
        self.before = self.claw

        near = self._look(x, y, turn)
        near.append(self._movement(x, y))
        near.append(0.5 + math.sin(self.tick) / 2.0)
        to_object = 0.5
        if not self.carrying:
            to_object -= math.atan2(ahead.imag, ahead.real) / math.tau
        zone = complex(ZONE_X - x, ZONE_Y - y) * turn.conjugate()
        to_zone = 0.5 - math.atan2(zone.imag, zone.real) / math.tau
        in_zone = abs(x - ZONE_X) <= ZONE_HALF and abs(y - ZONE_Y) <= ZONE_HALF
        self.left, self.right, self.claw = self.mind.commands(
            near, to_object, to_zone, float(in_reach), float(in_zone)
        )
        if self.carrying:
            self.lifted = True
        elif self.lifted:
            self._deliver()

    def _move(self) -> None:
        """Push, damp and move; pymunk moves by the velocities that it is given before its step."""
        body, along = self.robot, DT * self.push / MASS
        vx, vy = body.velocity
        body.velocity = (
            (vx + along * math.cos(self.angle)) / SLOWING,
            (vy + along * math.sin(self.angle)) / SLOWING,
        )
        self.spin = (self.spin + DT * self.torque / MOMENT) / SPIN_SLOWING
        if not self.carrying:
            vx, vy = self.ball.velocity
            if vx or vy:
                self.ball.velocity = vx / BALL_SLOWING, vy / BALL_SLOWING
        self.space.step(DT)
        self.angle += DT * self.spin

    def _look(self, x: float, y: float, turn: complex) -> list[float]:
        """Return what the range finders read."""
        points: Any = (RAYS * turn + complex(x, y)).view(np.float64).reshape(-1, 2).tolist()
        query, readings = self.space.segment_query_first, []
        for place in range(0, len(points), 4):
            start, nearest = points[place], 1.0
            for end in points[place + 1 : place + 4]:
                met = query(start, end, 0.0, SEEN)
                if met is not None and met.alpha < nearest:
                    nearest = met.alpha
            readings.append(nearest)
        return readings

    def _movement(self, x: float, y: float) -> float:
        """Return how much the robot moved about: the mean distance between its last positions."""
        if (self.tick - 1) % EVERY == 0:
            positions, here = self.positions, (x, y)
            if len(positions) == REMEMBERED:
                gone = positions.pop(0)
                self.apart -= sum(map(math.dist, positions, repeat(gone)))
            self.apart += sum(map(math.dist, positions, repeat(here)))
            positions.append(here)
            count = len(positions)
            if count > 1:
                self.moved = min(self.apart / (count * (count - 1) / 2) / LARGEST, 1.0)
        return self.moved

    def _let_go(self, x: float, y: float, turn: complex) -> None:
        """Put the ball down, just ahead of the robot."""
        self.carrying = False
        self.ball.position = x + 2.0 * turn.real, y + 2.0 * turn.imag
        self.ball.velocity = self.robot.velocity
        self.space.add(self.ball, self.ball_shape)

    def _deliver(self) -> None:
        """Count a ball that was let go in the zone, and put it elsewhere."""
        self.lifted = False
        x, y = self.ball.position
        if abs(x - ZONE_X) <= ZONE_HALF and abs(y - ZONE_Y) <= ZONE_HALF:
            self.delivered += 1
            self.ball.position = self.object_place()
            self.ball.velocity = (0.0, 0.0)
            self.space.reindex_shapes_for_body(self.ball)


def episode(seed: int, ticks: int, mind: Mind) -> World:
    """Return a world of the standard benchmark at the end of its episode."""
    drawn = Drawn(seed)
    world = World(drawn.obstacles, drawn.angle, drawn.object_place, mind)
    world.run(ticks)
    return world
