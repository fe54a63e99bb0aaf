"""The folders of models: where they are, and which of their files decide how a model runs.

A model is a folder with a ``model.py``. The models that ship are documents: loaded by path under a
private name, never imported as a package called ``models``.
"""

from __future__ import annotations

import ast
import hashlib
import inspect
import os
from collections.abc import Iterator
from pathlib import Path
from shlex import quote
from typing import Any

from socialmind.errors import SocialmindError, nearest
from socialmind.language.syntax import parsed
from socialmind.sources.typed_in import is_typed_in

PACKAGE = Path(__file__).resolve().parent.parent
MODEL_FILE = "model.py"
METACIV_FILE = "parametres.metaciv"
"""What a folder of MetaCiv's holds in place of a `model.py`."""
FIGURES_FILE = "figures.py"
APP_FILE = "app.py"
OTHER_MINDS = "mind_"
"""How the names of folders begin that hold minds beside the model's own."""
STUDIES_FILE = "studies.py"


def shipped(kind: str, file: str) -> dict[str, Path]:
    """The folders that ship with socialmind and hold a file: its models, or its studies.

    In a checkout or an editable install they stand beside the package, in a wheel they are data
    of the package.

    Args:
        kind: ``models`` or ``analysis``.
        file: the file.

    Returns:
        Each folder by its name, in alphabetical order; none where they are not installed.
    """
    for home in (PACKAGE / f"_{kind}", PACKAGE.parent / kind):
        if home.is_dir():
            return {
                folder.name: folder
                for folder in sorted(home.iterdir())
                if (folder / file).is_file()
            }
    return {}


def catalogue() -> dict[str, Path]:
    """The models that ship with socialmind.

    Returns:
        The folder of each model by its name, in alphabetical order.
    """
    return shipped("models", MODEL_FILE)


def model_folder(name_or_path: str | Path) -> Path:
    """The folder of a model.

    Args:
        name_or_path: a name of the catalogue (``farmer_artisan`` or ``farmer-artisan``), or the
            path of a folder with a ``model.py``, or of that file. A name of the catalogue comes
            first; write ``./name`` for a folder of that name.

    Returns:
        The folder's absolute path.

    Raises:
        SocialmindError: there is no such model, or the folder holds no ``model.py``.
    """
    name = str(name_or_path)
    known = catalogue()
    if isinstance(name_or_path, str) and name.replace("-", "_") in known:
        return known[name.replace("-", "_")]
    path = Path(name_or_path).expanduser()
    if path.is_file() and path.name == MODEL_FILE:
        return path.resolve().parent
    if path.is_dir():
        if is_metaciv(path):
            raise SocialmindError(
                f"{path}: a model of MetaCiv's; `socialmind import {quote(str(path))} --out DIR` "
                "writes it as one of this toolkit, and `socialmind run` runs it at once"
            )
        if not (path / MODEL_FILE).is_file():
            raise SocialmindError(
                f"{path}: not a model, it holds no {MODEL_FILE}; "
                "`socialmind new FOLDER` writes one to start from"
            )
        return path.resolve()
    if path.name != name:
        raise SocialmindError(f"{path}: no such folder; a model is a folder with a {MODEL_FILE}")
    raise SocialmindError(f"no model called {name}; {nearest(name.replace('-', '_'), known)}")


def is_metaciv(folder: Path) -> bool:
    """Return whether a folder is a model of MetaCiv's, and none of this toolkit."""
    return spelled(folder / METACIV_FILE).is_file() and not (folder / MODEL_FILE).is_file()


def spelled(path: Path) -> Path:
    """Return a path as its folder spells the name: in other letter case if none is as asked.

    MetaCiv's users had Windows and macOS, where a folder `Simulation` is found as `simulation`.
    """
    if os.path.lexists(path):
        return path
    try:
        alike = [one for one in path.parent.iterdir() if one.name.lower() == path.name.lower()]
    except OSError:
        return path
    return alike[0] if len(alike) == 1 else path


def digest(content: bytes) -> str:
    """Return the SHA-256 of bytes."""
    return hashlib.sha256(content).hexdigest()


def source_hash(folder: Path) -> str:
    """The SHA-256 of what decides how a model runs: its Python files but figures and app.

    Other minds beside the model's own, in folders called ``mind_…``, do not count: runs keep a
    copy of the mind that they are given. Of other models whose files it loads by
    ``model_folder("name")`` all count that decides about them.

    Args:
        folder: the model's folder, or one Python file.

    Returns:
        64 hexadecimal digits.
    """
    return _source_hash(folder, ())


def _source_hash(folder: Path, above: tuple[Path, ...]) -> str:
    """The hash of a model that those above load."""
    total = hashlib.sha256()
    named: set[str] = set()
    if folder.is_file():
        content = folder.read_bytes()
        named |= models_in(content)
        total.update(content)
    else:
        for path in deciding_files(folder):
            content = path.read_bytes()
            named |= models_in(content)
            total.update(f"{path.relative_to(folder).as_posix()}\0{len(content)}\0".encode())
            total.update(content)
    known = catalogue() if named else {}
    for name in sorted(named):
        other = known.get(name.replace("-", "_"))
        if other is not None and other != folder and other not in above:
            total.update(f"{name}\0{_source_hash(other, (*above, folder))}\0".encode())
    return total.hexdigest()


def deciding_files(folder: Path) -> Iterator[Path]:
    """The Python files of a model that decide how it runs, in order.

    Those that runs and trainings keep in the model's folder are copies, and decide nothing.
    """
    kept = {path.parent for path in folder.rglob("manifest.json")} - {folder}
    for path in sorted(folder.rglob("*.py")):
        if not kept.isdisjoint(path.parents):
            continue
        place = path.relative_to(folder)
        hidden = any(part.startswith((".", "__pycache__")) for part in place.parts)
        other_mind = len(place.parts) > 1 and place.parts[0].startswith(OTHER_MINDS)
        if not hidden and not other_mind and place not in (Path(FIGURES_FILE), Path(APP_FILE)):
            yield path


def file_of_class(one: type[Any]) -> Path | None:
    """Return the file that defines a class; None for one that was typed in."""
    if is_typed_in(one):
        return None
    try:
        return Path(inspect.getfile(one))
    except (OSError, TypeError):
        return None


def models_in(source: bytes) -> set[str]:
    """The names of models whose folders a Python file asks for.

    >>> models_in(b"import x; model_folder('collect')")
    {'collect'}
    """
    if model_folder.__name__.encode() not in source:
        return set()
    try:
        tree = parsed(source)
    except (SyntaxError, ValueError):
        return set()  # loading it says what is wrong
    calls = [
        one
        for one in ast.walk(tree)
        if isinstance(one, ast.Call)
        and isinstance(one.func, ast.Name | ast.Attribute)
        and (one.func.id if isinstance(one.func, ast.Name) else one.func.attr)
        == model_folder.__name__
    ]
    names = [
        one.args[0].value for one in calls if one.args and isinstance(one.args[0], ast.Constant)
    ]
    return {name for name in names if isinstance(name, str)}
