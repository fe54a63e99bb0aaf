"""Steering by hand: what one robot's actuators are told, in place of what its mind says."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from coglogo_py.border.numbers import whole_number
from socialmind.errors import SocialmindError
from socialmind.model import Model

Society = TypeVar("Society", bound=Model)


@dataclass(frozen=True)
class Steer:
    """Commands to one robot on a plane, which hold until others come.

    Its mind goes on thinking, and is not obeyed; other robots obey theirs. Somebody who drives a
    robot gives one of these whenever a key is pressed or let go.

    Args:
        tick: 0 or more; actuators carry the commands out from the next tick on.
        population: the robot's.
        agent: its identity.
        commands: 0 … 1, one for each of the body's actuators in their order; None gives the robot
            back to its mind.

    Raises:
        SocialmindError: no tick.

    >>> Steer(100, "robots", 0, [1.0, 0.5, 0.5]).commands
    (1.0, 0.5, 0.5)
    """

    tick: int
    population: str
    agent: int
    commands: tuple[float, ...] | None

    def __post_init__(self) -> None:
        tick = whole_number(self.tick, "the tick of steering", 0, error=SocialmindError)
        object.__setattr__(self, "tick", tick)
        if self.commands is not None:
            try:
                commands = tuple(float(one) for one in self.commands)
            except (TypeError, ValueError):
                found = f"commands {self.commands!r}; expected numbers, 0 … 1"
                raise SocialmindError(found) from None
            object.__setattr__(self, "commands", commands)

    def applied(self, society: Society) -> Society:
        """Steer a robot of a society; returns it.

        Raises:
            SocialmindError: there is no such robot, or it has other actuators; the society is as
                before.
        """
        society.steer(self.population, self.commands, self.agent)
        return society
