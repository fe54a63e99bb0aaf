"""Models on a plane: one world at both speeds and by either engine, stopped and gone on with."""

import itertools
import math
from pathlib import Path

import numpy as np
import pytest

from socialmind import Agent, Model, ModelError, Population, RuleError, SocialmindError, each
from socialmind.sources.loading import load_file
from socialmind.worlds.plane import (
    BALL,
    Act,
    Body,
    Disc,
    Interruption,
    Obstacle,
    Plane,
    RangeFinder,
    Reward,
    Robot,
    Sense,
    Zone,
    collision,
    wheel,
)

HERE = Path(__file__).parent
MENAGERIE = load_file(HERE / "menagerie" / "model.py")


def menagerie(seed, **arguments):
    """The small world with a bit of everything; its collectors nearly go to balls."""
    left, right, claw = [1, 0, 0, 0, 0.25], [-1, 0, 0, 0, 1.25], [0, 0.8, 0, -1, 0.1]
    genome = np.random.default_rng(seed).normal([*left, *right, *claw], 0.1)
    collect = MENAGERIE.COLLECTOR.skill("Collect").changed(genome=genome)
    mind = MENAGERIE.COLLECTOR.with_modules(skills=[collect])
    return MENAGERIE.Menagerie(seed=seed, hierarchy={"collectors": mind}, **arguments)


def everything(model):
    """All that a model is: the living of each population, its variables, its tick and its end."""
    found = {name: table.id.tolist() for name, table in model.tables.items()}
    for name, table in model.tables.items():
        for field in table.dtype.names:
            if field not in ("_slot", "_mind"):
                found[name, field] = table.rows[field][table.slots].tolist()
    variables = {name: getattr(model, name) for name in model.variables}
    return found | variables | {"tick": model.tick, "over": model.over}


@pytest.mark.parametrize("seed", range(6))
def test_interpreted_and_compiled_are_equal_to_the_last_bit(seed):
    fast, slow = menagerie(seed), menagerie(seed, compiled=False)
    for _ in range(6):
        fast.advance(25)
        slow.advance(25)
        assert everything(fast) == everything(slow)


def test_the_world_has_a_bit_of_everything():
    fast = menagerie(5)
    carried = False
    for _ in range(150):
        fast.advance(1)
        carried |= bool((fast.balls.carrier_kind >= 0).any())
    assert carried
    assert fast.balls.id.max() > 2 and fast.scouts.id.max() > 5  # born
    assert len(fast.balls) <= fast.balls.id.max()  # and dead
    assert fast.collectors.collisions.sum() + fast.scouts.collisions.sum() > 0
    assert fast.born > 0


@pytest.mark.parametrize(
    ("physics", "first", "then"),
    [
        ("compiled", True, False),
        ("compiled", False, True),
        ("compiled", True, True),
        ("pymunk", True, True),
        ("pymunk", True, False),
    ],
)
def test_a_restored_world_goes_on_as_if_never_stopped(physics, first, then):
    whole = menagerie(5, physics=physics, compiled=first)
    whole.advance(90)
    part = menagerie(5, physics=physics, compiled=first)
    part.advance(37)
    state = part.state()
    going = menagerie(5, physics=physics, compiled=then)
    going.advance(11)  # whatever it did before
    going.restore(state)
    going.advance(53)
    assert everything(going) == everything(whole)


def test_the_engines_agree_until_impacts_part_them():
    by_kernel, by_pymunk = menagerie(1), menagerie(1, physics="pymunk")
    for model in (by_kernel, by_pymunk):
        model.advance(3)
    for name in ("x", "y", "angle", "vx", "vy"):
        ours, theirs = getattr(by_kernel.scouts, name), getattr(by_pymunk.scouts, name)
        assert ours == pytest.approx(theirs, abs=1e-6)


def test_interpreted_and_compiled_are_equal_by_pymunk_too():
    fast, slow = (menagerie(2, physics="pymunk", compiled=one) for one in (True, False))
    for model in (fast, slow):
        model.advance(80)
    assert everything(fast) == everything(slow)


