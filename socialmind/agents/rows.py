"""Rows: an agent or a patch as interpreted rules and users hold it.

A row reads and writes the arrays, and gives plain Python values, not NumPy's. Rules are typed
before they run, so theirs are bare; users get rows that check names, values and whether the agent
still lives (`Held…`).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any

from coglogo_py.mind import Mind
from coglogo_py.receipts.receipt import Receipt
from socialmind.agents.attributes import field_property, held_array, unknown
from socialmind.agents.idleness import count_idle
from socialmind.errors import UnknownNameError
from socialmind.language.shape import PopulationShape
from socialmind.mind.kernel import weights
from socialmind.values import fitted

Keeper = Callable[[float, str], float]
"""Takes a place and, for an error, whose it is; gives it as agents of the world keep it."""


class Row:
    """One agent: its fields as attributes, its identity and, where it has one, its mind."""

    __slots__ = ("_slot", "_table")

    def __init__(self, table: Any, slot: int) -> None:
        self._table = table
        self._slot = slot

    @property
    def id(self) -> int:
        """The agent's identity, never used again."""
        return int(self._table.columns["_id"].item(self._slot))

    def die(self) -> None:
        """Leave the world; the agent's rule still runs to its end."""
        self._table.die(self)

    def hatch(self, keep_groups: bool = False) -> Any:
        """Bring a copy of oneself into the world; it acts from the next tick on."""
        return self._table.hatch(self, keep_groups)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Row) and other._table is self._table and other._slot == self._slot

    def __hash__(self) -> int:
        return hash((id(self._table), self._slot))

    def __reduce__(self) -> tuple[Any, ...]:
        return _row_of, (self._table, self._slot)

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={getattr(self, name)!r}" for name in self._table.shape.fields)
        return f"<{self._table.shape.name} {self.id}: {fields}>"


class AgentMind(Mind):
    """The mind of an agent; it tells the model when no plan was available."""

    __slots__ = ("_row",)

    @classmethod
    def of(cls, row: Row) -> AgentMind:
        """Return the mind of a row."""
        mind = row._table.mind_of(row._slot)
        made = cls(mind.society, mind.slot)
        made._row = row
        return made

    _row: Row

    def __reduce__(self) -> tuple[Any, ...]:
        return _mind, (self._row,)

    def explain(self, within: Mapping[str, tuple[float, float]] | None = None) -> Receipt:
        """Return the receipt of the next decision; changes stay within the population's bounds."""
        table = self._row._table
        kept = table.model.populations[table.shape.name].bounds
        own = {name: ends for name, ends in kept.items() if name in self.society.names.cognitons}
        return super().explain(own if within is None else within)

    def choose_next_plan(self) -> str | None:
        """Choose the next plan; None, and counted as idle, when none is available."""
        row = self._row
        model = row._table.model
        if model.watch is not None and model.watch == (row._table.shape.name, row.id):
            model.watched = self.explain()
        weighed = row._table.weighing is not None
        plan = self._choose_weighed() if weighed else super().choose_next_plan()
        row._table.columns["_decided"][row._slot] = model.tick
        if plan is None:
            count_idle(model.context, row.id)
        return plan

    def _choose_weighed(self) -> str | None:
        """Let the hierarchy weigh the plans, and choose one."""
        table, slot, society = self._row._table, self._row._slot, self.society
        places, steps = table.weighing, table.minds.stepping
        values = society.minds.values[self.slot].tolist()
        for cogniton, sensor in enumerate(places.weighing_sensor.tolist()):
            if sensor >= 0:
                read = weights.sensed(values[cogniton], places.weighing_reach.item(cogniton))
                steps.module.set_sensor(steps.address, slot, sensor, read)
        steps.evaluate(slot)
        count = self._count_available()
        position = self._position_of_choice(count)
        society.minds.draws[self.slot] += 1
        return None if position is None else society.scheme.plans[society.plans_scratch[position]]

    def _count_available(self) -> int:
        """Leave the available plans and their weights in scratch space; how many.

        Where a hierarchy weighs them, these are the weights of its last evaluation.
        """
        count = super()._count_available()
        table, society = self._row._table, self.society
        if table.weighing is not None:
            commands = table.minds.state.actuators[self._row._slot, :, 0]
            actuators = table.weighing.weighing_actuator
            for place in range(count):
                command = commands.item(actuators[society.plans_scratch[place]])
                reach = table.weighing.weighing_plans.item(0)
                society.weights_scratch[place] = weights.weighed(command, reach)
        return count


def _row_of(table: Any, slot: int) -> Row:
    row: Row = table.row_class(table, slot)
    return row


def _mind(row: Row) -> AgentMind:
    """The agent's mind."""
    return AgentMind.of(row)


def _plan(row: Row) -> str | None:
    """The agent's plan, or None."""
    plan = row._table.columns["_plan"].item(row._slot)
    return None if plan < 0 else row._table.society.scheme.plans[plan]


