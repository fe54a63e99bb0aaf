"""What decides how a model runs: the Python files and the data that it was made from.

Found, not listed by anybody: the files of the model's folder; every module that these import and
that is no installed package's, wherever it lies; the other models that they load; and the files
that any of this code reads, as Python opens them. Schemes and minds do not count: a run keeps
copies of those it is given.
"""

from __future__ import annotations

import ast
import hashlib
import inspect
import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from importlib.util import resolve_name
from pathlib import Path
from types import FrameType, ModuleType
from typing import Any, Protocol

from socialmind.compiling.reached import is_of_a_package
from socialmind.errors import ModelError, SocialmindError
from socialmind.language.syntax import parsed
from socialmind.sources import folders
from socialmind.sources.cells import FILE, Cells, cells_of
from socialmind.sources.folders import MODEL_FILE, deciding_files, digest, models_in
from socialmind.sources.loading import PRIVATE, found_by
from socialmind.sources.typed_in import MAIN, is_typed_in

VERSION = 2
"""Of how sources are found and hashed; a record without one is of the model's folder alone."""
LARGEST_KEPT = 10 * 2**20
"""Bytes of the largest file that a run keeps a copy of; of larger ones it keeps the hash."""
KEPT = "source"
"""The folder within a run's that holds the copies."""
CELLS = f"model/{FILE}"
"""What was typed in stands for a file of the model's."""

_HOME = Path(__file__).resolve().parents[1]
_OURS = (f"{_HOME}{os.sep}", f"{_HOME.parent / 'coglogo_py'}{os.sep}")
_loaded: dict[str, tuple[ModuleType, str]] = {}
"""Each module of the user's, and the hash of its file when the module was first seen."""
_read_by: dict[str, dict[str, None]] = {}
"""What the code of each module read while it was loaded, or when a society asked it something."""
_defining: set[str] = set()
"""The modules in which a model was defined."""


class ModelClass(Protocol):
    """What is asked of a model's class."""

    __module__: str

    @property
    def shape(self) -> Any:
        """What its rules may read and write."""

    @property
    def variables(self) -> Mapping[str, Any]:
        """The fields of its own."""

    def typed(self, compiled: bool = True) -> Any:
        """Return its typed rules."""


@dataclass(frozen=True)
class Sources:
    """The files that decide how a model runs.

    Attributes:
        files: their paths, by what they are to the model: ``model/rules.py`` stands in its folder,
            ``modules/town/maps.py`` is imported as ``town.maps``, ``models/collect/model.py``
            is another model's, ``data/home/ann/map.csv`` lies elsewhere.
        packages: the versions of the installed packages that they import.
        loaded: the hashes of those that are modules, as they were loaded.
        texts: the hash of what no file holds, such as a notebook's cells.
        typed: that as a Python file, where it can be written as one.
    """

    files: dict[str, Path]
    packages: dict[str, str]
    loaded: dict[str, str]
    texts: dict[str, str]
    typed: str = ""

    def record(self) -> dict[str, Any]:
        """Return what a manifest says of them.

        Raises:
            SocialmindError: a file was edited since it was loaded.
        """
        hashes = self.hashes()
        for label, hashed in self.loaded.items():
            if hashes[label] != hashed:
                raise SocialmindError(
                    f"{self.files[label]}: was edited since it was loaded; load the model again, "
                    "or start Python again"
                )
        named = [*hashes.items(), *self.packages.items()]
        whole = "".join(f"{label}\0{one}\n" for label, one in named)
        return {
            "version": VERSION,
            "sha256": digest(whole.encode()),
            "files": hashes,
            "packages": self.packages,
        }

    def hashes(self) -> dict[str, str]:
        """Return the hash of each file as it is, and of what no file holds."""
        return {label: _hash_of(path) for label, path in sorted(self.files.items())} | self.texts

    def late(self, known: Mapping[str, str]) -> dict[str, str]:
        """Return the hashes of the data files that are not known yet."""
        new = [(label, path) for label, path in self.files.items() if label not in known]
        return {label: _hash_of(path) for label, path in new if path.suffix != ".py"}

    def copies(self) -> dict[str, bytes]:
        """Return the contents that a run keeps, by their places in its folder."""
        typed = {f"{KEPT}/{CELLS}": self.typed.encode()} if self.typed else {}
        return typed | {
            f"{KEPT}/{label}": path.read_bytes()
            for label, path in self.files.items()
            if _outside(label) is None and path.stat().st_size <= LARGEST_KEPT
        }


