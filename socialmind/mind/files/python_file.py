"""Functions in Python files of a mind's folder: found by name, and written out of a program.

EvoAgents names Java classes, `class:MoveForward`; here that is the function `MoveForward` or
`move_forward` of a Python file, or its only public function.
"""

from __future__ import annotations

import ast
import builtins
import dis
import inspect
import math
import re
import textwrap
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

from socialmind.errors import ModelError, written_at
from socialmind.language.syntax import parsed
from socialmind.mind.files.evoagents.text_file import inside, is_file, text_of
from socialmind.sources.folders import MODEL_FILE
from socialmind.sources.loading import PRIVATE, load_file, tree_of

Function = Callable[..., Any]


def snake_case(name: str) -> str:
    """Return a class's name as Python writes a function's.

    >>> snake_case("MoveForward"), snake_case("DMGoTo"), snake_case("wire")
    ('move_forward', 'dm_go_to', 'wire')
    """
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def load_function(
    path: Path, name: str, named_in: str, line: int | None, only: bool = False
) -> Function:
    """Return a function of a Python file.

    Args:
        path: the Python file.
        name: the function's name, or that of a class in EvoAgents.
        named_in: the file that names it, for messages.
        line: its line there.
        only: whether the file's only public function will do, whatever it is called.

    Raises:
        ModelError: the file cannot be loaded, or has no such function.
    """
    own = _outlines(path) if _unrun.get() else _functions(path)
    for wanted in (name, snake_case(name)):
        if wanted in own:
            return own[wanted]
    public = [key for key in own if not key.startswith("_")]
    if only and len(public) == 1:
        return own[public[0]]
    there = f"there is {', '.join(public)}" if public else "write one there"
    names = " or ".join(dict.fromkeys((f"{name}()", f"{snake_case(name)}()")))
    raise ModelError(
        f"{name!r}, which {path} does not define",
        f"a function {names} there",
        there,
        named_in,
        line,
    )


def _functions(path: Path) -> dict[str, FunctionType]:
    module = load_file(path)
    return {
        key: value
        for key, value in vars(module).items()
        if isinstance(value, FunctionType) and value.__module__ == module.__name__
    }


_unrun: ContextVar[bool] = ContextVar("unrun", default=False)


@contextmanager
def programs_unrun() -> Iterator[None]:
    """Read minds without running their programs, whose functions then do nothing."""
    token = _unrun.set(True)
    try:
        yield
    finally:
        _unrun.reset(token)


def runs_programs() -> bool:
    """Whether the programs of a mind that is read are run."""
    return not _unrun.get()


def _outlines(path: Path) -> dict[str, FunctionType]:
    """Return the functions that a file defines, by their heads alone; nothing of it is run."""
    heads: dict[str, FunctionType] = {}
    for node in tree_of(text_of(path), path).body:
        if isinstance(node, ast.FunctionDef):
            given = node.args
            for one in (*given.posonlyargs, *given.args, *given.kwonlyargs):
                one.annotation = None
            given.vararg = given.vararg and ast.arg(given.vararg.arg)
            given.kwarg = given.kwarg and ast.arg(given.kwarg.arg)
            given.defaults = [ast.Constant(0.0) for _ in given.defaults]
            given.kw_defaults = [one and ast.Constant(0.0) for one in given.kw_defaults]
            # At its own line, for messages.
            head = "\n" * (node.lineno - 1) + f"def {node.name}({ast.unparse(given)}): pass"
            made: dict[str, Any] = {
                "__name__": PRIVATE
            }  # of a file of a mind, as those that are run
            exec(compile(head, str(path), "exec"), made)
            heads[node.name] = made[node.name]
        elif isinstance(node, ast.Assign) and isinstance(node.value, ast.Name):
            # Another name for a function, as the writer of minds gives one.
            heads |= {
                one.id: heads[node.value.id]
                for one in node.targets
                if isinstance(one, ast.Name) and node.value.id in heads
            }
    return heads


def load_beside(
    path: Path, file: str, name: str, named_in: str, line: int | None, only: bool = False
) -> Function:
    """Return a function of a Python file that stands in the folder of the file that names it.

    Args:
        path: the Python file that is meant where none is named.
        file: the one that is named, or nothing.
        name: the function's name.
        named_in: the file that names it.
        line: its line there.
        only: whether the file's only public function will do, whatever it is called.

    Raises:
        ModelError: no such file or function.
    """
    folder = Path(named_in).parent if file else path.parent
    path = inside(folder, file or path.name, "the file", named_in, line)
    if not name.isidentifier() or not (path.suffix == ".py" and is_file(path)):
        wrong = not name.isidentifier()
        raise ModelError(
            f"the function {name!r} of {path}",
            "a name of a function" if wrong else "a Python file that there is",
            "write file.py:function" if wrong else f"write def {name} in {path.name}",
            named_in,
            line,
        )
    return load_function(path, name, named_in, line, only)


