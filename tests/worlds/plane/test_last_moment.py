"""What is earned in the last moment is paid: at a death, at the end of an episode, at a birth."""

import pytest

from socialmind import Model, Population, each, parameter
from socialmind.experiments import score
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.learning.imprinting.plane_world import PlaneWorld
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.worlds.plane import (
    Disc,
    Interruption,
    Measure,
    Plane,
    Reward,
    Robot,
    constant,
    paid,
    total,
    wheel,
)

MIND = MindDescription(
    "goer",
    ["S"],
    ["W"],
    skills=[Skill("Go", ["SE:S"], ["MO:W"], Perceptron(layers=0), [0.0, 1.0])],
)


class Worker(Robot):
    """A robot that is paid for what it does."""

    jobs: int = 0


def work(robot, model):
    """Live as the tests below tell."""
    if model.tick == 3 and robot.id == 0:
        robot.earned += 10.0
        robot.jobs += 1
        robot.die()
    if model.tick == 4 and robot.id == 1:
        robot.earned += 5.0
        child = robot.hatch()
        child.earned += 2.0
        robot.die()
        robot.earned += 1.0  # its rule still runs to its end
    if model.tick == model.last:
        robot.earned += 3.0
        robot.jobs += 1
        model.ticked = model.tick
    if model.early and model.tick == 0 and robot.id == 0:
        robot.earned += 7.0
        robot.die()
    if model.early and model.tick == 1 and robot.id == 1:
        model.workers.create()
    if model.tick == model.flood:
        robot.earned += 1.0
        robot.die()


def late(model):
    """Tell the end, if it is told to."""
    return model.tick >= model.end


def bonus(robot, found):
    """Pay a twentieth of the jobs in sight of another robot, or half of them alone."""
    due = robot.jobs * (0.05 if found else 0.5)
    robot.jobs = 0
    return due


class Town(Model):
    """Three workers; one dies in tick 3, one in tick 4, giving birth, and all earn in tick 9."""

    ticks = 10
    count: int = parameter(3)
    last: int = parameter(9, doc="when all earn")
    flood: int = parameter(-1, doc="when all die")
    early: int = parameter(0, doc="whether the first dies in tick 0, and another takes its slot")
    end: int = parameter(1000, doc="when it is interrupted")
    ticked: int = 0
    world = Plane(20.0)
    workers = Population(
        Worker,
        "count",
        body=Disc(),
        sensors={"S": constant(0.5)},
        actuators={"W": wheel((0.0, 0.0))},
        hierarchy=MIND,
    )
    rewards = {"paid": paid()}  # noqa: RUF012
    interruptions = {"late": Interruption(late)}  # noqa: RUF012
    measures = {  # noqa: RUF012
        "jobs": total("jobs"),
        "score": total("score"),
        "lived": Measure(len, ("jobs",)),
    }
    schedule = (each(workers, work),)


SCORES = [10.0, 6.0, 3.0, 5.0]
"""Of those who have lived, the one that was born last: 2 when it was, 3 in the last tick."""


@pytest.mark.parametrize("engine", ["compiled", "pymunk"])
def test_episodes_and_measures_pay_the_dead_the_born_and_the_last_tick(engine):
    outcome = Episodes(Town, record=("jobs", "score", "ticked"), physics=engine).run(None, [1, 2])
    assert outcome.fields["score"].tolist() == [[SCORES, SCORES]]
    assert outcome.score.tolist() == [[sum(SCORES) / 4] * 2]
    assert outcome.fields["jobs"].tolist() == [[[1, 0, 1, 1]] * 2]
    assert outcome.lived["jobs"].tolist() == [[4, 4]]
    assert outcome.fields["ticked"].tolist() == [[9, 9]]
    found = score(Town, episodes=2, workers=1, engine=engine).frame
    assert found[["jobs", "score", "lived"]].to_numpy().tolist() == [[3.0, 24.0, 4.0]] * 2


@pytest.mark.parametrize("compiled", [True, False])
def test_a_run_pays_the_dead_in_their_tick_and_goes_on(compiled):
    town = Town(seed=1, compiled=compiled)
    town.advance(4)
    assert town.workers.id.tolist() == [1, 2]
    assert town.series()["score"] == 10.0 / 3
    town.advance(1)
    # The newly born has neither what its parent earned nor its score.
    assert [town.workers.id.tolist(), town.workers.earned.tolist()] == [[2, 3], [0.0, 2.0]]
    assert town.series()["score"] == 16.0 / 4
    town.advance(5)
    # A run may go on: what is earned last is paid then, and in no other way.
    assert town.workers.score.tolist() == [0.0, 2.0] and town.workers.earned.tolist() == [3.0, 3.0]
    longer = Town(seed=1, compiled=compiled)
    longer.restore(town.state())
    longer.advance(1)
    assert longer.workers.score.tolist() == [3.0, 5.0]