def sources_of(model_class: ModelClass) -> Sources:
    """Find what decides how a model runs."""
    bases = [base.__module__ for base in getattr(model_class, "__mro__", ())]
    apart = set(_minds_and_schemes(model_class))
    cells = _typed_in(model_class)
    if cells is not None:
        typed = cells.as_file()
        texts = {"cells": _cells_of(model_class)} if typed is None else {CELLS: _hash(typed)}
        here = ModuleType(MAIN)  # what else stands in a notebook does not count
        vars(here).update({one: sys.modules[one] for one in cells.modules})
        return replace(_found(None, bases, apart, texts, {MAIN: here}), typed=typed or "")
    file = _file_of(sys.modules.get(model_class.__module__))
    texts = {} if file is not None else {"cells": _cells_of(model_class)}
    first = sys.modules.get(model_class.__module__)
    return _found(file, bases, apart, texts, {} if first is None else found_by(first))


def sources_of_module(name: str) -> Sources:
    """Find what decides how the functions of a file run.

    Args:
        name: of the module that was loaded from it.
    """
    module = sys.modules[name]
    return _found(_file_of(module), [name], set(), {}, found_by(module))


def _found(
    file: Path | None,
    names: list[str],
    apart: set[Path],
    texts: dict[str, str],
    known: Mapping[str, ModuleType],
) -> Sources:
    """Find what some code reaches.

    Args:
        file: the one that it stands in, if any.
        names: of the modules that it begins with.
        apart: files and folders that do not count.
        texts: as of `Sources`.
        known: modules in place of those that Python's own table has by now, by name.
    """
    home = None if file is None else file.parent
    places: dict[Path, str] = {}
    if file is not None and home is not None:
        own = deciding_files(home) if file.name == MODEL_FILE else [file]
        places = {path: f"model/{path.relative_to(home).as_posix()}" for path in own}
    modules, packages = _reached_modules(names, known)
    for module in modules.values():
        path = _file_of(module)
        if path is not None:
            places.setdefault(path, _label(module, path))
    for path in list(places):
        places |= {one: label for one, label in _other_models(path, home) if one not in places}
    data = [one for path in list(places) for one in _named_in(path)]
    data += [Path(one) for name in modules for one in _read_by.get(name, ())]
    for path in data:
        if path.is_file() and path.suffix not in (".py", ".pyc") and not _lies_in(path, apart):
            places.setdefault(path.resolve(), _data_label(path, home))
    loaded = {}
    for name, module in modules.items():
        path = _file_of(module)
        if path is not None and name in _loaded and _loaded[name][0] is module:
            loaded[path] = _loaded[name][1]
    files: dict[str, Path] = {}
    for path, label in places.items():  # of two models of one name each counts
        files[label if label not in files else _elsewhere(path)] = path
    as_loaded = {label: loaded[path] for label, path in files.items() if path in loaded}
    return Sources(files, packages, as_loaded, texts)


def difference(record: Mapping[str, Any], sources: Sources) -> str | None:
    """Return what differs between a record and the files as they are, in words, or None.

    Args:
        record: what `Sources.record` gave then.
        sources: what is found now.
    """
    now = sources.hashes()
    for label, hashed in record["files"].items():
        place = sources.files.get(label) or _outside(label)
        if label in now:
            found = now[label]
        elif place is not None and place.is_file():
            found = _hash_of(place)  # read later, when the society is made
        else:
            return f"{place or label}: is not there any more"
        if found != hashed:
            return f"{place or label}: is not the file that the run was made with"
    for label, place in sources.files.items():
        if label not in record["files"] and place.suffix == ".py":
            return f"{place}: decides about the model now and did not when the run was made"
    for name, version in record["packages"].items():
        if sources.packages.get(name, version) != version:
            return f"{name} {sources.packages[name]} is here, {version} when the run was made"
    return None


def difference_of_copies(record: Mapping[str, Any], folder: Path) -> str | None:
    """Return what differs between a record and the copies that a run keeps, in words, or None.

    Args:
        record: what `Sources.record` gave.
        folder: the run's.
    """
    for label, hashed in record["files"].items():
        place = _outside(label) or folder / KEPT / label
        if not place.is_file():
            return f"{place}: is not there"
        if _hash_of(place) != hashed:
            return f"{place}: is not the file that the run was made with"
    return None


# What is loaded and what is read ------------------------------------------------------------------


