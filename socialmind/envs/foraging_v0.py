"""The robots of the model `foraging` as a parallel environment of PettingZoo."""

from typing import Any

from socialmind.envs.plane_parallel_env import PlaneParallelEnv

MODEL = "foraging"


def parallel_env(**arguments: Any) -> PlaneParallelEnv:
    """Return the environment; `arguments` are those of `PlaneParallelEnv` but for the model."""
    return PlaneParallelEnv(MODEL, **arguments)
