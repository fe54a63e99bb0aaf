"""A rule's source: its syntax tree with the author's file and line numbers."""

from __future__ import annotations

import ast
import inspect
import linecache
import os
import re
import sys
import textwrap
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from types import CodeType, FunctionType
from typing import Any

from socialmind.errors import ModelError
from socialmind.language.syntax import compiled, parsed

COMMAND = "<string>"
"""The file that Python names for what it was given with `-c`."""
TIMED = "<timed exec>"
"""The file that IPython names for a cell under `%%time`, whose text it does not keep."""
_ABSENT = object()


class Names(Mapping[str, Any]):
    """The names that a function sees in its file, or a rule in another module; it notes the read.

    What a rule reads is written into its program. So a program stands for the values that were
    read, and no longer for the file once one of them is another (a notebook's next cell).

    Args:
        namespace: the names, as they are.
    """

    def __init__(self, namespace: Mapping[str, Any]) -> None:
        self._namespace = namespace
        self._read: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        value = self._read[name] = self._namespace.get(name, _ABSENT)
        if value is _ABSENT:
            raise KeyError(name)
        return value

    def __iter__(self) -> Iterator[str]:
        return iter(self._namespace)

    def __len__(self) -> int:
        return len(self._namespace)

    @property
    def outdated(self) -> bool:
        """Whether a name that was read means something else by now."""
        now = self._namespace.get
        for name, value in self._read.items():  # of each society that is made, so no generator
            other = now(name, _ABSENT)
            if other is not value and not same(value, other):
                return True
        return False


def same(one: Any, other: Any) -> bool:
    """Return whether two values mean the same to a rule."""
    # 1 == 1.0 == True, yet rules tell them apart.
    return one is other or (isinstance(one, _PLAIN) and repr(one) == repr(other))


_PLAIN = int | float | bool | str | tuple


@dataclass(frozen=True)
class RuleSource:
    """A plain Python function as its author wrote it.

    Attributes:
        function: the function itself.
        name: its name.
        file: the file it stands in.
        line: the line of its `def`.
        tree: its syntax tree, with line numbers of the file.
        names: the names of its file that it can see.
        state: its code and its parameters' defaults when it was read.
    """

    function: Callable[..., Any]
    name: str
    file: str
    line: int
    tree: ast.FunctionDef
    names: Names
    state: tuple[CodeType, tuple[Any, ...] | None]

    def error(self, found: str, expected: str | None, remedy: str) -> ModelError:
        """Return an error with the rule's place."""
        return ModelError(found, expected, remedy, self.file, self.line)

    @property
    def outdated(self) -> bool:
        """Whether the function, or something that it reads, is another by now."""
        code, defaults = self.state
        function = self.function
        same = function.__code__ is code and function.__defaults__ is defaults
        return not same or self.names.outdated

    @property
    def defaults(self) -> dict[str, Any]:
        """The values of its parameters that a call may leave out."""
        values = self.function.__defaults__ or ()
        return dict(zip(self.parameters[len(self.parameters) - len(values) :], values, strict=True))

    @property
    def public_names(self) -> list[str]:
        """The names of its file that an error may propose."""
        return [name for name in self.names if not name.startswith("_")]

    @property
    def parameters(self) -> list[str]:
        """The names of its parameters, in order."""
        return [argument.arg for argument in self.tree.args.args]


def hold_text(file: str) -> None:
    """Keep the text of a file that has just been loaded, whatever becomes of the file.

    Rules are read when they are first needed, which may be long after.

    Args:
        file: its path; what is no file, such as a notebook's cell, is known to Python already.
    """
    if not os.path.isfile(file):  # noqa: PTH113  # of each model that is defined
        return
    linecache.cache.pop(file, None)
    lines = linecache.getlines(file)
    # Without a time of change Python does not look whether the file has another one by now.
    linecache.cache[file] = (sum(map(len, lines)), None, lines, file)


