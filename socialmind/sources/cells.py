"""What was typed in, for other processes and for files: definitions with all that they need.

Nothing is pickled that has a text: a class or function goes as its lines, so that rules can be
read and errors name the notebook's cell there too.
"""

from __future__ import annotations

import ast
import linecache
import pickle
import symtable
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from types import FunctionType, ModuleType
from typing import Any

from coglogo_py import CogLogoError, CognitiveScheme
from coglogo_py.border import places
from socialmind.errors import ModelError
from socialmind.language.source import does, same
from socialmind.language.syntax import compiled, parsed
from socialmind.sources.typed_in import (
    MAIN,
    PLACE,
    TOOK,
    Definition,
    definition_of,
    is_typed_in,
    whole_text,
)

FILE = "cells.py"
"""The file in which a run keeps what was typed in of its model."""
_WITHIN = ("genexpr", "lambda", "listcomp", "setcomp", "dictcomp")
_LIBRARIES = ("coglogo_py", "socialmind", "numpy")


@dataclass(frozen=True)
class Cells:
    """What was typed in, as another process takes it.

    Attributes:
        definitions: classes and functions, each behind those that it stands on.
        imports: lines that import names.
        values: what else has a name.
        names: second names of definitions.
        texts: the whole cells, by what Python calls them.
        called: what the notebook calls these.
    """

    definitions: tuple[Definition, ...]
    imports: tuple[str, ...]
    values: dict[str, Any]
    names: tuple[tuple[str, str], ...]
    texts: dict[str, str] = field(repr=False)
    called: dict[str, str]

    @property
    def modules(self) -> list[str]:
        """The modules that the imports name."""
        return [line.split()[1] for line in self.imports]

    def as_file(self) -> str | None:
        """Return a Python file that defines the same; None where a value cannot be written."""
        imports, values = [*self.imports], []
        for name, value in self.values.items():
            written = _written(value)
            if written is None:
                return None
            imports += written[0]
            values.append(f"{name} = {written[1]}")
        names = [f"{name} = {known}" for name, known in self.names]
        top = [*sorted(set(imports), key=lambda one: (one.startswith("from"), one)), "", *values]
        parts = ["\n".join(top), *(one.text.strip("\n") for one in self.definitions), *names]
        return "\n\n\n".join(parts).strip("\n") + "\n"

    def module(self, name: str) -> ModuleType:
        """Return a module in which all of it is defined, as in the process it was typed into."""
        made = ModuleType(name)
        for file, text in self.texts.items():
            linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
        places.tell(self.called)
        sys.modules[name] = made  # classes look for their names there
        try:
            exec("\n".join(self.imports), vars(made))
            vars(made).update(self.values)
            for one in self.definitions:
                tree = parsed(one.text)
                ast.increment_lineno(tree, one.line - 1)
                exec(compiled(tree, one.file), vars(made))
            for other, known in self.names:
                setattr(made, other, getattr(made, known))
        except BaseException:
            del sys.modules[name]
            raise
        return made


def cells_of(something: Any) -> Cells:
    """Return a class or function that was typed in, with all that it stands on.

    Raises:
        ModelError: Python does not keep what was typed.
    """
    return _Gathering(something).gathered()


def taken_by(something: Any) -> dict[str, Any]:
    """Return what a class or function took when it was made, and keeps whatever the names become.

    That is the values of names in its own lines and in those of the classes and functions that
    these name; not what functions read when they are called.
    """
    namespace = vars(sys.modules[MAIN])
    found: dict[str, Any] = {}
    waiting = [something]
    while waiting:
        try:
            names, _ = needs(definition_of(waiting.pop()).text)
        except ModelError:
            continue
        for name in names:
            if name in namespace and name not in found:
                value = found[name] = namespace[name]
                if isinstance(value, type | FunctionType) and is_typed_in(value):
                    waiting.append(value)
    return found


def refuse_outdated(cls: Any) -> None:
    """Refuse a class that was typed in and took what has been written anew since.

    Raises:
        ModelError: says what, and which cell to run.
    """
    namespace = vars(sys.modules[MAIN])
    for name, value in getattr(cls, TOOK, {}).items():
        now = namespace.get(name, value)
        if name != cls.__name__ and not _is_same(now, value):
            plain = getattr(now, "__code__", None)
            file = plain.co_filename if plain else getattr(now, PLACE, None)
            raise ModelError(
                f"{name}, which was written anew since the class {cls.__name__} was made",
                f"the {name} that {cls.__name__} was made with",
                f"run the cell of class {cls.__name__} again, after those that it stands on",
                file,
                plain.co_firstlineno if plain else None,
            )


def _is_same(now: Any, value: Any) -> bool:
    """Return whether running a cell once more has changed nothing."""
    if now is value or same(now, value):
        return True
    if type(now) is not type(value):
        return False
    try:
        if isinstance(now, FunctionType):
            alike = does(now.__code__) == does(value.__code__)
            return alike and same(now.__defaults__, value.__defaults__)
        if isinstance(now, type):
            return definition_of(now).text == definition_of(value).text
        return pickle.dumps(now) == pickle.dumps(value)
    except Exception:  # what cannot be compared is another
        return False


