"""The colonies of the study: each is run and measured here, one row for each."""

from __future__ import annotations

from typing import Any

import numpy as np
import pandas as pd

from socialmind.catalogue import load_model
from socialmind.experiments.measures.settling import settlings
from socialmind.experiments.measures.specialisation import Course
from socialmind.experiments.measures.split import distance_to, split_of

TASKS = 2
EVERY = 100
"""Ticks between two records."""
WANTED = {"task 0": 2, "task 1": 2, "none": 1}
"""The split that is looked for: five workers, two for each task and one in reserve."""

MINORS, MAJORS = 1.0, 8.0
"""Thresholds of the castes; with δ = 1, α = 3 and p = 0.2 as everywhere here."""
CASTES = {
    "n_workers": 100, "n_tasks": 1, "threshold": MINORS, "majors_threshold": MAJORS,
    "learning": 0.0, "forgetting": 0.0,
}  # fmt: skip
FIXED = {"learning": 0.0, "forgetting": 0.0}

REMOVED_AT = 5_000
AFTER = 5_000
"""Ticks from the return of the specialists to the last look."""


# Castes with fixed thresholds ---------------------------------------------------------------------


def answering(threshold: float, stimulus: float, seed: int, ticks: int) -> dict[str, float]:
    """Measure how much a hundred workers work where the stimulus stays as it is.

    Args:
        threshold: of all workers.
        stimulus: of the one task.
        seed: of every draw.
        ticks: that are measured, after a quarter as many that are not.

    Returns:
        The share of time that they work.
    """
    options = {**CASTES, "threshold": threshold, "demand": 0.0, "efficiency": 0.0}
    colony = load_model("thresholds")(seed, **options)
    colony.tasks.stimulus = stimulus
    colony.advance(ticks // 4)
    before = colony.workers.done[:, 0].sum()
    colony.advance(ticks)
    work = (colony.workers.done[:, 0].sum() - before) / (ticks * len(colony.workers))
    return {"threshold": threshold, "stimulus": stimulus, "seed": seed, "work": float(work)}


def works(stimulus: float, threshold: float, p: float = 0.2) -> float:
    """Return the share of time that a worker works at a stimulus, T / (T + p).

    >>> works(8.0, 8.0)
    0.7142857142857143
    """
    response = stimulus**2 / (stimulus**2 + threshold**2)
    return response / (response + p)


def caste(majors: int, seed: int, ticks: int) -> dict[str, float]:
    """Measure how much each caste works.

    Args:
        majors: of a hundred workers.
        seed: of every draw.
        ticks: that are measured, after a quarter as many that are not.

    Returns:
        The share of time that majors and minors work, and the mean stimulus.
    """
    colony = load_model("thresholds")(seed, n_majors=majors, **CASTES)
    colony.advance(ticks // 4)
    before = colony.workers.done[:, 0].copy()
    stimuli = []
    for _ in range(100):
        colony.advance(ticks // 100)
        stimuli.append(float(colony.tasks.stimulus[0]))
    share = (colony.workers.done[:, 0] - before) / ticks
    return {
        "majors": majors,
        "seed": seed,
        "major_work": float(share[:majors].mean()) if majors else np.nan,
        "minor_work": float(share[majors:].mean()) if majors < len(share) else np.nan,
        "stimulus": float(np.mean(stimuli)),
    }


def expected(share: float, p: float = 0.2, wanted: float = 1 / 3) -> tuple[float, float]:
    """Return what majors and minors work on the mean in an endless colony.

    A worker works the share x = T / (T + p) of its time. The stimulus is the one at which both
    castes together do what is wanted: f · x(major) + (1 − f) · x(minor) = δ / α.

    Args:
        share: f, of majors.
        p: chance to stop working.
        wanted: δ / α.

    >>> expected(0.0)[1], expected(1.0)[0]
    (0.333, 0.333)
    """

    low, high = 0.0, 1000.0
    for _ in range(60):
        middle = (low + high) / 2
        done = share * works(middle, MAJORS, p) + (1 - share) * works(middle, MINORS, p)
        low, high = (middle, high) if done < wanted else (low, middle)
    return round(works(low, MAJORS, p), 3), round(works(low, MINORS, p), 3)


# Specialists out of equals ------------------------------------------------------------------------


def records(colony: Any, ticks: int) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Run a colony and return its roles and its work, as the measures take them."""
    roles, works = [], []
    for place in range(ticks // EVERY + 1):
        if place:
            colony.advance(EVERY)
        roles.append(roles_of(colony))
        own = {"tick": colony.tick, "agent": colony.workers.id}
        for task in range(TASKS):
            done = colony.workers.done[:, task]
            works.append(pd.DataFrame({**own, "task": f"task {task}", "amount": done}))
    work = pd.concat(works, ignore_index=True)
    work["amount"] = work.groupby(["agent", "task"])["amount"].diff().fillna(0.0)
    return pd.concat(roles, ignore_index=True), work[work["amount"] > 0]


def roles_of(colony: Any) -> pd.DataFrame:
    """Return the roles of all workers now: the task that each is a specialist of, or none."""
    names = np.array(["task 0", "task 1", "none"])[colony.roles()]
    return pd.DataFrame({"tick": colony.tick, "agent": colony.workers.id, "role": names})


def specialists(workers: int, learns: bool, seed: int, ticks: int) -> dict[str, Any]:
    """Measure how a colony of equals divides two tasks.

    Args:
        workers: of the colony.
        learns: whether thresholds are learned and forgotten, or fixed.
        seed: of every draw.
        ticks: length of the run.

    Returns:
        The measures of `Course`, and the split at the end.
    """
    options = {} if learns else FIXED
    colony = load_model("thresholds")(seed, n_workers=workers, **options)
    roles, works = records(colony, ticks)
    course = Course(roles, works, WANTED)
    last = course.split.iloc[-1]
    split = {name.replace(" ", "_"): float(last.get(name, 0)) for name in WANTED}
    return {"workers": workers, "learns": learns, "seed": seed, **split, **course.measures()}


# Specialists taken away and brought back ----------------------------------------------------------


def absence(workers: int, forgets: bool, away: int, seed: int) -> dict[str, Any]:
    """Take the specialists of task 0 away for so many ticks, and look at what became of all.

    Args:
        workers: of the colony.
        forgets: whether those who are away forget what they learned.
        away: ticks until they are brought back; 0 takes nobody away.
        seed: of every draw.

    Returns:
        Of those who stayed: their thresholds for the task at the removal and at the return, in
        shares of the range, and how many are specialists of it then. Of all, `AFTER` ticks later:
        what is another than before the removal, in shares of the range or of workers. And the ticks
        from the return until the split is the wanted one for 1,000 ticks; infinite for never.
    """
    options = {"remove_at": REMOVED_AT, "return_at": REMOVED_AT + away} if away else {}
    colony = load_model("thresholds")(seed, n_workers=workers, forgetting_away=forgets, **options)
    colony.advance(REMOVED_AT)
    before, roles = thresholds_of(colony), colony.roles()
    colony.advance(away)
    gone = colony.workers.away if away else roles == 0
    at_return, stand_ins = thresholds_of(colony), colony.roles() == 0
    seen = []
    for _ in range(AFTER // EVERY):
        colony.advance(EVERY)
        seen.append(roles_of(colony))
    distance = distance_to(split_of(pd.concat(seen)), WANTED)
    settled = settlings(distance, within=0, hold=1_000)["settled"].iloc[0] - REMOVED_AT - away
    again = colony.roles()
    return {
        "workers": workers,
        "forgets": forgets,
        "away": away,
        "seed": seed,
        "removed": int(gone.sum()),
        "stayed_before": float(before[~gone, 0].mean()),
        "stayed_return": float(at_return[~gone, 0].mean()),
        "stand_ins": float(stand_ins[~gone].sum()),
        "change": float(np.abs(thresholds_of(colony) - before).mean()),
        "other_role": float((again != roles).mean()),
        "lost_role": float((again != roles)[gone].mean()) if gone.any() else np.nan,
        "stayed_other_role": float((again != roles)[~gone].mean()),
        "settled_again": float(settled),
    }


def absence_told(away: int, seed: int, before: int, after: int, every: int) -> pd.DataFrame:
    """Follow the thresholds for task 0 of five workers, of whom the specialists are taken away.

    Args:
        away: ticks until they are brought back.
        seed: of every draw.
        before, after: ticks that are told before the removal, and after the return.
        every: ticks between two rows of a worker.

    Returns:
        A row for each worker and tick from the removal on: its threshold and whether it is one of
        those who are taken away.
    """
    colony = load_model("thresholds")(seed, remove_at=REMOVED_AT, return_at=REMOVED_AT + away)
    colony.advance(REMOVED_AT - before)
    rows = []
    for since in range(-before, away + after + 1, every):
        colony.advance(REMOVED_AT + since - colony.tick)
        rows.append(
            pd.DataFrame(
                {
                    "since": since, "agent": colony.workers.id, "away": colony.workers.away,
                    "threshold": colony.workers.thresholds[:, 0],
                }
            )
        )  # fmt: skip
    told = pd.concat(rows, ignore_index=True)
    return told.assign(removed=told.groupby("agent")["away"].transform("any"))


def thresholds_of(colony: Any) -> Any:
    """Return the thresholds of all workers, (workers, tasks), as shares of the range 1 … 1000."""
    return (colony.workers.thresholds[:, :TASKS] - 1.0) / 999.0
