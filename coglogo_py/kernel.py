"""Every operation of a mind, as functions over the arrays of its scheme and society.

Each is ordinary Python that numba compiles; `f.py_func` is the same text, interpreted. A mind is
a slot of `MindArrays`; cogniton, plan, group, role and culturon are positions in the scheme (roles
and culturons counted over all groups). Callers have checked these; what only the running model can
know is checked here, before any state changes: finite values, the plan fed back from, group ids.

Groups stand in `groups/instances`, and are reached from here as all else. A file and what it
imports are the key that its compiled code is kept under. Sums run in the scheme's order, so both
speeds give the same bits.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from coglogo_py.arrays import ALIVE as ALIVE
from coglogo_py.arrays import FREE_INSTANCES as FREE_INSTANCES
from coglogo_py.arrays import FREE_MINDS as FREE_MINDS
from coglogo_py.arrays import NEXT_GROUP as NEXT_GROUP
from coglogo_py.arrays import NEXT_MIND as NEXT_MIND
from coglogo_py.arrays import SEED_HIGH as SEED_HIGH
from coglogo_py.arrays import SEED_LOW as SEED_LOW
from coglogo_py.arrays import STREAM as STREAM
from coglogo_py.compiled.borrow import borrowed
from coglogo_py.compiled.machine_code import kept, key_of_file
from coglogo_py.groups.instances import add_to_culturon_value as add_to_culturon_value
from coglogo_py.groups.instances import add_to_group_attribute as add_to_group_attribute
from coglogo_py.groups.instances import add_to_participation as add_to_participation
from coglogo_py.groups.instances import ask_to_join as ask_to_join
from coglogo_py.groups.instances import asked_row as asked_row
from coglogo_py.groups.instances import change_role as change_role
from coglogo_py.groups.instances import create_and_join_group as create_and_join_group
from coglogo_py.groups.instances import enclose_group as enclose_group
from coglogo_py.groups.instances import enter as enter
from coglogo_py.groups.instances import expel as expel
from coglogo_py.groups.instances import find_group as find_group
from coglogo_py.groups.instances import forget_requests as forget_requests
from coglogo_py.groups.instances import get_asked_group_id as get_asked_group_id
from coglogo_py.groups.instances import get_culturon_value as get_culturon_value
from coglogo_py.groups.instances import get_enclosing_group_id as get_enclosing_group_id
from coglogo_py.groups.instances import get_group_attribute as get_group_attribute
from coglogo_py.groups.instances import get_group_id as get_group_id
from coglogo_py.groups.instances import get_group_role_id as get_group_role_id
from coglogo_py.groups.instances import get_participation as get_participation
from coglogo_py.groups.instances import grant_entry as grant_entry
from coglogo_py.groups.instances import index_instances as index_instances
from coglogo_py.groups.instances import join_group as join_group
from coglogo_py.groups.instances import leave_all_groups as leave_all_groups
from coglogo_py.groups.instances import leave_group as leave_group
from coglogo_py.groups.instances import refuse_entry as refuse_entry
from coglogo_py.groups.instances import release_group as release_group
from coglogo_py.groups.instances import set_culturon_value as set_culturon_value
from coglogo_py.groups.instances import set_group_attribute as set_group_attribute
from coglogo_py.groups.instances import set_participation as set_participation
from coglogo_py.groups.instances import standing as standing
from coglogo_py.streams import LOW_32, MIND_BIRTH_STREAMS, MIND_STREAMS, uniforms

if TYPE_CHECKING:
    from coglogo_py.arrays import Bools, Floats, Ints, MindArrays, SchemeArrays

MAXIMUM_WEIGHT = 0
WEIGHTED_STOCHASTIC = 1
BIASED_WEIGHTED_STOCHASTIC = 2
MODELLERS_OWN = 3
POSITIVE_STOCHASTIC = 4
"""Codes of the decision makers, as `SchemeArrays.maker[0]` holds them."""
CODES = {
    "MaximumWeight": MAXIMUM_WEIGHT,
    "WeightedStochastic": WEIGHTED_STOCHASTIC,
    "BiasedWeightedStochastic": BIASED_WEIGHTED_STOCHASTIC,
    "PositiveStochastic": POSITIVE_STOCHASTIC,
}
"""Those of the built-in ones, by their names."""

_KEY = key_of_file("coglogo", __file__)
_operation = kept(_KEY, no_cfunc_wrapper=True)
_inlined = kept(_KEY, no_cfunc_wrapper=True, forceinline=True)
_inner = kept(_KEY, no_cfunc_wrapper=True, no_cpython_wrapper=True, forceinline=True)

# --------------------------------------------------------------------------- birth and death


@_operation
def new_mind(scheme: SchemeArrays, minds: MindArrays) -> int:
    """Make a mind with the scheme's starting cognitons; return its slot, -1 when all are taken."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    counters = minds.counters
    if counters[FREE_MINDS] == 0:
        return -1
    counters[FREE_MINDS] -= 1
    slot = minds.free_minds[counters[FREE_MINDS]]
    minds.mind_id[slot] = counters[NEXT_MIND]
    counters[NEXT_MIND] += 1
    counters[ALIVE] += 1
    for cogniton in range(scheme.start.shape[0]):
        minds.values[slot, cogniton] = scheme.start[cogniton]
    draw_at_birth(scheme, minds, slot, -1)
    return slot


