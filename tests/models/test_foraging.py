"""The world of the foraging robots, its lessons and its mind, worked out by hand."""

import math

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.experiments import score
from socialmind.mind import Hierarchy, MindDescription
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = model_folder("foraging")
WORLD = load_file(FOLDER / "model.py")
LESSONS = load_file(FOLDER / "lessons.py")
MINDS = load_file(FOLDER / "minds.py")
STILL = (0.5, 0.5, 0.5, 0.0)
SENSORS = list(WORLD.SENSORS)


def world(environment=WORLD.Foraging, seed=1, commands=STILL, **parameters):
    """Return a world whose robots are told the same thing all the time."""
    model = environment(seed, compiled=False, hierarchy=False, **parameters)
    model.steer("robots", commands)
    return model


@pytest.fixture(scope="module")
def worlds():
    return [world(seed=seed) for seed in range(10)]


def reading(model, robot, name):
    return model.tables["robots"].rows["readings"][robot][SENSORS.index(name)]


# The world ----------------------------------------------------------------------------------------


def test_a_cluster_lies_together_away_from_walls_and_drop_zone(worlds):
    places = set()
    for model in worlds:
        (cluster,) = model.clusters
        assert math.hypot(cluster.x, cluster.y) >= WORLD.FROM_ZONE
        assert max(abs(cluster.x), abs(cluster.y)) <= model.half_width - WORLD.FROM_WALLS
        balls = list(model.objects)
        assert len(balls) == model.cluster_size == 8
        for ball in balls:
            assert math.hypot(ball.x - cluster.x, ball.y - cluster.y) <= model.spread
        places.add((cluster.x, cluster.y))
    assert len(places) == len(worlds)


def test_obstacles_leave_the_middle_free(worlds):
    for model in worlds:
        assert 56 <= len(model.obstacles) <= 64
        for stone in model.obstacles:
            assert math.hypot(stone.x, stone.y) >= stone.half_width * 1.4143 + WORLD.FREE
            assert max(abs(stone.x), abs(stone.y)) <= model.half_width


def test_robots_start_around_the_middle_and_touch_nothing(worlds):
    for model in worlds:
        far = [math.hypot(robot.x, robot.y) for robot in model.robots]
        assert len(far) == 4 and max(far) <= WORLD.START
        assert len({robot.angle for robot in model.robots}) == 4


def test_robots_pass_through_each_other():
    model = world(cluster_size=0)
    for robot in model.robots:
        robot.x = robot.y = robot.angle = 0.0
    model.advance(10)
    assert [(robot.x, robot.y) for robot in model.robots] == [(0.0, 0.0)] * 4
    assert not any(robot.collisions for robot in model.robots)


def placed(model, number, x, y, angle=0.0):
    robot = model.robots[number]
    robot.x, robot.y, robot.angle = x, y, angle
    return robot


def test_robots_sense_objects_team_mates_and_signals_within_their_reach():
    model = world(cluster_size=1, sight=20.0, company=100.0, hearing=200.0)
    (ball,) = model.objects
    for number, x in enumerate((0.0, 90.0, -110.0, -119.0)):
        placed(model, number, x, 0.0)
    ball.x, ball.y = 0.0, 19.0  # to the left of the first
    model.advance(2)
    first = {name: reading(model, 0, name) for name in SENSORS}
    assert (first["ACTOBJ"], first["RADOBJ"]) == (1.0, pytest.approx(0.25))
    assert (first["ACTBOT"], first["RADBOT"]) == (1.0, pytest.approx(0.5))
    assert (first["ACTSIG"], first["RADSIG"]) == (0.0, 0.5)
    assert reading(model, 1, "ACTOBJ") == 0.0
    # Nobody is within 100 of the second but the first, at its back.
    assert reading(model, 1, "RADBOT") == pytest.approx(0.0, abs=1e-6)
    model.steer("robots", [STILL, (0.5, 0.5, 0.5, 1.0), STILL, STILL])
    model.advance(2)
    assert reading(model, 0, "ACTSIG") == 1.0
    assert reading(model, 0, "RADSIG") == pytest.approx(0.5)
    assert [reading(model, number, "ACTSIG") for number in (1, 2, 3)] == [0.0, 1.0, 0.0]


