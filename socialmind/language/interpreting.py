"""Typed trees run as ordinary Python."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from types import CodeType, FunctionType
from typing import Any

from socialmind.language import arithmetic
from socialmind.language.source import RuleSource
from socialmind.language.syntax import compiled


def code_of(tree: ast.FunctionDef, source: RuleSource) -> CodeType:
    """Return a function as Python's code, under its author's name for tracebacks and debuggers."""
    module = compiled(ast.Module([tree], []), source.file)
    (code,) = (one for one in module.co_consts if isinstance(one, CodeType))
    return code.replace(co_name=source.name, co_qualname=source.name)


def functions_of(
    codes: Mapping[str, CodeType], namespace: Mapping[str, Any]
) -> dict[str, Callable[..., Any]]:
    """Return functions that call each other by name.

    Args:
        codes: of each, by its name.
        namespace: what else they call by name.
    """
    names: dict[str, Any] = {**RUNTIME, **namespace}
    made: dict[str, Callable[..., Any]] = {
        symbol: FunctionType(code, names) for symbol, code in codes.items()
    }
    names |= made
    return made


def present(value: Any) -> Any:
    """Return an optional field's value; raise when it is None."""
    if value is None:
        raise ValueError("a field that is None was used as a number; ask `is None` before")
    return value


def agent_there(agent: Any) -> Any:
    """Return an agent that may be None; raise when it is."""
    if agent is None:
        raise ValueError("an agent that is None was used; ask `is not None` before")
    return agent


RUNTIME: dict[str, Any] = {
    **{
        f"_{name}": function
        for name, function in vars(arithmetic).items()
        if isinstance(function, FunctionType) and not name.startswith("_")
    },
    "_present": present,
    "_agent_there": agent_there,
    "_perhaps": lambda agent: agent,
    "_as_int": int,
    "_as_float": float,
    "_abs": abs,
    "_len": len,
    "_range": range,
    "_print": print,
    "_breakpoint": breakpoint,
}
"""What the trees of both speeds call by name."""
