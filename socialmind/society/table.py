"""The arrays of a population of a running model, and the agents in them as rows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.parts import memes_of
from socialmind.agents import bookkeeping, events
from socialmind.agents.attributes import unknown
from socialmind.agents.heeding import Heeding
from socialmind.agents.plan_steps import ENDED
from socialmind.agents.rows import Row
from socialmind.columns import column, columns_of
from socialmind.errors import SocialmindError, UnknownNameError, nearest
from socialmind.fields import Field, presence
from socialmind.language.aggregates import AGGREGATES, aggregated, field_called
from socialmind.language.arithmetic import turned
from socialmind.language.shape import PopulationShape
from socialmind.language.typing.calls.groups import SETS
from socialmind.language.typing.calls.neighbours import AGENTS
from socialmind.society.connection import plan_functions
from socialmind.society.filling import fill, kept_within, slots_of
from socialmind.society.founding.beginning import Beginning

if TYPE_CHECKING:
    from coglogo_py import Mind
    from socialmind.agents.running import Running
    from socialmind.language.program import Program
    from socialmind.mind.contract import CognitonMinds, SkillMinds
    from socialmind.mind.weighing import WeighingPlaces
    from socialmind.society.founding.blueprint import TableForm


KEPT_BY_TABLES = frozenset((
    "acting", "alive", "columns", "counters", "default", "dtype", "free", "minds", "model",
    "order", "row_class", "rows", "shape", "slot_of", "society", "weighing",
))  # fmt: skip
"""What a table keeps under names without an underscore; users assign to fields alone."""


class Table:
    """A population of a running model.

    It is what `model.humans` gives: the number of the living, an agent by its identity, a loop
    over all of them, and each field as a NumPy array over the living in order of birth, which is a
    copy. Assigning to the field writes it, one value for all or an array:

        model.humans.wheat.sum()
        for human in model.humans: ...
        model.humans[3].wheat
        model.humans.wheat = 0.0
        model.humans.wheat *= 2
        model.humans.sum("wheat"), also mean, min, max: as rules compute them, in order of birth

    Args:
        model: the model.
        shape: the population's shape.
        form: what its tables have in common in all societies.
        size: how many agents there are at the start.
        society: the minds, or None.
        minds: makes the hierarchies for so many agents, or None.
        births: whether rules bring agents into it: it begins with room for some, unless they have
            minds, which get theirs before the first tick.
    """

    def __init__(
        self,
        model: Running,
        shape: PopulationShape,
        form: TableForm,
        size: int,
        society: CognitonMinds | None,
        minds: Callable[[int], SkillMinds] | None = None,
        births: bool = False,
    ) -> None:
        self.model = model
        self.shape = shape
        self.society = society
        self.minds = None if minds is None else minds(max(size, 1))
        self.dtype = form.dtype
        self.default = form.default.copy()
        keepers = {name: model.ground.keeper(shape.name, name) for name in shape.fields}
        keepers["heading"] = lambda value, whose: turned(value)
        self._keepers = {name: keep for name, keep in keepers.items() if keep is not None}
        for name, keep in self._keepers.items():
            if name in shape.fields:
                self.default[name] = kept_within(self.default[name], keep, repr(shape.name))
        capacity = identities = max(size, 1)
        if births and society is None and minds is None:
            capacity, identities = _more_slots(size), _more_identities(size)
        self.rows = np.zeros(capacity, self.dtype)
        self.order = np.zeros(capacity, np.int64)
        self.acting = np.zeros(capacity, np.int64)
        self.alive = np.zeros(capacity, np.bool_)
        self.slot_of = np.full(identities, -1, np.int64)
        self.free = np.arange(capacity - 1, -1, -1, dtype=np.int64)
        self.counters = np.zeros(bookkeeping.SIZE, np.int64)
        # The founders take the first slots, in order.
        self.rows[:size] = self.default[0]
        founders = np.arange(size)
        for array in (self.order, self.slot_of, self.rows["_slot"], self.rows["_id"]):
            array[:size] = founders
        self.alive[:size] = True
        self.counters[bookkeeping.FREE] = capacity - size
        self.counters[
            [bookkeeping.COUNT, bookkeeping.ENTRIES, bookkeeping.ALIVE, bookkeeping.NEXT_ID]
        ] = size
        if society is not None:
            self.rows["_mind"][:size] = society.new_minds(size)
        self.weighing: WeighingPlaces | None = None
        if shape.weighed and society is not None and self.minds is not None:
            description = self.minds.assembly.description
            weighing = model.populations[shape.name].weighing
            self.weighing = weighing.places(society.scheme, description)
        self._bare, self._held = form.row_classes(self._keepers)
        self.row_class: type[Row] = self._held
        heeds = society is not None and shape.name in model.conditioned
        self._heeding = Heeding(self) if heeds else None
        self._scratch: dict[str, NDArray[Any]] = {}
        self._networks: list[Any] = []
        self._placed_by: Beginning | None = None
        self._index: dict[str, NDArray[Any]] = {}
        self._lists: dict[str, dict[str, NDArray[Any]]] = {}
        self._listed: tuple[int, ...] = ()
        self._see_columns()

    def _see_columns(self) -> None:
        names = self.dtype.names or ()
        self.columns = {name: self.rows[name] for name in names}

    def __reduce__(self) -> tuple[Any, ...]:
        return _population_of, (self.model, self.shape.name)

    # The living -------------------------------------------------------------------------------

    def __len__(self) -> int:
        return int(self.counters[bookkeeping.ALIVE])

    def __iter__(self) -> Iterator[Any]:
        for place in range(int(self.counters[bookkeeping.ENTRIES])):
            slot = int(self.order[place])
            if self.alive[slot]:
                yield self.row_class(self, slot)

    def __getitem__(self, identity: int) -> Any:
        try:
            slot = int(bookkeeping.slot_of_agent(self.slot_of, int(identity)))
        except IndexError:
            raise IndexError(
                f"no living agent of {self.shape.name!r} has the identity {identity}"
            ) from None
        return self.row_class(self, slot)

    def __getattr__(self, name: str) -> Any:
        """Return a field of the living agents, in order of birth: a copy, and read-only.

        Or, under a name that is no field, what is asked of all of them (`mean`, …) or around
        somebody (`near`, `nearest` …), or who is in a group (`members_of`).
        """
        shape = self.__dict__.get("shape")
        if shape is None or name.startswith("_"):
            raise AttributeError(f"no attribute {name!r}")
        if name in AGGREGATES and name not in shape.fields:
            return partial(self._aggregated, name)
        if name in AGENTS and name not in shape.fields:
            from socialmind.worlds.neighbours.asked import QUESTIONS

            return partial(QUESTIONS[name], self)
        if name in SETS and name not in shape.fields:
            from socialmind.society.groups import asked

            return partial(asked.QUESTIONS[name], self)
        if name != "id" and name not in shape.fields:
            raise unknown(name, shape.name, type(self), ["id", *shape.fields])
        values = self.columns["_id" if name == "id" else name][self.slots]
        field: Field | None = shape.fields.get(name)
        if field is not None and field.optional:
            values = values.astype(object)
            values[~self.holds(name)] = None
        if field is not None and field.choices:
            values = np.array(field.choices, object)[values]
        return column(values, f"society.{shape.name}.{name}")

    def __setattr__(self, name: str, value: Any) -> None:
        """Set a field of all the living: one value for all, or an array in order of birth."""
        shape = self.__dict__.get("shape")
        if shape is not None and name in shape.fields:
            self.set(**{name: value})
        elif name.startswith("_") or name in KEPT_BY_TABLES:
            object.__setattr__(self, name, value)
        else:
            raise unknown(name, self.shape.name, type(self), self.shape.fields)

    def set(self, **fields: Any) -> None:
        """Set fields of all the living.

        Nothing is written unless all of it can be.

        Args:
            fields: by name, one value for all, or a value for each in order of birth; of an array
                field one row for all, or a row for each. None stands for none, and in columns of
                numbers for optional fields NaN too.

        Raises:
            UnknownNameError: there is no such field.
            ValueRefusedError: too many or few values, or one that the field cannot hold.
        """
        fill(self, fields, self.slots, self._keepers)

    def set_from(self, data: Any, by: str | None = None) -> None:
        """Set fields of the living from a table of data, one row for an agent.

        Nothing is written unless all of it can be.

        Args:
            data: a data frame, an Arrow table or a mapping; its columns are called as the fields.
            by: the column that holds the agents' identities; unless given, one called `agent` or
                `id`. Agents that no row is for stay as they are. Without such a column the rows
                are for all the living, in order of birth.

        Raises:
            UnknownNameError: a column is no field.
            ValueRefusedError: a row is for no living agent, two are for one, or a value is one
                that the field cannot hold, with the row.
        """
        what = f"data for {self.shape.name!r}"
        columns = columns_of(data, what)
        if by is None:
            by = next((name for name in ("agent", "id") if name in columns), None)
        elif by not in columns:
            raise UnknownNameError(f"{what} without the column {by!r}; {nearest(by, columns)}")
        slots = self.slots if by is None else slots_of(self, columns.pop(by), what, by)
        fill(self, columns, slots, self._keepers)

    def begin_with(self, beginning: Beginning) -> None:
        """Set fields of the founders from the table that they begin with, before any setup."""
        fill(self, beginning.columns, self.slots, self._keepers, beginning)
        if {"x", "y"} <= beginning.columns.keys():
            self._placed_by = beginning

    def hand_out(self, bare: bool) -> None:
        """Give out agents as rules hold them, or, as else, as users do."""
        self.row_class = self._bare if bare else self._held

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
        order = self.order[: int(self.counters[bookkeeping.ENTRIES])]
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
        self.heed_conditions()
        slots = self.columns["_mind"][self.slots]
        column: NDArray[np.float64] = self.society.minds.values[slots, names.index(name)]
        return column

    def plays(self, group: str, role: str) -> NDArray[np.bool_]:
        """Return of each living agent whether it plays a role in a group of a type.

        Raises:
            SocialmindError: the scheme has no such group or role, or there are no minds.
        """
        groups = {} if self.society is None else self.society.names.roles
        if self.society is None or role not in groups.get(group, ()):
            hint = nearest(role, groups[group]) if group in groups else nearest(group, groups)
            what = f"role {role!r} of a group {group!r}"
            raise SocialmindError(f"{self.shape.name!r} has no {what}; {hint}")
        minds, slots = self.society.minds, self.columns["_mind"][self.slots]
        place = list(self.society.names.groups).index(group)
        inside = minds.group_slot[slots, place] >= 0
        return np.asarray(inside & (minds.role[slots, place] == groups[group][role]), np.bool_)

    def heed_conditions(self) -> None:
        """Let all minds heed the conditions of their scheme, if it has some."""
        if self._heeding is not None:
            self._heeding.heed_all()

    def contains(self, identity: int) -> bool:
        """Say whether an agent of this identity lives."""
        return bool(bookkeeping.is_living(self.slot_of, identity))

    def one_of(self, rng: Any) -> Any:
        """Return an agent drawn at random from the living."""
        if not len(self):
            raise ValueError("one_of() of a population without agents")
        place = rng.integers(0, len(self))
        return self.row_class(
            self, int(bookkeeping.nth_living(self.counters, self.order, self.alive, place))
        )

    # Sums over a field ------------------------------------------------------------------------

    def _aggregated(self, what: str, name: str) -> Any:
        whose = f"agents of {self.shape.name!r}"
        field = field_called(name, self.shape.fields, whose, (float, int, bool))
        values = self.columns[field.name][self.slots].tolist()
        return aggregated(what, values, field, "a population without agents")

    # Births and deaths ------------------------------------------------------------------------

    def create(self) -> Any:
        """Bring a new agent into the world, with default fields and a mind at birth."""
        slot = self._place()
        self.rows[slot] = self.default[0]
        agent = self._named(slot)
        self._note(agent, events.CREATED)
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
        if self.shape.steps is not None:
            self.columns["_plan"][slot] = self.columns["_step"][slot] = ENDED
        agent = self._named(slot)
        self._note(agent, parent.id)
        if self.society is not None:
            self.columns["_decided"][slot] = -1  # its plan is its parent's, as a field is
            self.columns["_mind"][slot] = parent.mind.hatch(keep_groups=keep_groups).slot
        if self.minds is not None:
            self.minds.copy(parent._slot, slot)
        return agent

    def die(self, agent: Any) -> None:
        """Take an agent out of the world; its mind leaves its groups."""
        slot = agent._slot
        if self.alive[slot]:
            self._note(agent, events.DIED)
            self.model.ground.leave(self, slot)
            for network in self._networks:
                network.end_links_of(self, slot)
            bookkeeping.died(self.counters, self.alive, self.slot_of, slot, agent.id)
            if self.society is not None:
                self.mind_of(slot).die()
                self.columns["_mind"][slot] = -1

    def _place(self) -> int:
        slot = int(bookkeeping.born(self.counters, self.order, self.alive, self.slot_of, self.free))
        if slot < 0:
            self.grow()
            slot = int(
                bookkeeping.born(self.counters, self.order, self.alive, self.slot_of, self.free)
            )
        return slot

    def _note(self, agent: Any, parent: int) -> None:
        """Note a birth or a death, where somebody asked for them; messages are no agents."""
        model: Any = self.model
        if model.event_log.kept and self.shape.messages_to is None:
            # What happens in a tick is first seen when it is over.
            tick = model.tick + int(model._in_rules)
            model.event_log.note(tick, self.shape.name, agent.id, parent)

    def _named(self, slot: int) -> Any:
        self.columns["_slot"][slot] = slot
        self.columns["_id"][slot] = self.counters[bookkeeping.NEXT_ID] - 1
        return self.row_class(self, slot)

    def settle(self) -> None:
        """End a tick: the dead leave, the new-born act from now on."""
        bookkeeping.settle(self.counters, self.order, self.alive, self.free)

    @property
    def short_of_room(self) -> bool:
        """Whether the next tick could bring more births than there is room for."""
        return bool(bookkeeping.short_of_room(self.counters, self.slot_of))

    @property
    def room(self) -> tuple[int, int]:
        """How many slots there are for the living, and how many identities can be known."""
        return len(self.rows), len(self.slot_of)

    def grow(self) -> None:
        """Make room for births: twice the slots, the identities, or both, as they are short."""
        slots, identities = self.room
        short_of_identities = bookkeeping.short_of_identities(self.counters, self.slot_of)
        self.reserve(
            _more_slots(slots) if bookkeeping.short_of_slots(self.counters) else slots,
            _more_identities(identities) if short_of_identities else identities,
        )

    def reserve(self, slots: int, identities: int) -> None:
        """Have at least so many slots (new ones are taken last) and identities."""
        if identities > len(self.slot_of):
            self.slot_of = _lengthened(self.slot_of, identities, -1)
        old = len(self.rows)
        if slots <= old:
            return
        for name in ("rows", "order", "acting", "alive"):
            setattr(self, name, _lengthened(getattr(self, name), slots, 0))
        count, added = int(self.counters[bookkeeping.FREE]), slots - old
        self.free = np.concatenate(
            [np.arange(slots - 1, old - 1, -1), self.free[:count], np.zeros(old - count, np.int64)]
        )
        self.counters[bookkeeping.FREE] = count + added
        self._see_columns()
        for network in self._networks:
            network.follow_ends()
        if self.society is not None:
            # A mind for each slot, and for those of the others who share these minds.
            others = [
                one
                for one in self.model.tables.values()
                if one is not self
                and one.society is not None
                and one.society.minds is self.society.minds
            ]
            vacant = sum(len(one.rows) - len(one) for one in others)
            self.society.reserve(slots - len(self) + vacant)
        if self.minds is not None:
            self.minds.grow(slots)

    def plan_steps(self, slots: Any) -> list[str | None]:
        """Return the rule or condition at which the plans of agents in slots go on, or None."""
        steps = self.shape.steps
        if steps is None or self.society is None:
            return [None] * len(slots)
        plans = self.society.scheme.plans
        found: list[str | None] = []
        standing = (self.columns[name][slots].tolist() for name in ("_plan", "_step"))
        for plan, step in zip(*standing, strict=True):
            ended = plan < 0 or step < 0 or plans[plan] not in steps.entries
            found.append(None if ended else steps.name(step or steps.entries[plans[plan]]))
        return found

    # State ------------------------------------------------------------------------------------

    _STATE = ("rows", "order", "alive", "slot_of", "free", "counters")

    def snapshot(self) -> dict[str, NDArray[Any]]:
        """Return copies of the arrays that a checkpoint keeps."""
        return {name: getattr(self, name).copy() for name in self._STATE}

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take the arrays of a checkpoint, as `check_state` finds them."""
        for name in self._STATE:
            setattr(self, name, np.array(state[name]))
        self.acting = np.zeros(len(self.rows), np.int64)
        self._see_columns()

    # Networks ---------------------------------------------------------------------------------

    def joined_by(self, network: Any) -> None:
        """Take note of a network whose links join agents of this population."""
        self._networks.append(network)

    def link_arrays(self) -> dict[str, NDArray[Any]]:
        """Return the arrays of an index over the rows that compiled code reaches, if any."""
        return {}

    def build_index(self) -> None:
        """Build the index over the rows anew: a state has been taken."""

    def odd_rows(self, rows: NDArray[Any], state: Mapping[str, NDArray[Any]]) -> str | None:
        """Say what is odd about the rows of the living in a state, beyond those of agents."""
        return None

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
            if self._heeding is not None:
                self._scratch |= self._heeding.arrays
            for command, learner, other in program.imitations:
                if command == "imitate_memes" and learner == self.shape.name:
                    places = memes_of(self.model.tables[other].society.scheme, scheme)
                    self._scratch[f"memes_{other}"] = np.array(places, np.int64).reshape(-1, 2)
        return self._scratch

    def index(self, program: Program) -> dict[str, NDArray[Any]]:
        """Return the arrays by which compiled rules find agents."""
        if not self._index or len(self._index["near_spots"]) != len(self.rows):
            from socialmind.worlds.neighbours.index import arrays

            name, loops = self.shape.name, program.loops_over_found
            patches, few = program.sought_on_patches(name), program.looked_through(name)
            self._index = arrays(len(self.rows), loops, patches, few)
        return self._index

    def gathered(self, kind: str, loops: int) -> dict[str, NDArray[Any]]:
        """Return the arrays by which compiled rules find agents in groups, to be made anew.

        Whenever they are asked for, anybody may have joined or left in the meantime.

        Args:
            kind: of which lists, "members" or "asking".
            loops: how many loops of the rules go over what they found.
        """
        from socialmind.society.groups.lists import STALE, arrays

        assert self.society is not None  # only minds are in groups
        room = (*self.room, len(self.society.minds.instance_id))
        if self._listed != room:
            self._lists, self._listed = {}, room
        if kind not in self._lists:
            self._lists[kind] = arrays(kind, self.room, self.society.minds, loops)
        lists = self._lists[kind]
        lists[f"{kind}_found"][STALE] = True
        return lists

    @property
    def acting_order(self) -> NDArray[np.int64]:
        """The slots of those who act in this tick, in order of birth (a copy)."""
        return self.order[: int(self.counters[bookkeeping.COUNT])].copy()

    def mind_of(self, slot: int) -> Mind:
        """Return the mind of the agent in a slot."""
        if self.society is None:
            raise AttributeError(f"the agents of {self.shape.name!r} have no minds")
        mind = int(self.columns["_mind"][slot])
        if mind < 0:
            identity = int(self.columns["_id"][slot])
            raise ValueError(
                f"the mind of agent {identity} of {self.shape.name!r}, which is dead; "
                "read what you need of it before it dies"
            )
        return self.society.mind_in(mind)


def _more_slots(slots: int) -> int:
    return max(2 * slots, 256)


def _more_identities(identities: int) -> int:
    # The dead leave their slots to others, and keep their identity alone.
    return max(2 * identities, min(16 * identities, 65536), 2048)


def _lengthened(array: NDArray[Any], length: int, rest: int) -> NDArray[Any]:
    larger = np.zeros(length, array.dtype)
    larger[: len(array)] = array
    if rest:
        larger[len(array) :] = rest
    return larger


def _population_of(model: Running, name: str) -> Table:
    table: Table = model.tables[name]
    return table