# The order of a tick -----------------------------------------------------------------------------


class Witness(Robot):
    """A robot that notes what it sees, when."""

    sensed: float = -1.0
    judged: float = -1.0
    ruled: float = -1.0
    acted: float = -1.0
    watched: float = -1.0


def sense(robot):
    robot.sensed = robot.x
    return min(robot.acted, 1.0)


def act(robot, command, before):
    robot.acted = robot.judged + 0.25 * (command + before)
    robot.push_x += 60.0


def judge(robot):
    robot.judged = robot.x
    return 1.0


def watch(robot, limit=2.0):
    robot.watched = robot.reward
    return robot.x > limit


def rule(robot, model):
    robot.ruled = robot.sensed
    robot.commands[0] = 1.0
    if robot.id == 0:
        robot.touching = model.tick > 1000


class Order(Model):
    world = Plane(50.0)
    robots = Population(
        Witness, 1, body=Disc(), sensors={"S": Sense(sense)}, actuators={"A": Act(act)}
    )
    rewards = {"judge": Reward(judge)}  # noqa: RUF012
    interruptions = {"watch": Interruption(watch)}  # noqa: RUF012
    schedule = (each(robots, rule),)


@pytest.mark.parametrize("compiled", [True, False])
def test_a_tick_moves_rewards_interrupts_acts_senses_and_keeps_house(compiled):
    model = Order(compiled=compiled)
    robot = model.robots[0]
    robot.vx = 3.0
    model.advance(1)
    moved = 3.0 / (1 + 5 / 30) / 30
    assert robot.x == pytest.approx(moved)
    assert robot.judged == robot.sensed == robot.ruled == robot.x
    assert robot.watched == robot.reward == robot.score == 1.0
    # Before the first evaluation commands are a half.
    assert robot.acted == robot.judged + 0.25 and robot.readings[0] == pytest.approx(robot.acted)
    model.advance(1)
    assert robot.acted == robot.judged + 0.25 * (1.0 + 0.5)
    assert robot.push_x == 60.0  # zeroed in each tick before actuators act
    assert robot.score == 2.0


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
def test_an_interruption_ends_all_but_the_ticks(compiled, physics):
    model = Order(compiled=compiled, physics=physics)
    model.robots[0].vx = 10.0
    while model.over is None:
        model.advance(1)
    assert model.over == "watch" and model.series()["over"] == "watch"
    tick, before = model.tick, model.robots.rows.copy()
    robot = model.robots[0]
    # Motion, rewards, a last look, and no more.
    assert robot.sensed == robot.x > 2.0 > robot.ruled
    state = model.state()
    model.advance(5)
    assert model.tick == tick + 5 and (model.robots.rows == before).all()
    again = Order(compiled=compiled, physics=physics)
    again.restore(state)
    again.advance(5)
    assert again.over == "watch" and everything(again) == everything(model)


# What devices see --------------------------------------------------------------------------------


class Thing(Agent):
    """Something without a body."""


def holds(held, found):
    return 0.5 + 0.5 * held if found else 0.0


def put(thing):
    thing.x = 3.0


@pytest.mark.parametrize("compiled", [True, False])
def test_what_has_no_body_is_never_held(compiled):
    class Seeing(Model):
        world = Plane(20.0)
        things = Population(Thing, 1)
        zones = Population(Zone, 1)
        balls = Population(Body, 2, body=BALL)
        robots = Population(
            Robot,
            1,
            body=Disc(),
            sensors={
                "thing": Sense(holds, of="things", free=False),
                "zone": Sense(holds, of="zones"),
                "ball": Sense(holds, of="balls", free=False, reach=1.0),
                "other": Sense(holds, of="balls", reach=50.0),
            },
        )
        setup = (each(things, put), each(balls, put))

    model = Seeing(compiled=compiled)
    model.advance(1)
    assert list(model.robots[0].readings) == [0.5, 0.5, 0.0, 0.5]
    ball = model.balls[0]
    ball.carrier_kind, ball.carrier = 1, 0
    ball.x = 0.5
    model.advance(1)
    # A carried one stands two radii ahead, out of the reach; looked for without a reach it is held.
    assert list(model.robots[0].readings) == [0.5, 0.5, 0.0, 0.5]


