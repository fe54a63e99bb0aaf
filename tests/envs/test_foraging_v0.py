"""The foraging robots as a parallel environment of PettingZoo."""

import warnings

import numpy as np
import pytest

pytest.importorskip("pettingzoo")
from pettingzoo.test import parallel_api_test

from socialmind.catalogue import load_model
from socialmind.envs import foraging_v0

HELD = 40
"""Ticks for which an action is held, so that robots get somewhere."""


def actions(ticks, agents):
    """Return an action of each agent for each tick, (ticks, agents, actuators)."""
    draws = np.random.default_rng(7).random((ticks // HELD + 1, agents, 4), np.float32)
    draws[..., :2] = 0.4 + 0.6 * draws[..., :2]  # wheels, ahead for the most part
    return np.repeat(draws, HELD, axis=0)


def whole_episode(env, seed):
    """Return the agents' observations and rewards, tick by tick, and how the episode ended."""
    observations, _ = env.reset(seed=seed)
    agents = list(env.agents)
    told = actions(10_000, len(agents))
    seen = [[observations[agent] for agent in agents]]
    paid, ended = [], {}
    while env.agents:
        commands = dict(zip(agents, told[len(seen)], strict=True))
        observations, rewards, terminations, truncations, infos = env.step(commands)
        seen.append([observations[agent] for agent in agents])
        paid.append([rewards[agent] for agent in agents])
        ended = {"terminated": terminations, "truncated": truncations, "infos": infos}
    return np.array(seen), np.array(paid), ended


def test_pettingzoo_finds_nothing_wrong():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        parallel_api_test(foraging_v0.parallel_env(), num_cycles=300)
        parallel_api_test(foraging_v0.parallel_env(ticks=60, physics="pymunk"), num_cycles=100)


def test_there_are_four_agents_with_the_bodies_sensors_and_actuators():
    env = foraging_v0.parallel_env()
    robots = load_model("foraging").populations["robots"]
    assert str(env) == "foraging_v0"
    assert env.possible_agents == [f"robots_{number}" for number in range(4)]
    for agent in env.possible_agents:
        assert env.observation_space(agent).shape == (len(robots.sensors),)
        assert env.action_space(agent).shape == (len(robots.actuators),) == (4,)
    assert foraging_v0.parallel_env(parameters={"n_robots": 7}).max_num_agents == 7


def test_whole_episodes_repeat_themselves_to_the_last_step():
    first, other = foraging_v0.parallel_env(), foraging_v0.parallel_env()
    seen, paid, ended = whole_episode(first, 5)
    assert seen.shape == (10_000, 4, 22) and paid.shape == (9_999, 4)
    assert all(ended["truncated"].values()) and not any(ended["terminated"].values())
    assert len(np.unique(seen)) > 10_000
    for env in (other, first):  # the second time one that has been used
        again, paid_again, ended_again = whole_episode(env, 5)
        assert np.array_equal(seen, again)
        assert np.array_equal(paid, paid_again)
        assert ended == ended_again
    assert not np.array_equal(seen[:100], beginning(first, 6, 100))


def beginning(env, seed, ticks):
    """Return the observations of the first ticks of another episode."""
    observations, _ = env.reset(seed=seed)
    seen = [list(observations.values())]
    for told in actions(ticks, 4)[1:ticks]:
        observations, *_ = env.step(dict(zip(env.possible_agents, told, strict=True)))
        seen.append(list(observations.values()))
    return np.array(seen)


def test_who_brings_an_object_home_is_rewarded_alone():
    env = foraging_v0.parallel_env(parameters={"cluster_size": 1})
    env.reset(seed=2)
    model = env.model
    (ball,) = model.tables["objects"].slots.tolist()
    balls, robots = model.tables["objects"].rows, model.tables["robots"].rows
    robots["x"][1], robots["y"][1] = balls["x"][ball] - 2.5, balls["y"][ball]
    robots["angle"][1] = 0.0
    still = np.array([0.5, 0.5, 0.5, 0.0], np.float32)
    grip, let_go = still.copy(), still.copy()
    grip[2], let_go[2] = 1.0, 0.0
    for _ in range(3):
        env.step({"robots_1": grip})
    assert robots["carrying"][1] >= 0
    robots["x"][1] = robots["y"][1] = 0.0
    env.step({"robots_1": grip})
    earned = dict.fromkeys(env.agents, 0.0)
    for _ in range(4):
        _, rewards, *_ = env.step({"robots_1": let_go})
        earned = {agent: earned[agent] + one for agent, one in rewards.items()}
    assert earned == {"robots_0": 0.0, "robots_1": 1.0, "robots_2": 0.0, "robots_3": 0.0}


def test_its_picture_shows_the_arena():
    env = foraging_v0.parallel_env(render_mode="rgb_array")
    env.reset(seed=1)
    picture = env.render()
    assert picture.dtype == np.uint8 and picture.shape[2] == 3
    for told in actions(60, 4)[:60]:
        env.step(dict(zip(env.possible_agents, told, strict=True)))
    assert not np.array_equal(picture, env.render())
