"""Worlds as environments of Gymnasium, in which others' learning algorithms steer the robot.

Importing this registers one for the world of each model that ships, and one for each of its
lessons:

    import gymnasium
    import socialmind.envs

    world = gymnasium.make("socialmind/Collect-v0")

Gymnasium looks for no plugins; `gymnasium.make("socialmind.envs:socialmind/Collect-v0")` imports
this as well.

Worlds with several robots are parallel environments of PettingZoo: `PlaneParallelEnv(model)`, and
`foraging_v0.parallel_env()` for the model `foraging`. PettingZoo is imported with them alone.
"""

from importlib.util import find_spec
from typing import Any

from socialmind.errors import SocialmindError


class MissingGymnasiumError(SocialmindError, ImportError):
    """The library `gymnasium` is not installed."""


if find_spec("gymnasium") is None:
    raise MissingGymnasiumError("environments need Gymnasium: pip install 'socialmind[gym]'")

from socialmind.envs.plane_env import PlaneEnv  # noqa: E402  # needs Gymnasium
from socialmind.envs.registration import environments_of, register_envs  # noqa: E402

__all__ = [
    "MissingGymnasiumError",
    "PlaneEnv",
    "PlaneParallelEnv",
    "environments_of",
    "register_envs",
]

register_envs()


def __getattr__(name: str) -> Any:
    """Import what needs PettingZoo once it is asked for.

    Raises:
        MissingPettingZooError: PettingZoo is not installed.
    """
    if name == "PlaneParallelEnv":
        from socialmind.envs.plane_parallel_env import PlaneParallelEnv

        return PlaneParallelEnv
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
