"""A light seeker on a plane, as a function: two eyes, two motors, no physics.

With `blink` above 1 the eyes see the light every so many ticks only, so that steering well takes a
memory.
"""

import math
import random
from functools import partial

TICKS = 120


def episode(controller, seed, blink=1):
    """The score is how close to the light the agent was on average."""
    rng = random.Random(seed)
    x = y = closeness = 0.0
    heading, way = rng.uniform(-math.pi, math.pi), rng.uniform(-math.pi, math.pi)
    light_x, light_y = 4.0 * math.cos(way), 4.0 * math.sin(way)
    for tick in range(TICKS):
        distance = math.hypot(light_x - x, light_y - y)
        bearing = math.atan2(light_y - y, light_x - x) - heading
        brightness = 0.0 if tick % blink else 1.0 / (1.0 + 0.2 * distance)
        eyes = [brightness * max(math.cos(bearing + side), 0.0) for side in (-0.5, 0.5)]
        left, right = controller(eyes)
        heading += 0.6 * (right - left)
        x += 0.05 * (left + right) * math.cos(heading)
        y += 0.05 * (left + right) * math.sin(heading)
        closeness += 1.0 / (1.0 + distance)
    return closeness / TICKS


blinking = partial(episode, blink=3)


def cross_over(left_eye, right_eye):
    """Braitenberg's vehicle 2b; in the dark it turns on the spot."""
    if left_eye + right_eye < 0.05:
        return 0.6, 0.2
    return right_eye, left_eye


class Remembering:
    """The same for a light that blinks: half of what it saw last is seen still."""

    def __init__(self):
        self.reset()

    def reset(self):
        self.seen = [0.0, 0.0]

    def __call__(self, eyes):
        self.seen = [max(eye, 0.5 * last) for eye, last in zip(eyes, self.seen, strict=True)]
        return self.seen[1], self.seen[0]
