"""Which environments Gymnasium is told of, and that it finds nothing wrong with them."""

import subprocess
import sys
import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from socialmind.envs import environments_of, register_envs
from socialmind.errors import SocialmindError
from socialmind.sources.folders import catalogue

SHIPPED = sorted(one for one in gymnasium.registry if one.startswith("socialmind/"))


def test_the_worlds_and_lessons_of_models_with_one_robot_are_there(taught):
    assert environments_of(taught) == {"TaughtRovers": None, "Empty": "Empty"}
    assert environments_of("boids") == {}
    assert register_envs(taught) == ["socialmind/TaughtRovers-v0", "socialmind/Empty-v0"]
    # Once more changes nothing.
    assert register_envs(taught) == ["socialmind/TaughtRovers-v0", "socialmind/Empty-v0"]
    for model in catalogue():
        for name, environment in environments_of(model).items():
            if environment is None:
                assert gymnasium.spec(f"socialmind/{name}-v0").kwargs == {"model": model}


@pytest.mark.parametrize("name", ["TaughtRovers", "Empty"])
def test_gymnasium_finds_nothing_wrong(taught, name):
    register_envs(taught)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gymnasium.make(f"socialmind/{name}-v0", render_mode="rgb_array")
        check_env(env.unwrapped)
        spec = gymnasium.envs.registration.EnvSpec.from_json(env.spec.to_json())
    assert spec.make().unwrapped.observation_space == env.observation_space


@pytest.mark.study
@pytest.mark.parametrize("identity", SHIPPED)
def test_gymnasium_finds_nothing_wrong_with_those_that_ship(identity):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gymnasium.make(identity).unwrapped)


@pytest.mark.parametrize(
    "identity", [*SHIPPED[:2], *(pytest.param(one, marks=pytest.mark.study) for one in SHIPPED[2:])]
)
def test_whole_episodes_of_those_that_ship_repeat_themselves(identity):
    told = []
    for _ in range(2):
        env = gymnasium.make(identity, ticks=400)
        env.action_space.seed(3)
        observation, _ = env.reset(seed=5)
        told.append([observation.tolist()])
        done = False
        while not done:
            observation, reward, terminated, truncated, info = env.step(env.action_space.sample())
            told[-1].append((observation.tolist(), reward, terminated, truncated, info))
            done = terminated or truncated
    assert told[0] == told[1]


def test_a_mind_need_not_be_learned(taught):
    register_envs(taught)
    env = gymnasium.make("socialmind/Empty-v0")
    observation, _ = env.reset(seed=1)
    assert observation.shape == (0,)
    steps = [env.step(np.ones(1, np.float32)) for _ in range(4)]
    assert [one[3] for one in steps] == [False, False, False, True]
    robot = env.unwrapped.model.tables["rovers"].rows[0]
    assert np.hypot(robot["x"], robot["y"]) > 0


def test_a_name_that_is_taken_is_told(taught, tmp_path):
    register_envs(taught)
    other = tmp_path / "other_rovers"
    other.mkdir()
    (other / "model.py").write_text((taught / "model.py").read_text())
    with pytest.raises(SocialmindError, match=r"socialmind/TaughtRovers-v0 stands for .*taught"):
        register_envs(other)


def test_gymnasium_can_import_them_by_itself():
    text = "import gymnasium; print(gymnasium.make('socialmind.envs:{}').unwrapped)"
    if not SHIPPED:
        pytest.skip("no model that ships has one robot on a plane")
    done = subprocess.run(
        [sys.executable, "-c", text.format(SHIPPED[0])], capture_output=True, text=True, check=False
    )
    assert "PlaneEnv" in done.stdout, done.stderr


def test_without_gymnasium_it_says_what_to_install():
    text = (
        "import importlib.util as util\nfind = util.find_spec\n"
        "util.find_spec = lambda name, *rest: None if name == 'gymnasium' else find(name, *rest)\n"
        "try:\n    import socialmind.envs\n"
        "except ImportError as error:\n    print(error)"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout == "environments need Gymnasium: pip install 'socialmind[gym]'\n"
