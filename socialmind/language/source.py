"""A rule's source: its syntax tree with the author's file and line numbers."""

from __future__ import annotations

import ast
import inspect
import textwrap
import types as python_types
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from socialmind.errors import ModelError
from socialmind.language.syntax import compiled, parsed


@dataclass(frozen=True)
class RuleSource:
    """A plain Python function as its author wrote it.

    Attributes:
        function: the function itself.
        name: its name.
        file: the file it stands in.
        line: the line of its `def`.
        tree: its syntax tree, with line numbers of the file.
        names: the module names it can see.
    """

    function: Callable[..., Any]
    name: str
    file: str
    line: int
    tree: ast.FunctionDef
    names: Mapping[str, Any]

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
    file, line = code.co_filename, code.co_firstlineno
    if function.__name__ == "<lambda>":
        raise ModelError("a lambda", "a rule with a name", "write it with `def`", file, line)
    if function.__closure__:
        raise ModelError(
            f"the rule {function.__name__!r} inside another function",
            "a rule at the top of its file",
            "move it there, and pass what it needs as parameters",
            file,
            line,
        )
    try:
        lines, start = inspect.getsourcelines(function)
        tree = parsed(textwrap.dedent("".join(lines))).body[0]
    except (OSError, TypeError, SyntaxError):
        raise ModelError(
            f"the rule {function.__name__!r} without a source",
            "a function written in a file or a notebook cell",
            "save the model in a file, and load it again after changes",
            file,
            line,
        ) from None
    ast.increment_lineno(tree, start - 1)
    if isinstance(tree, ast.AsyncFunctionDef):
        raise ModelError("an async rule", "a plain function", "write `def`", file, tree.lineno)
    if not isinstance(tree, ast.FunctionDef):
        raise ModelError(f"{function!r}", "a plain function", "write `def`", file, line)
    if not _is_source_of(tree, function):
        raise ModelError(
            f"another text where the rule {function.__name__!r} stood",
            "the file as it was loaded",
            "it has changed since: load the model again, or start Python again",
            file,
            line,
        )
    return RuleSource(function, function.__name__, file, tree.lineno, tree, function.__globals__)


def _is_source_of(tree: ast.FunctionDef, function: python_types.FunctionType) -> bool:
    """Say whether a syntax tree can be a function's; its file may have changed since."""
    module = compiled(ast.Module([tree], []), function.__code__.co_filename)
    codes = [one for one in module.co_consts if isinstance(one, python_types.CodeType)]
    found = [one for one in codes if one.co_name == function.__code__.co_name]
    return any(
        (one.co_varnames, one.co_names)
        == (function.__code__.co_varnames, function.__code__.co_names)
        for one in found
    )


def _no_function(inner: Any, found: str, remedy: str) -> ModelError:
    """Return the error of what is no plain function, though one may be inside it."""
    code = getattr(inner, "__code__", None)
    file = None if code is None else code.co_filename
    return ModelError(
        found, "a plain function", remedy, file, None if code is None else code.co_firstlineno
    )