def rule_source(function: Any) -> RuleSource:
    """Read the source of a rule.

    Raises:
        ModelError: what is given is no plain function, or its source cannot be read.
    """
    if hasattr(function, "__wrapped__"):
        found = f"the rule {inspect.unwrap(function).__name__!r} inside a decorator"
        raise _no_function(inspect.unwrap(function), found, "leave the decorator out")
    if not inspect.isfunction(function):
        inner = getattr(function, "__func__", getattr(function, "func", None))
        remedy = "write the rule with `def` at the top of the file"
        raise _no_function(inner, f"{function!r} as a rule", remedy)
    code = function.__code__
    place = file, _ = code.co_filename, code.co_firstlineno
    if function.__name__ == "<lambda>":
        raise ModelError("a lambda", "a rule with a name", "write it with `def`", *place)
    if function.__closure__:
        raise ModelError(
            f"the rule {function.__name__!r} inside another function",
            "a rule at the top of its file",
            "move it there, and pass what it needs as parameters",
            *place,
        )
    whole = text_of(function)
    line = None if whole is None else _line_of(code, whole)
    # What `exec` made under `python -c` goes by the same file as the command, and is not in it.
    if whole is None or (line is None and file == COMMAND):
        raise ModelError(
            f"the rule {function.__name__!r}, whose text Python did not keep",
            "a function of a file, of `python -c`, or of a cell of Jupyter, marimo or IPython",
            "write it in a cell of its own, without %%time"
            if file == TIMED
            else "save the model in a file and run that, or paste it into `ipython`",
            *place,
        )
    if line is None:
        raise _changed(function)
    lines = inspect.getblock(whole.splitlines(keepends=True)[line - 1 :])
    tree = parsed(textwrap.dedent("".join(lines))).body[0]
    ast.increment_lineno(tree, line - 1)
    if isinstance(tree, ast.AsyncFunctionDef):
        raise ModelError("an async rule", "a plain function", "write `def`", file, tree.lineno)
    if not isinstance(tree, ast.FunctionDef):
        raise ModelError(f"{function!r}", "a plain function", "write `def`", *place)
    names = Names(function.__globals__)
    state = (code, function.__defaults__)
    return RuleSource(function, function.__name__, file, tree.lineno, tree, names, state)


def _changed(function: FunctionType) -> ModelError:
    code = function.__code__
    return ModelError(
        f"another text where the rule {function.__name__!r} stood",
        "the file as it was loaded",
        "it has changed since: load the model again, or start Python again",
        code.co_filename,
        code.co_firstlineno,
    )


def _line_of(code: CodeType, text: str) -> int | None:
    """Return the line at which a function stands in a text; None where another stands there.

    The text may have changed since the function was loaded from it. One that was only moved, by
    an edit above it, is the same (IPython's `%autoreload` leaves it as it is).
    """
    found = [
        one.co_firstlineno
        for one in _functions(text, code.co_filename)
        if one.co_name == code.co_name and does(one) == does(code)
    ]
    return min(found, key=lambda line: abs(line - code.co_firstlineno), default=None)


@lru_cache(maxsize=16)
def _functions(text: str, file: str) -> tuple[CodeType, ...]:
    """Return the code of all functions of a file.

    The whole file is compiled: what a call compiles to depends on the file's imports as well.
    """
    try:
        tree = parsed(text)
        parts = [tree, *cells_in(tree)]
        if not os.path.isfile(file):  # noqa: PTH113
            # IPython compiles a cell statement by statement, past its imports.
            parts += [ast.Module([node], []) for node in tree.body]
        waiting = [compiled(one, file) for one in parts]
    except (SyntaxError, ValueError):
        return ()
    found = []
    while waiting:
        inner = [one for one in waiting.pop().co_consts if isinstance(one, CodeType)]
        found += inner
        waiting += inner
    return tuple(found)


def does(code: CodeType) -> tuple[Any, ...]:
    """Return what a code object does, wherever it stands."""
    constants = [
        does(one) if isinstance(one, CodeType) else (type(one), repr(one)) for one in code.co_consts
    ]
    return (
        code.co_name,
        code.co_code,
        constants,
        code.co_names,
        code.co_varnames,
    )


def _no_function(inner: Any, found: str, remedy: str) -> ModelError:
    """Return the error of what is no plain function, though one may be inside it."""
    code = getattr(inner, "__code__", None)
    file = None if code is None else code.co_filename
    return ModelError(
        found, "a plain function", remedy, file, None if code is None else code.co_firstlineno
    )


# Where the text is --------------------------------------------------------------------------------


def text_of(function: Callable[..., Any]) -> str | None:
    """Return the whole text around a function, as far as Python keeps it; None where it does not.

    Args:
        function: a plain function.
    """
    try:
        return "".join(inspect.findsource(function)[0])
    except (OSError, TypeError, IndexError, SyntaxError):
        return command() if function.__code__.co_filename == COMMAND else None


def command() -> str | None:
    """Return what this Python was given with `-c`, if it was."""
    for option, text in pairwise(sys.orig_argv[1:]):
        if re.fullmatch("-[A-Za-z]*c", option):
            return textwrap.dedent(text) if sys.version_info >= (3, 14) else text
        if not option.startswith("-"):
            return None  # a script, whose arguments follow
    return None


def cells_in(tree: ast.Module) -> Iterator[ast.Module]:
    """Yield the cells of a marimo notebook that is kept as a Python file, each a function there."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) and _is_cell(node):
            yield ast.Module([one for one in node.body if not isinstance(one, ast.Return)], [])


def _is_cell(node: ast.FunctionDef | ast.AsyncFunctionDef) -> bool:
    makers = [one.func if isinstance(one, ast.Call) else one for one in node.decorator_list]
    return any(isinstance(one, ast.Attribute) and one.attr == "cell" for one in makers)
