"""The text in which a function was written: of a file, a cell of a notebook, or `python -c`."""

from __future__ import annotations

import ast
import inspect
import re
import sys
import textwrap
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

COMMAND = "<string>"
"""The file that Python names for what it was given with `-c`."""


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
