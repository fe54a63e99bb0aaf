"""Finding models: by name among those that ship with socialmind, or by a folder's path.

A model is a folder with a ``model.py``. In a checkout or an editable install the models that
ship stand in ``models/`` beside the package, in a wheel they are data of the package. They are
documents: loaded by path under a private name, never imported as a package called ``models``.
"""

from __future__ import annotations

import ast
import hashlib
import importlib.util
import os
import signal
import sys
import threading
import traceback
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import CodeType, FrameType, ModuleType
from typing import TYPE_CHECKING

from socialmind.errors import ModelError, SocialmindError, nearest
from socialmind.language.syntax import parsed
from socialmind.sources.trust import programs_in, remember

if TYPE_CHECKING:
    from socialmind.model import Model

MODEL_FILE = "model.py"
FIGURES_FILE = "figures.py"
APP_FILE = "app.py"
OTHER_MINDS = "mind_"
"""How the names of folders begin that hold minds beside the model's own."""
PRIVATE = "_socialmind_"
"""How the names of modules begin that were loaded by path."""


def catalogue() -> dict[str, Path]:
    """The models that ship with socialmind.

    Returns:
        The folder of each model by its name, in alphabetical order.
    """
    package = Path(__file__).resolve().parent
    for home in (package / "_models", package.parent / "models"):
        if home.is_dir():
            return {
                folder.name: folder
                for folder in sorted(home.iterdir())
                if (folder / MODEL_FILE).is_file()
            }
    return {}


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
        if not (path / MODEL_FILE).is_file():
            raise SocialmindError(
                f"{path}: not a model, it holds no {MODEL_FILE}; "
                "`socialmind new FOLDER` writes one to start from"
            )
        return path.resolve()
    if path.name != name:
        raise SocialmindError(f"{path}: no such folder; a model is a folder with a {MODEL_FILE}")
    raise SocialmindError(f"no model called {name}; {nearest(name.replace('-', '_'), known)}")


def load_model(name_or_path: str | Path) -> type[Model]:
    """The model class that a model's folder defines.

    Loading the same, unchanged folder again gives the same class. Its programs are remembered as
    named by this user (`socialmind.sources.trust`).

    Args:
        name_or_path: as for `model_folder`; or the path of any Python file that defines a model.

    Returns:
        The one subclass of `socialmind.model.Model` that ``model.py`` defines, or the one that
        it names with ``model = …``.

    Raises:
        SocialmindError: there is no such model.
        ModelError: the file cannot be read or run, or which class is meant is unclear.
    """
    script = Path(name_or_path).expanduser()
    if script.suffix == ".py" and script.name != MODEL_FILE and script.is_file():
        return load_script(script)
    folder = model_folder(name_or_path)
    remember(programs_in(folder))
    return _model_class(load_file(folder / MODEL_FILE))


def load_script(path: Path, name: str | None = None) -> type[Model]:
    """The model class that a Python file of any name defines.

    Files beside it can be imported, as when Python runs it; what it does under
    ``if __name__ == "__main__":`` it does not do.

    Args:
        path: the file.
        name: of the class; the only one by default.

    Raises:
        ModelError: the file cannot be read or run, or which class is meant is unclear.
    """
    with modules_from(path.resolve().parent):
        module = load_file(path.resolve(), alone=True)
    if name is None:
        return _model_class(module)
    from socialmind.model import Model

    found = getattr(module, name, None)
    if not (isinstance(found, type) and issubclass(found, Model)):
        raise ModelError(f"no model called {name!r} any more", file=path)
    return found


@contextmanager
def modules_from(folder: Path) -> Iterator[None]:
    """Let imports find the modules of a folder first, and load those anew.

    Args:
        folder: which need not exist.
    """
    own = {one.stem for one in folder.iterdir()} if folder.is_dir() else set()
    before = {name: one for name, one in sys.modules.items() if name.partition(".")[0] in own}
    from_elsewhere = {
        name
        for name, one in before.items()
        if not str(getattr(one, "__file__", None) or "").startswith(str(folder))
        and name.partition(".")[0] not in sys.stdlib_module_names
    }
    for name in from_elsewhere:
        del sys.modules[name]
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        sys.path.remove(str(folder))
        for name in from_elsewhere:
            sys.modules[name] = before[name]


def load_figures(folder: Path) -> ModuleType | None:
    """The module of a model's ``figures.py``; None where the folder has none."""
    path = folder / FIGURES_FILE
    if not path.is_file():
        return None
    module = load_file(path)
    if not callable(getattr(module, "draw", None)):
        raise ModelError("no function draw(run)", file=path, remedy="define draw(run) -> figures")
    return module


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
    """The Python files of a model that decide how it runs, in order."""
    for path in sorted(folder.rglob("*.py")):
        place = path.relative_to(folder)
        hidden = any(part.startswith((".", "__pycache__")) for part in place.parts)
        other_mind = len(place.parts) > 1 and place.parts[0].startswith(OTHER_MINDS)
        if not hidden and not other_mind and place not in (Path(FIGURES_FILE), Path(APP_FILE)):
            yield path


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


