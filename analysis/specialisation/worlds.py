"""One world: a society of robots that is run, watched and measured.

Until half-time nothing is known of what happens then, so a society is run that far but once.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from socialmind.catalogue import load_file, model_folder
from socialmind.experiments.measures.division import works_of
from socialmind.experiments.measures.settling import role_changes
from socialmind.experiments.measures.specialisation import Course
from socialmind.experiments.measures.split import role_of, wanted_shares

from .societies import CONDITIONS, TRAINED, Condition

if TYPE_CHECKING:
    from socialmind import Model

MINDS = load_file(TRAINED / "minds.py")
RULES = load_file(model_folder("foraging_roles") / "thresholds.py")
"""The model by whose robots all are measured alike, by what they bring home."""
B = 2
EVERY = 100
"""Ticks between two records of roles and of what was delivered; a trip takes some 800."""
SHOWN_EVERY = 500
"""Ticks between two records of the distance, and of how many are specialised, that are kept."""


def lived(
    conditions: Sequence[str],
    seed: int,
    ticks: int,
    parameters: Mapping[str, float],
    lesson: str = "",
    attempt: int = 0,
) -> dict[str, list[dict[str, Any]]]:
    """Run a society to half-time, and from there on under each condition; measure each run.

    Args:
        conditions: their names.
        seed: of the world.
        ticks: how long.
        parameters: that make the society.
        lesson: whose mind the robots have; empty where they need none.
        attempt: which of its attempts.

    Returns:
        Rows by table, each with its `condition`: `worlds`, the measures of the run; `course`,
        distance and specialised robots over time; `kinds`, what became of the programmed and the
        learned; `spells`, the roles of each robot.
    """
    half = ticks // 2
    own, mind = MINDS.decided_by(lesson, attempt) if lesson else ({}, None)
    model = RULES.ForagingByThresholds(seed=seed, hierarchy=mind, **{**parameters, **own})
    before = watched(model, range(0, half, EVERY))
    model.advance(half - 1 - model.tick)  # what happens does so in the tick that ends at half-time
    state = model.state()
    tables: dict[str, list[dict[str, Any]]] = {}
    for name in conditions:
        what = CONDITIONS[name]
        model.restore(_with(state, what.parameters(half)))
        after = watched(model, range(half, ticks + 1, EVERY))
        seen = pd.concat([before, after], ignore_index=True)
        for table, rows in looked_at(seen, what, half).items():
            named = [{"condition": name, "seed": seed, **row} for row in rows]
            tables.setdefault(table, []).extend(named)
    return tables


def _with(state: Mapping[str, Any], parameters: Mapping[str, int]) -> dict[str, Any]:
    """Return a state as if the model had had other parameters, which counted for nothing so far."""
    context = state["context"].copy()
    for name, value in parameters.items():
        context[name] = value
    return {**state, "context": context}


def looked_at(seen: pd.DataFrame, what: Condition, half: int) -> dict[str, list[dict[str, Any]]]:
    """Return what a run comes to, rows by table.

    Args:
        seen: what was seen of its robots.
        what: happened to them.
        half: when.
    """
    tasks = deliveries(seen)
    course = Course(seen[["tick", "agent", "role"]], tasks, what.wanted(half), what.shocks(half))
    over_time = pd.DataFrame({"distance": course.distance, "specialised": course.specialised})
    shown: Any = over_time[over_time.index % SHOWN_EVERY == 0].reset_index().to_dict("records")
    return {
        "worlds": [measured(course, what, half)],
        "course": shown,
        "kinds": kinds(seen, tasks, course.last),
        "spells": spells(seen),
    }


def watched(model: Model, ticks: Iterable[int]) -> pd.DataFrame:
    """Run a model on, and return what is seen of its robots at some ticks.

    Args:
        model: at the first of the ticks, or before.
        ticks: ascending.

    Returns:
        `tick`, `agent`, `role`, the kind that it brought home last, and A before that;
        `programmed`, and `a` and `b`, delivered so far.
    """
    seen = []
    for tick in ticks:
        model.advance(tick - model.tick)
        robots: Any = model.robots  # type: ignore[attr-defined]  # this model's population
        seen.append(
            {
                "tick": np.full(len(robots), tick),
                "agent": np.array(robots.id),
                "role": role_of(robots.brought == B),
                "programmed": np.array(robots.programmed, bool),
                "a": np.array(robots.delivered_a),
                "b": np.array(robots.delivered_b),
            }
        )
    return pd.DataFrame({name: np.concatenate([one[name] for one in seen]) for name in seen[0]})


def deliveries(seen: pd.DataFrame) -> pd.DataFrame:
    """Return each delivery, at the first record after it.

    >>> seen = pd.DataFrame({"tick": [0, 0, 100, 100], "agent": [0, 1, 0, 1],
    ...                      "a": [0, 0, 0, 1], "b": [0, 0, 1, 0]})
    >>> deliveries(seen).to_dict("records")
    ... # doctest: +NORMALIZE_WHITESPACE
    [{'tick': 100, 'agent': 0, 'task': 'B', 'amount': 1},
     {'tick': 100, 'agent': 1, 'task': 'A', 'amount': 1}]
    """
    ordered = seen.sort_values(["agent", "tick"], kind="stable")
    so_far = ordered[["a", "b"]]
    more = so_far - so_far.groupby(ordered["agent"]).shift(fill_value=0)
    table = ordered[["tick", "agent"]].assign(A=more["a"], B=more["b"])
    long = table.melt(["tick", "agent"], var_name="task", value_name="amount")
    return (
        long[long["amount"] > 0]
        .sort_values(["tick", "agent", "task"], kind="stable")
        .reset_index(drop=True)
    )


def measured(course: Course, condition: Condition, half: int) -> dict[str, float]:
    """Return the measures of a run.

    To those of `Course` it adds `settled_after`, ticks from the start or the shock until it
    settled, all that were left where it never did; `late_changes`, of roles for each robot and
    10,000 ticks in the last quarter, settled or not; and `in_ratio`, the objects delivered that
    make up the wanted ratio.

    Args:
        course: the run.
        condition: what happened in it.
        half: when.
    """
    found = course.measures()
    return {
        **found,
        "settled_after": course.scored()["settling_ticks"],
        "late_changes": role_changes(course.roles, [(course.last, math.inf)]),
        "in_ratio": in_ratio(course.tasks, condition, half),
    }


def in_ratio(tasks: pd.DataFrame, condition: Condition, half: int) -> float:
    """Return how many of the objects delivered make up the wanted ratio, each half for itself.

    Of what was delivered in a half, it is the largest part with that half's ratio.

    >>> tasks = pd.DataFrame({"tick": [1, 2, 3, 4], "agent": 0, "task": list("ABBB")})
    >>> round(in_ratio(tasks, CONDITIONS["undisturbed"], 100), 9)  # an A and two B
    3.0
    """
    found = 0.0
    for since, until in ((-math.inf, half), (half, math.inf)):
        goods = works_of(tasks, since, until).sum()
        shares = wanted_shares(condition.wanted(half), [max(since, 0)]).iloc[0]
        found += min(goods.get(kind, 0.0) / share for kind, share in shares.items())
    return float(found)


def kinds(seen: pd.DataFrame, tasks: pd.DataFrame, last: float) -> list[dict[str, Any]]:
    """Return what became of the programmed and of the learned robots of a society.

    Args:
        seen: what was seen of them.
        tasks: what they delivered.
        last: the tick at which the last quarter begins.

    Returns:
        A row for each kind there is: `robots`; `in_b`, the share of their time that they were in B
        in the last quarter; their changes of roles for each robot and 10,000 ticks in the whole run
        (`changes`) and in the last quarter (`late_changes`); and `delivered`, for each robot.
    """
    rows = []
    for programmed, part in seen.groupby("programmed"):
        late = part[part["tick"] >= last]
        agents = part["agent"].unique()
        delivered = tasks.loc[tasks["agent"].isin(agents), "amount"].sum()
        rows.append(
            {
                "kind": "programmed" if programmed else "learned",
                "robots": len(agents),
                "in_b": float((late["role"] == "B").mean()) if len(late) else math.nan,
                "changes": role_changes(part),
                "late_changes": role_changes(late) if len(late) else math.nan,
                "delivered": float(delivered) / len(agents),
            }
        )
    return rows


def spells(seen: pd.DataFrame) -> list[dict[str, Any]]:
    """Return how long each robot had which role: `agent`, `since`, `until`, `role`, `programmed`.

    >>> seen = pd.DataFrame({"tick": [0, 100, 200], "agent": 4, "role": list("ABB"),
    ...                      "programmed": False})
    >>> [(row["since"], row["until"], row["role"]) for row in spells(seen)]
    [(0, 100, 'A'), (100, 200, 'B')]
    """
    rows = []
    for agent, part in seen.sort_values("tick", kind="stable").groupby("agent"):
        ticks, roles = part["tick"].to_numpy(), part["role"].to_numpy()
        begins = [0, *(np.flatnonzero(roles[1:] != roles[:-1]) + 1).tolist()]
        ends = [*begins[1:], len(ticks) - 1]
        for begin, end in zip(begins, ends, strict=True):
            rows.append(
                {
                    "agent": int(agent),
                    "since": int(ticks[begin]),
                    "until": int(ticks[end]),
                    "role": str(roles[begin]),
                    "programmed": bool(part["programmed"].iloc[0]),
                }
            )
    return rows
