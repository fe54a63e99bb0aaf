"""A small language for measures of a run: `mean(farmers[-100:])`, `gini(agents.wheat)`.

- a name is a column of the series, an array with a value for each recorded tick; `tick` is one;
- `x[-100:]`, `x[::2]`, `x[0]`: some of its values, as in Python;
- `agents.FIELD`, `agents("POPULATION").FIELD`: a value for each agent at the end;
- `series("odd name")`: a column whose name is no word;
- `mean median min max sum std count first last abs sqrt log exp gini`, and `quantile(x, 0.9)`;
- arithmetic, comparisons, `and`, `or`, `not`, `a if condition else b`.

An expression is parsed, and walked against a list of what it may hold; nothing of it is run as
Python.
"""

from __future__ import annotations

import ast
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import nearest, shown
from socialmind.errors import SocialmindError
from socialmind.experiments.measures.inequality import gini

LONGEST = 1000
"""Characters of an expression."""
DEEPEST = 100
"""Operators and calls in each other."""


class Source(Protocol):
    """Where an expression takes its arrays from."""

    def column(self, name: str) -> NDArray[Any]:
        """Return a column of the series; raises KeyError with the names that there are."""

    def agents(self, population: str | None, field: str) -> NDArray[Any]:
        """Return a field of the agents at the end; raises KeyError likewise."""


def _deviation(values: Any) -> Any:
    """Return the standard deviation of a sample, over n − 1; NaN of one value."""
    array = np.asarray(values, np.float64)
    return np.std(array, ddof=1) if array.size > 1 else np.nan


