"""A world whose robots are steered from outside: what environments of either library run."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import whole_number
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError, nearest
from socialmind.learning.training.course import lessons_module
from socialmind.model import Model
from socialmind.sources.folders import model_folder

if TYPE_CHECKING:
    from socialmind.envs.drawing import Drawing


class SteeredWorld:
    """What environments of either library have in common: a world, episode after episode.

    Args:
        model: a model's class, name or folder.
        environment: the name of a class in its `lessons.py`, in place of the model itself.
        render_mode: None, or "rgb_array".
        ticks: the limit of an episode; the model's own by default.
        physics: what moves the bodies, "compiled" or "pymunk".
        without: names of interruptions that are not heeded.
        parameters: values of the model's parameters that differ from the defaults.

    Attributes:
        model: the running model; None before `reset` was called.

    Raises:
        SocialmindError: no such model or lesson; no plane; a wrong render mode, or too few ticks.
    """

    # As both libraries declare it; an instance has its own.
    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 30}  # noqa: RUF012

    def __init__(
        self,
        model: type[Model] | str | Path,
        environment: str | None = None,
        render_mode: str | None = None,
        ticks: int | None = None,
        physics: str = "compiled",
        without: Sequence[str] = (),
        parameters: Mapping[str, Any] | None = None,
    ) -> None:
        if render_mode not in (None, "rgb_array"):
            raise SocialmindError(f"render_mode {render_mode!r}; expected 'rgb_array' or None")
        self._model_class = class_of(model, environment)
        _check_names(self._model_class, physics, without, parameters or {})
        self._sizes = sizes_of(self._model_class, parameters)
        self._limit = limit_of(self._model_class, ticks)
        world = self._model_class.shape.world
        self._bodies = {name: one for name, one in world.robots.items() if one.actuators}
        self.metadata = {**self.metadata, "render_fps": round(1 / world.dt)}
        self._made_with = {"physics": physics, "without": without, **(parameters or {})}
        self.render_mode = render_mode
        self._drawing: Drawing | None = None
        self.model: Model | None = None
        self._seed = 0
        self._prepare()

    def _prepare(self) -> None:
        """Find who is steered."""

    def _begin(self, drawn: int, options: Mapping[str, Any] | None) -> Model:
        """Return the model of another episode, before its first tick.

        Args:
            drawn: the seed of its world, unless it is given.
            options: `{"world": seed}`, or nothing.
        """
        given = dict(options or {})
        for name in given:
            if name != "world":
                hint = nearest(str(name), ["world"])
                raise SocialmindError(f"the option {shown(name)} of reset(); {hint}")
        self._seed = whole_number(
            given.get("world", drawn), "the option 'world'", 0, 2**64 - 1, SocialmindError
        )
        self.model = self._model_class(seed=self._seed, hierarchy=False, **self._made_with)
        self._drawing = None
        return self.model

    def _advance(self) -> None:
        """Run a tick; in the last one robots are paid what is still due to them."""
        model = self._running
        model.advance()
        if self._up and model.over is None:
            model.ground.settle()
        if self.render_mode is None:
            return
        if self._drawing is None:
            from socialmind.envs.drawing import Drawing

            self._drawing = Drawing(list(self._bodies))
        self._drawing.note(self._running)

    @property
    def _running(self) -> Model:
        """The running model.

        Raises:
            ResetNeeded: there is none yet.
        """
        if self.model is None:
            raise gymnasium.error.ResetNeeded("call reset() before the first step()")
        return self.model

    @property
    def _up(self) -> bool:
        """Whether the ticks of the episode are up."""
        return self._running.tick >= self._limit

    def _slot_of(self, population: str, identity: int) -> int | None:
        """Return where a robot is in its table, None once it is dead."""
        table = self._running.tables[population]
        return int(table.slot_of[identity]) if table.contains(identity) else None

    def _row_of(self, population: str, identity: int) -> Any:
        """Return a robot, in the tick in which it dies as it was at last."""
        rows = self._running.tables[population].rows
        slot = self._slot_of(population, identity)
        return rows[np.flatnonzero(rows["_id"] == identity)[0] if slot is None else slot]

    def _facts(self) -> dict[str, Any]:
        """Return the seed of the world, the tick, and what has ended the episode, or None."""
        return {"world": self._seed, "tick": self._running.tick, "over": self._running.over}

    def __copy__(self) -> Any:
        return copy.deepcopy(self)  # or both would run one world

    def render(self) -> Any:
        """Return the picture of the world, (height, width, 3) bytes; None without a render mode."""
        if self._drawing is None or self.model is None:
            return None
        return self._drawing.pixels(self.model)

    def close(self) -> None:
        """Let the world go."""
        self.model = self._drawing = None


def commands_of(action: Any, actuators: Sequence[str], whose: str = "") -> NDArray[np.float64]:
    """Return an action as commands, 0 … 1.

    Args:
        action: what a learning algorithm gives.
        actuators: the names of the robot's.
        whose: the agent's name, where there are several.

    Raises:
        SocialmindError: it is not a number for each actuator.
    """
    try:
        told = np.asarray(action, np.float64)
    except (TypeError, ValueError):
        told = np.full(len(actuators), np.nan)
    what = f"an action of {whose!r}" if whose else "an action"
    if told.shape != (len(actuators),):
        raise SocialmindError(
            f"{what} of shape {told.shape}; expected {(len(actuators),)}: {', '.join(actuators)}"
        )
    if np.isnan(told).any():
        raise SocialmindError(f"{what}: found {shown(action)}; expected numbers, 0 … 1")
    return np.clip(told, 0.0, 1.0)


def limit_of(model_class: type[Model], ticks: int | None) -> int:
    """Return the limit of an episode: `ticks`, or the model's own.

    Raises:
        SocialmindError: too few for a step after the reset.
    """
    given = model_class.ticks if ticks is None else ticks
    limit = whole_number(given, "ticks", error=SocialmindError)
    if limit < 2:
        raise SocialmindError(f"ticks {limit}; expected 2 or more, one for the reset")
    return limit


def _check_names(
    model_class: type[Model], physics: str, without: Sequence[str], parameters: Mapping[str, Any]
) -> None:
    """Refuse engines, interruptions and parameters that there are not, before the first reset."""
    engines = model_class.shape.world.engines
    given = [("engine", [physics], engines), ("parameter", parameters, model_class.parameters)]
    ignored = [without] if isinstance(without, str) else without
    given.append(("interruption", ignored, model_class.interruptions))
    for what, names, known in given:
        for name in names:
            if name not in known:
                hint = nearest(str(name), known)
                raise SocialmindError(f"{model_class.name} has no {what} {shown(name)}; {hint}")


def sizes_of(
    model_class: type[Model], parameters: Mapping[str, Any] | None = None
) -> dict[str, int]:
    """Return how many robots of each population a model begins with.

    Raises:
        SocialmindError: it has no plane.
    """
    world = model_class.shape.world
    if not world.has_episodes:
        raise SocialmindError(
            f"the model {model_class.name} has no plane; expected one that declares "
            "world = Plane(…)"
        )
    known = {name: one.default for name, one in model_class.parameters.items()}
    known |= parameters or {}
    sizes = {}
    for name in world.robots:
        several = model_class.populations[name].sizes
        sizes[name] = sum(
            int(known.get(one, 0) if isinstance(one, str) else one) for one in several
        )
    return sizes


def class_of(model: type[Model] | str | Path, environment: str | None) -> type[Model]:
    """Return the class of a model, or of one of its lessons.

    Raises:
        SocialmindError: there is no such model or lesson.
    """
    if environment is None:
        return load_model(model)
    folder = model.folder() if isinstance(model, type) else model_folder(model)
    lessons = lessons_of(folder)
    if environment not in lessons:
        raise SocialmindError(
            f"no environment {environment!r} in {folder}/lessons.py; "
            f"{nearest(environment, lessons)}"
        )
    return lessons[environment]


def lessons_of(folder: Path) -> dict[str, type[Model]]:
    """Return the models that a model's `lessons.py` defines, by name."""
    module = lessons_module(folder)
    return {
        name: value
        for name, value in (vars(module) if module is not None else {}).items()
        if isinstance(value, type)
        and issubclass(value, Model)
        and value.__module__ == getattr(module, "__name__", "")
        and value.__name__ == name
    }