def test_range_finders_and_bodies_meet_obstacles_where_rules_have_moved_them():
    def away(stone, model):
        stone.x = 10.0 if model.tick < 2 else 3.0
        if model.tick == 6:
            stone.die()

    class Moving(Model):
        world = Plane(40.0)
        stones = Population(Obstacle, 1)
        robots = Population(Robot, 1, body=Disc(), sensors={"S": RangeFinder(0.0, rays=1)})
        setup = (each(stones, away),)
        schedule = (each(stones, away),)

    readings = {}
    for compiled, physics in itertools.product((True, False), ("compiled", "pymunk")):
        model = Moving(compiled=compiled, physics=physics)
        seen = []
        for tick in range(9):
            if tick == 4:
                model.robots[0].x = 1.5
                state = model.state()
                model = Moving(compiled=compiled, physics=physics)
                model.restore(state)
            model.advance(1)
            seen.append((model.robots[0].readings[0], model.robots[0].contact))
        readings[compiled, physics] = seen
    ours = readings[True, "compiled"]
    assert [round(12 * reading, 9) for reading, _ in ours] == [8, 8, 8, 1, 0, 0, 0, 12, 12]
    assert [contact for _, contact in ours] == [0, 0, 0, 0, 1, 0, 0, 0, 0]
    for seen in readings.values():
        assert seen == [(pytest.approx(reading), contact) for reading, contact in ours]


# What fails --------------------------------------------------------------------------------------


def brittle(robot, model):
    return 1.0 / (3 - model.tick)


def nowhere(robot, model, command):
    robot.push_x = math.inf if model.tick == 3 else command


@pytest.mark.parametrize(
    ("kind", "who"),
    [("sensors", "the sensor 'weak'"), ("rewards", "the reward 'weak'")],
)
@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
def test_a_device_that_fails_says_which_it_is_and_where(kind, who, compiled, physics):
    sensors = {"weak": Sense(brittle)} if kind == "sensors" else {"S": RangeFinder()}
    attributes = {
        "world": Plane(20.0),
        "robots": Population(Robot, 2, body=Disc(), sensors=sensors),
        "rewards": {"weak": Reward(brittle)} if kind == "rewards" else {},
    }
    model = type("Brittle", (Model,), attributes)(compiled=compiled, physics=physics)
    model.robots[0].vx = 3.0
    with pytest.raises(RuleError) as caught:
        model.advance(10)
    line = brittle.__code__.co_firstlineno + 1
    assert str(caught.value).startswith(f"{__file__}:{line}: ZeroDivisionError")
    assert f"in tick 3, {who} of agent 0 of 'robots'" in str(caught.value)
    # What moved in the tick that failed moved once.
    speeds = 3.0 * np.cumprod(np.full(4, 1 / (1 + 5 / 30)))
    assert model.robots[0].x == pytest.approx(speeds.sum() / 30)


def test_a_sensor_that_is_no_number_is_said_with_its_function():
    def lost():
        return math.nan

    class Lost(Model):
        world = Plane(20.0)
        robots = Population(Robot, 1, body=Disc(), sensors={"lost": Sense(lost)})

    for compiled in (True, False):
        with pytest.raises(RuleError, match=r"test_arena.py:\d+: ValueError: a sensor gave a valu"):
            Lost(compiled=compiled).advance(1)


@pytest.mark.parametrize("compiled", [True, False])
@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
def test_motion_that_is_not_finite_is_refused(compiled, physics):
    class Racing(Model):
        world = Plane(20.0)
        robots = Population(Robot, 1, body=Disc(), actuators={"A": Act(nowhere)})

    with pytest.raises(ModelError, match="agent 0 of 'robots', whose motion is not finite"):
        Racing(compiled=compiled, physics=physics).advance(10)


