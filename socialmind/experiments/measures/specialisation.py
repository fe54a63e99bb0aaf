"""The measures of specialisation, over what a society was seen to do: one run, one row of numbers.

Each is defined in a file of its own:

- `split`: roles, and the distance to the wanted ratio;
- `settling`: when a society has settled, and again after each shock; role changes after that;
- `division`: division of labour, the share of agents that are specialised, goods delivered;
- `recovery`: how a number comes back after a shock;
- `effects`, `intervals`: how two societies differ over many seeds.

`Course` puts them together.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd

from socialmind.errors import SocialmindError
from socialmind.experiments.measures import division as labour
from socialmind.experiments.measures.settling import HOLD, WITHIN, role_changes, settlings
from socialmind.experiments.measures.split import Wanted, checked_columns, distance_to, split_of

LAST_QUARTER = 0.75
"""Where in a run the part begins that levels are taken from."""


@dataclass(frozen=True, eq=False)
class Course:
    """What agents were seen to be and to do in a run.

    Args:
        roles: `tick`, `agent`, `role` at recorded ticks.
        tasks: `tick`, `agent`, `task`, maybe `amount`: each piece of work.
        wanted: the wanted ratio of roles, which may change.
        shocks: their ticks, ascending, after the first record.
        within: agents that a settled split may be away from the wanted one.
        hold: ticks that it must stay there.
        window: ticks of work that count as recent.
        share: the share of its recent work that a specialist gives to one task.
        least: how much recent work it takes to tell.

    Raises:
        SocialmindError: no roles are recorded, a column is missing, or an agent stands twice at
            one tick.

    >>> roles = pd.DataFrame({"tick": np.repeat([0, 5000, 10000], 3), "agent": [0, 1, 2] * 3,
    ...                       "role": ["B", "B", "B", "A", "B", "B", "A", "B", "B"]})
    >>> tasks = pd.DataFrame({"tick": [8000, 8500, 9000], "agent": [0, 1, 2], "task": list("ABB")})
    >>> course = Course(roles, tasks, {"A": 1, "B": 2}, within=0.5, least=1)
    >>> {name: round(value, 2) for name, value in course.measures().items()}
    ... # doctest: +NORMALIZE_WHITESPACE
    {'distance': 0.33, 'last_distance': 0.0, 'within': 1.0, 'settling_ticks': 5000.0,
     'role_changes': 0.0, 'specialised': 1.0, 'agents_to_tasks': 1.0, 'tasks_to_agents': 0.58,
     'agents_to_tasks_by_chance': 1.0, 'delivered': 3.0}
    """

    roles: pd.DataFrame
    tasks: pd.DataFrame
    wanted: Wanted
    shocks: Sequence[float] = ()
    within: float = WITHIN
    hold: int = HOLD
    window: float = labour.WINDOW
    share: float = labour.SHARE
    least: float = labour.LEAST

    def __post_init__(self) -> None:
        if not len(self.roles):
            raise SocialmindError("a course without a record of roles; expected one at least")
        checked_columns(self.roles, ("tick", "agent", "role"), "roles")
        again = self.roles[self.roles.duplicated(["tick", "agent"])]
        if len(again):
            tick, agent = again[["tick", "agent"]].iloc[0].tolist()
            raise SocialmindError(
                f"roles: agent {agent} twice at tick {tick}; expected one row for each agent at a "
                "tick"
            )

    @cached_property
    def split(self) -> pd.DataFrame:
        """How many agents have each role at each recorded tick."""
        return split_of(self.roles)

    @cached_property
    def distance(self) -> pd.Series:
        """How many agents would have to change roles for the wanted split, by tick."""
        return distance_to(self.split, self.wanted)

    @cached_property
    def settlings(self) -> pd.DataFrame:
        """When it settled at first and after each shock; see `settling.settlings`."""
        return settlings(self.distance, self.shocks, self.within, self.hold)

    @cached_property
    def specialised(self) -> pd.Series:
        """The share of agents that are specialised, by tick."""
        return labour.share_specialised(self.tasks, self.roles, self.window, self.share, self.least)

    @property
    def last(self) -> float:
        """The tick at which the last quarter of the run begins."""
        ticks = self.split.index
        return float(ticks[0] + LAST_QUARTER * (ticks[-1] - ticks[0]))

    @property
    def _late(self) -> pd.Series:
        """The distance in the last quarter."""
        return self.distance[self.distance.index >= self.last]

    def _within_late(self) -> float:
        """Return 1 if all of the last quarter is within the agents allowed, else 0."""
        return float((self._late <= self.within + 1e-9).all())

    def measures(self) -> dict[str, float]:
        """Return the run's numbers.

        Returns:
            `distance`: the mean over the records, in agents; `last_distance`: over those of the
            last quarter; `within`: whether all of these are within the agents allowed, 1 or 0;
            `settling_ticks`: until it settled at first, infinite for never; `recovery_ticks_1`, …:
            until it was settled again after each shock; `role_changes`: for each agent and 10,000
            ticks while settled, NaN if it never was; `specialised`: the mean share of specialised
            agents in the last quarter; `agents_to_tasks`, `tasks_to_agents`: division of labour
            in the last quarter, and what luck alone gives of the first of them; `delivered`: all
            work of the whole run.
        """
        found = self.settlings
        windows = list(zip(found["settled"], found["end"], strict=True))
        works = labour.works_of(self.tasks, since=self.last).to_numpy()
        division = labour.division_of_labour(works)
        whole = bool((works == np.round(works)).all())
        chance = labour.division_by_chance(works).agents_to_tasks if whole else math.nan
        again = found["ticks"].tolist()[1:]
        return {
            "distance": float(self.distance.mean()),
            "last_distance": float(self._late.mean()),
            "within": self._within_late(),
            "settling_ticks": float(found["ticks"].iloc[0]),
            **{f"recovery_ticks_{n}": float(ticks) for n, ticks in enumerate(again, 1)},
            "role_changes": role_changes(self.roles, windows),
            "specialised": float(self.specialised[self.specialised.index >= self.last].mean()),
            "agents_to_tasks": division.agents_to_tasks,
            "tasks_to_agents": division.tasks_to_agents,
            "agents_to_tasks_by_chance": chance,
            "delivered": float(labour.works_of(self.tasks).to_numpy().sum()),
        }

    def scored(self) -> dict[str, float]:
        """Return the measures of settling with a number even where it never settled.

        They are what a model counts while it runs, for `socialmind score`; equal to it to the last
        digit where every tick is recorded.

        Returns:
            `within_one`: as `within`; `settling_ticks`: from the last shock, or the start without
            any, until it settled, or else all the ticks that there were; `role_changes`: for each
            agent and 10,000 ticks while settled, or of the whole run if it never was.
        """
        found = self.settlings
        begin, settled = found[["begin", "settled"]].iloc[-1].tolist()
        ticks = self.distance.index
        changes = role_changes(self.roles, list(zip(found["settled"], found["end"], strict=True)))
        return {
            "within_one": self._within_late(),
            "settling_ticks": min(settled, float(ticks[-1])) - begin,
            "role_changes": role_changes(self.roles) if math.isnan(changes) else changes,
        }
