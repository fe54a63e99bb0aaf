"""What a world gives a society. Grid, plane and none meet it, and so does any that is added.

A world is three things: its declaration, which a modeller writes (`World`); its shape, which rules
are typed and compiled against (`socialmind.language.shape.WorldShape`); and the ground of a running
society (`Ground`). Nothing outside this folder asks which world it is.

- **Required**: `World.check`, `World.shape`, `World.ground`; of a ground with arrays `arrays`,
  `state`, `check_state` and `restore`.
- **Optional**: everything else has a default, which is what a model without a world does.
- **Derived**: what modellers call as `society.world` is the ground's `world`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.agents.running import Running
from socialmind.errors import ModelError, SocialmindError
from socialmind.language.shape import WorldShape

Functions = dict[str, Callable[..., Any]]
Place = Callable[[str], tuple[str | None, int | None]]
"""Gives the file and the line of an attribute of a model's class."""


class Extent(NamedTuple):
    """The rectangle that agents are in, as those who look for neighbours know it.

    Attributes:
        low_x: its left end.
        low_y: its lower end.
        width: how wide it is.
        height: how high.
        wraps_x: whether its right end lies beside its left one.
        wraps_y: whether its upper end lies beside its lower one.
        whole: whether it consists of patches, squares of side 1.
    """

    low_x: float
    low_y: float
    width: float
    height: float
    wraps_x: bool
    wraps_y: bool
    whole: bool


class World:
    """The declaration of a world, as the attribute `world` of a model; this one is none.

    Attributes:
        sizes: what decides its memory, each a number or the parameter of whole numbers that gives
            it, 1 or more.
        devices: what a model may declare for it beside its populations: attribute and class.
        has_episodes: whether interruptions end a run there, and not `stop_when`.
    """

    sizes: tuple[int | str, ...] = ()
    devices: Mapping[str, type] = {}  # never changed
    has_episodes = False

    def __get__(self, model: Any, owner: type) -> Any:
        return self if model is None else model.ground.world

    def __str__(self) -> str:
        """What listings call it."""
        return type(self).__name__

    def check(self) -> None:
        """Refuse a declaration that is wrong.

        Raises:
            ModelError: so it is.
        """

    def shape(self, model: Any, place: Place) -> WorldShape:
        """Return what rules know of the world in a model.

        Args:
            model: the class, whose parameters, populations and devices are read.
            place: where an attribute of the class stands, for errors.

        Raises:
            ModelError: what the class declares does not go with the world.
        """
        for name, one in model.populations.items():
            if one.body is not None or one.sensors or one.actuators:
                raise ModelError(
                    f"bodies of {name!r} without a plane", "world = Plane(…)", None, *place(name)
                )
        return WorldShape()

    def ground(self, society: Running, *sizes: int) -> Ground:
        """Return the world of a running society, whose tables are not made yet.

        Args:
            society: the society.
            sizes: what `sizes` come to there.
        """
        return Ground(society)


class Ground:
    """The world of a running society; this one is none.

    Args:
        society: the society; its `tables` are made between this and `settle_in`.

    Attributes:
        world: what `society.world` gives.
        layered: whether its patches are layers of a square, as Mesa's grids have them.
    """

    world: Any = None
    layered = False

    def __init__(self, society: Running) -> None:
        self.society = society

    def settle_in(self) -> None:
        """Take note of the society's tables, once they are made."""

    def build(self) -> None:
        """Look at where everything is, after the setup or a restored state."""

    # Its arrays -------------------------------------------------------------------------------

    def arrays(self) -> Mapping[str, NDArray[Any]]:
        """Return the arrays that compiled code reaches, by the columns of their addresses."""
        return {}

    def connect(self, context: Any) -> None:
        """Write numbers of the world into the model's record."""

    def state(self) -> dict[str, NDArray[Any]]:
        """Return copies of the arrays that change in a run, by name."""
        return {}

    def check_state(self, state: Mapping[str, Any], context: Any) -> str | None:
        """Say what is wrong with arrays that are offered as a state, and with the model's record.

        Returns:
            The name of an array and what it holds, as `world.rows holds nothing`; None if it fits.
        """
        return None

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take back the arrays of `state`, checked."""

    @property
    def entities(self) -> int:
        """How many things a setup visits beside agents: patches."""
        return 0

    @property
    def extent(self) -> Extent | None:
        """The rectangle that agents are in; None where nobody is anywhere."""
        return None

    # Agents in it -----------------------------------------------------------------------------

    def keeper(self, population: str, field: str) -> Callable[[float, str], float] | None:
        """Return what brings a place back into the world, or refuses it; None where it may be any.

        It takes the value and, for an error, whose it is.
        """
        return None

    def put(self, agent: Any, x: float, y: float) -> None:
        """Move an agent, as from outside the rules."""
        agent.x, agent.y = x, y

    def on_patches(self, table: Any, slots: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return those of some agents of a table that stand on a patch."""
        return slots

    def leave(self, table: Any, slot: int) -> None:
        """Take note that the agent in a slot of a table dies."""

    def hand_out(self, bare: bool) -> None:
        """Give out parts of the world as rules hold them, bare, or, as else, as users do."""

    def functions(self) -> Functions:
        """Return what interpreted rules call beside the commands of its shape."""
        return {}

    # A tick -----------------------------------------------------------------------------------

    def run_tick(self, functions: Functions, schedule: Callable[[], None]) -> None:
        """Run a tick, interpreted: the schedule, and what the world does before and after it."""
        schedule()

    def before_compiled_tick(self) -> None:
        """Do what an engine that is not compiled does before the rest of a tick."""

    def after_compiled_tick(self) -> None:
        """Look at what a tick changed, for an engine that is not compiled."""

    # Episodes ---------------------------------------------------------------------------------

    @property
    def over(self) -> str | None:
        """What ended the episode; None while it goes on."""
        return None

    def settle(self) -> None:
        """Pay robots what is still due to them: an episode ends at a limit of ticks."""

    def steer(self, population: str, commands: ArrayLike | None, agent: int | None = None) -> None:
        """Steer robots from outside, in place of their minds; see `Model.steer`."""
        raise SocialmindError(f"{self.society.name} has no plane with robots to steer")

    def steered(self, population: str) -> int | None:
        """Return the identity of the robot that is steered alone; None where none is."""
        return None

    def series(self) -> dict[str, Any]:
        """Return what a run records of the world beside the society."""
        return {}

    def agents(self) -> dict[str, Any] | None:
        """Return what a run records of agents there, or None for what it records anywhere."""
        return None
