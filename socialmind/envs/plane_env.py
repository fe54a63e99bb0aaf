"""The world of a robot on a plane as an environment of Gymnasium."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from socialmind.envs.steered_world import SteeredWorld, commands_of, sizes_of
from socialmind.errors import SocialmindError
from socialmind.model import Model

Numbers = NDArray[np.float32]


class PlaneEnv(gymnasium.Env[Numbers, Numbers]):
    """A world with one robot, which is steered from outside.

    An observation is what the body's sensors read, an action is what its actuators are told, both
    0 … 1 and in the body's order. A reward is what the model's rewards give in the tick. An
    interruption or the robot's death terminates an episode, the limit of ticks truncates it. Robots
    that are born on the way are told 0.5.

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
        self._world = SteeredWorld(
            model, environment, render_mode, ticks, physics, without, parameters
        )
        self._robots = robot_of(self._world.model_class, parameters)
        body = self._world.bodies[self._robots]
        self.observation_space = Box(0.0, 1.0, (len(body.sensors),), np.float32)
        self.action_space = Box(0.0, 1.0, (len(body.actuators),), np.float32)
        self.metadata = {**self.metadata, "render_fps": self._world.fps}
        self.render_mode = render_mode
        self._actuators = list(body.actuators)
        self._identity = 0
        self._pending = 0.0

    @property
    def model(self) -> Model | None:
        """The running model; None before `reset` was called."""
        return self._world.model

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
        model = self._world.begin(int(self.np_random.integers(2**63)), options)
        if not len(model.tables[self._robots]):
            raise SocialmindError(f"the robot of {model.name} died in its setup")
        self._identity = int(model.tables[self._robots].id[0])
        self._world.advance()
        self._pending = self._column("reward")
        return self._observation(), self._info()

    def step(self, action: Numbers) -> tuple[Numbers, float, bool, bool, dict[str, Any]]:
        """Run a tick.

        Args:
            action: (actuators,), held to 0 … 1.

        Returns:
            What the sensors read, the reward, whether an interruption or the robot's death has
            ended the episode, whether its ticks are up, and what `reset` tells.

        Raises:
            SocialmindError: an action that is not a number for each actuator.
        """
        model = self._world.running
        told = commands_of(action, self._actuators)
        reward, self._pending = self._pending, 0.0
        if not self._ended:
            slots = model.tables[self._robots].slots
            commands = np.full((len(slots), len(told)), 0.5)
            commands[slots == self._world.slot(self._robots, self._identity)] = told
            model.steer(self._robots, commands)
            self._world.advance()
            reward += self._column("reward")
        return self._observation(), reward, self._ended, self._world.up, self._info()

    def __copy__(self) -> Any:
        return copy.deepcopy(self)  # or both would run one world

    def render(self) -> Any:
        """Return the picture of the world, (height, width, 3) bytes; None without a render mode."""
        return self._world.pixels()

    def close(self) -> None:
        """Let the world go."""
        self._world.close()

    @property
    def _ended(self) -> bool:
        dead = self._world.slot(self._robots, self._identity) is None
        return dead or self._world.running.over is not None

    def _column(self, name: str) -> Any:
        return self._world.row(self._robots, self._identity)[name].item()

    def _observation(self) -> Numbers:
        readings = self._world.row(self._robots, self._identity)["readings"]
        shape: Any = self.observation_space.shape
        return readings[: shape[0]].astype(np.float32)

    def _info(self) -> dict[str, Any]:
        return {**self._world.facts(), "score": self._column("score")}


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
    if not model_class.shape.world.robots[name].actuators:
        raise SocialmindError(f"the robot of {model_class.name} has no actuators to steer")
    return name