class _Gathering:
    """What a definition needs, found from name to name.

    Args:
        something: a class or function that was typed in.
    """

    def __init__(self, something: Any) -> None:
        self._namespace = getattr(something, TOOK, {}) | vars(sys.modules[MAIN])
        self._seen: set[str] = {something.__name__}
        self._definitions: list[Definition] = []
        self._imports: list[str] = []
        self._values: dict[str, Any] = {}
        self._names: list[tuple[str, str]] = []
        self._define(something)

    def gathered(self) -> Cells:
        files = dict.fromkeys(one.file for one in self._definitions)
        called = {file: places.cell_of(file) for file in files}
        return Cells(
            tuple(self._definitions),
            tuple(dict.fromkeys(self._imports)),
            self._values,
            tuple(self._names),
            {file: whole_text(file) for file in files},
            {file: one for file, one in called.items() if one is not None},
        )

    def _define(self, something: Any) -> None:
        found = definition_of(something)
        at_once, later = needs(found.text)
        if found.name in at_once:
            raise ModelError(
                f"{found.name}, which is made of another {found.name}",
                "two names",
                "call one of them otherwise",
                found.file,
                found.line,
            )
        for name in at_once:
            self._take(name)
        self._definitions.append(found)
        for name in later:
            self._take(name)

    def _take(self, name: str) -> None:
        """Take a name that a definition reads, unless it is Python's own or nobody's yet."""
        if name in self._seen or name not in self._namespace:
            return
        self._seen.add(name)
        value = self._namespace[name]
        line = _import_of(name, value)
        plain = getattr(value, "py_func", value)
        if line is not None:
            self._imports.append(line)
        elif isinstance(plain, type | FunctionType) and is_typed_in(plain):
            if plain.__name__ == name:
                self._define(value)
            else:
                self._names.append((name, plain.__name__))
                if self._namespace.get(plain.__name__) is value:
                    self._take(plain.__name__)
                elif plain.__name__ not in self._seen:
                    self._seen.add(plain.__name__)
                    self._define(value)
        else:
            self._values[name] = value


@lru_cache(maxsize=256)
def needs(text: str) -> tuple[tuple[str, ...], tuple[str, ...]]:
    r"""Return the names of its module that a definition reads: when it is made, and when called.

    >>> needs("class A(B):\n    x = f(1)\n    def g(self, h):\n        return K + h + self.x")
    (('B', 'f'), ('K',))
    """
    at_once: dict[str, None] = {}
    later: dict[str, None] = {}

    def look(table: symtable.SymbolTable, called: bool) -> None:
        top = table.get_type() == "module"
        for one in table.get_symbols():
            if one.is_referenced() and (one.is_global() or (top and not one.is_assigned())):
                (later if called else at_once)[one.get_name()] = None
        for inner in table.get_children():
            look(inner, called or (_is_function(inner) and inner.get_name() not in _WITHIN))

    look(symtable.symtable(text, "<definition>", "exec"), False)
    return tuple(at_once), tuple(name for name in later if name not in at_once)


def _is_function(table: symtable.SymbolTable) -> bool:
    return str(getattr(table.get_type(), "value", table.get_type())) == "function"


def _import_of(name: str, value: Any) -> str | None:
    """Return the line that imports a value under a name, where it can be imported."""
    if isinstance(value, ModuleType):
        return f"import {value.__name__} as {name}" if value.__name__ != name else f"import {name}"
    module, qualified = getattr(value, "__module__", None), getattr(value, "__qualname__", None)
    if not isinstance(module, str) or not isinstance(qualified, str) or "." in qualified:
        return None
    if module == MAIN or getattr(sys.modules.get(module), qualified, None) is not value:
        return None
    if module.startswith("_socialmind_"):
        return None  # of a file that was loaded by its path, which packing knows
    package = module.partition(".")[0]
    if getattr(sys.modules.get(package), qualified, None) is value:
        module = package  # as users import it
    return f"from {module} import {qualified}" + (f" as {name}" if name != qualified else "")


def _written(value: Any) -> tuple[list[str], str] | None:
    """Return a value as Python text with the imports that this needs; None where it has none."""
    if isinstance(value, CognitiveScheme):
        return _written_scheme(value)
    text = repr(value)
    try:
        tree = parsed(text, "eval")
        used = {node.id for node in ast.walk(tree) if isinstance(node, ast.Name)}
        known = {name: home for name in used for home in _homes(name)}
        if used != set(known):
            return None
        again = eval(text, {name: getattr(home, name) for name, home in known.items()})
        same = type(again) is type(value) and repr(again) == text and bool(again == value)
    except Exception:  # of whatever the value's class thinks a text of it is
        return None
    lines = [f"from {home.__name__} import {name}" for name, home in sorted(known.items())]
    return (lines, text) if same else None


def _written_scheme(scheme: CognitiveScheme) -> tuple[list[str], str] | None:
    """Return a scheme likewise; None where a decision maker of the modeller's own decides."""
    from coglogo_py.files.yaml_file import written

    try:
        text = written(scheme)
        if CognitiveScheme.parsed(text, "scheme.yaml") != scheme:
            return None
    except CogLogoError:
        return None
    quoted = repr(text) if '"""' in text or "\\" in text else f'"""{text}"""'
    line = "from coglogo_py import CognitiveScheme"
    return [line], f'CognitiveScheme.parsed({quoted}, "scheme.yaml")'


def _homes(name: str) -> Iterator[ModuleType]:
    for one in _LIBRARIES:
        home = sys.modules.get(one)
        if home is not None and hasattr(home, name):
            yield home
            return