@_operation
def draw_at_birth(scheme: SchemeArrays, minds: MindArrays, slot: int, parent: int) -> None:
    """Let chance decide on cognitons of a mind that is new, or has its parent's values.

    The draws are of the mind and of the cogniton's name: they disturb no others.

    Args:
        scheme: the scheme's arrays.
        minds: the society's arrays.
        slot: the mind.
        parent: the slot of the mind that it was hatched from, -1 for a new mind.
    """
    scheme, minds = borrowed(scheme), borrowed(minds)
    chances = scheme.chances
    counters = minds.counters
    for row in range(chances.shape[0]):
        first, second = uniforms(
            int(chances[row, 3]),
            int(minds.mind_id[slot]) & LOW_32,
            0,
            MIND_BIRTH_STREAMS | int(counters[STREAM]),
            int(counters[SEED_LOW]),
            int(counters[SEED_HIGH]),
        )
        if parent < 0 or second >= chances[row, 2]:
            cogniton = int(chances[row, 0])
            has_it = first < chances[row, 1]
            minds.values[slot, cogniton] = scheme.start[cogniton] if has_it else np.nan


@_operation
def hatch(scheme: SchemeArrays, minds: MindArrays, slot: int, keep_groups: bool) -> int:
    """Make a mind with the cogniton values of the one in `slot`; return its slot, or -1.

    Chance decides on those that are not always inherited. With `keep_groups` the child is a true
    member of its parent's group instances, with the parent's roles and participation; otherwise it
    is in no group.
    """
    scheme, minds = borrowed(scheme), borrowed(minds)
    child = new_mind(scheme, minds)
    if child < 0:
        return child
    for cogniton in range(minds.values.shape[1]):
        minds.values[child, cogniton] = minds.values[slot, cogniton]
    draw_at_birth(scheme, minds, child, slot)
    if keep_groups:
        for group in range(minds.group_slot.shape[1]):
            row = minds.group_slot[slot, group]
            if row >= 0:
                enter(minds, child, group, minds.role[slot, group], row)
                minds.participation[child, group] = minds.participation[slot, group]
    return child


@_operation
def die(scheme: SchemeArrays, minds: MindArrays, slot: int) -> None:
    """Free the slot of a mind; it leaves its groups at once. A free slot is left as it is."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    if minds.mind_id[slot] < 0:
        return
    leave_all_groups(minds, slot)
    forget_requests(minds, slot)
    minds.mind_id[slot] = -1
    minds.draws[slot] = 0
    for cogniton in range(minds.values.shape[1]):
        minds.values[slot, cogniton] = np.nan
    counters = minds.counters
    minds.free_minds[counters[FREE_MINDS]] = slot
    counters[FREE_MINDS] += 1
    counters[ALIVE] -= 1


# --------------------------------------------------------------------------- cognitons


@_operation
def set_cogniton_value(minds: MindArrays, slot: int, cogniton: int, value: float) -> None:
    """Set an active cogniton's value; an inactive one stays inactive."""
    minds = borrowed(minds)
    if not math.isfinite(value):
        raise ValueError("set_cogniton_value: the value must be a finite number")
    if not math.isnan(minds.values[slot, cogniton]):
        minds.values[slot, cogniton] = value


