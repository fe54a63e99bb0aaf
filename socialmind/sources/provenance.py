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
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any, Protocol

from socialmind.errors import ModelError, SocialmindError
from socialmind.sources import folders
from socialmind.sources.cells import FILE, Cells, cells_of
from socialmind.sources.folders import MODEL_FILE, deciding_files, digest, models_in
from socialmind.sources.loading import PRIVATE, found_by
from socialmind.sources.modules import (
    file_of,
    hash_as_loaded,
    hash_of,
    nodes_of,
    reached_modules,
    read_by,
)
from socialmind.sources.typed_in import MAIN, is_typed_in

VERSION = 2
"""Of how sources are found and hashed; a record without one is of the model's folder alone."""
LARGEST_KEPT = 10 * 2**20
"""Bytes of the largest file that a run keeps a copy of; of larger ones it keeps the hash."""
KEPT = "source"
"""The folder within a run's that holds the copies."""
CELLS = f"model/{FILE}"
"""What was typed in stands for a file of the model's."""


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
        return {label: hash_of(path) for label, path in sorted(self.files.items())} | self.texts

    def late(self, known: Mapping[str, str]) -> dict[str, str]:
        """Return the hashes of the data files that are not known yet."""
        new = [(label, path) for label, path in self.files.items() if label not in known]
        return {label: hash_of(path) for label, path in new if path.suffix != ".py"}

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
    file = file_of(sys.modules.get(model_class.__module__))
    texts = {} if file is not None else {"cells": _cells_of(model_class)}
    first = sys.modules.get(model_class.__module__)
    return _found(file, bases, apart, texts, {} if first is None else found_by(first))


def sources_of_module(name: str) -> Sources:
    """Find what decides how the functions of a file run.

    Args:
        name: of the module that was loaded from it.
    """
    module = sys.modules[name]
    return _found(file_of(module), [name], set(), {}, found_by(module))


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
    modules, packages = reached_modules(names, known)
    for module in modules.values():
        path = file_of(module)
        if path is not None:
            places.setdefault(path, _label(module, path))
    for path in list(places):
        places |= {one: label for one, label in _other_models(path, home) if one not in places}
    data = [one for path in list(places) for one in _named_in(path)]
    data += [one for name in modules for one in read_by(name)]
    for path in data:
        if path.is_file() and path.suffix not in (".py", ".pyc") and not _lies_in(path, apart):
            places.setdefault(path.resolve(), _data_label(path, home))
    loaded = {}
    for name, module in modules.items():
        path, hashed = file_of(module), hash_as_loaded(name, module)
        if path is not None and hashed is not None:
            loaded[path] = hashed
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
            found = hash_of(place)  # read later, when the society is made
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
        if hash_of(place) != hashed:
            return f"{place}: is not the file that the run was made with"
    return None


# Files ------------------------------------------------------------------------------------------


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


@lru_cache(maxsize=512)
def _texts_in(file: Path, changed: int) -> tuple[str, ...]:
    """Return the texts in a Python file that may name a file."""
    values = [one.value for one in nodes_of(file) if isinstance(one, ast.Constant)]
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
    file = file_of(sys.modules.get(model_class.__module__))
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
