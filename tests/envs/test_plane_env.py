"""The environment of a robot: what it sees, does and is paid, and that it repeats itself."""

import copy
import pickle

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from socialmind.envs import PlaneEnv
from socialmind.errors import SocialmindError

FORWARD = np.ones(2, np.float32)


def episode(env, seed, actions):
    """Return all that an episode tells."""
    told = [env.reset(seed=seed)]
    for action in actions:
        told.append(env.step(action))
        if told[-1][2] or told[-1][3]:
            break
    return told


def repacked(env):
    """Return what is read from the bytes of an environment."""
    return pickle.loads(pickle.dumps(env))


def equal(first, other):
    return len(first) == len(other) and all(
        np.array_equal(one[0], two[0]) and one[1:] == two[1:]
        for one, two in zip(first, other, strict=True)
    )


def test_gymnasium_finds_nothing_wrong(rover, recwarn):
    check_env(rover, skip_render_check=True)
    # A spec, which the check asks for, is what `make` gives; see test_registration.
    warned = [str(one.message) for one in recwarn if "render modes" not in str(one.message)]
    assert warned == []


def test_spaces_are_those_of_the_body(rover):
    assert rover.observation_space == gymnasium.spaces.Box(0.0, 1.0, (2,), np.float32)
    assert rover.action_space == gymnasium.spaces.Box(0.0, 1.0, (2,), np.float32)
    observation, info = rover.reset(seed=1)
    # From the rim of a robot in the middle the border is 5 away at least, 7.5 in a corner's
    # direction, of 12; the other sensor is constant.
    assert 5 / 12 - 1e-6 <= observation[0] <= (6 * np.sqrt(2) - 1) / 12
    assert observation[1] == 0.5
    assert (info["tick"], info["over"]) == (1, None)


@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
def test_whole_episodes_repeat_themselves(rovers, physics):
    actions = np.random.default_rng(5).random((100, 2), np.float32)
    first, other = PlaneEnv(rovers, physics=physics), PlaneEnv(rovers, physics=physics)
    told = episode(first, 3, actions)
    assert len(told) > 30
    assert equal(told, episode(other, 3, actions))
    # An environment that has been used repeats itself as well, and other seeds are other worlds.
    assert equal(told, episode(first, 3, actions))
    assert not equal(told, episode(first, 4, actions))
    assert not equal(told, episode(first, None, actions))


def test_what_the_tick_of_the_reset_paid_is_in_the_first_reward_alone(rover, monkeypatch):
    monkeypatch.setattr(PlaneEnv, "_column", lambda env, name: 3.0)  # paid in every tick
    rover.reset(seed=1)
    assert [rover.step(FORWARD)[1] for _ in range(3)] == [6.0, 3.0, 3.0]


def test_worlds_follow_one_another_from_one_seed(rover, rovers):
    worlds = [rover.reset(seed=one)[1]["world"] for one in (7, None, None)]
    assert len(set(worlds)) == 3
    again = PlaneEnv(rovers)
    assert [again.reset(seed=one)[1]["world"] for one in (7, None, None)] == worlds


def test_who_acts_as_the_mind_does_lives_through_the_same_episode(rover, rovers):
    _, info = rover.reset(seed=11)
    model = rovers(seed=info["world"])
    total = 0.0
    for _ in range(100):
        _, reward, terminated, truncated, info = rover.step(FORWARD)
        total += reward
        if terminated or truncated:
            break
    while model.over is None and model.tick < rovers.ticks:
        model.advance()
    assert (info["tick"], info["over"]) == (model.tick, model.over)
    assert terminated == (model.over is not None)
    mine, its = (one.tables["rovers"].rows[0] for one in (rover.model, model))
    assert mine == its
    assert total == pytest.approx(its["score"], abs=1e-12) and total > 0


def test_a_world_can_be_chosen(rover, rovers):
    rover.reset(options={"world": 42})
    assert rover.model.tables["rovers"].angle.tolist() == rovers(seed=42).rovers.angle.tolist()


