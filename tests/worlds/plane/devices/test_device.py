"""What every device keeps to, run over all that are registered and a modeller's own."""

import copy
import inspect
import math
import random
from types import SimpleNamespace

import numpy as np
import pytest
from own_devices import OWN

from socialmind import Model, ModelError, Population, each
from socialmind.fields import class_fields
from socialmind.language.program import Program
from socialmind.language.shape import ModelShape, PopulationShape, WorldShape
from socialmind.worlds.plane.bodies import BALL, Body, Disc, Obstacle, Robot, Zone
from socialmind.worlds.plane.devices.actuators import ACTUATORS, claw, emitter, wheel
from socialmind.worlds.plane.devices.device import GIVEN, Act, Interruption, Reward, Sense, typed
from socialmind.worlds.plane.devices.interruptions import INTERRUPTIONS
from socialmind.worlds.plane.devices.rewards import REWARDS
from socialmind.worlds.plane.devices.sensors import SENSORS, RangeFinder
from socialmind.worlds.plane.plane import Plane

ARGUMENTS = {
    "orientation": ("objects",),
    "distance_to": ("zones", 30.0),
    "active": ("objects", 4.0),
    "in_claw": ("objects",),
    "inside": ("zones",),
    "signal_orientation": ("robots", 1),
    "signal_distance": ("robots", 1, 40.0),
    "signal_active": ("robots", 1, 8.0),
    "noise": (3,),
    "moved": (5, 3),
    "constant": (0.3,),
    "identity": (4,),
    "payoff": (0.5,),
    "wheel": ((0.0, 1.0),),
    "claw": ("objects",),
    "emitter": (1,),
    "closing": ("objects", 0.1),
    "reached": ("S1", 0.5),
    "forward": (0.01,),
    "speed": (0.01,),
    "collision_cost": (0.1,),
    "exploring": (1.0, 4.0, 10),
    "straight": (0.1, 5),
    "clear": (("S1", "S2"), 0.8, 0.1),
    "over_threshold": ("S2", 0.9),
    "under_threshold": ("S2", 0.2),
    "after": (30,),
}
"""What the makers of devices are called with; those that are not here take nothing."""
MADE = {
    name: maker(*ARGUMENTS.get(name, ()))
    for makers in (SENSORS, ACTUATORS, REWARDS, INTERRUPTIONS)
    for name, maker in makers.items()
}
DEVICES = MADE | OWN
"""All devices by name."""


def of_kind(cls):
    return {name: one for name, one in DEVICES.items() if isinstance(one, cls)}


def sensed(device):
    """Return a device as a sensor, so that what it returns is seen."""
    bound = {name: getattr(device, name) for name in ("of", "at", "angle", "reach", "sensor")}
    return Sense(device.function, **bound, settings=device.settings)


class Bot(Robot):
    signal: list[float] = [0.0, 0.0]  # noqa: RUF012


def scatter(row, rng):
    row.x = rng.uniform(-9, 9)
    row.y = rng.uniform(-9, 9)
    row.angle = rng.uniform(-3, 3)


def drive(robot, model, rng):
    """Command the robot at random for a while at a time, and change what sensors tell."""
    if rng.random() < 0.1:
        for place in range(len(robot.commands)):
            robot.commands[place] = rng.integers(5) / 4
    robot.battery -= 0.01
    if rng.random() < 0.05:
        robot.earned += 1
        robot.restarted = True


class Ground(Model):
    """A plane on which robots have every sensor, actuator and reward."""

    ticks = 200
    world = Plane(10.0)
    zones = Population(Zone, 2)
    stones = Population(Obstacle, 4)
    objects = Population(Body, 6, body=BALL)
    robots = Population(
        Bot,
        3,
        body=Disc(meets=("objects",)),
        sensors={
            "S1": RangeFinder(0.0),
            "S2": RangeFinder(0.4),
            **of_kind(Sense),
            **{name: sensed(one) for name, one in of_kind(Interruption).items()},
        },
        actuators={**of_kind(Act), "right": wheel((0.0, -1.0))},
    )
    rewards = of_kind(Reward)
    setup = (
        each(zones, scatter),
        each(stones, scatter),
        each(objects, scatter),
        each(robots, scatter),
    )
    schedule = (each(robots, drive),)


TICKS = 150


@pytest.fixture(scope="module")
def histories():
    """The rows of robots and objects, tick by tick, compiled and interpreted."""
    runs = []
    for compiled in (True, False):
        model = Ground(seed=5, compiled=compiled)
        rows = []
        for _ in range(TICKS):
            model.advance(1)
            rows.append([model.tables[one].rows.copy() for one in ("robots", "objects")])
        runs.append([np.array([tick[one] for tick in rows]) for one in (0, 1)])
    return runs