@pytest.mark.parametrize("compiled", [True, False])
def test_when_all_have_died_their_scores_are_left(compiled):
    town = Town(seed=1, compiled=compiled, flood=1)
    town.advance(5)
    assert len(town.workers) == 0
    assert town.series() == {"workers": 0, "score": 1.0, "ticked": 0, "over": None}
    assert all(len(column) == 0 for column in town.agents().values())


def test_an_episode_without_survivors_has_the_score_of_the_dead():
    for engine in ("compiled", "pymunk"):
        drowned = Episodes(Town, parameters={"flood": 2}, physics=engine)
        assert drowned.run(None, [5]).score.tolist() == [[1.0]]


def test_ones_own_reward_can_settle():
    rewards = {"bonus": Reward(bonus, of="workers", reach=50.0, settles=True)}
    town = type("Bonus", (Town,), {"rewards": rewards})(seed=1, compiled=False, flood=4)
    town.advance(4)
    assert town.series()["score"] == 0.05 / 3
    town.advance(1)
    assert town.series()["score"] == 0.05 / 4
    longer = type("Bonus", (Town,), {"rewards": rewards})(seed=1, compiled=False, last=6)
    longer.advance(7)
    longer.ground.settle()
    assert longer.workers.score.tolist() == [0.05, 0.05]


def test_whoever_shows_a_skill_is_paid_for_the_last_tick():
    world = PlaneWorld(Town, "Go", parameters={"count": 1})
    assert world(lambda inputs: [0.5], 1) == 10.0  # it dies in tick 3
    assert world(lambda inputs: [0.5], 1) == Episodes(Town, {"count": 1}).run(None, [1]).score
    late = PlaneWorld(Town, "Go", parameters={"count": 1, "last": 1}, ticks=2)
    assert late(lambda inputs: [0.5], 1) == 3.0


def test_in_an_environment_of_each_robot():
    pytest.importorskip("pettingzoo")
    from socialmind.envs import PlaneParallelEnv

    for engine in ("compiled", "pymunk"):
        world = PlaneParallelEnv(Town, physics=engine)
        world.reset(seed=1)
        paid, told = dict.fromkeys(world.agents, 0.0), {}
        while world.agents:
            _, rewards, ended, up, infos = world.step({})
            for agent, reward in rewards.items():
                paid[agent] += reward
                told[agent] = ended[agent], up[agent], infos[agent]["tick"], infos[agent]["score"]
        assert list(paid.values()) == SCORES[:3]
        assert told == {
            "workers_0": (True, False, 4, 10.0),
            "workers_1": (True, False, 5, 6.0),
            "workers_2": (False, True, 10, 3.0),
        }


def test_in_the_environment_of_one_robot_its_death_ends_the_episode():
    pytest.importorskip("gymnasium")
    from socialmind.envs import PlaneEnv

    world = PlaneEnv(Town, parameters={"count": 1})
    world.reset(seed=1)
    steps = [world.step([0.5]) for _ in range(4)]
    assert [one[1:4] for one in steps] == [
        (0.0, False, False), (0.0, False, False), (10.0, True, False), (0.0, True, False),
    ]  # fmt: skip
    assert [one[4]["score"] for one in steps] == [0.0, 0.0, 10.0, 10.0]


def test_a_death_in_the_tick_of_the_reset_is_told_by_the_first_step():
    pytest.importorskip("pettingzoo")
    from socialmind.envs import PlaneParallelEnv

    world = PlaneParallelEnv(Town, parameters={"early": 1})
    observations, infos = world.reset(seed=1)
    assert list(observations) == list(infos) == world.agents == world.possible_agents
    _, rewards, ended, _, infos = world.step({agent: [1.0] for agent in world.agents})
    assert rewards == {"workers_0": 7.0, "workers_1": 0.0, "workers_2": 0.0}
    assert ended == {"workers_0": True, "workers_1": False, "workers_2": False}
    assert infos["workers_0"]["score"] == 7.0
    assert world.agents == ["workers_1", "workers_2"]


def test_what_is_earned_in_the_tick_of_the_reset_is_paid_once_by_the_first_step():
    pytest.importorskip("gymnasium")
    pytest.importorskip("pettingzoo")
    from socialmind.envs import PlaneEnv, PlaneParallelEnv

    one = PlaneEnv(Town, parameters={"count": 1, "last": 0})
    one.reset(seed=1)
    assert [one.step([0.5])[1] for _ in range(3)] == [3.0, 0.0, 10.0]
    many = PlaneParallelEnv(Town, parameters={"count": 2, "last": 0})
    many.reset(seed=1)
    assert [list(many.step({})[1].values()) for _ in range(3)] == [
        [3.0, 3.0], [0.0, 0.0], [10.0, 0.0],
    ]  # fmt: skip


@pytest.mark.parametrize("compiled", [True, False])
def test_the_last_look_is_at_the_world_as_it_ended(compiled):
    town = Town(seed=1, compiled=compiled, end=2)
    town.advance(2)
    town.tables["workers"].rows["readings"] = 0.0
    town.advance(1)
    assert town.over == "late"
    assert town.tables["workers"].rows["readings"][:3].tolist() == [[0.5]] * 3
