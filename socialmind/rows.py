"""Rows: an agent or a patch as interpreted rules and users hold it.

A row reads and writes the arrays, and gives plain Python values, not NumPy's.
"""

from __future__ import annotations

from typing import Any

from coglogo_py.mind import Mind
from socialmind.fields import Field, presence
from socialmind.language.shape import PopulationShape
from socialmind.mind.kernel import weights


class ArrayField:
    """An array field of a row."""

    __slots__ = ("_values",)

    def __init__(self, values: Any) -> None:
        self._values = values

    def __len__(self) -> int:
        return len(self._values)

    def __getitem__(self, place: int) -> Any:
        return self._values.item(place)

    def __setitem__(self, place: int, value: float) -> None:
        self._values[place] = value

    def __iter__(self) -> Any:
        # One after another, as compiled rules see them: a loop may change what lies ahead.
        for place in range(len(self._values)):
            yield self._values.item(place)

    def __repr__(self) -> str:
        return repr(self._values.tolist())


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
            model.count_idle(row.id)
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
        model.run_plan(row._table.shape.name, plan, row, rng)


def _hierarchy(row: Row) -> Any:
    """The agent's hierarchy of skills."""
    return row._table.minds.of(row._slot)


def row_class(shape: PopulationShape) -> type[Row]:
    """Return the class of a population's rows, with its fields as properties."""
    members: dict[str, Any] = {"__slots__": ()}
    for field in shape.fields.values():
        members[field.name] = _field_property(field, _slot_of_row)
    if shape.minded:
        members["mind"] = property(_mind)
        members["plan"] = property(_plan, _set_plan)
        members["run_plan"] = _run_plan
    if shape.hierarchy:
        members["hierarchy"] = property(_hierarchy)
    return type(shape.name, (Row,), members)


def _slot_of_row(row: Any) -> tuple[Any, int]:
    return row._table.columns, row._slot


def _field_property(field: Field, place: Any) -> property:
    name = field.name
    if field.size is not None:

        def read_array(row: Any) -> ArrayField:
            columns, slot = place(row)
            return ArrayField(columns[name][slot])

        return property(read_array)
    if field.optional:
        there = presence(name)

        def read_optional(row: Any) -> Any:
            columns, slot = place(row)
            return columns[name].item(slot) if columns[there][slot] else None

        def write_optional(row: Any, value: Any) -> None:
            columns, slot = place(row)
            columns[there][slot] = value is not None
            columns[name][slot] = 0 if value is None else value

        return property(read_optional, write_optional)

    def read(row: Any) -> Any:
        columns, slot = place(row)
        return columns[name].item(slot)

    def write(row: Any, value: Any) -> None:
        columns, slot = place(row)
        columns[name][slot] = value

    return property(read, write)


class PatchRow:
    """One patch: its fields as attributes, and the coordinates of its centre."""

    __slots__ = ("_place", "_world")

    def __init__(self, world: Any, place: int) -> None:
        self._world = world
        self._place = place

    @property
    def x(self) -> int:
        """The column, low … high."""
        return self._place // self._world.size + self._world.low

    @property
    def y(self) -> int:
        """The row, low … high."""
        return self._place % self._world.size + self._world.low

    def __reduce__(self) -> tuple[Any, ...]:
        return _patch_of, (self._world, self._place)

    def __repr__(self) -> str:
        return f"<patch {self.x} {self.y}>"


def _patch_of(world: Any, place: int) -> PatchRow:
    patch: PatchRow = world.row_class(world, place)
    return patch


def patch_class(fields: dict[str, Field]) -> type[PatchRow]:
    """Return the class of a world's patches, with their fields as properties."""
    members: dict[str, Any] = {"__slots__": ()}
    for field in fields.values():
        members[field.name] = _field_property(field, lambda row: (row._world.columns, row._place))
    return type("Patch", (PatchRow,), members)