def shape():
    kinds = {"robots": Bot, "objects": Body, "zones": Zone}
    populations = {name: PopulationShape(name, class_fields(one)) for name, one in kinds.items()}
    return ModelShape("a world", {}, {}, populations, WorldShape(), (), ())


def program():
    return Program(shape(), compiled=True)


def world(seed, stand_in):
    """Rows at random, and all that a device may be given."""
    rng = random.Random(seed)
    members = stand_in.members(
        *(
            stand_in.body(
                rng.uniform(-6, 6),
                rng.uniform(-6, 6),
                number,
                angle=rng.uniform(-3, 3),
                half_width=rng.uniform(0, 5),
                carrier_kind=0 if number == 2 else -1,
                carrier=1 if number == 2 else -1,
                signal=[rng.random(), rng.random()],
            )
            for number in range(4)
        )
    )
    robot = stand_in.body(
        rng.uniform(-6, 6),
        rng.uniform(-6, 6),
        3,
        angle=rng.uniform(-3, 3),
        vx=rng.uniform(-5, 5),
        vy=rng.uniform(-5, 5),
        spin=rng.uniform(-3, 3),
        contact=rng.randrange(2),
        battery=rng.choice((0.0, rng.random(), 1.0)),
        reward=rng.uniform(-2, 2),
        earned=rng.choice((0.0, 1.0)),
        carrying=rng.choice((-1, 2)),
    )
    return {
        "robot": robot,
        "members": members,
        "own": rng.random() < 0.5,
        "target": members[rng.randrange(4)],
        "found": rng.random() < 0.8,
        "held": rng.random() < 0.5,
        "restarted": rng.random() < 0.2,
        "reading": rng.random(),
        "command": rng.choice((0.0, 0.5, 1.0, rng.random())),
        "before": rng.choice((0.0, 0.5, 1.0, rng.random())),
        "slot": rng.randrange(3),
        "model": SimpleNamespace(tick=rng.randrange(50)),
        "rng": rng,
    }


def outcomes(device, stand_in):
    """Call a device in many worlds; yield what it returned, and what it found and left there."""
    memory = [0.0] * device.memory
    for seed in range(200):
        given = world(seed, stand_in) | {"memory": memory}
        given["readings"] = [0.1 * seed % 1.0] * len(device.sensors)
        if given["restarted"] and isinstance(device, Reward):
            memory[:] = [0.0] * len(memory)
        before = copy.deepcopy([vars(given["robot"]), [vars(one) for one in given["members"]]])
        result = stand_in.call(device, **given)
        yield result, before, [vars(given["robot"]), [vars(one) for one in given["members"]]]


def changed(before, after):
    return {name for name in after if after[name] != before[name]}


WRITES = {
    "wheel": {"push_x", "push_y", "torque"},
    "claw": {"closed", "carrying"},
    "emitter": {"signal"},
    "paid": {"earned"},
    "own act": {"push_x", "push_y"},
}
"""The fields of the robot that devices write, all others none; the claw also its objects'."""


def test_every_maker_has_an_example():
    named = {**SENSORS, **ACTUATORS, **REWARDS, **INTERRUPTIONS}
    assert set(ARGUMENTS) <= set(named)
    assert {type(one) for one in OWN.values()} == {Sense, Act, Reward, Interruption}
    for name, maker in named.items():
        required = [
            one for one in inspect.signature(maker).parameters.values() if one.default is one.empty
        ]
        assert len(ARGUMENTS.get(name, ())) >= len(required)


@pytest.mark.parametrize("name", DEVICES)
class TestContract:
    def test_it_is_typed_in_the_language_of_rules(self, name):
        made = program()
        symbol = typed(made, DEVICES[name], "robots", ["S1", "S2"])
        assert made.functions[symbol].source.function is DEVICES[name].function
        assert tuple(made.functions[symbol].source.parameters) == DEVICES[name].takes

    def test_it_returns_what_its_kind_returns(self, name, stand_in):
        device = DEVICES[name]
        results = [result for result, *_ in outcomes(device, stand_in)]
        if isinstance(device, Act):
            assert set(results) == {None}
        elif isinstance(device, Interruption):
            assert {type(one) for one in results} == {bool}
            assert len(set(results)) == 2
        else:
            assert all(math.isfinite(one) for one in results)
            assert len(set(results)) > 1 or name == "constant"
        if isinstance(device, Sense) and name in MADE:
            assert all(0.0 <= one <= 1.0 for one in results)

    def test_it_changes_what_it_is_for_and_nothing_else(self, name, stand_in):
        written, told = set(), set()
        for _, (robot, members), (robot_after, members_after) in outcomes(DEVICES[name], stand_in):
            written |= changed(robot, robot_after)
            for before, after in zip(members, members_after, strict=True):
                told |= changed(before, after)
        assert written == WRITES.get(name, set())
        assert told == ({"carrier", "carrier_kind"} if name == "claw" else set())

    def test_its_description_is_frozen_and_goes_through_pickle(self, name):
        device = DEVICES[name]
        with pytest.raises(AttributeError):
            device.reach = 1.0
        assert copy.deepcopy(device) == device
        assert hash(device) == hash(copy.copy(device))


