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
from socialmind.agents.plan_steps import BEGUN, ENDED, outweighed
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

    @property
    def slot(self) -> int:
        """Where the society holds the mind, which heeds its conditions, as it is asked."""
        slot = super().slot
        heeding = self._row._table._heeding
        if heeding is not None:
            heeding.heed(self._row._slot, slot)
        return slot

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
        self._be_watched()
        weighed = row._table.weighing is not None
        plan = self._choose_weighed() if weighed else super().choose_next_plan()
        row._table.columns["_decided"][row._slot] = model.tick
        if plan is None:
            count_idle(model.context, row.id)
        return plan

    def choose_over(self, plan: str, factor: float) -> str | None:
        """Choose anew if some plan weighs more than factor times the one that goes on, else it."""
        row, society = self._row, self.society
        if row._table.weighing is not None:
            self._weigh()
        goes_on = society.scheme.plans.index(plan)
        weights, plans = society.weights_scratch, society.plans_scratch
        if not outweighed(weights, plans, self._count_available(), goes_on, factor):
            return plan
        self._be_watched()
        row._table.columns["_decided"][row._slot] = row._table.model.tick
        return self._choose_among(self._count_available())

    def _be_watched(self) -> None:
        """Leave a receipt of the decision, if somebody asked for it."""
        row = self._row
        model = row._table.model
        if model.watch is not None and model.watch == (row._table.shape.name, row.id):
            model.watched = self.explain()

    def _choose_weighed(self) -> str | None:
        """Let the hierarchy weigh the plans, and choose one."""
        self._weigh()
        return self._choose_among(self._count_available())

    def _weigh(self) -> None:
        """Let the hierarchy look at the cognitons, and command the plans' weights."""
        table, slot, society = self._row._table, self._row._slot, self.society
        places, steps = table.weighing, table.minds.stepping
        values = society.minds.values[self.slot].tolist()
        for cogniton, sensor in enumerate(places.weighing_sensor.tolist()):
            if sensor >= 0:
                read = weights.sensed(values[cogniton], places.weighing_reach.item(cogniton))
                steps.module.set_sensor(steps.address, slot, sensor, read)
        steps.evaluate(slot)

    def _choose_among(self, count: int) -> str | None:
        """Choose one of the available plans in scratch space."""
        society = self.society
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
    if row._table.shape.steps is not None:
        row._table.columns["_step"][row._slot] = ENDED if plan is None else BEGUN


def _run_plan(row: Row, model: Any, rng: Any) -> None:
    """Carry out the agent's plan, or its next action where it goes on over ticks."""
    plan = _plan(row)
    if plan is not None:
        model.engine.run_plan(row._table.shape.name, plan, row, rng)


def _plan_ended(row: Row) -> bool:
    """Whether the agent's plan has ended, or it has none."""
    return bool(row._table.columns["_step"].item(row._slot) < 0)


def _plan_step(row: Row) -> str | None:
    """The rule or condition at which the agent's plan goes on; None once it has ended."""
    step: str | None = row._table.plan_steps([row._slot])[0]
    return step


def _reconsider_plan(row: Row, factor: float) -> bool:
    """Choose a plan when the last has ended; else let one take over that weighs factor times it.

    Returns:
        Whether a plan begins.
    """
    if not factor >= 1.0:
        raise ValueError("reconsider_plan() wants a factor of 1 or more")
    mind, before = AgentMind.of(row), _plan(row)
    ended = row._table.shape.steps is not None and _plan_ended(row)
    if before is None or ended:
        plan = mind.choose_next_plan()
    else:
        plan = mind.choose_over(before, factor)
        if plan == before:
            return False
    _set_plan(row, plan)
    return plan is not None


def _hierarchy(row: Row) -> Any:
    """The agent's hierarchy of skills."""
    return row._table.minds.of(row._slot)


def _source(link: Row) -> Any:
    """The agent that a link comes from."""
    return link._table.end_of(link._slot, "source")


def _target(link: Row) -> Any:
    """The agent that a link leads to."""
    return link._table.end_of(link._slot, "target")


def _other(link: Row, agent: Row) -> Any:
    """Return the agent at the other end of a link."""
    return link._table.other_end(link._slot, agent)


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
        members["reconsider_plan"] = _reconsider_plan
    if shape.steps is not None:
        members["plan_ended"] = property(_plan_ended)
        members["plan_step"] = property(_plan_step)
    if shape.hierarchy:
        members["hierarchy"] = property(_hierarchy)
    if shape.links is not None:
        members["source"] = property(_source)
        members["target"] = property(_target)
        members["other"] = _other
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
