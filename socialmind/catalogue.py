"""Models by name: those that ship with socialmind, and those of any folder or Python file."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

from coglogo_py.border.errors import shown
from socialmind.errors import ModelError, SocialmindError
from socialmind.sources.folders import (
    FIGURES_FILE,
    MODEL_FILE,
    catalogue,
    model_folder,
    source_hash,
)
from socialmind.sources.loading import load_file
from socialmind.sources.trust import programs_in, remember

if TYPE_CHECKING:
    from socialmind.model import Model

__all__ = [
    "catalogue",
    "load_figures",
    "load_file",
    "load_model",
    "load_script",
    "model_folder",
    "source_hash",
]


def load_model(model: str | Path | type[Model]) -> type[Model]:
    """The model class that a model's folder defines, or the class itself.

    Loading the same, unchanged folder again gives the same class. Its programs are remembered as
    named by this user (`socialmind.sources.trust`).

    Args:
        model: as for `model_folder`; the path of any Python file that defines a model; or a
            class, which is checked to be a model's.

    Returns:
        The one subclass of `socialmind.model.Model` that ``model.py`` defines, or the one that
        it names with ``model = …``.

    Raises:
        SocialmindError: there is no such model, or this is none.
        ModelError: the file cannot be read or run, or which class is meant is unclear.
    """
    if not isinstance(model, str | Path):
        return _checked_class(model)
    script = Path(model).expanduser()
    if script.suffix == ".py" and script.name != MODEL_FILE and script.is_file():
        return load_script(script)
    folder = model_folder(model)
    remember(programs_in(folder))
    return _model_class(load_file(folder / MODEL_FILE))


def _checked_class(model: Any) -> type[Model]:
    # Whatever has a length and goes on tick by tick can be run, a stand-in in tests too.
    if isinstance(model, type) and hasattr(model, "ticks") and hasattr(model, "advance"):
        return model
    remedy = "; give its class" if hasattr(model, "advance") else ""
    raise SocialmindError(
        f"model: found {shown(model)}; expected a model's class, its name or its folder{remedy}"
    )


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
    module = load_file(path.resolve(), alone=True, modules=path.resolve().parent)
    if name is None:
        return _model_class(module)
    from socialmind.model import Model

    found = getattr(module, name, None)
    if not (isinstance(found, type) and issubclass(found, Model)):
        raise ModelError(f"no model called {name!r} any more", file=path)
    return found


def load_figures(folder: Path) -> ModuleType | None:
    """The module of a model's ``figures.py``; None where the folder has none."""
    path = folder / FIGURES_FILE
    if not path.is_file():
        return None
    module = load_file(path)
    if not callable(getattr(module, "draw", None)):
        raise ModelError("no function draw(run)", file=path, remedy="define draw(run) -> figures")
    return module


def _model_class(module: ModuleType) -> type[Model]:
    """Pick the model class of a loaded ``model.py``."""
    from socialmind.model import Model

    chosen = getattr(module, "model", None)
    # `from .model import …` leaves the file beside it there, which chooses nothing.
    if chosen is not None and not isinstance(chosen, ModuleType):
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
