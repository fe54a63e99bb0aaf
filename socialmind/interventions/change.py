"""A change of parameters and schemes: the society goes on as if it had begun with them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from coglogo_py import CogLogoError, CognitiveScheme
from coglogo_py.border.numbers import whole_number
from coglogo_py.changing.carrying_over import carried_over
from socialmind.agents.plan_steps import ENDED
from socialmind.errors import SocialmindError
from socialmind.model import Model
from socialmind.society import copying

Society = TypeVar("Society", bound=Model)
State = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Change:
    """Other parameters and schemes from a tick on.

    Args:
        tick: 0 or more; what is recorded of the tick shows the society before.
        parameters: values by name.
        schemes: the scheme of a population in place of the one before, or its file, by name. Minds
            keep what both schemes know, by its name.

    Raises:
        SocialmindError: no tick.
    """

    tick: int
    parameters: Mapping[str, Any] = field(default_factory=dict)
    schemes: Mapping[str, CognitiveScheme | Path] = field(default_factory=dict)

    def __post_init__(self) -> None:
        tick = whole_number(self.tick, "the tick of a change", 0, error=SocialmindError)
        object.__setattr__(self, "tick", tick)

    def applied(self, society: Society) -> Society:
        """Return a society in the same state but for what changes; the one given stays as it is.

        Raises:
            SocialmindError: a parameter cannot change or have that value, or a scheme does not fit.
        """
        made = self._remade(society)
        made.restore(self._carried(society, made))
        return made

    def begun(self, society: Society) -> Society:
        """Return a society made with what changes, which has not begun: it is to take a state."""
        return self._remade(society)

    def _remade(self, society: Society) -> Society:
        kind, settings, _ = copying.parts_of(society)
        _refuse_sizes(society, self.parameters)
        for name in self.schemes:
            if name not in society.schemes:
                known = ", ".join(society.schemes) or "none"
                raise SocialmindError(
                    f"a scheme of {name!r} in {society.name}; populations with schemes: {known}"
                )
        schemes = {**society.schemes, **self.schemes} or None
        made: Society = copying.unfinished(
            Model, kind, {**settings, **self.parameters, "scheme": schemes}
        )
        vars(made).update(copying.own_of(society, Model))
        made.event_log.rows = society.event_log.rows.copy()
        made._made = True
        return made

    def _carried(self, society: Model, made: Model) -> State:
        """Return the state of a society as one with other parameters and schemes takes it."""
        state = society.state()
        for name in made.parameters:
            state["context"][name] = made.context[name]
        for name, table in society.tables.items():
            if table.society is None or society.schemes[name] == made.schemes[name]:
                continue
            _refuse_other_sharing(society, made, name)
            begin = f"{name}.minds."
            held = {key[len(begin) :]: one for key, one in state.items() if key.startswith(begin)}
            minds: tuple[Any, Any] = table.society, made.tables[name].society
            try:
                carried = carried_over(held, *minds)
            except CogLogoError as error:
                where = f"the minds of {name!r} at tick {society.tick}"
                raise SocialmindError(f"{where}: {error}") from None
            state |= {f"{begin}{part}": one for part, one in carried.items()}
            _carry_plans(
                state[f"{name}.rows"], society.schemes[name].plans, made.schemes[name].plans
            )
        return state


def _refuse_sizes(society: Model, parameters: Mapping[str, Any]) -> None:
    """Refuse parameters that say how large a society is at its start."""
    of: dict[Any, str] = dict.fromkeys(type(society).declared_world.sizes, "the world")
    of |= {size: repr(name) for name, one in society.populations.items() for size in one.sizes}
    for name in parameters:
        if name in of and parameters[name] != getattr(society, name):
            raise SocialmindError(
                f"parameter {name}: says how large {of[name]} is at the start, which is over at "
                f"tick {society.tick}; let a function make agents, or begin another run"
            )


def _refuse_other_sharing(society: Model, made: Model, name: str) -> None:
    """Refuse schemes by which a population shares groups with others than before."""
    for other in society.schemes:
        both = [(one.tables[name], one.tables[other]) for one in (society, made)]
        together = [one.society is another.society for one, another in both]
        if together[0] != together[1]:
            raise SocialmindError(
                f"schemes by which {name!r} and {other!r} "
                f"{'no longer share their' if together[0] else 'come to share'} groups; "
                "change both alike"
            )


def _carry_plans(rows: NDArray[Any], before: tuple[str, ...], after: tuple[str, ...]) -> None:
    """Let agents keep their plans by name; who has one that there is no more has none."""
    if before == after:
        return
    places = np.array([after.index(one) if one in after else -1 for one in before] + [-1])
    rows["_plan"] = places[rows["_plan"]]
    if "_step" in (rows.dtype.names or ()):
        rows["_step"][rows["_plan"] < 0] = ENDED
