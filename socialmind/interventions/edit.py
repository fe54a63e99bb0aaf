"""An edit: one value of one agent, set by hand between two ticks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from coglogo_py import Mind
from coglogo_py.border.numbers import whole_number
from socialmind.errors import SocialmindError, nearest
from socialmind.model import Model

Society = TypeVar("Society", bound=Model)
Value = float | int | bool | str | None
PARTS = ("field", "cogniton", "participation", "culturon")


@dataclass(frozen=True)
class Edit:
    """Another value of an agent from a tick on.

    Args:
        tick: 0 or more; what is recorded of the tick shows the society before.
        population: the agent's.
        agent: its identity.
        part: what changes: ``field NAME``; ``cogniton NAME``, which None makes inactive;
            ``participation GROUP``; ``culturon GROUP.NAME``, of the group that the agent is in, and
            so for all of its members.
        value: what it is from then on.

    Raises:
        SocialmindError: no tick.

    >>> Edit(100, "humans", 6, "cogniton Farmer", 12.0).part
    'cogniton Farmer'
    """

    tick: int
    population: str
    agent: int
    part: str
    value: Value

    def __post_init__(self) -> None:
        tick = whole_number(self.tick, "the tick of an edit", 0, error=SocialmindError)
        object.__setattr__(self, "tick", tick)

    def applied(self, society: Society) -> Society:
        """Change a society; returns it.

        Raises:
            SocialmindError: there is no such agent or part, or it cannot have that value; the
                society is as before.
        """
        what = f"{self.part} of agent {self.agent} of {self.population!r}"
        table = society.tables.get(self.population)
        if table is None:
            raise SocialmindError(f"{what}: {nearest(self.population, society.tables)}")
        if not table.contains(self.agent):
            raise SocialmindError(f"{what}: no such agent lives at tick {society.tick}")
        kind, _, name = self.part.partition(" ")
        if kind not in PARTS or not name:
            expected = "field NAME, cogniton NAME, participation GROUP or culturon GROUP.NAME"
            raise SocialmindError(f"{what}; expected {expected}")
        agent, before = table[self.agent], society.state()
        try:
            if kind == "field":
                setattr(agent, name, self.value)
            else:
                self._set_in_mind(agent.mind, kind, name)
        except (SocialmindError, ValueError, AttributeError) as error:
            society.restore(before)
            raise SocialmindError(f"{what} set to {self.value!r}: {error}") from None
        # What follows from the state is found anew, as when a run goes on from a checkpoint.
        society.restore(society.state())
        return society

    def _set_in_mind(self, mind: Mind, kind: str, name: str) -> None:
        if kind == "cogniton" and self.value is None:
            mind.deactivate_cogniton(name)
            return
        if isinstance(self.value, bool | str) or self.value is None:
            raise SocialmindError("expected a number")
        value = float(self.value)
        if kind == "cogniton":
            mind.activate_cogniton(name)
            mind.set_cogniton_value(name, value)
        elif kind == "participation":
            mind.set_participation(name, value)
        else:
            group, _, culturon = name.partition(".")
            mind.set_culturon_value(group, culturon, value)
