"""Distillation: a readable cognitive scheme that chooses as a learned mind does.

A mind that weighs plans (`socialmind.mind.weighing`) is asked what it would do in many states of
cognitons, such as those that its society lives through. To its answers influence links are fitted;
links that matter least are left out one after another, as long as the choices stay nearly the same;
and the rest is rounded. Everything else of the scheme, from conditional links to the decision
maker, stays as it was. What comes out is a scheme like one that a person wrote.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from coglogo_py import CognitiveScheme, Cogniton
from coglogo_py.laying_out import scheme_arrays
from socialmind.errors import ModelError, SocialmindError
from socialmind.mind.description import MindDescription
from socialmind.mind.hierarchy import Hierarchy
from socialmind.mind.kernel.weights import sensed, weighed
from socialmind.mind.weighing import Weighing

HABIT = "Habit"
"""The cogniton, always 1, whose links are what a plan weighs whatever else is."""
TOLERANCE = 0.01
"""How much of the overlap of choices leaving links out may cost."""
LEVEL = 0.01
"""How much the level of weights counts beside their differences."""
DIGITS = 2
"""Significant digits of the links."""

Floats = NDArray[np.float64]


def states_of(model: Any, population: str, ticks: Sequence[int]) -> Floats:
    """Run a model on, and return the cognitons of its minds at some ticks.

    Args:
        model: the model; it is at the last of the ticks afterwards.
        population: whose minds.
        ticks: ascending, from the model's tick on.

    Returns:
        (states, cognitons), NaN for inactive ones: all living minds at each tick.
    """
    seen = []
    for tick in ticks:
        model.advance(int(tick) - model.tick)
        table = model.tables[population]
        values = table.society.minds.values[table.columns["_mind"][table.slots]]
        seen.append(values[:, : len(table.society.scheme.cognitons)].copy())
    return np.concatenate(seen)


def available(states: Floats, scheme: CognitiveScheme) -> NDArray[np.bool_]:
    """Return which plans are available in some states: (states, plans), by conditional links."""
    opens = scheme_arrays(scheme).conditional[: states.shape[1]]
    return np.asarray((~np.isnan(states)).astype(np.int64) @ opens.astype(np.int64) > 0)


def weights_by_links(states: Floats, scheme: CognitiveScheme) -> Floats:
    """Return what plans weigh in some states by a scheme's influence links (equation 3.2).

    Args:
        states: (states, cognitons), NaN for inactive ones; a last cogniton of the scheme that has
            no column, such as a habit, has its value at birth.
        scheme: the scheme.

    >>> hunger = Cogniton("Hunger", influence={"eat": 2.0}, conditional=("eat",))
    >>> weights_by_links(np.array([[3.0], [np.nan]]), CognitiveScheme("cows", (hunger,))).tolist()
    [[6.0], [0.0]]
    """
    rest = [one.start_value for one in scheme.cognitons[states.shape[1] :]]
    values = np.column_stack([np.nan_to_num(states), *(np.full(len(states), one) for one in rest)])
    return np.asarray(values @ scheme_arrays(scheme).influence[: values.shape[1]])


def weights_by_hierarchy(
    states: Floats,
    scheme: CognitiveScheme,
    mind: MindDescription,
    weighing: Weighing,
    master: str | None = None,
) -> Floats:
    """Return what plans weigh in some states by a hierarchy, each asked afresh.

    Args:
        states: (states, cognitons), NaN for inactive ones.
        scheme: the scheme whose cognitons and plans these are.
        mind: the hierarchy.
        weighing: how it reads cognitons and weighs plans.
        master: its master skill; may be left out where no other skill influences exactly one.

    Raises:
        ModelError: a hierarchy that reads what is no cogniton, or remembers: what it does is no
            matter of the state alone.
    """
    if mind.variables:
        raise ModelError(f"the mind {mind.name!r} with variables", "one without memory")
    weighing.places(scheme, mind)
    names = [one.name for one in scheme.cognitons]
    read = {}
    for sensor in mind.sensors:
        if sensor not in weighing.cognitons:
            raise ModelError(f"the sensor {sensor!r} of {mind.name!r}", "cognitons with a reach")
        reach = weighing.cognitons[sensor]
        column = states[:, names.index(sensor)].tolist()
        read[sensor] = np.array([sensed(value, reach) for value in column])
    minds = Hierarchy(mind, master).many(len(states))
    commands = minds.evaluate(read)
    told = np.stack([np.asarray(commands[plan], np.float64) for plan in scheme.plans], axis=1)
    return np.asarray(weighed(told, weighing.reach), np.float64)


def choices(weights: Floats, open_plans: NDArray[np.bool_], scheme: CognitiveScheme) -> Floats:
    """Return how probable each plan is under a scheme's decision maker.

    Args:
        weights: (states, plans).
        open_plans: (states, plans), which are available.
        scheme: whose decision maker chooses.

    Returns:
        (states, plans), rows that sum to 1, or 0 where no plan is available.
    """
    maker = scheme.decision_maker
    found = np.zeros(weights.shape)
    for state, is_open in enumerate(open_plans):
        if is_open.any():
            found[state, is_open] = maker.probabilities(weights[state, is_open], maker.bias)
    return found


@dataclass(frozen=True)
class Agreement:
    """How alike two minds choose, over states.

    Attributes:
        overlap: the mean of Σ min(p, q) over the plans, 0 … 1: how often they can choose the same,
            at best; 1 − the distance of total variation.
        same: the share of states in which both hold the same plan for the most probable.
    """

    overlap: float
    same: float


def agreement(first: ArrayLike, second: ArrayLike) -> Agreement:
    """Compare the choices of two minds in the same states.

    Args:
        first: (states, plans) probabilities, as `choices` gives them.
        second: those of the other; states in which either has no plan do not count.

    Raises:
        SocialmindError: no states in which both have a plan, or other shapes.

    >>> agreement([[0.5, 0.5], [1.0, 0.0]], [[0.75, 0.25], [1.0, 0.0]])
    Agreement(overlap=0.875, same=1.0)
    """
    p, q = np.asarray(first, np.float64), np.asarray(second, np.float64)
    if p.shape != q.shape or p.ndim != 2:
        raise SocialmindError(f"choices of the shapes {p.shape} and {q.shape}; expected the same")
    both = (p.sum(axis=1) > 0) & (q.sum(axis=1) > 0)
    if not both.any():
        raise SocialmindError("no state in which both minds have a plan to choose")
    p, q = p[both], q[both]
    same = p.argmax(axis=1) == q.argmax(axis=1)
    return Agreement(float(np.minimum(p, q).sum(axis=1).mean()), float(same.mean()))


@dataclass(frozen=True)
class Distillation:
    """A scheme distilled from a mind.

    Attributes:
        scheme: the scheme.
        links: how many influence links it has.
        agreement: with the mind, in states that it was not fitted to.
        unpruned: that of all links, before any was left out or rounded.
    """

    scheme: CognitiveScheme
    links: int
    agreement: Agreement
    unpruned: Agreement


def distilled(
    states: Floats,
    weights: Floats,
    scheme: CognitiveScheme,
    name: str = "distilled",
    tolerance: float = TOLERANCE,
    digits: int = DIGITS,
    seed: int = 0,
) -> Distillation:
    """Fit a scheme to what plans weigh in a mind.

    Differences between available plans count for a choice, and how large they are beside each
    other; the level of all weights hardly does. So links are fitted by least squares to the weights
    less their mean in each state, and to the mean itself as if it were a hundredth as large, all
    divided by the sum of the weights above the least. One link after another is left out, that
    whose loss raises the sum of squares least, the others being fitted anew. Of all these
    schemes, rounded, it is the one with the fewest links whose choices overlap with the mind's by
    no more than `tolerance` less than those of all links. Two thirds of the states are fitted to,
    the others judge.

    Args:
        states: (states, cognitons), NaN for inactive ones.
        weights: (states, plans), what they weigh in the mind.
        scheme: whose links are replaced; all else is kept.
        name: of the distilled scheme.
        tolerance: how much of the overlap may be lost, 0 … 1.
        digits: significant digits of the links.
        seed: of the draw of the states that judge.

    Raises:
        SocialmindError: fewer than ten states, or arrays that do not fit.
    """
    plans = scheme.plans
    shape = (len(states), len(plans))
    if weights.shape != shape or states.shape[1] != len(scheme.cognitons) or len(states) < 10:
        raise SocialmindError(
            f"states of the shape {states.shape} and weights of {weights.shape}; expected ten "
            f"states or more of {len(scheme.cognitons)} cognitons, weights of {len(plans)} plans"
        )
    if any(one.name == HABIT for one in scheme.cognitons):
        raise SocialmindError(f"the scheme {scheme.name!r} has a cogniton {HABIT!r} already")
    order = np.random.default_rng(seed).permutation(len(states))
    fitted, judged = np.split(order, [2 * len(states) // 3])
    is_open = available(states, scheme)
    squares, product = _normal_equations(states[fitted], weights[fitted], is_open[fitted])
    aim = choices(weights[judged], is_open[judged], scheme)

    def scheme_of(links: Floats, rounded: bool) -> tuple[CognitiveScheme, Agreement]:
        one = _with_links(scheme, name, _rounded(links, digits) if rounded else links)
        chosen = choices(weights_by_links(states[judged], one), is_open[judged], one)
        return one, agreement(aim, chosen)

    size = (states.shape[1] + 1, len(plans))
    kept = list(range(size[0] * size[1]))
    unpruned = scheme_of(_solved(squares, product, kept).reshape(size), rounded=False)[1]
    best: Distillation | None = None
    while kept:
        links = _solved(squares, product, kept)
        one, found = scheme_of(links.reshape(size), rounded=True)
        if best is None or found.overlap >= unpruned.overlap - tolerance:
            best = Distillation(one, len(kept), found, unpruned)
        kept.remove(_least_missed(squares, product, kept, links))
    if best is None:
        raise SocialmindError("a scheme without cognitons or plans; there is nothing to distil")
    return best


def _normal_equations(
    states: Floats, weights: Floats, is_open: NDArray[np.bool_]
) -> tuple[Floats, Floats]:
    """Return XᵀX and Xᵀy of the fit; a link's place is cogniton · plans + plan."""
    values = np.column_stack([np.nan_to_num(states), np.ones(len(states))])
    count = np.maximum(is_open.sum(axis=1, keepdims=True), 1)
    centred = np.where(is_open, weights - (weights * is_open).sum(axis=1, keepdims=True) / count, 0)
    least = np.where(is_open, centred, np.inf).min(axis=1, keepdims=True)
    above = np.where(is_open, centred - np.where(np.isfinite(least), least, 0.0), 0.0)
    spread = above.sum(axis=1, keepdims=True)
    level = np.where(is_open, weights, 0.0).sum(axis=1, keepdims=True) / count
    several = (is_open.sum(axis=1) > 1) & (spread[:, 0] > 0)
    scale = np.where(several[:, None], 1.0 / np.where(spread > 0, spread, 1.0), 0.0)
    # What a link (c, q) adds to the centred weight of plan p: v_c (δ_pq − open_q / count).
    plans = weights.shape[1]
    share = is_open / count
    effect = (np.eye(plans)[None] - share[:, None, :]) * is_open[:, :, None] * is_open[:, None, :]
    design = np.einsum("nc,npq->npcq", values * scale, effect)
    levels = np.einsum("nc,nq->ncq", LEVEL * values * scale, share)
    rows = np.concatenate(
        [design.reshape(len(states) * plans, -1), levels.reshape(len(states), -1)]
    )
    target = np.concatenate([(centred * scale).ravel(), (LEVEL * level * scale).ravel()])
    return rows.T @ rows, rows.T @ target