@_operation
def add_to_cogniton_value(minds: MindArrays, slot: int, cogniton: int, value: float) -> None:
    """Add to an active cogniton's value; an inactive one stays inactive."""
    minds = borrowed(minds)
    if not math.isfinite(value):
        raise ValueError("add_to_cogniton_value: the value must be a finite number")
    old = minds.values[slot, cogniton]
    if not math.isnan(old):
        if not math.isfinite(old + value):
            raise ValueError("add_to_cogniton_value: the sum is beyond the largest number")
        minds.values[slot, cogniton] = old + value


@_operation
def get_cogniton_value(minds: MindArrays, slot: int, cogniton: int) -> float:
    """Return a cogniton's value, 0.0 when it is inactive."""
    minds = borrowed(minds)
    value = minds.values[slot, cogniton]
    return 0.0 if math.isnan(value) else value


@_operation
def activate_cogniton(minds: MindArrays, slot: int, cogniton: int) -> None:
    """Make an inactive cogniton active with value 0.0 (never its starting value)."""
    minds = borrowed(minds)
    if math.isnan(minds.values[slot, cogniton]):
        minds.values[slot, cogniton] = 0.0


@_operation
def deactivate_cogniton(minds: MindArrays, slot: int, cogniton: int) -> None:
    """Make a cogniton inactive; its value is forgotten."""
    minds = borrowed(minds)
    minds.values[slot, cogniton] = np.nan


@_operation
def is_active(minds: MindArrays, slot: int, cogniton: int) -> bool:
    """Say whether a cogniton is active."""
    minds = borrowed(minds)
    return not math.isnan(minds.values[slot, cogniton])


@_operation
def imitate(
    minds: MindArrays, slot: int, cogniton: int, others: MindArrays, other: int, theirs: int
) -> bool:
    """Take over a cogniton of another mind, active with its value; False where it is inactive.

    Args:
        minds: the arrays of the mind that imitates.
        slot: that mind.
        cogniton: which of its cognitons.
        others: the arrays of the mind that is imitated, perhaps the same.
        other: that mind.
        theirs: which of its cognitons.
    """
    minds, others = borrowed(minds), borrowed(others)
    value = others.values[other, theirs]
    if math.isnan(value):
        return False
    minds.values[slot, cogniton] = value
    return True


# --------------------------------------------------------------------------- decisions