def test_births_lose_no_tick_by_any_engine():
    def breed(ball, model):
        if model.tick % 2 == 0:
            born = ball.hatch()
            born.x += 1.0 + ball.id

    class Growing(Model):
        world = Plane(200.0)
        balls = Population(Body, 1, body=Disc(linear_damping=0.0))
        schedule = (each(balls, breed),)

    ways = itertools.product((True, False), ("compiled", "pymunk"))
    ended = []
    for compiled, physics in ways:
        model = Growing(compiled=compiled, physics=physics)
        model.balls[0].vx = 0.3
        model.advance(14)
        assert model.tick == 14 and len(model.balls) == 2**7
        ended.append(sorted(model.balls.x.tolist()))
        assert model.balls[0].x == pytest.approx(14 * 0.3 / 30)
    assert all(places == pytest.approx(ended[0]) for places in ended)


def test_an_engine_that_there_is_not_is_refused():
    with pytest.raises(SocialmindError, match="found 'pymunc'; did you mean 'pymunk'"):
        Order(physics="pymunc")

    class Flat(Model):
        pass

    with pytest.raises(SocialmindError, match="physics='pymunk' for flat, which has no plane"):
        Flat(physics="pymunk")


def test_rules_leave_the_evaluation_to_the_plane():
    def twice(collector):
        collector.hierarchy.evaluate()

    model = MENAGERIE.Menagerie
    schedule = (each(model.collectors, twice),)
    with pytest.raises(ModelError, match=r"evaluate.. of 'collectors', whose hierarchies"):
        type("Twice", (model,), {"schedule": schedule})()


def test_the_dead_are_heard_no_more():
    """What the dead would command a shared variable of their group does not count."""
    model = menagerie(3)
    model.advance(150)
    slow = menagerie(3, compiled=False)
    slow.advance(150)
    for one in (model, slow):
        minds = one.scouts.minds
        dead = ~one.scouts.alive
        # Those who died in the last tick leave before the next evaluation.
        one.advance(1)
        assert (minds.state.group[dead & ~one.scouts.alive] == -1).all()
    assert everything(model) == everything(slow)


# Under Mesa --------------------------------------------------------------------------------------


def test_it_is_a_mesa_model_until_an_interruption_ends_it():
    pytest.importorskip("mesa")
    model = Order().mesa()
    model.society.robots[0].vx = 10.0
    while model.running:
        model.step()
    assert model.society.over == "watch" and model.tick < 1000
    frame = model.datacollector.get_model_vars_dataframe()
    assert frame["over"].iloc[-1] == "watch" and frame["score"].iloc[-1] == model.tick
    (agent,) = model.agents
    assert agent.x > 2.0
    with pytest.raises(AttributeError, match="has no patches"):
        _ = model.grid


# What is recorded --------------------------------------------------------------------------------


class Bumper(Robot):
    bumps: int = 0


class Bumping(Model):
    world = Plane(3.0)
    robots = Population(
        Bumper,
        2,
        body=Disc(),
        sensors={"S1": RangeFinder()},
        actuators={"L": wheel((0.0, 1.0)), "R": wheel((0.0, -1.0))},
    )
    interruptions = {"collision": collision()}  # noqa: RUF012


def test_robots_are_recorded_where_they_are_and_how_they_fare():
    model = Bumping(without=("collision",))
    model.robots[0].vx, model.robots[0].vy = 3.0, 4.0
    recorded = model.agents()
    assert list(recorded) == [
        "agent", "x", "y", "angle", "speed", "carrying", "battery", "collisions", "score", "bumps",
    ]  # fmt: skip
    assert recorded["speed"].tolist() == [5.0, 0.0]
    assert list(model.series()) == ["robots", "score", "over"]
    model.robots[0].vx = 60.0
    model.advance(2)
    assert model.series()["over"] is None  # it is left out
    assert model.agents()["collisions"].tolist() == [1, 0]


def test_teams_are_recorded_one_after_another():
    recorded = menagerie(1).agents()
    assert recorded["population"] == ["scouts"] * 3 + ["collectors"] * 2
    assert recorded["agent"] == [0, 1, 2, 0, 1]
    assert recorded["brought"] == [None, None, None, 0, 0]
    assert recorded["generation"] == [0, 0, 0, None, None]
