"""The base of annotated classes that declare what an agent is."""


class Agent:
    """What every agent has: a place in the world and a heading (degrees, 0 north, clockwise).

    A modeller's class inherits from it and declares further fields:

    >>> class Human(Agent):
    ...     wheat: float = 0.0
    ...     land_x: int | None = None
    """

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0