@_inner
def _weigh(
    scheme: SchemeArrays, minds: MindArrays, slot: int, weights: Floats, opened: Bools | Ints
) -> None:
    """Write each plan's weight (equation 3.2), and whether a conditional link opens the plan."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    weights, opened = borrowed(weights), borrowed(opened)
    # Taken out of the tuples once, before the loops: it is not free.
    link_begin = scheme.link_begin
    link_cogniton = scheme.link_cogniton
    link_weight = scheme.link_weight
    link_opens = scheme.link_opens
    influence = scheme.influence
    conditional = scheme.conditional
    group_culturons = scheme.group_culturons
    role_culturons = scheme.role_culturons
    values = minds.values
    group_slot = minds.group_slot
    culturons = minds.culturons
    n_cognitons = values.shape[1]
    for plan in range(weights.shape[0]):
        weight = 0.0
        is_open = False
        for link in range(link_begin[plan], link_begin[plan + 1]):
            value = values[slot, link_cogniton[link]]
            if not math.isnan(value):
                weight += link_weight[link] * value
                is_open |= link_opens[link]
        for group in range(group_slot.shape[1]):
            row, role, by = standing(scheme, minds, slot, group)
            if row >= 0:
                participation = minds.participation[slot, by]
                for culturon in range(group_culturons[group, 0], group_culturons[group, 1]):
                    if role_culturons[role, culturon]:
                        link = n_cognitons + culturon
                        weight += influence[link, plan] * participation * culturons[row, culturon]
                        is_open |= conditional[link, plan]
        if is_open and not math.isfinite(weight):
            raise ValueError("a plan's weight is beyond the largest number")
        weights[plan] = weight
        opened[plan] = is_open


@_operation
def plan_weights(
    scheme: SchemeArrays, minds: MindArrays, slot: int, weights: Floats, available: Bools
) -> int:
    """Write each plan's weight, and whether it is available; return how many are available.

    A plan that is not available has no weight: NaN.
    """
    scheme, minds = borrowed(scheme), borrowed(minds)
    weights, available = borrowed(weights), borrowed(available)
    _weigh(scheme, minds, slot, weights, available)
    count = 0
    for plan in range(weights.shape[0]):
        if available[plan]:
            count += 1
        else:
            weights[plan] = np.nan
    return count


@_inlined
def available_weights(
    scheme: SchemeArrays, minds: MindArrays, slot: int, weights: Floats, plans: Ints
) -> int:
    """Write the available plans and their weights, in the scheme's order; return their number."""
    scheme, minds = borrowed(scheme), borrowed(minds)
    weights, plans = borrowed(weights), borrowed(plans)
    _weigh(scheme, minds, slot, weights, plans)
    count = 0
    for plan in range(weights.shape[0]):
        if plans[plan]:
            weights[count] = weights[plan]
            plans[count] = plan
            count += 1
    return count


@_inlined
def next_draw(minds: MindArrays, slot: int) -> float:
    """Return the number in [0, 1) of the mind's next decision, without counting it as drawn."""
    minds = borrowed(minds)
    counters = minds.counters
    count = int(minds.draws[slot])
    return uniforms(
        count & LOW_32,
        int(minds.mind_id[slot]) & LOW_32,
        count >> 32,
        MIND_STREAMS | int(counters[STREAM]),
        int(counters[SEED_LOW]),
        int(counters[SEED_HIGH]),
    )[0]


@_inner
def _choose(maker_code: int, bias: float, weights: Floats, count: int, u: float) -> int:
    """Return the position that a built-in maker picks among the first `count` weights.

    The same decision as the makers in decision.py, bit for bit, without allocating: the stochastic
    ones overwrite the weights with their shares.
    """
    best = 0
    least = weights[0]
    for i in range(1, count):
        if weights[i] > weights[best]:
            best = i
        least = min(least, weights[i])
    if maker_code == MAXIMUM_WEIGHT:
        return best

    if maker_code == POSITIVE_STOCHASTIC:
        scale = 1e-10 / count if weights[best] > 1e300 / count else 1.0
        total = 0.0
        for i in range(count):
            weights[i] = weights[i] * scale if weights[i] > 0.0 else 0.0
            total += weights[i]
        if total <= 0.0:
            return best
        cumulative = 0.0
        for i in range(count):
            cumulative += weights[i] / total
            if u < cumulative:
                return i
        return best

    scale = 1.0
    if weights[best] > 1e300 / count or least < -1e300 / count:
        scale = 1e-10 / count
        for i in range(count):
            weights[i] *= scale
    total = 0.0
    for i in range(count):
        if least < 1.0:
            weights[i] = (weights[i] - least * scale) + scale
        total += weights[i]
    best = 0
    for i in range(count):
        weights[i] /= total
        if weights[i] > weights[best]:
            best = i

    if maker_code == WEIGHTED_STOCHASTIC:
        cumulative = 0.0
        for i in range(count - 1):
            cumulative += weights[i]
            if u <= cumulative:
                return i
        return count - 1

    # By rank: the largest share first, the earlier first among equals (which unequal weights can
    # become). With a bias of 1 or more u**bias is at most u: within the first share, no power.
    cumulative = weights[best]
    if bias >= 1.0 and u <= cumulative:
        return best
    draw = math.pow(u, bias)
    for _ in range(count - 1):
        if draw <= cumulative:
            return best
        weights[best] = -1.0
        best = 0
        for i in range(1, count):
            if weights[i] > weights[best]:
                best = i
        cumulative += weights[best]
    return best