def _set_plan(row: Row, plan: str | None) -> None:
    plans = row._table.society.scheme.plans
    if plan is not None and plan not in plans:
        raise ValueError(f"no plan {plan!r}; there is {', '.join(plans)}")
    row._table.columns["_plan"][row._slot] = -1 if plan is None else plans.index(plan)


def _run_plan(row: Row, model: Any, rng: Any) -> None:
    """Carry out the agent's plan."""
    plan = row._table.columns["_plan"].item(row._slot)
    if plan >= 0:
        model.engine.run_plan(row._table.shape.name, plan, row, rng)


def _hierarchy(row: Row) -> Any:
    """The agent's hierarchy of skills."""
    return row._table.minds.of(row._slot)


def row_class(shape: PopulationShape, kept: Collection[str]) -> type[Row]:
    """Return the class of a population's rows as rules hold them, its fields as properties.

    Args:
        shape: the population's.
        kept: the fields for which the table has a keeper, which turns a heading to 0 … 360, and
            brings a place back into the world or refuses it.
    """
    members: dict[str, Any] = {"__slots__": ()}
    for field in shape.fields.values():
        members[field.name] = field_property(field, _slot_of_row)
        if field.name in kept:
            members[field.name] = _kept_property(field.name)
    if shape.minded:
        members["mind"] = property(_mind)
        members["plan"] = property(_plan, _set_plan)
        members["run_plan"] = _run_plan
    if shape.hierarchy:
        members["hierarchy"] = property(_hierarchy)
    return type(shape.name, (Row,), members)


class HeldRow(Row):
    """An agent as users hold it: for as long as it lives, and with what is written checked."""

    __slots__ = ("_identity", "_place")

    def __init__(self, table: Any, slot: int) -> None:
        put = object.__setattr__
        put(self, "_table", table)
        put(self, "_place", slot)
        put(self, "_identity", table.columns["_id"].item(slot))

    @property
    def _slot(self) -> int:  # type: ignore[override]  # a slot of the class there
        if self._table.columns["_id"].item(self._place) != self._identity:
            raise self._dead()
        return self._place

    @property
    def id(self) -> int:
        """The agent's identity, never used again."""
        return self._identity

    def _dead(self) -> UnknownNameError:
        return UnknownNameError(f"agent {self._identity} of {self._table.shape.name!r} is dead")

    def __setattr__(self, name: str, value: Any) -> None:
        table = self._table
        field = table.shape.fields.get(name)
        if field is None:
            if name == "plan" and table.shape.minded:
                object.__setattr__(self, name, value)
                return
            raise unknown(name, table.shape.name, type(self), table.shape.fields)
        if not table.alive[self._slot]:
            raise self._dead()
        value = fitted(field, value, f"the field {name!r} of agent {self._identity}")
        if field.size is not None:
            table.columns[name][self._slot] = value
        else:
            object.__setattr__(self, name, value)

    def __getattr__(self, name: str) -> Any:
        # Python comes here too when a property raises AttributeError, which then raises again.
        if name.startswith("__") or hasattr(type(self), name):
            return object.__getattribute__(self, name)
        raise unknown(name, self._table.shape.name, type(self), self._table.shape.fields)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Row) and other._table is self._table and other.id == self._identity

    def __hash__(self) -> int:
        return hash((id(self._table), self._identity))

    def __repr__(self) -> str:
        if not self._table.contains(self._identity):
            return f"<{self._table.shape.name} {self._identity}: dead>"
        return super().__repr__()


def held_class(bare: type[Row], shape: PopulationShape) -> type[HeldRow]:
    """Return the class of a population's rows as users hold them."""
    members: dict[str, Any] = {"__slots__": ()}
    for field in shape.fields.values():
        if field.size is not None:
            members[field.name] = held_array(field, _slot_of_row)
    if shape.minded:
        members["mind"] = property(_living_mind)
    return type(shape.name, (HeldRow, bare), members)


def _living_mind(row: HeldRow) -> AgentMind:
    """The agent's mind."""
    if not row._table.contains(row._identity):
        raise UnknownNameError(
            f"agent {row._identity} of {row._table.shape.name!r} is dead and has no mind any more; "
            "read what you need of it before it dies"
        )
    return AgentMind.of(row)


def _slot_of_row(row: Any) -> tuple[Any, int]:
    return row._table.columns, row._slot


def _kept_property(name: str) -> property:
    """Return a coordinate or a heading, which is brought back to its range, or refused."""

    def read(row: Any) -> float:
        value: float = row._table.columns[name].item(row._slot)
        return value

    def write(row: Any, value: float) -> None:
        table = row._table
        table.columns[name][row._slot] = table._keepers[name](value, f"agent {row.id}")

    return property(read, write)
