"""Populations: what a modeller declares of agents, and the arrays that hold them.

- `Agent`: the base of annotated classes; every agent has a place and a heading.
- `Population`: the declaration in a model: which agents, how many, with what mind.
- `Table`: the arrays of a population of a running model, and the agents in them as rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
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
from socialmind.errors import ModelError, SocialmindError
from socialmind.fields import Field, class_fields, place_of_field, presence
from socialmind.language.layout import row_dtype
from socialmind.language.nodes import nearest
from socialmind.language.shape import PopulationShape
from socialmind.rows import row_class

if TYPE_CHECKING:
    from coglogo_py import CognitiveScheme, Mind, Society
    from socialmind.language.program import Program
    from socialmind.mind.description import MindDescription
    from socialmind.mind.population_minds import PopulationMinds
    from socialmind.mind.weighing import Weighing, WeighingPlaces
    from socialmind.model import Model
    from socialmind.worlds.plane.bodies import Disc
    from socialmind.worlds.plane.devices import Act, Sense
    from socialmind.worlds.plane.sensors import RangeFinder


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


TAKEN_NAMES = frozenset(
    (
        "id",
        "mind",
        "plan",
        "run_plan",
        "die",
        "hatch",
        "hierarchy",
        "minds",
        "acting",
        "alive",
        "columns",
        "counters",
        "default",
        "dtype",
        "free",
        "model",
        "order",
        "row_class",
        "rows",
        "shape",
        "slot_of",
        "society",
        "weighing",
    )
)
"""What an agent, and a population's table, keep under these names beside its methods."""


class Population:
    """The declaration of a population, as an attribute of a model.

    Args:
        agent: the annotated class of its agents, which inherits from `Agent`.
        size: how many there are at the start: a number, or the name of a parameter.
        mind: the scheme of their minds: a file beside the model, or a `CognitiveScheme`.
        plans: the function of each plan, by the plan's name in the scheme.
        decision_makers: decision makers of the modeller's own that the scheme's file may name.
        hierarchy: the hierarchy of skills of its agents (MIND): a folder or YAML file beside the
            model, or a `MindDescription`. An agent may have both kinds of mind.
        master: the name of the hierarchy's master skill; may be left out where no other skill
            influences exactly one.
        drive: the hierarchy's drive module, a plain function `drive(mind)`.
        own_genomes: whether each agent has its own weights.
        instances: how many instances there are of the groups that share variables.
        weighing: how the hierarchy weighs the plans of the minds, in place of the scheme's
            influence links; None where it does not.
        body: what its bodies are made of, where the world is a plane and they move on it.
        sensors: the sensors of each body, by name.
        actuators: the actuators of each body, by name.
    """

    def __init__(
        self,
        agent: type,
        size: int | str,
        mind: str | Path | CognitiveScheme | None = None,
        plans: Mapping[str, Callable[..., Any]] | None = None,
        decision_makers: tuple[Any, ...] = (),
        hierarchy: str | Path | MindDescription | None = None,
        master: str | None = None,
        drive: Callable[..., None] | None = None,
        own_genomes: bool = False,
        instances: int = 0,
        weighing: Weighing | None = None,
        body: Disc | None = None,
        sensors: Mapping[str, Sense | RangeFinder] | None = None,
        actuators: Mapping[str, Act] | None = None,
    ) -> None:
        self.agent = agent
        self.size = size
        self.mind = mind
        self.plans = dict(plans or {})
        self.decision_makers = decision_makers
        self.hierarchy = hierarchy
        self.master = master
        self.drive = drive
        self.own_genomes = own_genomes
        self.instances = instances
        self.weighing = weighing
        self.body = body
        self.sensors = dict(sensors or {})
        self.actuators = dict(actuators or {})
        self.name = ""

    def __set_name__(self, owner: type, name: str) -> None:
        self.name = name

    def check(self) -> None:
        """Refuse agents of a wrong class, names that are taken, and plans without a mind.

        Raises:
            ModelError: so it is.
        """
        name = self.name
        if not (isinstance(self.agent, type) and issubclass(self.agent, Agent)):
            raise ModelError(
                f"{self.agent!r} as the agents of {name!r}",
                "a class that inherits from socialmind.Agent",
                "write class Human(Agent): …",
            )
        if self.plans and self.mind is None:
            raise ModelError(
                f"plans for {name!r}, which has no mind",
                None,
                "name its scheme: mind='scheme.yaml'",
            )
        self._check_hierarchy()
        for field in class_fields(self.agent).values():
            file, line = place_of_field(self.agent, field.name)
            found = f"a field called {field.name!r}"
            if field.name in TAKEN_NAMES or hasattr(Table, field.name):
                expected = "a name that agents and populations do not use"
                raise ModelError(found, expected, None, file, line)
            if field.name in Agent.__annotations__ and (field.storage, field.size) != ("f8", None):
                raise ModelError(found, "a float, as in every agent", None, file, line)

    def _check_hierarchy(self) -> None:
        """Refuse what belongs to a hierarchy where there is none, and wrong instances."""
        number = self.instances
        if isinstance(number, bool) or not isinstance(number, int) or number < 0:
            raise ModelError(f"instances={number!r} for {self.name!r}", "a whole number, 0 or more")
        given = {"master": self.master, "drive": self.drive, "own_genomes": self.own_genomes,
                 "instances": number}  # fmt: skip
        for setting, value in given.items():
            if value and self.hierarchy is None:
                raise ModelError(
                    f"{setting}= for {self.name!r}, which has no hierarchy",
                    None,
                    "give it one: hierarchy='mind'",
                )
        if self.weighing is not None and (self.mind is None or self.hierarchy is None):
            raise ModelError(
                f"weighing= for {self.name!r}, which has not both kinds of mind",
                "a scheme, whose plans a hierarchy weighs",
                "give it both: mind='scheme.yaml', hierarchy='mind'",
            )
        if self.weighing is not None and self.body is not None:
            raise ModelError(
                f"weighing= for {self.name!r}, whose hierarchies move bodies on a plane",
                "a population without bodies",
                "let a skill of the hierarchy be a CognitonScheme",
            )

    def __get__(self, model: Any, owner: type) -> Any:
        return self if model is None else model.tables[self.name]

    @property
    def shape(self) -> PopulationShape:
        """What rules may know of the population."""
        fields = class_fields(self.agent)
        return PopulationShape(
            self.name,
            fields,
            self.mind is not None,
            self.plans,
            self.hierarchy is not None,
            self.weighing is not None,
        )


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


def set_default(rows: NDArray[Any], field: Field) -> None:
    """Give a field of all rows its default."""
    if field.size is not None:
        rows[field.name] = np.array(field.default)
    elif field.optional:
        rows[field.name] = 0 if field.default is None else field.default
        rows[presence(field.name)] = field.default is not None
    else:
        rows[field.name] = field.default