class TestBothSpeeds:
    @pytest.mark.parametrize("name", [*of_kind(Sense), *of_kind(Interruption)])
    def test_readings_are_equal_to_the_last_bit(self, name, histories):
        place = list(Ground.robots.sensors).index(name)
        compiled, interpreted = (robots["readings"][:, :, place] for robots, _ in histories)
        assert np.array_equal(compiled, interpreted)
        # What never changes tells nothing of how it is bound.
        assert len(np.unique(compiled)) > 1 or name == "constant"

    @pytest.mark.parametrize("part", [0, 1], ids=["robots", "objects"])
    def test_rows_are_equal_to_the_last_bit(self, part, histories):
        compiled, interpreted = (one[part] for one in histories)
        for column in compiled.dtype.names:
            assert np.array_equal(compiled[column], interpreted[column]), column

    @pytest.mark.parametrize("column", ["reward", "torque", "carrying", "signal", "closed"])
    def test_the_run_shows_what_devices_do(self, column, histories):
        assert len(np.unique(histories[0][0][column])) > 1

    def test_a_reward_is_given_in_the_tick(self, histories):
        robots = histories[0][0]
        assert np.allclose(np.cumsum(robots["reward"], axis=0), robots["score"])


# Refusals --------------------------------------------------------------------------------------


def see(robot, distence):
    return distence


def weigh(robot, weight, scale=2.0):
    return weight / scale * robot.x


def spring(command, robot):
    robot.push_x += command


def remember(memory):
    return memory[0]


def look(target):
    return target.x


def read(reading):
    return reading


def read_all(readings):
    return readings[0]


def start(restarted):
    return restarted


def count(found=True):
    return found


def label(text="near"):
    return text


def say_nothing(robot):
    robot.torque = 1.0


def say_much(robot):
    return robot.x > 0


def say_number(robot):
    return robot.x


def beyond(memory):
    return memory[0] + len([1])


def unknown_field(target):
    return target.wings


LINE = {
    one.__name__: one.__code__.co_firstlineno for one in (see, weigh, unknown_field, say_number)
}