def note_definition(module_name: str) -> None:
    """Note the contents of the user's modules as a model is defined, which has just loaded them.

    Args:
        module_name: the module in which the model's class stands.
    """
    _defining.add(module_name)
    for name, module in list(sys.modules.items()):
        known = name in _loaded and _loaded[name][0] is module and name != module_name
        if not known and _is_of_the_user(module):
            file = _file_of(module)
            if file is not None:
                _loaded[name] = module, _hash_of(file)


def note_module(name: str) -> None:
    """Note the contents of a module of functions, and of those it imports, when it is first met."""
    module = sys.modules.get(name)
    if module is not None and (name not in _loaded or _loaded[name][0] is not module):
        note_definition(name)


def _note_read(event: str, arguments: tuple[Any, ...]) -> None:
    """Note a file that a model's own code opens: while it is loaded, or when a society asks it."""
    if event != "open" or not isinstance(arguments[0], str | bytes | os.PathLike):
        return
    mode, flags = arguments[1], arguments[2]
    if set(mode) & set("wax+") if mode else (flags or 0) & (os.O_WRONLY | os.O_RDWR):
        return
    asked: list[str] = []
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        file = frame.f_code.co_filename
        if file.startswith(_OURS):
            break  # a society asks; what it reads for itself has nobody before it in the list
        name = frame.f_globals.get("__name__")
        if isinstance(name, str) and not is_of_a_package(file):
            asked.append(name)
            # What a script reads once its model is defined are results, unless a society asks.
            if frame.f_code.co_name == "<module>" and (name != "__main__" or name not in _defining):
                break
        frame = frame.f_back
    else:
        return
    try:
        path = os.path.abspath(os.fsdecode(arguments[0]))  # noqa: PTH100  # of each file opened
    except OSError:  # the working folder is gone; opening the file says so
        return
    for name in asked:
        _read_by.setdefault(name, {})[path] = None


sys.addaudithook(_note_read)

# Modules ------------------------------------------------------------------------------------------

_KNOWN = frozenset((*sys.stdlib_module_names, "socialmind", "coglogo_py", "numpy"))


def _reached_modules(
    names: list[str], known: Mapping[str, ModuleType]
) -> tuple[dict[str, ModuleType], dict[str, str]]:
    """Return the user's modules that some modules reach, and the versions of packages.

    Args:
        names: of the modules.
        known: what is called otherwise in Python's own table by now, by name.
    """
    modules: dict[str, ModuleType] = {}
    packages: dict[str, str] = {}
    waiting = list(names)
    while waiting:
        name = waiting.pop()
        module = known.get(name) or sys.modules.get(name)
        root = name.partition(".")[0]
        if module is None or name in modules or root in _KNOWN:
            continue
        if _is_of_the_user(module):
            modules[name] = module
            waiting += _imports_of(module)
        else:
            version = getattr(sys.modules.get(root), "__version__", None)
            packages |= {root: str(version)} if version is not None else {}
    return modules, dict(sorted(packages.items()))


def _is_of_the_user(module: Any) -> bool:
    """Return whether a module is neither Python's, nor an installed package's, nor ours."""
    name, file = getattr(module, "__name__", ""), getattr(module, "__file__", None)
    if name == "__main__" or str(name).startswith(PRIVATE):
        return True
    if not isinstance(file, str) or not file.endswith(".py") or file.startswith(_OURS):
        return False
    return not is_of_a_package(file)


def _file_of(module: Any) -> Path | None:
    file = getattr(module, "__file__", None)
    path = Path(file) if isinstance(file, str) else None
    return path.resolve() if path is not None and path.is_file() else None


def _label(module: ModuleType, path: Path) -> str:
    if module.__name__.startswith(PRIVATE):
        return f"models/{path.parent.name}/{path.name}"
    parts = module.__name__.split(".")
    if path.name == "__init__.py":
        parts.append("__init__")
    return f"modules/{'/'.join(parts)}.py"


def _data_label(path: Path, home: Path | None) -> str:
    path = path.resolve()
    if home is not None and path.is_relative_to(home):
        return f"model/{path.relative_to(home).as_posix()}"
    return _elsewhere(path)


def _elsewhere(path: Path) -> str:
    return "data/" + path.as_posix().lstrip("/")


def _outside(label: str) -> Path | None:
    """Return the path of a file that neither the model's folder nor a module holds."""
    kind, _, rest = label.partition("/")
    return Path(f"/{rest}") if kind == "data" else None


