"""Who does what: division of labour, and how many agents are specialised.

Tables have a row for each piece of work: `tick`, `agent`, `task`, and `amount` where pieces differ
(1 unless given). A piece of work is whatever a study counts: a delivery, a trade, or what an agent
is seen doing at a record, as students of ants scan their colonies.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import SocialmindError
from socialmind.experiments.measures.split import checked_columns

WINDOW = 10_000
"""Ticks of work that count as recent."""
SHARE = 0.8
"""The share of its recent work that a specialist gives to one task, at least."""
LEAST = 3.0
"""How much recent work it takes to tell."""


def works_of(
    tasks: pd.DataFrame, since: float = -math.inf, until: float = math.inf
) -> pd.DataFrame:
    """Return how much of each task each agent did.

    Args:
        tasks: `tick`, `agent`, `task`, maybe `amount`.
        since: the first tick that counts.
        until: the tick before which work counts.

    Returns:
        A row for each agent, a column for each task of the whole table, whether or not it was done
        in that time; the goods delivered of each kind are the columns' sums.

    Raises:
        SocialmindError: a column is missing, or an amount is not finite.

    >>> table = pd.DataFrame({"tick": [3, 5, 8, 9], "agent": [0, 1, 0, 1], "task": list("ABAB")})
    >>> works_of(table, until=9).to_dict("index")
    {0: {'A': 2.0, 'B': 0.0}, 1: {'A': 0.0, 'B': 1.0}}
    """
    checked_columns(tasks, ("tick", "agent", "task"), "tasks")
    amount = tasks["amount"] if "amount" in tasks.columns else pd.Series(1.0, tasks.index)
    if not np.isfinite(amount.to_numpy(float)).all():
        raise SocialmindError("tasks: an amount that is not finite; expected how much was done")
    counted = (tasks["tick"] >= since) & (tasks["tick"] < until)
    return (
        amount.where(counted, 0.0)
        .astype(float)
        .groupby([tasks["agent"], tasks["task"]])
        .sum()
        .unstack(fill_value=0)
        .sort_index(axis=1)
    )


@dataclass(frozen=True)
class Division:
    """Division of labour (Gorelick, Bertram, Killeen & Fewell, 2004, American Naturalist 164).

    Attributes:
        agents_to_tasks: I / H(tasks), 0 … 1: how much knowing the agent says about the task. 1
            when each agent does one task alone; 0 when all do the tasks alike.
        tasks_to_agents: I / H(agents), 0 … 1: how much knowing the task says about the agent. 1
            when each task is done by one agent alone; the more agents share a task, the less.
        information: I, the mutual information of agents and tasks, in bits.
    """

    agents_to_tasks: float
    tasks_to_agents: float
    information: float

    @property
    def both(self) -> float:
        """I / √(H(agents) H(tasks)), the geometric mean of both: one index of the whole matrix.

        Of the fourteen that Gorelick and Bertram (2007, Insectes Sociaux 54: 105–112) review they
        ask for those that take agents and tasks at once.

        >>> division_of_labour([[4, 0], [4, 0], [0, 8]]).both  # √(1 · 2/3)
        0.816496580927726
        """
        return math.sqrt(self.agents_to_tasks * self.tasks_to_agents)


def division_of_labour(works: ArrayLike) -> Division:
    """Measure how a society divides its work.

    With p the shares of all work by agents and tasks, I = Σ p_at log₂(p_at / (p_a p_t)) is divided
    by the entropy of the tasks and by that of the agents. Where all work is of one task, or one
    agent's, nothing is divided and both are 0. Few pieces of work look divided by luck alone:
    compare with `division_by_chance`.

    Args:
        works: (agents, tasks), 0 or more, as `works_of` gives it.

    Returns:
        The measures; NaN where there is no work.

    Raises:
        SocialmindError: amounts below 0 or not finite, or an array of another shape.

    >>> division_of_labour([[4, 0], [4, 0], [0, 8]])
    Division(agents_to_tasks=1.0, tasks_to_agents=0.6666666666666666, information=1.0)
    >>> division_of_labour([[1, 3], [2, 6]]).agents_to_tasks
    0.0
    """
    table = _checked(works)
    total = table.sum()
    if total == 0:
        return Division(math.nan, math.nan, math.nan)
    shares = table / total
    agents, tasks = shares.sum(axis=1), shares.sum(axis=0)
    done = shares > 0
    odds = shares[done] / np.outer(agents, tasks)[done]
    information = float((shares[done] * np.log2(odds)).sum())
    information = information if information > 1e-12 else 0.0  # it is never below 0 but by rounding
    return Division(
        _over(information, _entropy(tasks)), _over(information, _entropy(agents)), information
    )


def division_by_chance(works: ArrayLike, draws: int = 200, seed: int = 0) -> Division:
    """Return the division of labour that luck alone gives.

    The pieces of work are dealt out anew at random, so that each agent does as many as before and
    each task is done as often, and measured again; the mean of many such deals is what agents
    without any preference come to.

    Args:
        works: (agents, tasks), whole numbers.
        draws: how many deals.
        seed: of the deals.

    Raises:
        SocialmindError: amounts that are no whole numbers: pieces cannot be dealt out.

    >>> division_of_labour([[2, 1], [1, 2]]).agents_to_tasks  # less than what luck gives
    0.08170416594551039
    >>> 0.12 < division_by_chance([[2, 1], [1, 2]]).agents_to_tasks < 0.22
    True
    """
    table = _checked(works)
    whole = np.round(table).astype(np.int64)
    if not (whole == table).all():
        raise SocialmindError("amounts of work that are no whole numbers; expected pieces of work")
    if not whole.any():
        return Division(math.nan, math.nan, math.nan)
    agents = np.repeat(np.arange(len(whole)), whole.sum(axis=1))
    tasks = np.concatenate([np.repeat(np.arange(whole.shape[1]), row) for row in whole])
    rng = np.random.default_rng(seed)
    found = np.zeros(3)
    for _ in range(draws):
        dealt = np.bincount(agents * whole.shape[1] + rng.permutation(tasks), minlength=whole.size)
        one = division_of_labour(dealt.reshape(whole.shape))
        found += (one.agents_to_tasks, one.tasks_to_agents, one.information)
    return Division(*(found / draws).tolist())


def share_specialised(
    tasks: pd.DataFrame,
    present: pd.DataFrame,
    window: float = WINDOW,
    share: float = SHARE,
    least: float = LEAST,
) -> pd.Series:
    """Return the share of agents that are specialised, tick by tick.

    An agent is specialised at a tick t if it did `least` work or more in the ticks after t − window
    up to t, and `share` or more of that was of one task. One that did less is not.

    Args:
        tasks: `tick`, `agent`, `task`, maybe `amount`.
        present: `tick`, `agent`: who was there at the recorded ticks, such as a table of roles.
        window: ticks.
        share: above 0.5, to 1.
        least: amount of work, above 0.

    Returns:
        By recorded tick, 0 … 1.

    Raises:
        SocialmindError: a column is missing, or an argument is out of range.

    >>> table = pd.DataFrame({"tick": [1, 2, 3, 1, 2, 3], "agent": [0, 0, 0, 1, 1, 1],
    ...                       "task": list("AAAABB")})
    >>> there = pd.DataFrame({"tick": [2, 2, 3, 3], "agent": [0, 1, 0, 1]})
    >>> share_specialised(table, there).tolist()
    [0.0, 0.5]
    """
    checked_columns(tasks, ("tick", "agent", "task"), "tasks")
    checked_columns(present, ("tick", "agent"), "who was there")
    if not 0.5 < share <= 1 or not window > 0 or not least > 0:
        raise SocialmindError(
            f"a window of {window}, a share of {share} and at least {least} work; expected a "
            "share above 0.5, to 1, and the others above 0"
        )
    ticks = np.unique(present["tick"].to_numpy())
    there = pd.crosstab(present["tick"], present["agent"]) > 0
    kinds, names = pd.factorize(tasks["task"])
    when = tasks["tick"].to_numpy(float)
    amount = tasks["amount"].to_numpy(float) if "amount" in tasks.columns else np.ones(len(tasks))
    found = np.zeros(len(ticks))
    for agent, rows in tasks.groupby("agent").indices.items():
        if agent not in there.columns:
            continue
        recent = np.zeros((len(names), len(ticks)))
        for kind in range(len(names)):
            own = rows[kinds[rows] == kind]
            own = own[np.argsort(when[own], kind="stable")]
            so_far = np.concatenate([[0.0], np.cumsum(amount[own])])
            upto = np.searchsorted(when[own], ticks, side="right")
            before = np.searchsorted(when[own], ticks - window, side="right")
            recent[kind] = so_far[upto] - so_far[before]
        total = recent.sum(axis=0)
        enough = total >= least * (1 - 1e-12)
        special = enough & (recent.max(axis=0) >= share * total * (1 - 1e-12))
        found += special & there[agent].to_numpy()
    shares = found / there.sum(axis=1).to_numpy()
    return pd.Series(shares, index=pd.Index(ticks, name="tick"), name="specialised")


def _checked(works: ArrayLike) -> NDArray[np.float64]:
    table = np.asarray(works, np.float64)
    if table.ndim != 2 or not (np.isfinite(table) & (table >= 0)).all():
        raise SocialmindError(
            f"works of the shape {table.shape}; expected agents by tasks, each 0 or more"
        )
    return table


def _entropy(shares: NDArray[np.float64]) -> float:
    some = shares[shares > 0]
    return float(-(some * np.log2(some)).sum())


def _over(information: float, entropy: float) -> float:
    return min(information / entropy, 1.0) if entropy > 1e-12 else 0.0