class TestRefusals:
    @pytest.mark.parametrize(
        ("make", "found", "advice"),
        [
            (lambda: Sense(see), "the parameter 'distence' of the sensor 'see'", "'distance'"),
            (lambda: Sense(weigh), "the parameter 'weight'", "settings={'weight': 1.0}"),
            (
                lambda: Sense(weigh, settings={"weight": 1, "wieght": 2}),
                "the setting 'wieght'",
                "did you mean 'weight'?",
            ),
            (lambda: Sense(weigh, settings={"weight": [1]}), "weight=[1]", "a number"),
            (lambda: Sense(weigh, settings={"weight": math.nan}), "weight=nan", "a number"),
            (lambda: Sense(weigh, settings={"weight": 1, "robot": 2}), "'robot'", "given anyway"),
            (lambda: Sense(label), "text='near'", "a number"),
            (lambda: Sense(count, of="objects"), "a default for 'found'", "leave it out"),
            (lambda: Sense(spring), "the parameter 'command'", "of actuators"),
            (lambda: Interruption(start), "the parameter 'restarted'", "of rewards"),
            (lambda: Sense(look), "which says no `of`", "of='objects'"),
            (lambda: Sense(remember), "which says no `memory`", "memory=2"),
            (lambda: Sense(read), "which says no `sensor`", "sensor='SENSOBJ'"),
            (lambda: Sense(read_all), "which says no `sensors`", "sensors=("),
            (lambda: Sense(see, of="objects", settings={"distence": 1}), "of='objects'", "target"),
            (lambda: Sense(read, sensor="S1", memory=2), "memory=2", "leave it out"),
            (lambda: Sense(read_all, sensors="S1"), "sensors='S1'", "sensors=('S1',)"),
            (lambda: Sense(remember, memory=-1), "memory=-1", "0 or more"),
            (lambda: Sense(remember, memory=1.5), "memory=1.5", "a whole number"),
            (lambda: Sense(look, of="objects", reach=0), "reach=0", "above 0"),
            (lambda: Sense(look, of="objects", angle=math.inf), "angle=inf", "radians"),
            (lambda: Act(spring, at=(1, 2, 3)), "at=(1, 2, 3)", "two numbers"),
            (lambda: Sense(3), "3 as the function of a sensor", "a function"),
        ],
    )
    def test_what_does_not_fit_is_refused_when_it_is_made(self, make, found, advice):
        with pytest.raises(ModelError) as caught:
            make()
        assert found in str(caught.value)
        assert advice in str(caught.value)

    def test_the_message_names_file_line_and_all_that_is_given(self):
        with pytest.raises(ModelError) as caught:
            Sense(see)
        assert (caught.value.file, caught.value.line) == (__file__, LINE["see"])
        for name in ("robot", "model", "target", "memory", "readings"):
            assert name in str(caught.value)
        assert "command" not in str(caught.value)

    @pytest.mark.parametrize(
        ("device", "found", "expected"),
        [
            (Sense(say_nothing), "which returns None", "a number"),
            (Reward(say_much), "which returns a truth value", "a number"),
            (Act(say_number), "which returns a number", "nothing"),
            (Interruption(say_number), "which returns a number", "`return x > 0.5`"),
            (Sense(look, of="objcts"), "looks for 'objcts'", "did you mean 'objects'?"),
            (Sense(read, sensor="S11"), "the sensor 'S11'", "did you mean 'S1'?"),
            (Sense(read_all, sensors=("S1", "S9")), "the sensor 'S9'", "there is S1, S2, S3"),
            (Sense(read_all, sensors=("S2", "S1")), "S2, S1", "next to each other"),
            (Sense(beyond, memory=1), "a list in the rule 'beyond'", "array field"),
            (
                Sense(unknown_field, of="objects"),
                "the unknown field 'wings'",
                "class of the agents of 'objects'",
            ),
            (
                Sense(unknown_field, of="zones"),
                "the unknown field 'wings'",
                "class of the agents of 'zones'",
            ),
        ],
    )
    def test_what_does_not_fit_the_model_is_refused_when_it_is_typed(self, device, found, expected):
        with pytest.raises(ModelError) as caught:
            typed(program(), device, "robots", ["S1", "S2", "S3"])
        assert found in str(caught.value)
        assert expected in str(caught.value)
        assert f"the {device.word} {device.name!r}" in str(caught.value)

    def test_its_place_in_the_model_is_named(self):
        device = Sense(unknown_field, of="objects")
        with pytest.raises(ModelError) as caught:
            typed(program(), device, "robots", [], "the sensor 'WINGS' of 'robots'")
        assert "in the sensor 'WINGS' of 'robots'" in str(caught.value)
        assert (caught.value.file, caught.value.line) == (__file__, LINE["unknown_field"] + 1)

    def test_wrong_results_name_the_line_of_the_function(self):
        with pytest.raises(ModelError) as caught:
            typed(program(), Interruption(say_number), "robots", [])
        assert (caught.value.file, caught.value.line) == (__file__, LINE["say_number"])

    def test_a_signal_without_its_field_is_refused(self):
        made = program()
        with pytest.raises(ModelError, match="without a field for signals in the class of"):
            typed(made, SENSORS["signal_distance"]("objects"), "robots", [])


class TestSettings:
    def test_defaults_of_the_function_are_settings(self):
        assert Sense(weigh, settings={"weight": 1}).settings == {"weight": 1.0, "scale": 2.0}

    def test_settings_are_numbers_in_the_order_of_the_parameters(self):
        device = Sense(weigh, settings={"scale": True, "weight": 3})
        assert list(device.settings.items()) == [("weight", 3.0), ("scale", 1.0)]
        assert {type(one) for one in device.settings.values()} == {float}

    def test_what_the_caller_holds_may_change(self):
        mine = {"weight": 1.0}
        device = Sense(weigh, settings=mine)
        mine["weight"] = 2.0
        assert device.settings["weight"] == 1.0

    def test_only_what_asks_for_the_nearest_seeks(self):
        assert SENSORS["orientation"]("objects").seeks
        assert not claw("objects").seeks
        assert not emitter().seeks

    def test_every_given_name_is_described(self):
        assert all(GIVEN.values())
        assert set(Sense(look, of="objects").given) <= set(GIVEN)
