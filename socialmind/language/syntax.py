"""Syntax trees, made and compiled by one thread at a time.

CPython counts how deep a tree is in one place for all threads, and stops with "AST constructor
recursion depth mismatch" when two of them are at it at once (gh-106905).
"""

from __future__ import annotations

import ast
from threading import RLock
from types import CodeType
from typing import Any

_ONE_AT_A_TIME = RLock()


def parsed(text: str | bytes, mode: str = "exec") -> Any:
    """Return the syntax tree of a text.

    Args:
        text: of Python.
        mode: `exec` for statements, `eval` for an expression.

    Raises:
        SyntaxError: the text is no Python, or is nested too deep for it.

    >>> parsed("1 + 2", "eval").body.left.value
    1
    """
    with _ONE_AT_A_TIME:
        try:
            return ast.parse(text, mode=mode)
        except (RecursionError, MemoryError):
            raise SyntaxError("brackets or blocks nested too deep") from None


def compiled(tree: ast.Module, file: str) -> CodeType:
    """Return the code of a module's tree.

    Args:
        tree: of the module.
        file: that error messages name.
    """
    with _ONE_AT_A_TIME:
        # A notebook's cell may wait at its top.
        flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
        code: CodeType = compile(tree, file, "exec", flags, dont_inherit=True)
        return code