def load_file(path: Path, alone: bool = False) -> ModuleType:
    """Run a Python file as a module with a private name that stands for its folder's content.

    The module is the package of its folder, so ``from .rules import eat`` finds ``rules.py``
    beside it, and two models may both have one. The same, unchanged file gives the same module.
    It is remembered as run by this user (`socialmind.sources.trust`).

    Args:
        path: the file.
        alone: whether it stands for itself, and not for the folder that it lies in.

    Raises:
        ModelError: it is no Python, or stopped with an error.
    """
    source = path.read_bytes()
    around = "" if alone else source_hash(path.parent)
    key = hashlib.sha256(f"{path}\0{around}\0".encode() + source).hexdigest()
    name = f"{PRIVATE}{path.parent.name}_{path.stem}_{key[:16]}"
    if name in sys.modules:
        return sys.modules[name]
    spec = importlib.util.spec_from_file_location(
        name, path, submodule_search_locations=[str(path.parent)]
    )
    if spec is None:
        raise ModelError("a file that Python cannot load", file=path)
    module = importlib.util.module_from_spec(spec)
    code = _compile(source, path)
    remember({str(path): source})
    sys.modules[name] = module
    with _heard_interrupts() as heard:
        try:
            with _no_bytecode():
                exec(code, module.__dict__)
        except SocialmindError:
            _forget(name)
            raise
        except BaseException as error:
            _forget(name)
            if heard:  # the user's Ctrl-C, and not the file's own exit
                raise
            raise _failed_import(error, path) from error
    return module


def _compile(source: bytes, path: Path) -> CodeType:
    """Compile the file as it stands, past any stale bytecode."""
    try:
        return compile(source, str(path), "exec", dont_inherit=True)
    except SyntaxError as error:
        raise _failed_import(error, path) from error
    except (RecursionError, MemoryError) as error:
        raise ModelError("brackets or blocks nested too deep for Python", file=path) from error
    except ValueError as error:  # null bytes
        raise ModelError(f"not a Python file ({error})", file=path) from error


@contextmanager
def _no_bytecode() -> Iterator[None]:
    """Neither leave a ``__pycache__`` in a model's folder nor run what lies in one there."""
    before = sys.dont_write_bytecode, sys.pycache_prefix
    sys.dont_write_bytecode, sys.pycache_prefix = True, os.devnull
    try:
        yield
    finally:
        sys.dont_write_bytecode, sys.pycache_prefix = before


@contextmanager
def _heard_interrupts() -> Iterator[list[int]]:
    """Note the signals of Ctrl-C, to tell them from an exception that a file raises itself."""
    heard: list[int] = []
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield heard
        return

    def noted(number: int, frame: FrameType | None) -> None:
        heard.append(number)
        before(number, frame)

    signal.signal(signal.SIGINT, noted)
    try:
        yield heard
    finally:
        # Unless the file set a handler of its own, which then stays.
        if signal.getsignal(signal.SIGINT) is noted:
            signal.signal(signal.SIGINT, before)


def _forget(name: str) -> None:
    """Take a module that failed, and its siblings, out of Python's table of modules."""
    for loaded in [m for m in sys.modules if m == name or m.startswith(name + ".")]:
        del sys.modules[loaded]


def _failed_import(error: BaseException, path: Path) -> ModelError:
    """Say in one line why a file of a model or mind cannot be loaded."""
    if isinstance(error, SyntaxError):
        return ModelError(
            f"not valid Python ({error.msg})", file=error.filename or path, line=error.lineno
        )
    missing = error.name if isinstance(error, ModuleNotFoundError) else None
    remedy = None
    if missing and (path.parent / f"{missing}.py").is_file():
        remedy = f"write `from . import {missing}` for a file of the model's own folder"
    elif missing:
        remedy = f"install {missing}, or correct the name"
    return failure_in_model(error, path, "loading", remedy)


def failure_in_model(
    error: BaseException, path: Path, doing: str, remedy: str | None = None
) -> ModelError:
    """Say in one line where in a model's own files an error came from.

    Args:
        error: what was raised.
        path: the file that was called.
        doing: what the file was called for.
        remedy: what to do.

    Returns:
        An error that names the innermost line that lies in the folder of `path`.
    """
    file, line = path, None
    for frame, number in traceback.walk_tb(error.__traceback__):
        place = Path(frame.f_code.co_filename)
        if place.is_relative_to(path.parent):
            file, line = place, number
    try:
        said = f": {error}"
    except Exception:  # an exception of the file's own, which cannot be written
        said = ""
    return ModelError(
        f"{doing} stopped with {type(error).__name__}{said}",
        remedy=remedy,
        file=file,
        line=line,
    )


def _model_class(module: ModuleType) -> type[Model]:
    """Pick the model class of a loaded ``model.py``."""
    from socialmind.model import Model

    chosen = getattr(module, "model", None)
    if chosen is not None:
        if isinstance(chosen, type) and issubclass(chosen, Model):
            return chosen
        raise ModelError(
            f"`model` set to {chosen!r}",
            "a subclass of socialmind.Model",
            "write `model = YourModel`, the class itself",
            module.__file__,
        )
    # A class may stand there under two names.
    defined = [
        value
        for value in dict.fromkeys(v for v in vars(module).values() if isinstance(v, type))
        if issubclass(value, Model) and value.__module__ == module.__name__
    ]
    if len(defined) == 1:
        return defined[0]
    if not defined:
        raise ModelError(
            "no model", "one subclass of socialmind.Model", "define it", module.__file__
        )
    raise ModelError(
        f"{len(defined)} models ({', '.join(c.__name__ for c in defined)})",
        "one",
        f"add a line `model = {defined[-1].__name__}` to say which one runs",
        module.__file__,
    )
