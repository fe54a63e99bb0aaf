"""The agents of a society as Mesa's tools see them: `mesa.Agent`s over the same rows.

An agent is known by its identity and looks its row up whenever it is asked, so it never reads or
writes what belongs to another, and holds no copy that could grow old.
"""

from __future__ import annotations

from operator import attrgetter
from typing import Any, ClassVar

import mesa

from socialmind.agents.agent import Agent
from socialmind.agents.attributes import unknown
from socialmind.columns import check_fields
from socialmind.errors import ModelError, SocialmindError
from socialmind.society.population import Population
from socialmind.society.table import Table
from socialmind.values import fitted

_SET_BY_MESA = frozenset(("current_action", "id", "model", "unique_id"))
"""What Mesa's tools keep in an agent, and the identity."""


class SocietyAgent(mesa.Agent):
    """An agent of a society under Mesa.

    A model has one class of these for each population, named after the class of its agents, which
    it inherits too: `agents.select(agent_type=Human)` works. Its fields are attributes.

    Args:
        model: the Mesa model.
        identity: the identity of a living agent; None brings another into the world.
        fields: values of fields.

    Attributes:
        id: the identity in the society (Mesa counts its `unique_id` over all populations).

    Raises:
        UnknownNameError: there is no such field; attributes that Mesa's tools alone know have names
            with a leading underscore.
        ValueRefusedError: a value that a field cannot hold; no agent was made.
    """

    population: ClassVar[str] = ""

    def __init__(self, model: Any, identity: int | None = None, **fields: Any) -> None:
        self._table: Table = model.society.tables[self.population]
        shape = self._table.shape
        check_fields(fields, shape.fields, repr(self.population))
        for name, value in fields.items():
            fitted(shape.fields[name], value, f"the field {name!r} of {self.population!r}")
        self._mesa_cell: Any = None
        if identity is None:
            identity = int(self._table.create().id)
            # Those who come between two ticks act in the next one.
            self._table.settle()
        self.id = identity
        super().__init__(model)
        model.enrol(self)
        if {"x", "y"} <= fields.keys():  # a move is one step
            try:
                self._table.model.ground.put(self.row, fields.pop("x"), fields.pop("y"))
            except SocialmindError:
                self.remove()
                raise
        for name, value in fields.items():
            setattr(self, name, value)

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_") and name not in _SET_BY_MESA and not hasattr(type(self), name):
            raise unknown(name, self.population, type(self), self._table.shape.fields)
        super().__setattr__(name, value)

    @property
    def row(self) -> Any:
        """The agent's row in the society, which rules see too.

        Raises:
            AttributeError: the agent is dead.
        """
        try:
            return self._table[self.id]
        except IndexError:
            raise AttributeError(f"agent {self.id} of {self.population!r} is dead") from None

    @property
    def alive(self) -> bool:
        """Whether the agent lives in the society."""
        return self._table.contains(self.id)

    @property
    def pos(self) -> tuple[float, float]:
        """The place on Mesa's grid, whose patches are counted from 0: what Mesa 3 draws."""
        low_x, low_y = self._low
        row = self.row
        return row.x - low_x, row.y - low_y

    @pos.setter
    def pos(self, place: tuple[float, float] | None) -> None:
        if place is not None:  # mesa.Agent begins with None
            low_x, low_y = self._low
            self._table.model.ground.put(self.row, place[0] + low_x, place[1] + low_y)

    @property
    def _low(self) -> tuple[int, int]:
        world = self._table.model.ground.world
        return getattr(world, "low_x", 0), getattr(world, "low_y", 0)

    @property
    def cell(self) -> Any:
        """The cell of Mesa's grid under the agent; setting it moves the agent to its centre."""
        row = self.row
        return self.model.space_of_cells.cell_at(row.x, row.y)

    @cell.setter
    def cell(self, cell: Any) -> None:
        self.pos = cell.coordinate
        self.move_into(cell)

    def move_to(self, cell: Any) -> None:
        """Move to the centre of a cell."""
        self.cell = cell

    def move_into(self, cell: Any) -> None:
        """Stand in the list of agents of a cell, or of none, in place of the one before."""
        if cell is not self._mesa_cell:
            if self._mesa_cell is not None:
                self._mesa_cell.remove_agent(self)
            if cell is not None:
                cell.add_agent(self)
            self._mesa_cell = cell

    def hatch(self, keep_groups: bool = False) -> Any:
        """Bring a copy into the world, body and mind, which acts from the next tick on."""
        identity = self.row.hatch(keep_groups).id
        self._table.settle()
        return type(self)(self.model, identity)

    def remove(self) -> None:
        """Die in the society, and leave the Mesa model."""
        if self.alive:
            self.row.die()
        self.model.strike_off(self)
        self.move_into(None)
        super().remove()


def class_of_agents(population: Population) -> type[SocietyAgent]:
    """Return the class of a population's agents under Mesa, its fields as properties.

    Raises:
        ModelError: a field has a name that Mesa gives to something else.
    """
    shape = population.shape
    members: dict[str, Any] = {"__doc__": population.agent.__doc__, "population": shape.name}
    taken = {*dir(SocietyAgent), "model", "unique_id", "id", "current_action"}
    names = [*shape.fields, *(("mind", "plan") if shape.minded else ())]
    names += ["hierarchy"] if shape.hierarchy else []
    for name in names:
        if name in taken:
            raise ModelError(
                f"a field {name!r} of {population.agent.__name__}, which Mesa's agents use",
                "another name",
                "rename it to use model.mesa()",
            )
        members[name] = through("row", name)
    members["__module__"] = population.agent.__module__
    bases = (SocietyAgent,) if population.agent is Agent else (SocietyAgent, population.agent)
    return type(population.agent.__name__, bases, members)


def through(part: str, name: str, writable: bool = True) -> property:
    """Return a property that stands for the attribute `name` of an object's attribute `part`."""

    def write(whole: Any, value: Any) -> None:
        setattr(getattr(whole, part), name, value)

    return property(attrgetter(f"{part}.{name}"), write if writable else None)
