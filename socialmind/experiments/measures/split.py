"""How a society splits into roles, and how far that is from the split that is wanted.

Tables have a row for each agent at each recorded tick: `tick`, `agent`, `role`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import SocialmindError

Wanted = Mapping[str, float] | pd.DataFrame
"""The wanted ratio: role → part, such as {"A": 1, "B": 2}; or, where it changes, a table with a row
for each ratio: `tick`, from which on it is wanted, and a column of parts for each role."""


def role_of(
    values: ArrayLike, names: tuple[str, str] = ("A", "B"), threshold: float = 0.5
) -> NDArray[np.str_]:
    """Return the roles that a variable stands for: the first below the threshold, else the second.

    Args:
        values: of the variable, any shape.
        names: of the two roles.
        threshold: the least value of the second role.

    >>> role_of([0.0, 0.49, 0.5, 1.0]).tolist()
    ['A', 'A', 'B', 'B']
    """
    return np.where(np.asarray(values, np.float64) < threshold, *names)


def split_of(roles: pd.DataFrame) -> pd.DataFrame:
    """Return how many agents have each role at each recorded tick.

    Args:
        roles: `tick`, `agent`, `role`; each agent once a tick.

    Returns:
        A row for each tick, ascending, a column for each role, in alphabetical order.

    Raises:
        SocialmindError: a column is missing, or a role.

    >>> table = pd.DataFrame({"tick": [0, 0, 0, 9, 9], "agent": [0, 1, 2, 0, 1],
    ...                       "role": ["A", "B", "B", "A", "A"]})
    >>> split_of(table).to_dict("index")
    {0: {'A': 1, 'B': 2}, 9: {'A': 2, 'B': 0}}
    """
    checked_columns(roles, ("tick", "agent", "role"), "roles")
    if roles["role"].isna().any():
        row = roles[roles["role"].isna()].iloc[0]
        raise SocialmindError(
            f"a table of roles: agent {row['agent']} has none at tick {row['tick']}; expected one "
            "for each agent, such as 'undecided'"
        )
    return pd.crosstab(roles["tick"], roles["role"])  # sorted both ways


def wanted_shares(wanted: Wanted, ticks: ArrayLike) -> pd.DataFrame:
    """Return the share of agents that each role is wanted to have at some ticks.

    Args:
        wanted: the parts of the roles, which need not sum to 1.
        ticks: (T,).

    Returns:
        A row for each tick, a column for each role; rows sum to 1.

    Raises:
        SocialmindError: no roles, parts below 0 or all 0, or a tick before the first ratio.

    >>> turned = pd.DataFrame({"tick": [0, 100], "A": [1, 2], "B": [2, 1]})
    >>> wanted_shares(turned, [0, 99, 100])["A"].round(2).tolist()
    [0.33, 0.33, 0.67]
    """
    at = np.asarray(ticks)
    if isinstance(wanted, pd.DataFrame):
        checked_columns(wanted, ("tick",), "wanted ratios")
        ratios = wanted.sort_values("tick", kind="stable")
        since = ratios["tick"].to_numpy()
        parts = ratios.drop(columns="tick").astype(float)
    else:
        since, parts = np.array([-np.inf]), pd.DataFrame([dict(wanted)], dtype=float)
    values = parts.to_numpy(float)
    finite = np.isfinite(values).all()
    if not (values.size and finite and (values >= 0).all() and (values.sum(axis=1) > 0).all()):
        raise SocialmindError(
            f"a wanted ratio of {parts.to_dict('records')}; expected parts of roles, finite, 0 or "
            "more, not all 0"
        )
    if len(at) and at.min() < since[0]:
        raise SocialmindError(f"no ratio is wanted at tick {at.min()}; the first is at {since[0]}")
    shares = values / values.sum(axis=1, keepdims=True)
    row = np.searchsorted(since, at, side="right") - 1
    index = pd.Index(at, name="tick")
    return pd.DataFrame(shares[row], index=index, columns=parts.columns)


def distance_to(split: pd.DataFrame, wanted: Wanted) -> pd.Series:
    """Return how many agents would have to change roles for the wanted split, tick by tick.

    That is Σ |n_r − w_r · n| / 2 over the roles r, n_r of n agents having the role and w_r being
    its wanted share; with two roles |n_A − w_A · n|. It is no whole number where the wanted share
    is none. A role that no ratio names is wanted by nobody.

    Args:
        split: as `split_of` gives it.
        wanted: the wanted ratio, which may change.

    Returns:
        Numbers of agents, 0 or more, by tick.

    >>> split = pd.DataFrame({"A": [3, 9, 0], "B": [6, 0, 6]}, index=[0, 100, 200])
    >>> distance_to(split, {"A": 1, "B": 2}).tolist()  # 3:6; then all are A; then three were lost
    [0.0, 6.0, 2.0]
    """
    shares = wanted_shares(wanted, split.index.to_numpy())
    roles = split.columns.union(shares.columns)
    found = split.reindex(columns=roles, fill_value=0).to_numpy(float)
    aim = shares.reindex(columns=roles, fill_value=0.0).to_numpy(float)
    away = np.abs(found - aim * found.sum(axis=1, keepdims=True)).sum(axis=1) / 2
    return pd.Series(away, index=split.index, name="distance")


def checked_columns(table: pd.DataFrame, columns: Sequence[str], what: str) -> None:
    """Refuse a table that lacks a column.

    Raises:
        SocialmindError: so it is.
    """
    for name in columns:
        if name not in table.columns:
            raise SocialmindError(
                f"a table of {what} without the column {name!r}; it has "
                f"{', '.join(map(str, table.columns)) or 'none'}"
            )
