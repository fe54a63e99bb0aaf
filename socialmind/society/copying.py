"""Copies of a society, in this process or as bytes for another: made anew and given the state."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any

from socialmind.society.declaration import kept_names
from socialmind.society.founding.making import begin_networks
from socialmind.work.packing import packed, unpacked


def _settings_of(society: Any) -> dict[str, Any]:
    """Return what a society is made with."""
    settings = {
        "seed": society.seed,
        "compiled": society.compiled,
        "scheme": society.schemes or None,
        "hierarchy": False if not society.minded else society._steerings or None,
        "physics": society.physics,
        "without": society.without,
    }
    return settings | society.parameter_values() | society._tables_given


def parts_of(society: Any) -> tuple[type, dict[str, Any], dict[str, Any]]:
    """Return what a society is made of anew: its class, its settings and its state."""
    return type(society), _settings_of(society), society.state()


def fresh(society: Any) -> Any:
    """Return the same society before its first tick, from what it was given."""
    settings = _settings_of(society)
    settings["scheme"], settings["hierarchy"] = society._given
    return type(society)(**settings)


def unbegun(society: Any, model: Any) -> dict[str, Any]:
    """Return the state of a society before its setup: that of another one, made like it.

    Args:
        society: just made.
        model: `Model`, which makes it.
    """
    kind: Any = type(society)
    made = kind.__new__(kind)
    made._sets_up = False
    model.__init__(made, **_settings_of(society))
    begin_networks(made)
    state: dict[str, Any] = made.state()
    return state


def own_of(society: Any, model: type) -> dict[str, Any]:
    """Return the attributes that a modeller's methods gave a society.

    Args:
        society: the society.
        model: `Model`, whose names are not among them.
    """
    kept = kept_names(model)
    return {name: one for name, one in vars(society).items() if name not in kept}


def remade(
    model: Any,
    kind: Any,
    settings: Mapping[str, Any],
    state: Mapping[str, Any],
    own: Mapping[str, Any] | None = None,
) -> Any:
    """Return a society in a state, with attributes that a modeller's methods gave it.

    Args:
        model: `Model`, which makes it: what the modeller's `__init__` did is in the state.
        kind: its class.
        settings: what it is made with.
        state: its arrays.
        own: attributes of the modeller's.
    """
    made = unfinished(model, kind, settings)
    made.restore(state)
    vars(made).update(own or {})
    made._made = True
    return made


def unfinished(model: Any, kind: Any, settings: Mapping[str, Any]) -> Any:
    """Return a society whose setup has not run, which is to take a state.

    Args:
        model: `Model`, which makes it.
        kind: its class.
        settings: what it is made with.
    """
    made = kind.__new__(kind)
    made._sets_up = False
    model.__init__(made, **settings)
    del made._sets_up
    return made


def copied(society: Any, model: type, memo: dict[int, Any] | None = None) -> Any:
    """Return a copy of a society; a deep one, of the modeller's attributes too, with a memo."""
    if memo is None:
        return remade(model, *parts_of(society), own_of(society, model))
    made = remade(model, *parts_of(society))
    memo[id(society)] = made
    vars(made).update(copy.deepcopy(own_of(society, model), memo))
    return made


def reduced(society: Any, model: type) -> tuple[Any, ...]:
    """Return a society as pickle takes it."""
    return _unpacked, (packed((model, *parts_of(society))),), own_of(society, model) or None


def _unpacked(content: bytes) -> Any:
    return remade(*unpacked(content))