def function_text(function: Function, called: str = "") -> str:
    """Return a Python file that defines a function.

    A file of a mind's folder is taken as it is. Out of any other, only the function is taken, with
    the modules, numbers and functions that it names.

    Args:
        function: the function.
        called: the name under which it is to be found; nothing for its own.

    Raises:
        ModelError: the function's source cannot be had, or it names anything else.
    """
    if not isinstance(function, FunctionType) or function.__name__ == "<lambda>":
        raise ModelError(
            f"{getattr(function, '__name__', repr(function))!r} as a function to be saved",
            "a plain function",
            "write it with def",
        )
    file = source_file(function)
    if file is not None and _is_of_a_mind(function, file):
        text = text_of(file)
        _refuse_siblings(text, file)
        return text
    extract = _Extract()
    extract.add(function)
    text = extract.text()
    if called not in ("", function.__name__) and snake_case(called) != function.__name__:
        text += f"\n\n{called} = {function.__name__}\n"
    return text


def source_file(function: Function) -> Path | None:
    """Return the file that defines a function; None where there is none, as at a prompt."""
    file, _ = written_at(function)
    return Path(file) if file is not None and Path(file).is_file() else None


def _is_of_a_mind(function: FunctionType, file: Path) -> bool:
    """Whether the file was loaded from a mind's folder, and not from that of a model."""
    return function.__module__.startswith(PRIVATE) and not (file.parent / MODEL_FILE).is_file()


def _refuse_siblings(text: str, file: Path) -> None:
    """Refuse a file that cannot stand in another folder alone."""
    for node in ast.walk(parsed(text)):
        if isinstance(node, ast.ImportFrom) and node.level:
            raise ModelError(
                "an import from the file's own folder",
                "a file that can be copied alone",
                "write the functions that it needs into the file",
                file,
                node.lineno,
            )


class _Extract:
    """A function with all that it names, gathered for a file of its own."""

    def __init__(self) -> None:
        self.modules: dict[str, str] = {}
        self.numbers: dict[str, str] = {}
        self.functions: dict[str, FunctionType] = {}
        self.sources: dict[str, str] = {}

    def add(self, function: FunctionType) -> None:
        """Take in a function, after those that it needs."""
        if self.functions.setdefault(function.__name__, function) is not function:
            raise _refused(function, "the second of this name")
        tree, source = _source(function)
        values = {**function.__globals__, **inspect.getclosurevars(function).nonlocals}
        for name in _names(function.__code__, tree):
            value = values.get(name)
            if isinstance(value, ModuleType):
                self._note(function, self.modules, name, f"import {value.__name__} as {name}")
            elif isinstance(value, int | float):
                self._note(function, self.numbers, name, f"{name} = {_written_number(value)}")
            elif isinstance(value, FunctionType) and value.__name__ == name:
                if self.functions.get(name) is not value:
                    self.add(value)
            elif name in values or not hasattr(builtins, name):
                raise _refused(function, f"which names {name!r}")
        self.sources[function.__name__] = source

    @staticmethod
    def _note(function: FunctionType, noted: dict[str, str], name: str, text: str) -> None:
        if noted.setdefault(name, text) != text:
            raise _refused(function, f"which names {name!r}, something else in another function")

    def text(self) -> str:
        """Return the file."""
        head = ["\n".join(lines.values()) for lines in (self.modules, self.numbers) if lines]
        annotated = any(one.__annotations__ for one in self.functions.values())
        future = ["from __future__ import annotations"] if annotated else []
        return (
            "\n\n".join([*future, *head])
            + "\n\n\n" * bool(head or future)
            + "\n\n\n".join(source.strip() for source in self.sources.values())
            + "\n"
        )


def _source(function: FunctionType) -> tuple[ast.FunctionDef, str]:
    try:
        text = textwrap.dedent(inspect.getsource(function))
        statement = parsed(text).body[0]
    except (OSError, TypeError, SyntaxError):
        raise _refused(function, "whose source cannot be had") from None
    if not isinstance(statement, ast.FunctionDef) or statement.decorator_list:
        raise _refused(function, "which is decorated")
    return statement, text


def _names(code: CodeType, tree: ast.FunctionDef) -> list[str]:
    """Return the names that a function takes from outside of it, in alphabetical order."""
    found = set(code.co_freevars)
    waiting = [code]
    while waiting:
        one = waiting.pop()
        found.update(
            instruction.argval
            for instruction in dis.get_instructions(one)
            if instruction.opname in ("LOAD_GLOBAL", "LOAD_NAME")
        )
        waiting += [inner for inner in one.co_consts if isinstance(inner, CodeType)]
    defaults = [*tree.args.defaults, *(one for one in tree.args.kw_defaults if one is not None)]
    for default in defaults:
        found.update(node.id for node in ast.walk(default) if isinstance(node, ast.Name))
    return sorted(found)


def _written_number(value: float) -> str:
    if isinstance(value, int):
        return repr(value)
    return repr(float(value)) if math.isfinite(value) else f'float("{float(value)}")'


def _refused(function: FunctionType, what: str) -> ModelError:
    return ModelError(
        f"the function {function.__name__!r}, {what}",
        "a plain function of numbers, modules and further functions",
        "write it into a file of its own in the mind's folder",
        *written_at(function),
    )
