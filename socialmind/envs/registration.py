"""Which environments there are, and telling Gymnasium of them."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import gymnasium

from socialmind.catalogue import load_model
from socialmind.envs.plane_env import robot_of
from socialmind.envs.steered_world import lessons_of, sizes_of
from socialmind.errors import SocialmindError
from socialmind.model import Model
from socialmind.sources.folders import catalogue, model_folder

NAMESPACE, VERSION = "socialmind", 0
ENTRY = "socialmind.envs:PlaneEnv"


def environments_of(model: str | Path) -> dict[str, str | None]:
    """Return the environments of a model: of its world, and of its lessons with one robot.

    Args:
        model: its name or folder.

    Returns:
        By the class's name, what `PlaneEnv` takes as `environment`: None for the model itself.

    Raises:
        SocialmindError: there is no such model, or its files are wrong.
    """
    folder = model_folder(model)
    main = load_model(folder)
    found: dict[str, str | None] = {}
    if _fits(main):
        found[main.__name__] = None
    for name, lesson in lessons_of(folder).items():
        if _fits(lesson):
            found.setdefault(name, name)
    return found


def register_envs(model: str | Path | None = None) -> list[str]:
    """Tell Gymnasium of the environments of a model, or of all models that ship.

    A world is called after its class, as `socialmind/Collect-v0`; a lesson too, with the name of
    the model's class before it where another model has given the name away:
    `socialmind/CollectPowerAvoid-v0`.

    Args:
        model: its name or folder; all that ship by default, but those whose files are wrong, of
            which a warning tells.

    Returns:
        The ids.

    Raises:
        SocialmindError: there is no such model, or its files are wrong.
    """
    ids = []
    for name, given in _all() if model is None else _of_one(str(model)):
        identity = f"{NAMESPACE}/{name}-v{VERSION}"
        known = gymnasium.registry.get(identity)
        if known is None:
            gymnasium.register(identity, ENTRY, kwargs=given)
        elif known.kwargs != given:
            raise SocialmindError(
                f"{identity} stands for {known.kwargs['model']} already; call the class "
                f"{name!r} of {given['model']} something else"
            )
        ids.append(identity)
    return ids


def _fits(model_class: type[Model]) -> bool:
    try:
        robot_of(model_class, sizes_of(model_class))
    except SocialmindError:
        return False
    return True


def _all() -> Iterator[tuple[str, dict[str, Any]]]:
    """Give the names of all environments that ship, worlds first, and what they are made with."""
    found: dict[str, dict[str, str | None]] = {}
    for model in catalogue():
        try:
            found[model] = environments_of(model)
        except SocialmindError as error:
            warnings.warn(f"no environments of {model}: {error}", stacklevel=4)
    named = [(name, model, one) for model, own in found.items() for name, one in own.items()]
    taken = set()
    for name, model, environment in sorted(named, key=lambda one: one[2] is not None):
        free = environment is None or name not in taken
        whole = name if free else f"{load_model(model).__name__}{name}"
        taken.add(whole)
        yield whole, _made_with(model, environment)


def _of_one(model: str) -> Iterator[tuple[str, dict[str, Any]]]:
    known = model if model.replace("-", "_") in catalogue() else str(model_folder(model))
    for name, environment in environments_of(model).items():
        yield name, _made_with(known, environment)


def _made_with(model: str, environment: str | None) -> dict[str, Any]:
    return {"model": model} | ({} if environment is None else {"environment": environment})
