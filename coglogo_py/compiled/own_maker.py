"""A modeller's own decision maker, where what it returns comes in: checked at both speeds alike.

What `choose` and `probabilities` return is looked at before anything is done with it. Compiled,
`choose` and the functions that it calls keep to the bounds of their arrays, as in Python, and get
weights of their own: whatever they write, the mind stays as it was.
"""

from __future__ import annotations

import linecache
import math
import re
from collections.abc import Callable
from types import CellType, FunctionType
from typing import TYPE_CHECKING, Any

import numba
import numpy as np
from numba import types
from numba.core.dispatcher import Dispatcher
from numba.extending import overload, register_jitable

from coglogo_py.border.errors import ChoiceError, SchemeError, shortened, shown
from coglogo_py.border.numbers import is_whole

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coglogo_py.decision import DecisionMaker

SUM_OF_PROBABILITIES = 1e-6
"""How far a maker's probabilities may be from the sum 1."""
_SIGNATURE = (types.float64[::1], types.float64, types.float64)
_FOREIGN = ("numba", "numpy")


def checked_choice(maker: DecisionMaker, found: object, count: int) -> int:
    """Return a position that a maker's `choose` returned.

    Args:
        maker: the maker.
        found: what it returned.
        count: how many plans were available.

    Raises:
        ChoiceError: it is no whole number, or none of the positions.
    """
    if is_whole(found) and 0 <= int(found) < count:  # type: ignore[call-overload]  # an Integral
        return int(found)  # type: ignore[call-overload]
    raise ChoiceError(
        f"{maker.name}.choose() returned {shown(found)}; expected a position, a whole number "
        f"in 0 … {count - 1} for {count} available plans",
        ":".join(map(str, _place(maker.choose))),
    )


def checked_probabilities(maker: DecisionMaker, found: Any, count: int) -> NDArray[np.float64]:
    """Return the probabilities that a maker gave.

    Raises:
        ChoiceError: they are not one number of 0 … 1 for each available plan, with sum 1.
    """
    try:
        chances = np.asarray(found, np.float64)
        ok = (
            chances.shape == (count,)
            and bool(np.all((chances >= -SUM_OF_PROBABILITIES) & (chances <= 1 + 1e-6)))
            and math.isclose(float(chances.sum()), 1.0, abs_tol=SUM_OF_PROBABILITIES)
        )
    except (TypeError, ValueError, OverflowError):
        ok = False
    if not ok:
        raise ChoiceError(
            f"{maker.name}.probabilities() returned {shown(found)}; expected {count} numbers of "
            "0 … 1 with sum 1, one for each available plan",
            ":".join(map(str, _place(maker.probabilities))),
        )
    return chances


def position_of(found: Any, count: int) -> int:
    """Return a position that a compiled `choose` returned; it raises for any other."""
    if not 0 <= found < count:
        raise ValueError("a decision maker chose none of the available plans")
    return int(found)


@overload(position_of)
def _position_of(found: Any, count: Any) -> Any:
    if isinstance(found, types.Integer):

        def within(found: Any, count: Any) -> Any:
            place = np.int64(found)
            if place < 0 or place >= count:
                raise ValueError("a decision maker chose none of the available plans")
            return place

        return within
    return None  # numba refuses the call; `refusal_of` says it in a modeller's words


@register_jitable
def _int(value: Any) -> Any:
    """Return `int(value)`; compiled, too, what no whole number can hold is an error.

    numba leaves open what comes of it, and the compiler takes that for leave to drop a check.
    """
    if not -9223372036854775808.0 <= value < 9223372036854775808.0:
        raise OverflowError("no whole number of 64 bits")
    return int(value)


def compiled_maker(choose: Callable[..., Any]) -> Any:
    """Return a maker's `choose` for compiled code, with all the functions that it calls."""
    return _compiled(choose, {})


def _compiled(function: Any, made: dict[Any, Any]) -> Any:
    """Return a function compiled with checks of bounds; helpers that it calls likewise."""
    options: dict[str, Any] = {}
    if isinstance(function, Dispatcher):
        options, function = dict(function.targetoptions), function.py_func
        options.pop("nopython", None)
    if function in made:
        return made[function]
    names = {"int": _int, **function.__globals__}
    cells = tuple(CellType() for _ in function.__closure__ or ())
    own = FunctionType(
        function.__code__, names, function.__name__, function.__defaults__, cells or None
    )
    own.__kwdefaults__ = function.__kwdefaults__
    made[function] = numba.njit(**{**options, "boundscheck": True})(own)
    for name in function.__code__.co_names:
        if names.get(name) is not _int and _is_helper(names.get(name)):
            names[name] = _compiled(names[name], made)
    for cell, old in zip(cells, function.__closure__ or (), strict=True):
        held = old.cell_contents
        cell.cell_contents = _compiled(held, made) if _is_helper(held) else held
    return made[function]


def _is_helper(value: object) -> bool:
    """Return whether a name stands for a function that somebody wrote for `choose` to call."""
    if isinstance(value, Dispatcher):
        value = value.py_func
    if not isinstance(value, FunctionType):
        return False
    return value.__module__ is None or value.__module__.split(".")[0] not in _FOREIGN


def refusal_of(maker: type[DecisionMaker]) -> tuple[SchemeError, bool] | None:
    """Return why a maker cannot be part of compiled code; None when it can.

    Args:
        maker: its class.

    Returns:
        The error, and whether it is only what `choose` returns, which Python could run.
    """
    file, line = _place(maker.choose)
    name = f"{maker.name}.choose()"
    try:
        dispatcher = compiled_maker(maker.choose)
        dispatcher.compile(_SIGNATURE)
    except Exception as error:  # numba raises errors of many kinds
        return SchemeError(
            f"{name}, which cannot be compiled: {_said(str(error))}",
            "numbers, arrays of numbers, loops, `math` and NumPy",
            "leave out texts, dictionaries, sets and objects, or run interpreted",
            file,
            _line_of(str(error), file) or line,
        ), False
    (result,) = (one.return_type for one in dispatcher.nopython_signatures)
    if isinstance(result, types.Integer):
        return None
    optional = isinstance(result, types.Optional)
    return SchemeError(
        f"{name}, which {'does not always return a number' if optional else f'returns {result}'}",
        "a position, a whole number, whichever way it ends",
        "write `return int(…)`",
        file,
        line,
    ), True


def _said(message: str) -> str:
    """Return what numba says is wrong, without where it was looking."""
    said: list[str] = []
    for line in re.sub(r"\x1b\[[0-9;]*m", "", message).splitlines():
        begins = line.strip()
        if said and begins.startswith(("File ", "During:", "<source")):
            break
        if begins and not begins.startswith("Failed in"):
            said.append(begins)
    return shortened(" ".join(said), 200)


def _line_of(message: str, file: str) -> int | None:
    """Return the line of a file that numba's error names last."""
    plain = re.sub(r"\x1b\[[0-9;]*m", "", message)
    name = re.escape(file.rsplit("/", 1)[-1])
    found = re.findall(rf"{name}[\"']?(?:, line |:|\s\()(\d+)", plain)
    return int(found[-1]) if found else None


def _place(function: Any) -> tuple[str, int]:
    """Return the file of a function and the line of its `def`."""
    code = getattr(function, "__code__", None) or function.py_func.__code__
    line = code.co_firstlineno
    for ahead in range(line, line + 20):  # decorators come before
        if linecache.getline(code.co_filename, ahead).strip().startswith("def "):
            return code.co_filename, ahead
    return code.co_filename, line