def _of_some(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that is NaN of nothing: a society may have died out."""

    def of_some(values: Any, *others: Any) -> Any:
        return function(values, *others) if np.size(values) else np.nan

    return of_some


def _least_of(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the least or greatest of an array, or of several numbers."""

    def least(*values: Any) -> Any:
        return function(values[0]) if len(values) == 1 else function(np.array(values))

    return _of_some(least)


FUNCTIONS: dict[str, tuple[Callable[..., Any], tuple[int, int]]] = {
    "mean": (_of_some(np.mean), (1, 1)),
    "median": (_of_some(np.median), (1, 1)),
    "min": (_least_of(np.min), (1, 9)),
    "max": (_least_of(np.max), (1, 9)),
    "sum": (np.sum, (1, 1)),
    "std": (_deviation, (1, 1)),
    "count": (np.count_nonzero, (1, 1)),
    "quantile": (_of_some(np.quantile), (2, 2)),
    "first": (_of_some(lambda values: np.atleast_1d(values)[0]), (1, 1)),
    "last": (_of_some(lambda values: np.atleast_1d(values)[-1]), (1, 1)),
    "abs": (np.abs, (1, 1)),
    "sqrt": (np.sqrt, (1, 1)),
    "log": (np.log, (1, 1)),
    "exp": (np.exp, (1, 1)),
    "gini": (gini, (1, 1)),
}
"""Functions by name, and how many arguments they take: from, to."""

_OPERATORS: dict[type, Callable[..., Any]] = {
    ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply, ast.Div: np.true_divide,
    ast.FloorDiv: np.floor_divide, ast.Mod: np.mod, ast.Pow: np.float_power,
    ast.USub: np.negative, ast.UAdd: np.positive, ast.Not: np.logical_not,
    ast.And: np.logical_and, ast.Or: np.logical_or,
    ast.Lt: np.less, ast.LtE: np.less_equal, ast.Gt: np.greater, ast.GtE: np.greater_equal,
    ast.Eq: np.equal, ast.NotEq: np.not_equal,
}  # fmt: skip


@dataclass(frozen=True)
class Expression:
    """A measure as an expression, checked.

    Args:
        name: of the measure.
        text: the expression.

    Raises:
        SocialmindError: it is none; says at which column.

    >>> Expression("settled", "mean(farmers[-2:]) / count(farmers >= 0)").columns
    ('farmers',)
    """

    name: str
    text: str

    def __post_init__(self) -> None:
        self._check(self._tree())

    @property
    def columns(self) -> tuple[str, ...]:
        """The columns of the series that it names."""
        tree = self._tree()
        called = {id(one.func) for one in ast.walk(tree) if isinstance(one, ast.Call)}
        called |= {id(one.value) for one in ast.walk(tree) if isinstance(one, ast.Attribute)}
        found = [_column_of(node) for node in ast.walk(tree) if id(node) not in called]
        return tuple(dict.fromkeys(one for one in found if one is not None))

    def check_names(self, source: Source) -> None:
        """Refuse columns and fields that there are not.

        Raises:
            SocialmindError: says which, and what there is.
        """
        tree = self._tree()
        called = {id(one.func) for one in ast.walk(tree) if isinstance(one, ast.Call)}
        called |= {id(one.value) for one in ast.walk(tree) if isinstance(one, ast.Attribute)}
        for node in ast.walk(tree):
            named = isinstance(node, ast.Attribute) or _column_of(node) is not None
            if named and id(node) not in called and isinstance(node, ast.expr):
                self._value(node, source)

    def value(self, source: Source) -> float | int | bool:
        """Return the measure of a run.

        Raises:
            SocialmindError: a column that there is not, or no single number comes of it.
        """
        with np.errstate(all="ignore"), warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # the mean of nothing is NaN
            found = self._value(self._tree(), source)
        if np.ndim(found) != 0:
            raise SocialmindError(
                f"measure {self.name}: {self.text} gives {np.size(found)} values; expected one: "
                f"write last({self.text}), mean({self.text}), …"
            )
        number = found.item() if isinstance(found, np.generic | np.ndarray) else found
        if isinstance(number, bool | int | float):
            return number
        raise SocialmindError(f"measure {self.name}: found {shown(number)}; expected a number")

    def _tree(self) -> ast.expr:
        if len(self.text) > LONGEST:
            raise SocialmindError(
                f"measure {self.name}: {len(self.text)} characters; expected {LONGEST} at most; "
                "write a function in a file: NAME=FILE.py:FUNCTION"
            )
        try:
            tree = _parsed(self.text.strip())
        except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
            place = getattr(error, "offset", None) or 1
            raise self._error(
                f"not an expression ({getattr(error, 'msg', error)})", place
            ) from None
        if _depth(tree) > DEEPEST:
            raise SocialmindError(
                f"measure {self.name}: {self.text!r}: operators or calls in more than {DEEPEST} "
                "others; write a function in a file: NAME=FILE.py:FUNCTION"
            )
        return tree

    def _error(self, what: str, node: ast.AST | int, remedy: str | None = None) -> SocialmindError:
        at = node if isinstance(node, int) else getattr(node, "col_offset", 0) + 1
        more = f"; {remedy}" if remedy else ""
        return SocialmindError(f"measure {self.name}: {self.text!r}, column {at}: {what}{more}")

    def _check(self, node: ast.expr) -> None:
        """Refuse what the language does not have."""
        match node:
            case ast.Constant(value=bool() | int() | float()):
                return
            case ast.Name() | ast.Attribute(value=ast.Name(id="agents")):
                return
            case ast.Attribute(
                value=ast.Call(
                    func=ast.Name(id="agents"), args=[ast.Constant(value=str())], keywords=[]
                )
            ):
                return
            case ast.Call(
                func=ast.Name(id="series"), args=[ast.Constant(value=str())], keywords=[]
            ):
                return
            case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in FUNCTIONS:
                low, high = FUNCTIONS[name][1]
                if not low <= len(arguments) <= high:
                    wanted = f"{low}" if low == high else f"{low} to {high}"
                    raise self._error(f"{name} of {len(arguments)}; expected {wanted}", node)
                for one in arguments:
                    self._check(one)
            case ast.Call(func=ast.Name(id=name)) if name in FUNCTIONS:
                raise self._error("an argument by its name", node, "write the values alone")
            case ast.Call(func=ast.Name(id=name)):
                hint = nearest(name, FUNCTIONS) or f"there is {', '.join(FUNCTIONS)}"
                raise self._error(f"no function {name}()", node, hint)
            case ast.BinOp(left=a, op=operator, right=b) if type(operator) in _OPERATORS:
                self._check(a)
                self._check(b)
            case ast.UnaryOp(op=operator, operand=a) if type(operator) in _OPERATORS:
                self._check(a)
            case ast.BoolOp(values=several):
                for one in several:
                    self._check(one)
            case ast.Compare(left=a, ops=operators, comparators=others) if all(
                type(one) in _OPERATORS for one in operators
            ):
                for one in (a, *others):
                    self._check(one)
            case ast.IfExp(test=a, body=b, orelse=c):
                for one in (a, b, c):
                    self._check(one)
            case ast.Subscript(value=a, slice=place):
                self._check(a)
                parts = (
                    [place.lower, place.upper, place.step]
                    if isinstance(place, ast.Slice)
                    else [place]
                )
                for part in parts:
                    if part is not None and _whole(part) is None:
                        raise self._error("a place that is no whole number", part)
                if isinstance(place, ast.Slice) and place.step and _whole(place.step) == 0:
                    raise self._error("a step of 0", place.step)
            case ast.Attribute(attr=name):
                raise self._error(
                    f"an attribute .{name}", node, "only agents have fields: agents.wheat"
                )
            case _:
                raise self._error(
                    f"{_said(node)}, which measures do not have",
                    node,
                    "write a function in a file: NAME=FILE.py:FUNCTION",
                )

    def _value(self, node: ast.expr, source: Source) -> Any:
        match node:
            case ast.Constant(value=value):
                return value
            case (
                ast.Name(id=name)
                | ast.Call(func=ast.Name(id="series"), args=[ast.Constant(value=str(name))])
            ):
                return self._taken(node, lambda: source.column(name), name, "series")
            case ast.Attribute(value=ast.Name(), attr=field):
                return self._taken(node, lambda: source.agents(None, field), field, "agents")
            case ast.Attribute(value=ast.Call(args=[ast.Constant(value=str(owner))]), attr=field):
                return self._taken(node, lambda: source.agents(owner, field), field, "agents")
            case ast.Call(func=ast.Name(id=name), args=arguments):
                values = [self._value(one, source) for one in arguments]
                return self._applied(node, FUNCTIONS[name][0], *values)
            case ast.BinOp(left=a, op=operator, right=b):
                pair = self._value(a, source), self._value(b, source)
                return self._applied(node, _OPERATORS[type(operator)], *pair)
            case ast.UnaryOp(op=operator, operand=a):
                return self._applied(node, _OPERATORS[type(operator)], self._value(a, source))
            case ast.BoolOp(op=operator, values=several):
                found = self._value(several[0], source)
                for one in several[1:]:
                    other = self._value(one, source)
                    found = self._applied(node, _OPERATORS[type(operator)], found, other)
                return found
            case ast.Compare(left=a, ops=operators, comparators=others):
                left, found = self._value(a, source), None
                for how, one in zip(operators, others, strict=True):
                    right = self._value(one, source)
                    holds = self._applied(node, _OPERATORS[type(how)], left, right)
                    found = holds if found is None else np.logical_and(found, holds)
                    left = right
                return found
            case ast.IfExp(test=a, body=b, orelse=c):
                chosen = self._value(a, source)
                if np.ndim(chosen) != 0:
                    raise self._error("a condition of many values", a, "take any one: last(…)")
                return self._value(b if chosen else c, source)
            case ast.Subscript(value=a, slice=place):
                array = np.atleast_1d(self._value(a, source))
                return self._applied(node, lambda: array[_place(place)])
        raise self._error("nothing that can be worked out", node)

    def _taken(
        self, node: ast.expr, take: Callable[[], NDArray[Any]], name: str, what: str
    ) -> NDArray[Any]:
        try:
            return take()
        except KeyError as error:
            known = list(error.args[0])
            hint = nearest(name, known) or f"there is {', '.join(known) or 'none'}"
            raise self._error(f"no column {name!r} of the {what}", node, hint) from None
        except TypeError as error:
            raise self._error(str(error), node) from None

    def _applied(self, node: ast.expr, function: Callable[..., Any], *values: Any) -> Any:
        try:
            return function(*values)
        except (TypeError, ValueError, IndexError, ArithmeticError) as error:
            raise self._error(f"{error}", node) from None


@lru_cache(256)
def _parsed(text: str) -> ast.expr:
    return ast.parse(text, mode="eval").body


def _depth(tree: ast.AST) -> int:
    """Return how many nodes of a tree are in each other at most."""
    depth, level = 0, [tree]
    while level:
        depth += 1
        level = [below for one in level for below in ast.iter_child_nodes(one)]
    return depth


def _column_of(node: ast.AST) -> str | None:
    """Return the column of the series that a node alone stands for, if any."""
    match node:
        case ast.Call(func=ast.Name(id="series"), args=[ast.Constant(value=str(name))]):
            return name
        case ast.Name(id=name):
            return name
    return None


def _whole(node: ast.expr) -> int | None:
    """Return the whole number that a node is, or None."""
    match node:
        case ast.Constant(value=int(value)) if not isinstance(value, bool):
            return value
        case ast.UnaryOp(op=ast.USub(), operand=ast.Constant(value=int(value))):
            return -value
    return None


def _place(place: ast.expr) -> Any:
    if isinstance(place, ast.Slice):
        ends = (place.lower, place.upper, place.step)
        return slice(*(None if one is None else _whole(one) for one in ends))
    return _whole(place)


def _said(node: ast.expr) -> str:
    names = {
        ast.Lambda: "a lambda", ast.Dict: "a dictionary", ast.List: "a list",
        ast.ListComp: "a loop", ast.GeneratorExp: "a loop", ast.Call: "such a call",
        ast.Constant: "a text", ast.JoinedStr: "a text", ast.Tuple: "a tuple",
        ast.NamedExpr: "an assignment", ast.Starred: "a star",
    }  # fmt: skip
    return names.get(type(node), type(node).__name__)