def _imports_of(module: ModuleType) -> Iterator[str]:
    """Yield the names of the modules that a module may have imported."""
    file = _file_of(module)
    if file is None:
        for value in list(vars(module).values()):
            named = "__name__" if isinstance(value, ModuleType) else "__module__"
            yield str(getattr(value, named, None) or "")
        return
    package = module.__package__ or ""
    for level, name, part in _imports_in(file, file.stat().st_mtime_ns):
        try:
            base = resolve_name("." * level + name, package) if level else name
        except ImportError:
            continue
        yield base
        if part:
            yield f"{base}.{part}"
        while "." in base:
            base = base.rpartition(".")[0]
            yield base


@lru_cache(maxsize=512)
def _imports_in(file: Path, changed: int) -> tuple[tuple[int, str, str], ...]:
    found: list[tuple[int, str, str]] = []
    for node in _nodes_of(file):
        if isinstance(node, ast.Import):
            found += [(0, one.name, "") for one in node.names]
        elif isinstance(node, ast.ImportFrom):
            found += [(node.level, node.module or "", one.name) for one in node.names]
    return tuple(found)


def _nodes_of(file: Path) -> Iterator[ast.AST]:
    try:
        return ast.walk(parsed(file.read_bytes()))
    except (OSError, SyntaxError, ValueError):
        return iter(())  # loading it says what is wrong


@lru_cache(maxsize=512)
def _texts_in(file: Path, changed: int) -> tuple[str, ...]:
    """Return the texts in a Python file that may name a file."""
    values = [one.value for one in _nodes_of(file) if isinstance(one, ast.Constant)]
    return tuple(
        dict.fromkeys(
            one for one in values if isinstance(one, str) and "." in one and len(one) < 200
            and one.isprintable() and not one.endswith((".py", "."))
        )
    )  # fmt: skip


def _named_in(file: Path) -> Iterator[Path]:
    """Yield the data files that a Python file names and that are there.

    What reads them may not be Python, so that nobody sees it open them.
    """
    for text in _texts_in(file, file.stat().st_mtime_ns):
        place = file.parent / text
        if place.is_file():
            yield place.resolve()


def _other_models(file: Path, home: Path | None) -> list[tuple[Path, str]]:
    """Return the files of the models that a Python file loads, by `model_folder("name")`."""
    found: dict[Path, str] = {}
    waiting = [file] if file.suffix == ".py" else []
    while waiting:
        names = models_in(waiting.pop().read_bytes())
        known = folders.catalogue() if names else {}
        for name in sorted(names):
            other = known.get(name.replace("-", "_"))
            for path in () if other is None or other == home else deciding_files(other):
                label = f"models/{path.relative_to(other).as_posix()}" if other else ""
                if path not in found:
                    found[path] = label.replace("models/", f"models/{name}/", 1)
                    waiting.append(path)
    return list(found.items())


def _minds_and_schemes(model_class: ModelClass) -> Iterator[Path]:
    """Yield where a model's schemes and minds lie, of which a run keeps copies of its own."""
    file = _file_of(sys.modules.get(model_class.__module__))
    for population in getattr(model_class, "populations", {}).values():
        for one in (population.mind, population.hierarchy):
            if isinstance(one, str | Path) and file is not None:
                yield (file.parent / one).resolve()


def _lies_in(path: Path, places: set[Path]) -> bool:
    resolved = path.resolve()
    return any(resolved == place or place in resolved.parents for place in places)


def _typed_in(model_class: Any) -> Cells | None:
    """Return what was typed in of a model; None where it was not, or its text is not kept."""
    if not is_typed_in(model_class):
        return None
    try:
        return cells_of(model_class)
    except ModelError:
        return None


def _cells_of(model_class: ModelClass) -> str:
    """Return a hash of a model that no file holds: of its rules with their constants, and so on."""
    digest = hashlib.sha256(repr(model_class.shape.parameters).encode())
    digest.update(repr(model_class.variables).encode())
    program = model_class.typed(compiled=False)
    for symbol, function in sorted(program.functions.items()):
        digest.update(f"{symbol}\n{ast.dump(function.tree)}\n".encode())
    for name, value in sorted(vars(model_class).items()):
        if inspect.isfunction(value):
            digest.update(
                f"{name}\n{value.__code__.co_code.hex()}{value.__code__.co_consts}".encode()
            )
    return digest.hexdigest()


def _hash(text: str) -> str:
    return digest(text.encode())


def _hash_of(path: Path) -> str:
    return digest(path.read_bytes())
