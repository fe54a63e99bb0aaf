"""The world of several robots on a plane as a parallel environment of PettingZoo."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from gymnasium.utils.seeding import np_random
from numpy.typing import NDArray

from coglogo_py.border.errors import shown
from socialmind.envs.steered_world import SteeredWorld, commands_of
from socialmind.errors import SocialmindError, nearest
from socialmind.model import Model


class MissingPettingZooError(SocialmindError, ImportError):
    """The library `pettingzoo` is not installed."""


if find_spec("pettingzoo") is None:
    raise MissingPettingZooError(
        "parallel environments need PettingZoo: pip install 'socialmind[pettingzoo]'"
    )

from pettingzoo import ParallelEnv  # noqa: E402  # needs PettingZoo

Numbers = NDArray[np.float32]


class PlaneParallelEnv(ParallelEnv[str, Numbers, Numbers]):
    """A world with any number of robots, each of which is steered from outside.

    An agent is a robot that is there from the start and has actuators; the second of the population
    `robots` is called `robots_1`. Its observation is what its sensors read, its action what its
    actuators are told, both 0 … 1 and in the body's order, and its reward what the model's rewards
    give that robot in the tick. Where an agent gets no action its actuators are told 0.5, as are
    those of robots that are born on the way.

    A step is a tick, and the first tick belongs to `reset`, as for `PlaneEnv`. An interruption
    terminates the episode for all agents, a robot's death for that one, and the limit of ticks
    truncates it.

    Args:
        model: a model's class, name or folder.
        environment: the name of a class in its `lessons.py`, in place of the model itself.
        render_mode: None, or "rgb_array".
        ticks: the limit of an episode; the model's own by default.
        physics: what moves the bodies, "compiled" or "pymunk".
        without: names of interruptions that are not heeded.
        parameters: values of the model's parameters that differ from the defaults.

    Attributes:
        possible_agents: the names of all agents.
        agents: those whose episode goes on.

    Raises:
        SocialmindError: no such model or lesson; no plane, or no robots to steer.
    """

    # As PettingZoo declares it; an instance has its own.
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
        bodies, sizes = self._world.bodies, self._world.sizes
        self._place = {
            f"{name}_{number}": (name, number) for name in bodies for number in range(sizes[name])
        }
        if not self._place:
            raise SocialmindError(
                f"{self._world.model_class.name} has no robots with actuators to steer"
            )
        self._counts = {
            name: (len(one.sensors), len(one.actuators)) for name, one in bodies.items()
        }
        # Each agent has spaces of its own, whose draws do not disturb those of others.
        spaces = {
            agent: [Box(0.0, 1.0, (count,), np.float32) for count in self._counts[name]]
            for agent, (name, _) in self._place.items()
        }
        self.observation_spaces = {agent: one for agent, (one, _) in spaces.items()}
        self.action_spaces = {agent: one for agent, (_, one) in spaces.items()}
        self.metadata = {
            **self.metadata,
            "name": f"{self._world.model_class.name}_v0",
            "render_fps": self._world.fps,
        }
        self.render_mode = render_mode
        self.possible_agents = list(self._place)
        self.agents: list[str] = []
        self._random, _ = np_random(None)
        self._identity: dict[str, int] = {}
        self._dead: dict[str, Any] = {}
        self._pending: dict[str, float] = {}

    @property
    def model(self) -> Model | None:
        """The running model; None before `reset` was called."""
        return self._world.model

    def observation_space(self, agent: str) -> Box:
        """Return the space of what an agent's sensors read."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Box:
        """Return the space of what an agent's actuators are told."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Numbers], dict[str, dict[str, Any]]]:
        """Begin an episode.

        Args:
            seed: of this world and those of later episodes.
            options: `{"world": seed}` for the world of `Model(seed=…)`.

        Returns:
            By agent what its sensors read; and `world`, the seed of the world, `tick`, the robot's
            `score` and `over`, the name of the interruption that has ended the episode or None.
        """
        if seed is not None:
            self._random, _ = np_random(seed)
        # PettingZoo's own checks of an environment give it an option called "options".
        given = {name: one for name, one in (options or {}).items() if name != "options"}
        model = self._world.begin(int(self._random.integers(2**63)), given)
        self._dead = {}
        self._identity = {
            agent: number
            for agent, (name, number) in self._place.items()
            if model.tables[name].contains(number)  # the others died in the setup
        }
        self._world.advance()
        # Who died in this tick as well: the first step tells of it, and pays what is due.
        self.agents = list(self._identity)
        self._dead = {
            agent: self._row(agent).copy() for agent in self.agents if self._slot(agent) is None
        }
        self._pending = {agent: float(self._row(agent)["reward"]) for agent in self.agents}
        return self._observations(self.agents), self._infos(self.agents)

    def step(
        self, actions: dict[str, Numbers]
    ) -> tuple[
        dict[str, Numbers],
        dict[str, float],
        dict[str, bool],
        dict[str, bool],
        dict[str, dict[str, Any]],
    ]:
        """Run a tick.

        Args:
            actions: (actuators,) by agent, held to 0 … 1.

        Returns:
            By agent what its sensors read, its reward, whether its episode has ended, whether its
            ticks are up, and what `reset` tells. The dead are told of once more, in the tick of
            their death.

        Raises:
            SocialmindError: an action for nobody, or that is not a number for each actuator.
        """
        model = self._world.running
        acting = list(self.agents)
        told = self._commands(actions)
        rewards, self._pending = {agent: self._pending.pop(agent, 0.0) for agent in acting}, {}
        living = [agent for agent in acting if agent not in self._dead]
        if model.over is None and living:
            self._steer(told)
            self._world.advance()
            for agent in living:
                rewards[agent] += float(self._row(agent)["reward"])
        over = model.over is not None
        ended = {agent: over or self._slot(agent) is None for agent in acting}
        up = dict.fromkeys(acting, self._world.up)
        self.agents = [agent for agent in acting if not (ended[agent] or up[agent])]
        return self._observations(acting), rewards, ended, up, self._infos(acting)

    def __copy__(self) -> Any:
        return copy.deepcopy(self)  # or both would run one world

    def render(self) -> Any:
        """Return the picture of the world, (height, width, 3) bytes; None without a render mode."""
        return self._world.pixels()

    def close(self) -> None:
        """Let the world go."""
        self._world.close()
        self.agents = []

    def _commands(self, actions: Mapping[str, Numbers]) -> dict[str, NDArray[np.float64]]:
        """Return the actions of all agents as commands."""
        for agent in actions:
            if agent not in self._place:
                hint = nearest(str(agent), self.possible_agents)
                raise SocialmindError(
                    f"an action for {shown(agent)}; expected agents among "
                    f"{', '.join(self.possible_agents)}; {hint}"
                )
        return {
            agent: commands_of(
                action, list(self._world.bodies[self._place[agent][0]].actuators), agent
            )
            for agent, action in actions.items()
        }

    def _steer(self, told: Mapping[str, NDArray[np.float64]]) -> None:
        """Tell each living robot's actuators the action of its agent."""
        model = self._world.running
        for name, (_, count) in self._counts.items():
            table = model.tables[name]
            commands = np.full((len(table.rows), count), 0.5)
            for agent, command in told.items():
                slot = self._slot(agent) if agent in self.agents else None
                if self._place[agent][0] == name and slot is not None:
                    commands[slot] = command
            model.steer(name, commands[table.slots])

    def _slot(self, agent: str) -> int | None:
        """Return where the robot of an agent is in its table, None once it is dead."""
        return self._world.slot(self._place[agent][0], self._identity[agent])

    def _row(self, agent: str) -> Any:
        """Return the robot of an agent, as it was at last if it is dead."""
        if agent in self._dead:
            return self._dead[agent]
        return self._world.row(self._place[agent][0], self._identity[agent])

    def _observations(self, agents: Sequence[str]) -> dict[str, Numbers]:
        found = {}
        for agent in agents:
            count = self._counts[self._place[agent][0]][0]
            found[agent] = self._row(agent)["readings"][:count].astype(np.float32)
        return found

    def _infos(self, agents: Sequence[str]) -> dict[str, dict[str, Any]]:
        told = self._world.facts()
        return {agent: {**told, "score": float(self._row(agent)["score"])} for agent in agents}
