"""The environment of several robots: what each sees, does and is paid, and that it repeats."""

import copy
import math
import pickle
import subprocess
import sys
import warnings

import gymnasium
import numpy as np
import pytest

pytest.importorskip("pettingzoo")
from pettingzoo.test import parallel_api_test

from socialmind import Model, Population, each
from socialmind.envs import PlaneEnv, PlaneParallelEnv
from socialmind.errors import SocialmindError
from socialmind.worlds.plane import (
    Disc,
    Plane,
    RangeFinder,
    Robot,
    collision,
    constant,
    forward,
    orientation,
    wheel,
)

WHEELS = {"MotL": wheel(at=(0.0, 1.0)), "MotR": wheel(at=(0.0, -1.0))}
REWARDS = {"forward": forward(0.001)}
INTERRUPTIONS = {"collision": collision()}
FORWARD = np.ones(2, np.float32)
LIFE = 60


class Walker(Robot):
    """A robot that does not live long once it is told to die."""

    age: int = 0


def start(walker, rng):
    """Turn to a random direction."""
    walker.angle = rng.uniform(-math.pi, math.pi)


def age(walker, model):
    """Die of age, the second one; the first gives birth to a third that nobody steers."""
    walker.age += 1
    if walker.age == LIFE and walker.id == 1:
        walker.die()
    if walker.age == LIFE // 2 and walker.id == 0:
        model.walkers.create()


class Convoy(Model):
    """Two walkers, one of which dies, and a cart that drives ahead of nobody."""

    ticks = 100

    world = Plane(0.0)
    walkers = Population(
        Walker,
        2,
        body=Disc(),
        sensors={"FINDER": RangeFinder(0.0), "MATE": orientation("walkers")},
        actuators=WHEELS,
    )
    carts = Population(
        Robot, 1, body=Disc(), sensors={"HALF": constant(0.5)},
        actuators={"Mot": wheel(at=(0.0, 0.0))},
    )  # fmt: skip
    beacons = Population(Robot, 1, body=Disc(), sensors={"HALF": constant(0.5)})
    rewards = REWARDS
    setup = (each(walkers, start),)
    schedule = (each(walkers, age),)


class Fenced(Convoy):
    """The same in a small arena, in which a collision ends the episode."""

    world = Plane(5.0)
    interruptions = INTERRUPTIONS


def told(env, seed, steps=10_000):
    """Return all that an episode tells, its actions drawn from the agents' own spaces."""
    for agent in env.possible_agents:
        env.action_space(agent).seed(3 + env.possible_agents.index(agent))
    observations, infos = env.reset(seed=seed)
    found = [({agent: one.tolist() for agent, one in observations.items()}, infos)]
    while env.agents and len(found) <= steps:
        actions = {agent: env.action_space(agent).sample() for agent in env.agents}
        observations, *others = env.step(actions)
        found.append(({agent: one.tolist() for agent, one in observations.items()}, *others))
    return found


@pytest.mark.parametrize("model", [Convoy, Fenced])
def test_pettingzoo_finds_nothing_wrong(model):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        parallel_api_test(PlaneParallelEnv(model), num_cycles=150)


def test_agents_are_the_robots_with_actuators():
    env = PlaneParallelEnv(Convoy)
    assert env.possible_agents == ["walkers_0", "walkers_1", "carts_0"]
    assert env.agents == []
    assert env.observation_space("walkers_1").shape == (2,)
    assert env.observation_space("carts_0").shape == env.action_space("carts_0").shape == (1,)
    assert (str(env), env.max_num_agents) == ("convoy_v0", 3)
    observations, infos = env.reset(seed=1)
    assert env.agents == env.possible_agents == list(observations) == list(infos)
    assert observations["carts_0"].tolist() == [0.5]
    assert observations["walkers_0"].dtype == np.float32
    assert (infos["walkers_1"]["tick"], infos["walkers_1"]["over"]) == (1, None)


@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
@pytest.mark.parametrize("model", [Convoy, Fenced])
def test_whole_episodes_repeat_themselves(model, physics):
    first, other = (PlaneParallelEnv(model, physics=physics) for _ in range(2))
    whole = told(first, 3)
    assert len(whole) > 20
    assert whole == told(other, 3)
    # An environment that has been used repeats itself as well, and other seeds are other worlds.
    assert whole == told(first, 3)
    assert whole != told(first, 4)
    assert whole != told(first, None)


def test_each_robot_does_what_its_agent_says():
    env = PlaneParallelEnv(Convoy)
    env.reset(seed=1)
    still = np.full(2, 0.5, np.float32)
    for _ in range(20):
        # An agent without an action stands still as well.
        _, rewards, *_ = env.step({"walkers_0": FORWARD, "walkers_1": still})
    walkers = env.model.tables["walkers"].rows
    assert np.hypot(walkers["x"][0], walkers["y"][0]) > 2
    assert (walkers["x"][1], walkers["y"][1]) == (0.0, 0.0)
    # Rewards are for the first population, and each robot has its own.
    assert rewards == {"walkers_0": 0.001, "walkers_1": 0.0, "carts_0": 0.0}


