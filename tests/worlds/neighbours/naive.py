"""Societies as plain lists, on which rules run as they are: who is near is asked of everybody."""

import math
from itertools import count
from types import SimpleNamespace


class Found(list):
    """Agents that were found; a loop goes on past those dead meanwhile."""

    def __iter__(self):
        return (one for one in list.__iter__(self) if one.alive)

    def one_of(self, rng):
        return self[int(rng.integers(0, len(self)))] if self else None


class Patches(list):
    """Patches that were found."""

    def one_of(self, rng):
        return self[int(rng.integers(0, len(self)))]


class NaiveAgent(SimpleNamespace):
    """An agent: its fields, and its flock."""

    __hash__ = object.__hash__

    def __eq__(self, other):
        return self is other

    def die(self):
        self.alive = False

    def hatch(self):
        return self.flock.add(**{k: v for k, v in vars(self).items() if k not in ("flock", "id")})


class NaiveFlock:
    """A population: its agents, the dead among them, in order of birth."""

    def __init__(self, world, **fields):
        self.world = world
        self.fields = fields
        self.agents = []
        self.ids = count()

    def add(self, **fields):
        agent = NaiveAgent(**{**self.fields, **fields, "alive": True})
        agent.flock, agent.id = self, next(self.ids)
        self.agents.append(agent)
        return agent

    create = add

    def __iter__(self):
        return (one for one in list(self.agents) if one.alive)

    def __len__(self):
        return sum(one.alive for one in self.agents)

    def others(self, who):
        return [one for one in self.agents if one.alive and one is not who]

    def near(self, who, radius):
        return Found(
            one for one in self.others(who) if self.world.square(who, one) <= radius * radius
        )

    def nearest(self, who, radius=math.inf):
        found = sorted(self.near(who, radius), key=lambda one: self.world.square(who, one))
        return found[0] if found else None

    def on(self, who):
        return Found(one for one in self.others(who) if self.world.moves(who, one) == (0, 0))

    def neighbours(self, who, steps=1):
        return Found(
            one for one in self.others(who) if 0 < max(self.world.moves(who, one)) <= steps
        )

    def neighbours4(self, who):
        return Found(one for one in self.others(who) if sum(self.world.moves(who, one)) == 1)


class NaiveWorld:
    """A world of patches: its ends, and whether they wrap."""

    def __init__(self, width, height, wraps):
        self.width, self.height = width, height
        self.low_x, self.low_y = -(width // 2), -(height // 2)
        self.round_x, self.round_y = wraps in (True, "x"), wraps in (True, "y")

    def offset(self, who, other):
        return (
            self.way(other.x - who.x, self.width, self.round_x),
            self.way(other.y - who.y, self.height, self.round_y),
        )

    def way(self, difference, size, wraps):
        if wraps and difference > size / 2:
            return difference - size
        return difference + size if wraps and difference < -size / 2 else difference

    def square(self, who, other):
        dx, dy = self.offset(who, other)
        return dx * dx + dy * dy

    def column(self, x):
        return (math.floor(x + 0.5) - self.low_x) % self.width

    def row(self, y):
        return (math.floor(y + 0.5) - self.low_y) % self.height

    def moves(self, who, other):
        across = abs(self.column(who.x) - self.column(other.x))
        up = abs(self.row(who.y) - self.row(other.y))
        return (
            min(across, self.width - across) if self.round_x else across,
            min(up, self.height - up) if self.round_y else up,
        )

    def patch(self, x, y):
        return self.at(self.column(x), self.row(y))

    def at(self, column, row):
        return SimpleNamespace(x=column + self.low_x, y=row + self.low_y)

    def around(self, who, steps):
        columns = line(self.column(who.x), steps, self.width, self.round_x)
        rows = line(self.row(who.y), steps, self.height, self.round_y)
        return [self.at(column, row) for column in columns for row in rows]

    def neighbours(self, who, steps=1):
        return Patches(one for one in self.around(who, steps) if max(self.moves(who, one)) > 0)

    def neighbours4(self, who):
        return Patches(one for one in self.around(who, 1) if sum(self.moves(who, one)) == 1)

    def is_inside(self, x, y):
        across = self.low_x - 0.5 <= x < self.low_x - 0.5 + self.width
        up = self.low_y - 0.5 <= y < self.low_y - 0.5 + self.height
        return (across or self.round_x) and (up or self.round_y)

    def move_to(self, agent, x, y):
        if self.round_x:
            x = wrapped(x, self.low_x, self.width)
        if self.round_y:
            y = wrapped(y, self.low_y, self.height)
        agent.x, agent.y = x, y


def line(place, steps, size, wraps):
    """Return the columns around one, from west to east; where they are all, from the first."""
    if not wraps:
        return [one for one in range(place - steps, place + steps + 1) if 0 <= one < size]
    if 2 * steps + 1 > size:
        return list(range(size))
    return [(place + step) % size for step in range(-steps, steps + 1)]


def wrapped(value, low, size):
    edge = low - 0.5
    if edge <= value < edge + size:
        return value
    value -= size * math.floor((value - edge) / size)
    return value if edge <= value < edge + size else edge