@pytest.mark.parametrize(("name", "sensor"), [("hearing", "ACTSIG"), ("company", "ACTBOT")])
def test_robots_can_be_made_deaf_or_blind_to_each_other(name, sensor):
    read = []
    for reach in (50.0, 0.0):
        model = world(commands=(0.5, 0.5, 0.5, 1.0), **{name: reach})
        model.advance(3)
        read.append({reading(model, number, sensor) for number in range(4)})
    assert read == [{1.0}, {0.0}]


# Objects ------------------------------------------------------------------------------------------


def carry_home(model, robot, ball):
    """Let a robot grip a ball, put both into the drop zone, and let go."""
    robot.x, robot.y, robot.angle = ball.x - 2.5, ball.y, 0.0
    commands = np.tile(STILL, (len(model.robots), 1))
    commands[robot.id, 2] = 1.0
    model.steer("robots", commands)
    model.advance(2)
    assert robot.carrying == ball.id
    assert reading(model, robot.id, "HOLDS") == 1.0
    robot.x = robot.y = 0.0
    model.advance(1)
    model.steer("robots", np.tile((0.5, 0.5, 0.0, 0.0), (len(model.robots), 1)))
    model.advance(2)


def test_the_robot_that_brings_an_object_home_is_paid_and_the_object_is_gone():
    model = world(cluster_size=2)
    carried, left = model.objects
    # Its claw's reach is clear of the other one.
    left.x, left.y = carried.x + 30.0, carried.y
    carry_home(model, model.robots[2], carried)
    assert [robot.delivered for robot in model.robots] == [0, 0, 1, 0]
    assert [robot.score for robot in model.robots] == [0.0, 0.0, 1.0, 0.0]
    assert [ball.id for ball in model.objects] == [left.id]
    assert model.clusters[0].number == 1


def test_another_cluster_appears_once_nothing_lies_about():
    model = world(cluster_size=1)
    (ball,) = model.objects
    before = model.clusters[0].x
    robot = placed(model, 0, ball.x - 2.5, ball.y)
    model.steer("robots", [(0.5, 0.5, 1.0, 0.0), STILL, STILL, STILL])
    model.advance(3)
    assert robot.carrying == ball.id
    assert model.clusters[0].number == 2 and model.clusters[0].x != before
    assert len(model.objects) == 2


def test_what_is_let_go_elsewhere_stays_there():
    model = world(cluster_size=2)
    carried, left = model.objects
    left.x, left.y = carried.x + 30.0, carried.y
    robot = placed(model, 1, carried.x - 2.5, carried.y)
    for claw in (1.0, 0.0):
        model.steer("robots", [STILL, (0.5, 0.5, claw, 0.0), STILL, STILL])
        model.advance(3)
    assert len(model.objects) == 2 and carried.carrier == -1 and carried.lifter == -1
    assert robot.delivered == 0


def test_without_clusters_there_is_nothing_to_find():
    model = world(cluster_size=0)
    model.advance(30)
    assert len(model.objects) == 0 and model.first_find == WORLD.UNSEEN


# Measures -----------------------------------------------------------------------------------------


def test_what_robots_see_is_noted_on_the_map():
    model = world(cluster_size=0, sight=20.0)
    for number in range(4):
        placed(model, number, 0.0, 0.0)
    model.advance(11)
    side = 2 * model.half_width / WORLD.SQUARES
    middles = (np.arange(WORLD.SQUARES) + 0.5) * side - model.half_width
    x, y = np.meshgrid(middles, middles)
    seen = np.hypot(x, y) <= 20.0
    assert model.covered == seen.sum() == 12
    chart = np.array(list(model.charts[0].seen)).reshape(seen.shape)
    assert np.array_equal(chart, seen)
    assert WORLD.share_covered(model.covered) == pytest.approx(12 / 24**2)


def test_the_first_find_is_when_a_robot_first_sees_an_object():
    model = world(cluster_size=1)
    (ball,) = model.objects
    for number in range(4):
        placed(model, number, -ball.x, -ball.y)
    model.advance(25)
    assert model.first_find == WORLD.UNSEEN
    placed(model, 3, ball.x - 10.0, ball.y)
    model.advance(10)
    assert model.first_find == 30
    assert WORLD.time_to_find(30, 1000) == 30
    assert WORLD.time_to_find(WORLD.UNSEEN, 1000) == 1000