def _solved(squares: Floats, product: Floats, kept: Sequence[int]) -> Floats:
    """Return the links of the least squares, 0 for those that are not kept."""
    links = np.zeros(len(product))
    part = squares[np.ix_(kept, kept)]
    # Each link in units of its own: cognitons differ by orders of magnitude.
    unit = np.sqrt(np.maximum(np.diag(part), 1e-300))
    found = np.linalg.lstsq(part / np.outer(unit, unit), product[kept] / unit, rcond=1e-10)[0]
    links[kept] = found / unit
    return links


def _least_missed(squares: Floats, product: Floats, kept: Sequence[int], links: Floats) -> int:
    """Return the link whose loss costs the fit least."""

    def cost(without: int) -> float:
        rest = [one for one in kept if one != without]
        if not rest:
            return 0.0
        found = _solved(squares, product, rest)
        return float(found @ squares @ found - 2 * product @ found)

    return min(kept, key=cost)


def _rounded(links: Floats, digits: int) -> Floats:
    """Return numbers to some significant digits.

    >>> _rounded(np.array([[0.0, 1234.0], [-0.0456, 7.0]]), 2).tolist()
    [[0.0, 1200.0], [-0.046, 7.0]]
    """
    return np.array([[float(f"{one:.{digits - 1}e}") for one in row] for row in links.tolist()])


def _with_links(scheme: CognitiveScheme, name: str, links: Floats) -> CognitiveScheme:
    """Return a scheme with other influence links, those of the last row of a cogniton Habit."""

    def of(row: Floats) -> Mapping[str, float]:
        return {plan: one for plan, one in zip(scheme.plans, row.tolist(), strict=True) if one}

    changed = [
        replace(one, influence=of(row)) for one, row in zip(scheme.cognitons, links, strict=False)
    ]
    if links[-1].any():
        changed.append(Cogniton(HABIT, start_value=1.0, influence=of(links[-1])))
    return replace(
        scheme, name=name, cognitons=tuple(changed), plan_order=scheme.plans, plan_positions={}
    )
