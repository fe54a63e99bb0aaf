"""The state of a model as arrays: what a checkpoint holds, and a run goes on from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from numpy.typing import NDArray

from socialmind.society.connection import words_of
from socialmind.society.messages import fill_mailboxes
from socialmind.society.state_check import check_state

if TYPE_CHECKING:
    from socialmind.agents.running import Running


def state_of(model: Running) -> dict[str, NDArray[Any]]:
    """Return copies of all arrays of a model that change in a run, by name.

    Args:
        model: at any tick.
    """
    bits = words_of(model) & model.record.kept_bits
    state: dict[str, NDArray[Any]] = {"context": bits.view(model.contexts.dtype)}
    for part, array in model.ground.state().items():
        state[f"world.{part}"] = array
    for name, table in model.tables.items():
        for part, array in table.snapshot().items():
            state[f"{name}.{part}"] = array
        if table.society is not None:
            for part, array in table.society.state().items():
                state[f"{name}.minds.{part}"] = array
        if table.minds is not None:
            for part, array in table.minds.snapshot().items():
                state[f"{name}.hierarchy.{part}"] = array
    return state


def restore(model: Running, state: Mapping[str, NDArray[Any]]) -> None:
    """Put a model into a state.

    Args:
        model: of the class and the parameters of the one whose state it is.
        state: as `state_of` returns it.

    Raises:
        SocialmindError: the state is that of another model.
    """
    check_state(model, state)
    for name in model.record.kept:
        model.contexts[name] = state["context"][name]
    model.connected = []
    model.ground.restore(_part(state, "world"))
    for name, table in model.tables.items():
        own = _part(state, name)
        table.restore({key: array for key, array in own.items() if "." not in key})
        if table.society is not None:
            table.society.restore(_part(own, "minds"))
        if table.minds is not None:
            table.minds.restore(_part(own, "hierarchy"))
    fill_mailboxes(model.tables)
    model.ground.build()


def _part(state: Mapping[str, NDArray[Any]], name: str) -> dict[str, NDArray[Any]]:
    begin = f"{name}."
    return {key.removeprefix(begin): value for key, value in state.items() if key.startswith(begin)}
