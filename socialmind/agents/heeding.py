"""Agents' minds heed the conditions of their scheme: thresholds of fields and parameters.

`coglogo_py.conditions` says what conditions are and what they do to a mind; here stands what they
compare in a model. Compiled rules fill it in from the text of `engine.conditions_text`.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py import CognitiveScheme
from coglogo_py.conditions.condition import Condition
from coglogo_py.conditions.heeding import FIELD, heed, heed_each, laid_out_conditions
from socialmind.errors import ModelError, nearest
from socialmind.fields import Field, presence


def comparable(fields: Mapping[str, Field]) -> list[Field]:
    """Return the fields, or the parameters, that conditions may name; places are their codes."""
    return [one for one in fields.values() if one.size is None and not one.choices]


def check_conditions(
    scheme: CognitiveScheme,
    population: str,
    fields: Mapping[str, Field],
    parameters: Mapping[str, Field],
    place: tuple[str | Path | None, int | None],
) -> None:
    """Refuse conditions on what agents or the model do not have.

    Args:
        scheme: the scheme of a population's minds.
        population: its name.
        fields: those of its agents.
        parameters: those of the model.
        place: the file of the scheme, and the line for conditions that know none.

    Raises:
        ModelError: so it is.
    """
    for cogniton in scheme.cognitons:
        for one in cogniton.conditions:
            for name, known, what in (
                (one.field, fields, f"field of the agents of {population!r}"),
                (one.bound, parameters, "parameter of the model"),
            ):
                if not isinstance(name, str) or name in [held.name for held in comparable(known)]:
                    continue
                raise ModelError(
                    f"{name!r} in the condition {str(one)!r} of cogniton {cogniton.name!r}",
                    f"a {what} that is a number or a truth value",
                    None if name in known else nearest(name, known),
                    place[0],
                    one.line or place[1],
                )


class Heeding:
    """The conditions of a population's scheme, as its agents' fields meet them.

    Args:
        table: the population, whose society is made.

    Attributes:
        conditions: as `coglogo_py.conditions.heeding` lays them out, with the codes of what is
            compared.
        sides: what each compares, filled for one agent after another.
    """

    def __init__(self, table: Any) -> None:
        self._table = table
        self.conditions, self.sides, written = laid_out_conditions(table.society.scheme)
        self._written: tuple[Condition, ...] = written
        fields = [one.name for one in comparable(table.shape.fields)]
        for row, one in enumerate(written):
            self.conditions[row, FIELD] = fields.index(one.field)
            if isinstance(one.bound, str):  # parameters stay as they are in a run
                self.sides[row, 1] = table.model.context[one.bound]

    @property
    def arrays(self) -> dict[str, NDArray[Any]]:
        """What compiled rules need of it."""
        return {"conditions": self.conditions, "sides": self.sides}

    def heed(self, slot: int, mind: int) -> None:
        """Bring the mind of the agent in a slot up to date.

        Args:
            slot: the agent's.
            mind: where the minds of the society hold its mind.
        """
        for row, one in enumerate(self._written):
            self.sides[row, 0] = self._compared(one, slot)
        heed(self.conditions, self.sides, self._table.society.minds.values, mind)

    def heed_all(self) -> None:
        """Bring the minds of all the living up to date."""
        table = self._table
        slots = table.slots
        compared = np.array([self._compared(one, slots) for one in self._written], np.float64)
        minds = table.columns["_mind"][slots]
        heed_each(self.conditions, self.sides, compared, table.society.minds.values, minds)

    def _compared(self, one: Condition, slots: Any) -> Any:
        """Return what a condition compares of agents, NaN where it is None."""
        columns = self._table.columns
        found = columns[one.field][slots]
        if self._table.shape.fields[one.field].optional:
            return np.where(columns[presence(one.field)][slots], found, np.nan)
        return found