@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
@pytest.mark.parametrize("copied", [copy.deepcopy, copy.copy, repacked])
def test_copies_go_on_alike_and_on_their_own(copied, physics, rovers):
    actions = np.random.default_rng(5).random((20, 2), np.float32)
    env = PlaneEnv(rovers, physics=physics, render_mode="rgb_array")
    assert copied(env).model is None
    env.reset(seed=3)
    env.step(FORWARD)
    env.render()
    other = copied(env)
    theirs = [other.step(action) for action in actions]
    before = env.model.rovers.x.tolist()
    assert equal(theirs, [env.step(action) for action in actions])
    assert before != env.model.rovers.x.tolist()
    assert np.array_equal(other.render(), env.render())
    assert other.reset()[1] == env.reset()[1]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"wrld": 3}, "the option 'wrld' of reset.*did you mean 'world'"),
        ({"world": 1.7}, "the option 'world': found 1.7; expected a whole number, 0 … 2"),
        ({"world": -1}, "the option 'world': found -1"),
        ({"world": True}, "the option 'world': found True"),
        ({"world": "7"}, "the option 'world': found '7'"),
    ],
)
def test_options_that_there_are_not_are_refused(rover, options, message):
    with pytest.raises(SocialmindError, match=message):
        rover.reset(options=options)
    rover.reset(options={"world": np.int64(7)})
    assert rover.model.seed == 7


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"parameters": {"half_wdth": 9.0}}, "no parameter 'half_wdth'"),
        ({"without": "colision"}, "no interruption 'colision'; did you mean 'collision'"),
        ({"without": ["colision"]}, "no interruption 'colision'"),
        ({"physics": "pymonk"}, "no engine 'pymonk'; did you mean 'pymunk'"),
        ({"ticks": 50.5}, "ticks: found 50.5; expected a whole number"),
    ],
)
def test_arguments_are_refused_at_once(rovers, arguments, message):
    with pytest.raises(SocialmindError, match=message):
        PlaneEnv(rovers, **arguments)
    assert PlaneEnv(rovers, without="collision").reset(seed=1)[1]["over"] is None


@pytest.mark.parametrize(
    ("action", "message"),
    [
        ([0.5], r"an action of shape \(1,\); expected \(2,\): MotL, MotR"),
        ([[0.5, 0.5]], r"an action of shape \(1, 2\)"),
        (0.5, r"an action of shape \(\)"),
        ([np.nan, 0.5], "an action: found .*nan.*; expected numbers, 0 … 1"),
        (["a", "b"], "an action: found .*; expected numbers"),
        (None, r"an action of shape \(\)|expected numbers"),
    ],
)
def test_actions_that_are_none_are_refused(rover, action, message):
    rover.reset(seed=1)
    with pytest.raises(SocialmindError, match=message):
        rover.step(action)
    assert rover.model.tick == 1


def test_an_interruption_terminates_and_the_limit_truncates(rovers):
    ended = episode(PlaneEnv(rovers, ticks=60), 1, [FORWARD] * 100)
    assert ended[-1][2:4] == (True, False)
    assert ended[-1][4]["over"] == "collision"
    # Nothing happens any more.
    env = PlaneEnv(rovers)
    episode(env, 1, [FORWARD] * 100)
    before = env.model.tick
    assert env.step(FORWARD)[1:4] == (0.0, True, False)
    assert env.model.tick == before
    going_on = episode(PlaneEnv(rovers, ticks=60, without=["collision"]), 1, [FORWARD] * 100)
    assert going_on[-1][2:4] == (False, True)
    assert (len(going_on), going_on[-1][4]["tick"]) == (60, 60)


def test_actions_are_held_to_what_there_is(rover):
    rover.reset(seed=1)
    rover.step(np.array([-3.0, 7.0], np.float32))
    assert rover.model.tables["rovers"].rows["commands"][0].tolist() == [0.0, 1.0]


def test_pictures_follow_the_robot(rovers):
    env = PlaneEnv(rovers, render_mode="rgb_array")
    assert env.render() is None
    env.reset(seed=1)
    first = env.render()
    assert first.dtype == np.uint8 and first.shape[2] == 3 and len(first) > 400
    for _ in range(20):
        env.step(FORWARD)
    assert not np.array_equal(first, env.render())
    assert PlaneEnv(rovers).metadata["render_fps"] == 30


def test_what_is_wrong_is_said(rover, rovers, taught):
    with pytest.raises(gymnasium.error.ResetNeeded):
        rover.step(FORWARD)
    with pytest.raises(SocialmindError, match="the model boids has no plane"):
        PlaneEnv("boids")
    with pytest.raises(SocialmindError, match=r"pair has 2 rovers; an environment of Gymnasium ha"):
        PlaneEnv(taught, "Pair")
    with pytest.raises(SocialmindError, match=r"no environment 'Pear' in .*; did you mean 'Pair'"):
        PlaneEnv(taught, "Pear")
    with pytest.raises(SocialmindError, match="render_mode 'human'"):
        PlaneEnv(rovers, render_mode="human")
    with pytest.raises(SocialmindError, match="ticks 1; expected 2 or more"):
        PlaneEnv(rovers, ticks=1)
    rover.reset()
    with pytest.raises(SocialmindError, match="expected numbers, 0 … 1"):
        rover.step([np.nan, 0.5])
