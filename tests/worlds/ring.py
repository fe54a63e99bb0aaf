"""A small world: places in a row of which the last is beside the first."""

from socialmind.language.arithmetic import brought_back
from socialmind.language.shape import WorldShape
from socialmind.worlds.contract import Ground, World


def stroll(world, agent, length):
    """Go on by a length, at most once round."""
    agent.x = agent.x + min(length, 1.0 * world.length)


class Ring(World):
    def __init__(self, size):
        self.sizes = (size,)

    def shape(self, model, place):
        return RingShape()

    def ground(self, society, size):
        ground = RingGround(society)
        ground.world, ground.length = ground, size
        return ground


class RingShape(WorldShape):
    numbers, columns, commands = (
        {"length": "_model._world_length"}, ("world_length",), {"stroll": stroll}
    )  # fmt: skip

    def kept_within(self, population, field):
        return ("_brought_back", "0", "_model._world_length") if field == "x" else ()


class RingGround(Ground):
    def connect(self, context):
        context["_world_length"] = self.length

    def keeper(self, population, field):
        return (lambda value, whose: brought_back(value, 0, self.length)) if field == "x" else None
