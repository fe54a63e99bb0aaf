"""Whether arrays are a state of a model, before it takes them: compiled code trusts its indices."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from coglogo_py.arrays import ASKED, STATE
from coglogo_py.state_check import odd_stack
from socialmind.agents.bookkeeping import ALIVE, COUNT, ENTRIES, FREE, NEXT_ID, SIZE
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from socialmind.agents.running import Running
    from socialmind.society.table import Table

Arrays = Mapping[str, NDArray[Any]]


def check_state(model: Running, state: Arrays) -> None:
    """Raise unless arrays are a state of a model.

    Args:
        model: the one that is to take them.
        state: what is offered.

    Raises:
        SocialmindError: an array is missing, of another type or shape, or holds an index of nobody.
    """
    record = _check(state, "context", None, (1,), model)
    mine, theirs = model.contexts.dtype, record.dtype.names or ()
    kept = model.record.kept
    # A record may hold addresses and sizes beside, as it did in older checkpoints.
    more = [one for one in theirs if one not in kept and one[0] != "_"]
    if more or any(one not in theirs or record.dtype[one] != mine[one] for one in kept):
        raise _refused(model, "context", "other fields than the model has")
    context = record[0]
    if context["_tick"] < 0 or context["_idle"] < 0:
        raise _refused(model, "context", "a tick before the first")
    of_world = {name[6:]: array for name, array in state.items() if name.startswith("world.")}
    odd_world = model.ground.check_state(of_world, context)
    if odd_world is not None:
        raise _refused(model, *odd_world.split(" holds ", 1))
    for name, table in model.tables.items():
        _check_table(model, name, table, state)


def _check_table(model: Running, name: str, table: Table, state: Arrays) -> None:
    """Look at one population's arrays."""
    rows = _check(state, f"{name}.rows", table.dtype, (None,), model)
    capacity = len(rows)
    whole, truth = np.dtype(np.int64), np.dtype(np.bool_)
    order = _check(state, f"{name}.order", whole, (capacity,), model)
    free = _check(state, f"{name}.free", whole, (capacity,), model)
    alive = _check(state, f"{name}.alive", truth, (capacity,), model)
    slot_of = _check(state, f"{name}.slot_of", whole, (None,), model)
    counters = _check(state, f"{name}.counters", whole, (SIZE,), model)
    acting, entries, living, identities, vacant = counters[
        [COUNT, ENTRIES, ALIVE, NEXT_ID, FREE]
    ].tolist()
    odd = not 0 <= acting <= entries <= capacity or vacant != capacity - entries
    odd = odd or not 0 <= identities <= len(slot_of) or capacity < 1
    odd = odd or odd_stack(np.concatenate([order[:entries], free[:vacant]]), capacity)
    if odd or alive.sum() != living:
        raise _refused(model, f"{name}.order", "slots that are not those of its agents")
    slots = order[:entries][alive[order[:entries]]]
    ids = rows["_id"][slots]
    if len(slots) != living or not np.array_equal(rows["_slot"][slots], slots):
        raise _refused(model, f"{name}.rows", "agents in slots that are not theirs")
    known = np.full(len(slot_of), -1, np.int64)
    if not len(ids) or (ids.min() >= 0 and ids.max() < identities):
        known[ids] = slots
    if not np.array_equal(known, slot_of):
        raise _refused(model, f"{name}.slot_of", "identities that are not those of its agents")
    fault = table.odd_rows(rows[slots], state)
    if fault is not None:
        raise _refused(model, f"{name}.rows", fault)
    for field in table.shape.fields.values():
        if field.choices and len(slots):
            chosen = rows[field.name][slots]
            if not 0 <= chosen.min() <= chosen.max() < len(field.choices):
                raise _refused(model, f"{name}.rows", f"no {field.name} of the model's")
    if table.society is not None:
        for part in STATE:
            if part not in (*ASKED, "within") or f"{name}.minds.{part}" in state:
                _check(state, f"{name}.minds.{part}", None, None, model)
        minds, plans = rows["_mind"][slots], rows["_plan"][slots]
        taken = state[f"{name}.minds.mind_id"]
        if len(minds) and not (
            minds.min() >= 0 and minds.max() < len(taken) and (taken[minds] >= 0).all()
        ):
            raise _refused(model, f"{name}.rows", "minds that are nobody's")
        if len(plans) and not -1 <= plans.min() <= plans.max() < len(table.society.scheme.plans):
            raise _refused(model, f"{name}.rows", "plans that its scheme lacks")
    if table.shape.steps is not None and len(slots):
        steps = rows["_step"][slots]
        if not -1 <= steps.min() <= steps.max() < len(table.shape.steps.steps):
            raise _refused(model, f"{name}.rows", "steps that its plans lack")
    if table.minds is not None:
        from socialmind.mind.kernel.layout import NOT_KEPT, State

        for part in State._fields:
            if part not in (*NOT_KEPT, "common"):
                _check(state, f"{name}.hierarchy.{part}", None, None, model)
        if len(state[f"{name}.hierarchy.fresh"]) != capacity:
            raise _refused(model, f"{name}.hierarchy.fresh", "hierarchies of another number")


def _check(
    state: Arrays,
    name: str,
    dtype: np.dtype[Any] | None,
    shape: tuple[int | None, ...] | None,
    model: Running,
) -> NDArray[Any]:
    """Return an array of a state, when it has a type and a shape (None: any length)."""
    if name not in state:
        raise _refused(model, name, "nothing")
    found = np.asarray(state[name])
    if dtype is not None and found.dtype != dtype:
        raise _refused(model, name, "other fields than the model has")
    if shape is not None and (
        found.ndim != len(shape)
        or any(want not in (None, have) for want, have in zip(shape, found.shape, strict=True))
    ):
        raise _refused(model, name, f"the shape {found.shape}")
    return found


def _refused(model: Running, name: str, found: str) -> SocialmindError:
    return SocialmindError(f"the checkpoint is not one of {model.name}: {name} holds {found}")