def test_who_acts_as_the_mind_does_lives_through_the_same_episode(rovers):
    alone, among = PlaneEnv(rovers), PlaneParallelEnv(rovers)
    first, info = alone.reset(seed=5)
    observations, infos = among.reset(seed=5)
    assert infos == {"rovers_0": info}
    assert observations["rovers_0"].tolist() == first.tolist()
    over = False
    while not over:
        one = alone.step(FORWARD)
        parts = among.step({"rovers_0": FORWARD})
        assert parts[0]["rovers_0"].tolist() == one[0].tolist()
        assert tuple(part["rovers_0"] for part in parts[1:]) == one[1:]
        over = one[2] or one[3]
    assert among.agents == []


def test_the_dead_are_terminated_and_the_others_go_on():
    env = PlaneParallelEnv(Convoy)
    whole = told(env, 2)
    deaths = [number for number, one in enumerate(whole[1:], 1) if one[2].get("walkers_1")]
    assert deaths == [LIFE - 1]  # the first tick was the reset's
    assert set(whole[LIFE][0]) == {"walkers_0", "carts_0"}
    assert env.model.tables["walkers"].rows[env.model.tables["walkers"].slots]["_id"].tolist() == [
        0, 2,
    ]  # fmt: skip
    last = whole[-1]
    assert last[2] == {"walkers_0": False, "carts_0": False}
    assert last[3] == {"walkers_0": True, "carts_0": True}
    assert len(whole) == Convoy.ticks


def test_an_interruption_terminates_for_all():
    env = PlaneParallelEnv(Fenced, ticks=50)
    env.reset(seed=1)
    ended = {"": False}
    while not any(ended.values()):
        _, _, ended, up, infos = env.step(dict.fromkeys(["walkers_0", "walkers_1"], FORWARD))
    assert ended == dict.fromkeys(env.possible_agents, True)
    assert not any(up.values()) and env.agents == []
    assert {one["over"] for one in infos.values()} == {"collision"}
    assert env.step({})[0] == {}
    going_on = PlaneParallelEnv(Fenced, ticks=50, without=["collision"])
    assert len(told(going_on, 1)) == 50


@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
def test_copies_go_on_alike_and_on_their_own(physics):
    env = PlaneParallelEnv(Convoy, physics=physics)
    env.reset(seed=3)
    for _ in range(LIFE):  # beyond a death and a birth
        env.step({"walkers_0": FORWARD})
    others = copy.deepcopy(env), copy.copy(env), pickle.loads(pickle.dumps(env))
    went = [[one.step({"walkers_0": FORWARD}) for _ in range(20)] for one in (*others, env)]
    told = [[(len(step[0]), *step[1:]) for step in steps] for steps in went]
    assert told[0] == told[1] == told[2] == told[3]
    seen = [[step[0]["walkers_0"].tolist() for step in steps] for steps in went]
    assert seen[0] == seen[1] == seen[2] == seen[3]


def test_pictures_follow_all_robots():
    env = PlaneParallelEnv(Convoy, render_mode="rgb_array")
    assert env.render() is None
    env.reset(seed=1)
    first = env.render()
    assert first.dtype == np.uint8 and first.shape[2] == 3
    for _ in range(20):
        env.step({"carts_0": np.ones(1, np.float32)})
    assert not np.array_equal(first, env.render())


def test_what_is_wrong_is_said():
    env = PlaneParallelEnv(Convoy)
    with pytest.raises(gymnasium.error.ResetNeeded):
        env.step({})
    env.reset(seed=1)
    with pytest.raises(SocialmindError, match="an action for 'walker_0'; expected agents among w"):
        env.step({"walker_0": FORWARD})
    with pytest.raises(SocialmindError, match=r"'walkers_0' of shape \(1,\); expected \(2,\)"):
        env.step({"walkers_0": np.ones(1)})
    with pytest.raises(SocialmindError, match=r"'walkers_0': found .*nan"):
        env.step({"walkers_0": [np.nan, 0.0]})
    with pytest.raises(SocialmindError, match="the option 'wrld' of reset"):
        env.reset(options={"wrld": 3})
    with pytest.raises(SocialmindError, match="render_mode 'human'"):
        PlaneParallelEnv(Convoy, render_mode="human")
    with pytest.raises(SocialmindError, match="the model boids has no plane"):
        PlaneParallelEnv("boids")


def test_worlds_of_one_robot_fit_as_well():
    env = PlaneParallelEnv("collect", "Avoid", ticks=20)
    assert env.possible_agents == ["robots_0"]
    assert len(told(env, 1)) == 20


def test_without_pettingzoo_it_says_what_to_install():
    text = (
        "import importlib.util as util\nfind = util.find_spec\n"
        "util.find_spec = lambda n, *rest: None if n == 'pettingzoo' else find(n, *rest)\n"
        "import socialmind.envs\n"
        "for line in ('import socialmind.envs.foraging_v0', "
        "'from socialmind.envs import PlaneParallelEnv'):\n"
        "    try:\n        exec(line)\n"
        "    except ImportError as error:\n        print(error)"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    message = "parallel environments need PettingZoo: pip install 'socialmind[pettingzoo]'\n"
    assert done.stdout == message * 2
