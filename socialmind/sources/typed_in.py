"""What was typed in: classes and functions of a notebook's cells, of `python -c`, of a prompt.

They stand in the module ``__main__`` and in no file that another process could load.
"""

from __future__ import annotations

import ast
import inspect
import linecache
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import FunctionType
from typing import Any

from socialmind.errors import ModelError
from socialmind.language.source import COMMAND, command, text_of
from socialmind.language.syntax import parsed

MAIN = "__main__"
CELLS = "__cells__"
"""The name that a module has which was made of what was typed in, elsewhere."""
PLACE = "_typed_at"
"""The attribute of a class that says in which cell it was made."""
TOOK = "_took"
"""The attribute of a class that holds what it took by name when it was made."""


@dataclass(frozen=True)
class Definition:
    """A class or function as it was typed in.

    Attributes:
        name: its name.
        file: what Python calls the cell.
        line: its first line there, decorators included.
        text: its lines, with nothing before the first.
    """

    name: str
    file: str
    line: int
    text: str


def is_typed_in(something: Any) -> bool:
    """Return whether a class or function was typed in, and stands at the top there."""
    if getattr(something, "__module__", None) != MAIN:
        return False
    name = getattr(something, "__qualname__", "")
    return "." not in name and name not in _names_at_top(_main_file())


def note_place(cls: type) -> None:
    """Note the cell that a class is being made in; of a class of fields alone nothing tells."""
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__name__") != MAIN:
        frame = frame.f_back
    setattr(cls, PLACE, frame.f_code.co_filename)


def _main_file() -> str | None:
    """Return the file that Python runs, which other processes load too."""
    found = getattr(sys.modules.get(MAIN), "__file__", None)
    return found if isinstance(found, str) and Path(found).is_file() else None


@lru_cache(maxsize=8)
def _names_at_top(file: str | None) -> frozenset[str]:
    """Return the classes and functions that a file defines, but for those within others."""
    try:
        waiting: list[ast.AST] = [] if file is None else [parsed(Path(file).read_bytes())]
    except (OSError, SyntaxError, ValueError):
        return frozenset()
    found = set()
    while waiting:
        for node in ast.iter_child_nodes(waiting.pop()):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
                found.add(node.name)
            elif isinstance(node, ast.stmt | ast.excepthandler):
                waiting.append(node)
    return frozenset(found)


def definition_of(something: Any) -> Definition:
    """Return a class or function as it was typed in.

    Raises:
        ModelError: Python does not keep what was typed.
    """
    if something.__name__ == "<lambda>":
        place = something.__code__.co_filename, something.__code__.co_firstlineno
        raise ModelError("a lambda", "a function with a name", "write it with `def`", *place)
    for file, text in _places_of(something):
        nodes: Iterator[Any] = ast.walk(_tree(text))
        for node in nodes:
            if _defines(node, something):
                first = min([node.lineno, *(one.lineno for one in node.decorator_list)])
                lines = text.splitlines(keepends=True)[first - 1 : node.end_lineno]
                indent = len(lines[0]) - len(lines[0].lstrip())
                whole = "".join(one[indent:] if one[:indent].isspace() else one for one in lines)
                return Definition(something.__name__, file, first, whole)
    raise ModelError(
        f"{something.__name__}, whose text Python did not keep",
        "what was written in a file, or in a cell of Jupyter, marimo or IPython",
        "save the model in a file and run that",
    )


def whole_text(file: str) -> str:
    """Return all of a cell."""
    return "".join(linecache.getlines(file)) or (command() or "" if file == COMMAND else "")


def _places_of(something: Any) -> Iterator[tuple[str, str]]:
    """Yield the texts that may define something, by what Python calls them; the latest first."""
    plain = getattr(something, "py_func", something)  # what numba compiled
    if isinstance(plain, FunctionType):
        text = text_of(plain)
        if text is not None:
            yield plain.__code__.co_filename, text
        return
    known = vars(something).get(PLACE)
    if known is not None:
        yield known, whole_text(known)
        return
    for one in vars(something).values():
        function = getattr(one, "__func__", getattr(one, "fget", one))
        if isinstance(function, FunctionType) and function.__module__ == MAIN:
            text = text_of(function)
            if text is not None:
                yield function.__code__.co_filename, text
    said = command()
    if said is not None:
        yield COMMAND, said
    for file in reversed(list(linecache.cache)):
        if file not in sys.modules and (not Path(file).is_file() or file == _main_file()):
            yield file, whole_text(file)


@lru_cache(maxsize=64)
def _tree(text: str) -> ast.Module:
    try:
        found: ast.Module = parsed(text)
    except (SyntaxError, ValueError):
        return ast.Module([], [])
    return found


def _defines(node: Any, something: Any) -> bool:
    """Return whether a node of a text is the definition of something."""
    plain = getattr(something, "py_func", something)
    if isinstance(plain, FunctionType):
        if not isinstance(node, ast.FunctionDef) or node.name != plain.__name__:
            return False
        return plain.__code__.co_firstlineno in (
            node.lineno,
            *(one.lineno for one in node.decorator_list),
        )
    if not isinstance(node, ast.ClassDef) or node.name != something.__name__:
        return False
    return _has_the_fields(node, something)


def _has_the_fields(node: ast.ClassDef, cls: type) -> bool:
    """Return whether a class has the fields and the plain values that a text gives one.

    Of several cells that define a class of one name this tells which it is.
    """
    annotated, values = [], {}
    for one in node.body:
        if isinstance(one, ast.AnnAssign) and isinstance(one.target, ast.Name):
            annotated.append(one.target.id)
            values[one.target.id] = one.value
        elif isinstance(one, ast.Assign) and isinstance(one.targets[0], ast.Name):
            values[one.targets[0].id] = one.value
        elif isinstance(one, ast.FunctionDef) and one.name not in vars(cls):
            return False
    if annotated != list(inspect.get_annotations(cls)):
        return False
    return all(_may_be(value, cls, name) for name, value in values.items() if value is not None)


def _may_be(value: ast.expr, cls: type, name: str) -> bool:
    try:
        found = vars(cls).get(name)
        written = ast.literal_eval(value)
    except (ValueError, TypeError):
        return True  # a call, or a name
    return type(found) is not type(written) or bool(found == written)
