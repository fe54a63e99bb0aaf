"""How different the agents of a society are: distances between them, and what these come to.

Distances are between what agents do (`work_distances`) or between what their minds would do
(`policy_distances`). System neural diversity is their mean; hierarchic social entropy looks at the
groups that are alike at each distance, and so tells few large groups from many small ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from socialmind.errors import SocialmindError


def work_distances(works: ArrayLike) -> NDArray[np.float64]:
    """Return how far each two agents are apart in what they do.

    It is half the sum of the differences of the shares of their work that they give to each task:
    0 for agents that divide their time alike, 1 for agents that have no task in common.

    Args:
        works: (agents, tasks), 0 or more, as `division.works_of` gives it; agents without work are
            left out.

    >>> work_distances([[4, 0], [1, 1], [0, 3]]).tolist()
    [[0.0, 0.5, 1.0], [0.5, 0.0, 0.5], [1.0, 0.5, 0.0]]
    """
    table = np.asarray(works, np.float64)
    if table.ndim != 2 or not (np.isfinite(table) & (table >= 0)).all():
        raise SocialmindError(
            f"works of the shape {table.shape}; expected agents by tasks, each 0 or more"
        )
    table = table[table.sum(axis=1) > 0]
    shares = table / table.sum(axis=1, keepdims=True)
    return np.abs(shares[:, None] - shares[None]).sum(axis=2) / 2


def policy_distances(
    actions: ArrayLike, deviations: ArrayLike | None = None
) -> NDArray[np.float64]:
    """Return how far each two agents are apart in what they would do, observation by observation.

    It is the mean over observations of the distance W₂ (Wasserstein) between the distributions of
    their actions (Bettini, Shankar and Prorok, 2025, Journal of Machine Learning Research 26(163)):
    for normal distributions with independent actions √(Σ (μ − μ')² + Σ (σ − σ')²), for minds that
    draw nothing the Euclidean distance of their actions.

    Args:
        actions: what each agent does on the mean at each observation, the same ones for all,
            (agents, observations, actions).
        deviations: the standard deviations, likewise; none for minds that draw nothing.

    Raises:
        SocialmindError: arrays of other shapes, numbers that are not finite, or negative
            deviations.

    >>> policy_distances([[[0, 0], [0, 0]], [[3, 4], [0, 1]]]).tolist()  # of 5 and 1
    [[0.0, 3.0], [3.0, 0.0]]
    """
    means = np.asarray(actions, np.float64)
    spreads = np.zeros_like(means) if deviations is None else np.asarray(deviations, np.float64)
    whole = np.isfinite(means).all() and np.isfinite(spreads).all() and (spreads >= 0).all()
    if means.ndim != 3 or 0 in means.shape or spreads.shape != means.shape or not whole:
        raise SocialmindError(
            f"actions of the shape {means.shape}; expected finite numbers, agents by observations "
            "by actions, and as many deviations of 0 or more"
        )
    both = np.concatenate([means, spreads], axis=2)
    found: NDArray[np.float64] = np.linalg.norm(both[:, None] - both[None], axis=3).mean(axis=2)
    return found


def system_neural_diversity(distances: ArrayLike) -> float:
    """Return the mean distance of two agents (SND: Bettini, Shankar and Prorok, 2025).

    Args:
        distances: (agents, agents), as `policy_distances` gives them.

    Returns:
        0 or more; NaN for one agent alone.

    Raises:
        SocialmindError: distances that are none.

    >>> system_neural_diversity([[0, 1, 1], [1, 0, 0], [1, 0, 0]])
    0.6666666666666666
    """
    table = _distances(distances)
    above = table[np.triu_indices(len(table), 1)]
    return float(above.mean()) if len(above) else float("nan")


def hierarchic_social_entropy(distances: ArrayLike) -> float:
    """Return the entropy of the groups that are alike, summed over what counts as alike.

    At each level h agents fall into the largest groups of which no two members are farther apart
    than h; an agent may be in several. With p the shares of memberships by group, the entropy is
    −Σ p log₂ p, and the measure its integral over h (Balch, 2000, Autonomous Robots 8: 209–238,
    whose groups are these u-diametric clusters).

    Args:
        distances: (agents, agents), some tens of agents at most.

    Returns:
        In bits times the unit of the distances; 0 where all are alike.

    Raises:
        SocialmindError: distances that are none.

    >>> hierarchic_social_entropy([[0, 3], [3, 0]])  # two groups of one up to 3: 1 bit
    3.0
    """
    table = _distances(distances)
    levels = np.unique(np.concatenate([[0.0], table.ravel()]))
    total = 0.0
    for level, above in pairwise(levels.tolist()):
        sizes = np.array([len(one) for one in _groups(table <= level)], np.float64)
        shares = sizes / sizes.sum()
        total += (above - level) * max(0.0, float(-(shares * np.log2(shares)).sum()))
    return total


def _groups(alike: NDArray[np.bool_]) -> Iterator[set[int]]:
    """Yield the largest groups whose members are all alike (Bron and Kerbosch, with a pivot)."""
    near = [set(np.flatnonzero(row).tolist()) - {agent} for agent, row in enumerate(alike)]
    waiting: list[tuple[set[int], set[int], set[int]]] = [(set(), set(range(len(near))), set())]
    while waiting:
        group, may, done = waiting.pop()
        if not may and not done:
            yield group
            continue
        pivot = max(may | done, key=lambda agent: (len(near[agent] & may), -agent))
        for agent in sorted(may - near[pivot]):
            waiting.append((group | {agent}, may & near[agent], done & near[agent]))
            may = may - {agent}
            done = done | {agent}


def _distances(distances: ArrayLike) -> NDArray[np.float64]:
    table = np.asarray(distances, np.float64)
    square = table.ndim == 2 and len(table) == len(table.T) > 0
    if not square or not (np.isfinite(table) & (table >= 0)).all() or np.diag(table).any():
        raise SocialmindError(
            f"distances of the shape {table.shape}; expected agents by agents, each 0 or more and "
            "0 from an agent to itself"
        )
    if not (table == table.T).all():
        raise SocialmindError("distances that are not the same both ways; expected one for a pair")
    return table
