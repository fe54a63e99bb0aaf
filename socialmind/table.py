"""The arrays of a population of a running model, and the agents in them as rows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from socialmind.bookkeeping import (
    ALIVE,
    COUNT,
    ENTRIES,
    FREE,
    NEXT_ID,
    SIZE,
    born,
    died,
    is_living,
    nth_living,
    settle,
    short_of_room,
    slot_of_agent,
)
from socialmind.connection import plan_functions
from socialmind.errors import SocialmindError
from socialmind.fields import Field, presence, set_default
from socialmind.language.layout import row_dtype
from socialmind.language.nodes import nearest
from socialmind.language.shape import PopulationShape
from socialmind.rows import row_class

if TYPE_CHECKING:
    from coglogo_py import Mind, Society
    from socialmind.language.program import Program
    from socialmind.mind.population_minds import PopulationMinds
    from socialmind.mind.weighing import WeighingPlaces
    from socialmind.model import Model


class Table:
    """A population of a running model.

    It is what `model.humans` gives: the number of the living, an agent by its identity, a loop
    over all of them, and each field as a NumPy array over the living in order of birth:

        model.humans.wheat.sum()
        for human in model.humans: ...
        model.humans[3].wheat

    Args:
        model: the model.
        shape: the population's shape.
        size: how many agents there are at the start.
        society: the minds, or None.
        minds: makes the hierarchies for so many agents, or None.
    """

    def __init__(
        self,
        model: Model,
        shape: PopulationShape,
        size: int,
        society: Society | None,
        minds: Callable[[int], PopulationMinds] | None = None,
    ) -> None:
        self.model = model
        self.shape = shape
        self.society = society
        self.minds = None if minds is None else minds(max(size, 1))
        self.dtype = row_dtype(dict(shape.fields), shape)
        self.default = np.zeros(1, self.dtype)
        for field in shape.fields.values():
            set_default(self.default, field)
        if shape.minded:
            self.default["_mind"] = self.default["_plan"] = self.default["_decided"] = -1
        capacity = max(size, 1)
        self.rows = np.zeros(capacity, self.dtype)
        self.order = np.zeros(capacity, np.int64)
        self.acting = np.zeros(capacity, np.int64)
        self.alive = np.zeros(capacity, np.bool_)
        self.slot_of = np.full(capacity, -1, np.int64)
        self.free = np.arange(capacity - 1, -1, -1, dtype=np.int64)
        self.counters = np.zeros(SIZE, np.int64)
        # The founders take the first slots, in order.
        self.rows[:size] = self.default[0]
        founders = np.arange(size)
        for array in (self.order, self.slot_of, self.rows["_slot"], self.rows["_id"]):
            array[:size] = founders
        self.alive[:size] = True
        self.counters[FREE] = capacity - size
        self.counters[[COUNT, ENTRIES, ALIVE, NEXT_ID]] = size
        if society is not None:
            self.rows["_mind"][:size] = society.new_minds(size)
        self.weighing: WeighingPlaces | None = None
        weighing = model.populations[shape.name].weighing
        if weighing is not None and society is not None and self.minds is not None:
            description = self.minds.assembly.description
            self.weighing = weighing.places(society.scheme, description)
        self.row_class = row_class(shape)
        self._scratch: dict[str, NDArray[Any]] = {}
        self._see_columns()

    def _see_columns(self) -> None:
        names = self.dtype.names or ()
        self.columns = {name: self.rows[name] for name in names}

    def __reduce__(self) -> tuple[Any, ...]:
        return _population_of, (self.model, self.shape.name)

    # The living -------------------------------------------------------------------------------

    def __len__(self) -> int:
        return int(self.counters[ALIVE])

    def __iter__(self) -> Iterator[Any]:
        for place in range(int(self.counters[ENTRIES])):
            slot = int(self.order[place])
            if self.alive[slot]:
                yield self.row_class(self, slot)

    def __getitem__(self, identity: int) -> Any:
        try:
            slot = int(slot_of_agent(self.slot_of, int(identity)))
        except IndexError:
            raise IndexError(
                f"no living agent of {self.shape.name!r} has the identity {identity}"
            ) from None
        return self.row_class(self, slot)

    def __getattr__(self, name: str) -> NDArray[Any]:
        """Return a field of the living agents as an array, in order of birth."""
        shape = self.__dict__.get("shape")
        if shape is None or (name != "id" and name not in shape.fields):
            known = "" if shape is None else ", ".join(["id", *shape.fields])
            raise AttributeError(f"no field {name!r}; there is {known}")
        column = self.columns["_id" if name == "id" else name][self.slots]
        field: Field | None = shape.fields.get(name)
        if field is not None and field.optional:
            column = column.astype(object)
            column[~self.holds(name)] = None
        return column

    def holds(self, name: str) -> NDArray[np.bool_]:
        """Say for each of the living whether an optional field holds a value."""
        column: NDArray[np.bool_] = self.columns[presence(name)][self.slots]
        return column

    def filled(self, name: str, missing: float = 0) -> NDArray[Any]:
        """Return an optional field of the living as numbers, with a number where it is None."""
        return np.where(self.holds(name), self.columns[name][self.slots], missing)

    @property
    def slots(self) -> NDArray[np.int64]:
        """The slots of the living, in order of birth."""
        order = self.order[: int(self.counters[ENTRIES])]
        return order[self.alive[order]]

    def cogniton(self, name: str) -> NDArray[np.float64]:
        """Return a cogniton's value in each living mind, NaN where it is inactive.

        Raises:
            SocialmindError: the scheme has no such cogniton, or there are no minds.
        """
        # A society without minds is false, as everything empty.
        cognitons = () if self.society is None else self.society.scheme.cognitons
        names = [one.name for one in cognitons]
        if self.society is None or name not in names:
            hint = nearest(name, names)
            raise SocialmindError(f"{self.shape.name!r} has no cogniton {name!r}; {hint}")
        slots = self.columns["_mind"][self.slots]
        column: NDArray[np.float64] = self.society.minds.values[slots, names.index(name)]
        return column

    def contains(self, identity: int) -> bool:
        """Say whether an agent of this identity lives."""
        return bool(is_living(self.slot_of, identity))

    def one_of(self, rng: Any) -> Any:
        """Return an agent drawn at random from the living."""
        if not len(self):
            raise ValueError("one_of() of a population without agents")
        place = rng.integers(0, len(self))
        return self.row_class(self, int(nth_living(self.counters, self.order, self.alive, place)))

    # Births and deaths ------------------------------------------------------------------------

    def create(self) -> Any:
        """Bring a new agent into the world, with default fields and a mind at birth."""
        slot = self._place()
        self.rows[slot] = self.default[0]
        agent = self._named(slot)
        if self.society is not None:
            self.columns["_mind"][slot] = self.society.new_mind().slot
        if self.minds is not None:
            self.minds.begin(slot)
        return agent

    def hatch(self, parent: Any, keep_groups: bool = False) -> Any:
        """Bring an agent into the world that is its parent's copy, body and mind."""
        if not self.alive[parent._slot]:
            raise ValueError("hatch() of an agent that is dead")
        slot = self._place()
        self.rows[slot] = self.rows[parent._slot]
        for name in self.shape.own:
            self.columns[name][slot] = self.default[name][0]
        agent = self._named(slot)
        if self.society is not None:
            self.columns["_mind"][slot] = parent.mind.hatch(keep_groups=keep_groups).slot
        if self.minds is not None:
            self.minds.copy(parent._slot, slot)
        return agent

    def die(self, agent: Any) -> None:
        """Take an agent out of the world; its mind leaves its groups."""
        slot = agent._slot
        if self.alive[slot]:
            died(self.counters, self.alive, self.slot_of, slot, agent.id)
            if self.society is not None:
                agent.mind.die()
                self.columns["_mind"][slot] = -1

    def _place(self) -> int:
        slot = int(born(self.counters, self.order, self.alive, self.slot_of, self.free))
        if slot < 0:
            self.grow()
            slot = int(born(self.counters, self.order, self.alive, self.slot_of, self.free))
        return slot

    def _named(self, slot: int) -> Any:
        self.columns["_slot"][slot] = slot
        self.columns["_id"][slot] = self.counters[NEXT_ID] - 1
        return self.row_class(self, slot)

    def settle(self) -> None:
        """End a tick: the dead leave, the new-born act from now on."""
        settle(self.counters, self.order, self.alive, self.free)

    @property
    def short_of_room(self) -> bool:
        """Whether the next tick could bring more births than there is room for."""
        return bool(short_of_room(self.counters, self.slot_of))

    def grow(self) -> None:
        """Make room for twice as many agents (the new slots are taken last)."""
        old = len(self.rows)
        capacity = max(2 * old, 256)
        for name in ("rows", "order", "acting", "alive"):
            array = getattr(self, name)
            larger = np.zeros(capacity, array.dtype)
            larger[:old] = array
            setattr(self, name, larger)
        identities = np.full(max(2 * len(self.slot_of), capacity), -1, np.int64)
        identities[: len(self.slot_of)] = self.slot_of
        self.slot_of = identities
        free = np.zeros(capacity, np.int64)
        added = capacity - old
        count = int(self.counters[FREE])
        free[:added] = np.arange(capacity - 1, old - 1, -1)
        free[added : added + count] = self.free[:count]
        self.free = free
        self.counters[FREE] = count + added
        self._see_columns()
        if self.society is not None:
            self.society.reserve(added)
        if self.minds is not None:
            self.minds.grow(capacity)

    # State ------------------------------------------------------------------------------------

    _STATE = ("rows", "order", "alive", "slot_of", "free", "counters")

    def snapshot(self) -> dict[str, NDArray[Any]]:
        """Return copies of the arrays that a checkpoint keeps."""
        return {name: getattr(self, name).copy() for name in self._STATE}

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take the arrays of a checkpoint."""
        for name in self._STATE:
            setattr(self, name, np.array(state[name]))
        if self.rows.dtype != self.dtype:
            raise SocialmindError(
                f"the checkpoint's agents of {self.shape.name!r} have other fields than the model's"
            )
        self.acting = np.zeros(len(self.rows), np.int64)
        self._see_columns()

    def scratch(self, program: Program) -> dict[str, NDArray[Any]]:
        """Return the arrays that a compiled decision needs beside the minds."""
        if not self._scratch and self.society is not None:
            scheme = self.society.scheme
            self._scratch = {
                "weights": np.zeros(len(scheme.plans)),
                "plans": np.zeros(len(scheme.plans), np.int64),
                "functions": plan_functions(program, self.shape.name, scheme),
            }
            if self.weighing is not None:
                self._scratch |= vars(self.weighing)
        return self._scratch

    @property
    def acting_order(self) -> NDArray[np.int64]:
        """The slots of those who act in this tick, in order of birth (a copy)."""
        return self.order[: int(self.counters[COUNT])].copy()

    def mind_of(self, slot: int) -> Mind:
        """Return the mind of the agent in a slot."""
        if self.society is None:
            raise AttributeError(f"the agents of {self.shape.name!r} have no minds")
        return self.society.mind_in(int(self.columns["_mind"][slot]))


def _population_of(model: Model, name: str) -> Table:
    return model.tables[name]