def test_a_score_has_the_measures_of_the_scenario():
    assert list(WORLD.Foraging.measures) == ["objects", "first_find", "area", "collisions"]


# Lessons ------------------------------------------------------------------------------------------


def test_searching_pays_who_sees_a_square_first():
    model = world(LESSONS.SearchTogether)
    for number in range(4):
        placed(model, number, 0.0, 0.0)
    model.advance(12)
    assert sum(robot.score for robot in model.robots) == model.covered == 12
    assert sorted(robot.score for robot in model.robots) == [0, 0, 0, 12]
    assert len(model.objects) == 0


def test_reaching_a_lamp_pays_and_puts_it_up_elsewhere():
    model = world(LESSONS.ReachSignal)
    (robot,), (lamp,) = model.robots, model.lamps
    model.advance(2)
    assert reading(model, 0, "ACTSIG") == 1.0
    robot.x, robot.y = lamp.x - 3.0, lamp.y
    before = lamp.x
    model.advance(2)
    assert robot.score == 1.0 and lamp.x != before
    assert math.hypot(lamp.x - robot.x, lamp.y - robot.y) >= LESSONS.LESSONS.LEAP


def test_the_curriculum_teaches_the_skills_of_figure_8_2():
    learned = [lesson.skills for lesson in LESSONS.curriculum.lessons]
    assert learned == [
        ("GoToSignal", "ReachSignal"),
        ("Search",),
        ("Search", "Search+Avoid"),
        ("Forage",),
        ("Search", "Search+Avoid", "GoToSignal", "ReachSignal", "Forage"),
    ]


# The mind -----------------------------------------------------------------------------------------


def test_the_mind_is_that_of_the_lessons_on_top_of_collecting():
    mind = MindDescription.load(FOLDER / "mind")
    built, known = MINDS.forager(), MINDS.collector()
    assert mind.masters == ("Forage",)
    for name, skill in built.skills.items():
        kept = mind.skills[name]
        assert [str(one) for one in kept.inputs] == [str(one) for one in skill.inputs]
        assert [str(one) for one in kept.outputs] == [str(one) for one in skill.outputs]
        assert (kept.genome is None) == (skill.genome_size == 0)
    for name, skill in known.skills.items():
        if skill.genome is not None:
            assert np.array_equal(mind.skills[name].genome, skill.genome), name
    assert mind.actuators["SIGNAL"].neutral == 0.0


def test_a_robot_signals_while_it_sees_objects():
    mind = MindDescription.load(FOLDER / "mind")
    only = Hierarchy(mind, master="EmitSignal")
    told = [only.evaluate(dict.fromkeys(mind.sensors, 0.0) | {"ACTOBJ": one})["SIGNAL"]
            for one in (0.0, 1.0, 0.0)]  # fmt: skip
    assert told == [0.0, 1.0, 0.0]


@pytest.mark.parametrize(
    ("noise", "wheels"), [(0.05, (0.0, 1.0)), (0.15, (1.0, 0.0)), (0.2, (1.0, 1.0))]
)
def test_a_random_walk_turns_now_and_then(noise, wheels):
    mind = MINDS.walking_at_random(MINDS.forager())
    walk = Hierarchy(mind, master="Search")
    told = walk.evaluate(dict.fromkeys(mind.sensors, 0.5) | {"NOISE": noise})
    assert (told["MotL"], told["MotR"]) == wheels


def test_robots_of_the_model_forage_better_than_deaf_ones():
    """Ten worlds: margins far below what the model's mind comes to."""
    model = load_model("foraging")
    together = score(model, episodes=10, seed=3, workers=1).frame["objects"]
    deaf = score(model, episodes=10, seed=3, workers=1, parameters={"hearing": 0.0})
    assert together.mean() > 5
    assert together.mean() > deaf.frame["objects"].mean()


def test_robots_of_the_model_search_better_than_at_random():
    """Ten worlds without objects, and a share of the arena that has been seen."""
    model = load_model("foraging")
    learned = MindDescription.load(FOLDER / "mind")
    terms = {"episodes": 10, "seed": 3, "workers": 1, "ticks": 2000}
    terms["parameters"] = {"cluster_size": 0}
    seen = score(model, learned, **terms).frame["area"].mean()
    assert seen > 1.1 * score(model, MINDS.walking_at_random(learned), **terms).frame["area"].mean()
