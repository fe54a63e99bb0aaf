"""The world of a robot on a plane as an environment of Gymnasium."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from socialmind.catalogue import load_model, model_folder
from socialmind.errors import SocialmindError
from socialmind.language.nodes import nearest
from socialmind.learning.course import lessons_module
from socialmind.model import Model

if TYPE_CHECKING:
    from socialmind.envs.drawing import Drawing

Numbers = NDArray[np.float32]


class PlaneEnv(gymnasium.Env[Numbers, Numbers]):
    """A world with one robot, which is steered from outside.

    An observation is what the body's sensors read, an action is what its actuators are told, both
    0 … 1 and in the body's order. A reward is what the model's rewards give in the tick. An
    interruption terminates an episode, the limit of ticks truncates it.

    A step is a tick. The first tick belongs to `reset`: actuators are told 0.5 in it, and it ends
    with the sensors reading for the first time, as for the minds of the model. Its reward comes
    with that of the first step. So whoever acts as a mind does lives through the same episode, and
    the rewards add up to the score that learning sees.

    Args:
        model: a model's class, name or folder.
        environment: the name of a class in its `lessons.py`, in place of the model itself.
        render_mode: None, or "rgb_array".
        ticks: the limit of an episode; the model's own by default.
        physics: what moves the bodies, "compiled" or "pymunk".
        without: names of interruptions that are not heeded.
        parameters: values of the model's parameters that differ from the defaults.

    Attributes:
        model: the running model, once `reset` was called.

    Raises:
        SocialmindError: no such model or lesson; no plane, or not one robot alone.
    """

    # As Gymnasium declares it; an instance has its own.
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
        check_render_mode(render_mode)
        self._class = class_of(model, environment)
        self._made_with = {"physics": physics, "without": without, **(parameters or {})}
        self._robots = robot_of(self._class, parameters)
        plane: Any = self._class.shape.plane
        robots = plane.robots[self._robots]
        self._limit = limit_of(self._class, ticks)
        self.observation_space = Box(0.0, 1.0, (len(robots.sensors),), np.float32)
        self.action_space = Box(0.0, 1.0, (len(robots.actuators),), np.float32)
        self.metadata = {**self.metadata, "render_fps": round(1 / plane.dt)}
        self.render_mode = render_mode
        self.model: Model | None = None
        self._pending = 0.0
        self._world = 0
        self._drawing: Drawing | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Numbers, dict[str, Any]]:
        """Begin an episode.

        Args:
            seed: of this world and those of later episodes.
            options: `{"world": seed}` for the world of `Model(seed=…)`.

        Returns:
            What the sensors read; and `world`, the seed of the world, `tick`, `score` and `over`,
            the name of the interruption that has ended the episode or None.
        """
        super().reset(seed=seed)
        drawn = int(self.np_random.integers(2**63))
        self._world = int((options or {}).get("world", drawn))
        self.model = self._class(seed=self._world, hierarchy=False, **self._made_with)
        self.model.advance()
        self._pending = self._column("reward")
        self._drawing = None
        self._draw()
        return self._observation(), self._info()

    def step(self, action: Numbers) -> tuple[Numbers, float, bool, bool, dict[str, Any]]:
        """Run a tick.

        Args:
            action: (actuators,), held to 0 … 1.

        Returns:
            What the sensors read, the reward, whether an interruption has ended the episode,
            whether its ticks are up, and what `reset` tells.
        """
        if self.model is None:
            raise gymnasium.error.ResetNeeded("call reset() before the first step()")
        reward, self._pending = self._pending, 0.0
        if self.model.over is None:
            self.model.steer(self._robots, np.clip(np.asarray(action, np.float64), 0.0, 1.0))
            self.model.advance()
            reward += self._column("reward")
            self._draw()
        ended = self.model.over is not None
        return self._observation(), reward, ended, self.model.tick >= self._limit, self._info()

    def render(self) -> Any:
        """Return the picture of the world, (height, width, 3) bytes; None without a render mode."""
        if self._drawing is None or self.model is None:
            return None
        return self._drawing.pixels(self.model)

    def close(self) -> None:
        """Let the world go."""
        self.model = self._drawing = None

    def _draw(self) -> None:
        """Note where the robot is for the picture's path."""
        if self.render_mode is None or self.model is None:
            return
        if self._drawing is None:
            from socialmind.envs.drawing import Drawing

            self._drawing = Drawing([self._robots])
        self._drawing.note(self.model)

    def _column(self, name: str) -> Any:
        model: Any = self.model
        return model.tables[self._robots].rows[name][0].item()

    def _observation(self) -> Numbers:
        model: Any = self.model
        readings = model.tables[self._robots].rows["readings"][0]
        shape: Any = self.observation_space.shape
        return readings[: shape[0]].astype(np.float32)

    def _info(self) -> dict[str, Any]:
        model: Any = self.model
        told = {"world": self._world, "tick": model.tick, "score": self._column("score")}
        return {**told, "over": model.over}


def check_render_mode(render_mode: str | None) -> None:
    """Refuse a render mode that there is not.

    Raises:
        SocialmindError: so it is.
    """
    if render_mode not in (None, "rgb_array"):
        raise SocialmindError(f"render_mode {render_mode!r}; expected 'rgb_array' or None")


def limit_of(model_class: type[Model], ticks: int | None) -> int:
    """Return the limit of an episode: `ticks`, or the model's own.

    Raises:
        SocialmindError: too few for a step after the reset.
    """
    limit = model_class.ticks if ticks is None else ticks
    if limit < 2:
        raise SocialmindError(f"ticks {limit}; expected 2 or more, one for the reset")
    return limit


def sizes_of(
    model_class: type[Model], parameters: Mapping[str, Any] | None = None
) -> dict[str, int]:
    """Return how many robots of each population a model begins with.

    Raises:
        SocialmindError: it has no plane.
    """
    plane = model_class.shape.plane
    if plane is None:
        raise SocialmindError(
            f"the model {model_class.name} has no plane; expected one that declares "
            "world = Plane(…)"
        )
    known = {name: one.default for name, one in model_class.parameters.items()}
    known |= parameters or {}
    sizes = {}
    for name in plane.robots:
        size = model_class.populations[name].size
        sizes[name] = int(known.get(size, 0) if isinstance(size, str) else size)
    return sizes


def class_of(model: type[Model] | str | Path, environment: str | None) -> type[Model]:
    """Return the class of a model, or of one of its lessons.

    Raises:
        SocialmindError: there is no such model or lesson.
    """
    if environment is None:
        return model if isinstance(model, type) else load_model(model)
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


def robot_of(model_class: type[Model], parameters: Mapping[str, Any] | None = None) -> str:
    """Return the population of the one robot that a model has.

    Raises:
        SocialmindError: it has none, or several, or one without actuators.
    """
    sizes = sizes_of(model_class, parameters)
    if sum(sizes.values()) != 1:
        found = ", ".join(f"{count} {name}" for name, count in sizes.items()) or "no robots"
        raise SocialmindError(
            f"{model_class.name} has {found}; an environment of Gymnasium has one robot, "
            "PlaneParallelEnv any number"
        )
    (name,) = (name for name, size in sizes.items() if size == 1)
    plane: Any = model_class.shape.plane
    if not plane.robots[name].actuators:
        raise SocialmindError(f"the robot of {model_class.name} has no actuators to steer")
    return name