@_operation
def choose(maker_code: int, bias: float, weights: Floats, u: float) -> int:
    """Return the position that one of the built-in decision makers picks.

    Args:
        maker_code: `MAXIMUM_WEIGHT`, `WEIGHTED_STOCHASTIC` or `BIASED_WEIGHTED_STOCHASTIC`.
        bias: above 0; only the third uses it.
        weights: (n,) finite weights of the available plans in the scheme's order, n ≥ 1.
        u: the draw, in [0, 1); MaximumWeight does without it.
    """
    return _choose(maker_code, bias, weights.copy(), weights.shape[0], u)


@_inlined
def choose_next_plan(
    scheme: SchemeArrays, minds: MindArrays, slot: int, weights: Floats, plans: Ints
) -> int:
    """Take the mind's next decision; return the plan, or -1 when none is available.

    It counts as a draw in either case, whether or not the decision maker looks at the number.

    Args:
        scheme: the scheme's arrays.
        minds: the society's arrays.
        slot: the mind.
        weights: (P,) scratch space.
        plans: (P,) scratch space.
    """
    scheme, minds = borrowed(scheme), borrowed(minds)
    weights, plans = borrowed(weights), borrowed(plans)
    count = available_weights(scheme, minds, slot, weights, plans)
    return choose_among(scheme, minds, slot, weights, plans, count)


@_inlined
def choose_among(
    scheme: SchemeArrays, minds: MindArrays, slot: int, weights: Floats, plans: Ints, count: int
) -> int:
    """Take the mind's next decision among plans that are weighed already; -1 for none.

    Args:
        scheme: the scheme's arrays; its maker decides.
        minds: the society's arrays.
        slot: the mind.
        weights: the weights of the available plans, in the scheme's order; they are overwritten.
        plans: these plans.
        count: how many there are.
    """
    scheme, minds = borrowed(scheme), borrowed(minds)
    weights, plans = borrowed(weights), borrowed(plans)
    maker_code = int(scheme.maker[0])
    if maker_code == MODELLERS_OWN:
        raise ValueError("choose_next_plan: a modeller's own decision maker has no compiled form")
    plan = -1
    if count > 0:
        u = 0.0 if maker_code == MAXIMUM_WEIGHT else next_draw(minds, slot)
        plan = plans[_choose(maker_code, scheme.maker[1], weights, count, u)]
    minds.draws[slot] += 1
    return plan


@_operation
def feed_back_from_plan(
    scheme: SchemeArrays, minds: MindArrays, slot: int, plan: int, value: float
) -> None:
    """Add `value` times its reinforcement link to every active cogniton and group's culturon.

    In the groups that the mind stands in, the culturons of all roles change, not scaled by its
    participation.
    """
    scheme, minds = borrowed(scheme), borrowed(minds)
    reinforcement = scheme.reinforcement
    if plan < 0 or plan >= reinforcement.shape[1]:
        raise ValueError("feed_back_from_plan: there is no such plan")
    if not math.isfinite(value):
        raise ValueError("feed_back_from_plan: the value must be a finite number")
    n_cognitons = minds.values.shape[1]
    # Twice over: first to see that every result is a number, then to write.
    for writing in range(2):
        for cogniton in range(n_cognitons):
            old = minds.values[slot, cogniton]
            if not math.isnan(old):
                result = old + value * reinforcement[cogniton, plan]
                if writing:
                    minds.values[slot, cogniton] = result
                elif not math.isfinite(result):
                    raise ValueError("feed_back_from_plan: a result is beyond the largest number")
        for group in range(minds.group_slot.shape[1]):
            row = standing(scheme, minds, slot, group)[0]
            if row >= 0:
                for culturon in range(
                    scheme.group_culturons[group, 0], scheme.group_culturons[group, 1]
                ):
                    change = value * reinforcement[n_cognitons + culturon, plan]
                    result = minds.culturons[row, culturon] + change
                    if writing:
                        minds.culturons[row, culturon] = result
                    elif not math.isfinite(result):
                        raise ValueError(
                            "feed_back_from_plan: a result is beyond the largest number"
                        )
