"""How influence decides: properties of all hierarchies, and the thesis's own example."""

import itertools
import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from random_minds import MASTER, random_mind, sensor_values
from small_minds import constant, mind, wired

from socialmind.mind import Actuator, Hierarchy, MindDescription, Minds, Programmed, Skill

SHARES = st.floats(0.0, 1.0)
INFLUENCES = st.floats(1e-290, 1.0) | st.just(0.0)  # a weighted mean of less has fewer digits


def one_hot(description, draw):
    """The same skills, of which each complex one influences a single other, with 1."""
    skills = []
    for skill in description.skills.values():
        if skill.is_complex:
            chosen = draw.choice(skill.subskills)
            skill = constant(skill.name, {f"SK:{n}": float(n == chosen) for n in skill.subskills})
        skills.append(skill)
    kinds = (description.sensors, description.actuators, description.variables)
    return MindDescription("one-hot", *(list(one.values()) for one in kinds), skills)


@pytest.mark.parametrize("seed", range(100))
def test_the_skill_with_all_influence_commands(seed):
    draw = random.Random(seed)
    description = one_hot(random_mind(draw), draw)
    hierarchy = Hierarchy(description, MASTER)
    base = MASTER
    while description.skills[base].is_complex:
        skill = description.skills[base]
        base = skill.subskills[list(skill.genome).index(1.0)]
    for values in sensor_values(description, draw, 10):
        motors = hierarchy.evaluate(values)
        given_out = hierarchy.outputs()
        for name, actuator in description.actuators.items():
            assert motors[name] == given_out.get((base, f"MO:{name}"), actuator.neutral)


@given(depth=st.integers(1, 8), values=st.lists(SHARES, min_size=3, max_size=3), data=st.data())
@settings(max_examples=30)
def test_one_hot_influence_reaches_any_depth(depth, values, data):
    way = data.draw(st.lists(st.integers(0, 2), min_size=depth, max_size=depth))
    skills = []
    for level, chosen in enumerate(way):
        below = [f"{level + 1} {k}" for k in range(3)]
        hot = {f"SK:{name}": float(name == below[chosen]) for name in below}
        skills += [constant(f"{level} {k}", hot) for k in range(3 if level else 1)]
    skills += [
        constant(f"{depth} {k}", {"MO:M": value, "MO:N": 1.0 - value})
        for k, value in enumerate(values)
    ]
    motors = Hierarchy(mind(skills), "0 0").evaluate({})
    assert motors == {"M": values[way[-1]], "N": 1.0 - values[way[-1]]}


@st.composite
def layers(draw):
    """Levels of skills: for each skill the influences it gives to all skills of the next level, and
    for each skill of the last level its commands to three motors."""
    sizes = [1, *draw(st.lists(st.integers(1, 4), min_size=1, max_size=5)), 3]
    some = st.floats(0.01, 1.0) | st.just(0.0)
    return [
        [draw(st.lists(some, min_size=below, max_size=below)) for _ in range(size)]
        for size, below in itertools.pairwise(sizes)
    ]


def layered(levels):
    skills = []
    for level, rows in enumerate(levels):
        last = level == len(levels) - 1
        kind = "MO:M" if last else f"SK:{level + 1} "
        for place, row in enumerate(rows):
            outputs = {f"{kind}{target}": value for target, value in enumerate(row)}
            skills.append(constant(f"{level} {place}", outputs))
    return Hierarchy(mind(skills), "0 0")


@given(layers(), st.floats(0.01, 1.0), st.data())
@settings(max_examples=50)
def test_scaling_the_influences_of_a_level_changes_no_motor(levels, factor, data):
    level = data.draw(st.integers(0, len(levels) - 2))
    scaled = [
        [[value * factor for value in row] for row in rows] if place == level else rows
        for place, rows in enumerate(levels)
    ]
    before, after = layered(levels), layered(scaled)
    assert after.evaluate({}) == pytest.approx(before.evaluate({}), rel=1e-12)
    below = [name for name in before.influences() if int(name.split()[0]) > level]
    for name in below:
        assert after.influences()[name] == pytest.approx(before.influences()[name] * factor)


@given(INFLUENCES, INFLUENCES, SHARES, SHARES)
@settings(max_examples=50)
def test_a_motor_is_the_mean_of_commands_weighted_by_influence(first, second, one, two):
    skills = [
        wired("Master", {"SK:A": "SE:1", "SK:B": "SE:2"}),
        wired("A", {"MO:M": "SE:A"}),
        wired("B", {"MO:M": "SE:B"}),
    ]
    hierarchy = Hierarchy(mind(skills))
    found = hierarchy.evaluate({"1": first, "2": second, "A": one, "B": two})["M"]
    if first + second == 0.0:
        assert found == 0.5
    else:
        assert found == pytest.approx((first * one + second * two) / (first + second))
        assert min(one, two) - 1e-15 <= found <= max(one, two) + 1e-15


def test_a_motor_without_influence_takes_its_neutral():
    skills = [
        wired("Master", {"SK:Base": "SE:on"}),
        constant("Base", {"MO:Wheel": 1.0, "MO:Claw": 0.75}),
    ]
    actuators = [Actuator("Wheel"), Actuator("Claw", neutral=0.0), Actuator("Lamp", neutral=0.25)]
    hierarchy = Hierarchy(MindDescription("still", ["on"], actuators, (), skills))
    still = {"Wheel": 0.5, "Claw": 0.0, "Lamp": 0.25}
    assert hierarchy.evaluate({"on": 0.0}) == still
    assert hierarchy.evaluate({"on": 1.0}) == {"Wheel": 1.0, "Claw": 0.75, "Lamp": 0.25}
    assert hierarchy.evaluate({"on": 0.0}) == still
    assert hierarchy.actuators() == still


def test_a_skill_that_is_left_alone_sends_nothing_on_and_a_faint_influence_counts():
    skills = [
        wired("Master", {"SK:Middle": "SE:middle", "SK:Other": "SE:other"}),
        constant("Middle", {"SK:Base": 1.0}),
        constant("Base", {"MO:M": 1.0}),
        constant("Other", {"MO:M": 0.25}),
    ]
    alone, many = Hierarchy(mind(skills), "Master"), Minds(mind(skills), "Master", 3)
    ticks = [  # influence on Middle and on Other; the mean of 1.0 and 0.25 by them
        (1.0, 1.0, 0.625),
        (0.0, 0.5, 0.25),
        (0.125, 0.0, 1.0),
        (0.0, 0.0, 0.5),
        (0.125, 0.25, 0.5),
    ]
    for middle, other, expected in ticks:
        sensed = {"middle": middle, "other": other}
        assert alone.evaluate(sensed) == {"M": expected}
        assert many.evaluate(sensed)["M"].tolist() == [expected] * 3


def test_a_master_may_stand_below_others():
    skills = [
        constant("Above", {"SK:Middle": 0.5, "SK:Base": 1.0}),
        constant("Middle", {"SK:Base": 0.5}),
        constant("Base", {"MO:M": 0.2}),
    ]
    hierarchy = Hierarchy(mind(skills), "Middle")
    assert hierarchy.evaluate({}) == {"M": 0.2}
    assert hierarchy.influences() == {"Middle": 1.0, "Base": 0.5}
    assert hierarchy.skills == ("Middle", "Base")


def test_equation_4_4():
    """A motor command from the master to the actuator in a hierarchy of three levels."""
    skills = [
        constant("Ms", {"SK:C1": 0.9, "SK:C2": 0.4}),
        constant("C1", {"SK:B1": 0.3, "SK:B2": 0.7}),
        constant("C2", {"SK:B1": 0.8, "SK:B2": 0.1}),
        constant("B1", {"MO:M": 0.25}),
        constant("B2", {"MO:M": 0.95}),
    ]
    first = 0.3 * (0.9 * 1.0) + 0.8 * (0.4 * 1.0)
    second = 0.7 * (0.9 * 1.0) + 0.1 * (0.4 * 1.0)
    expected = (0.25 * first + 0.95 * second) / (first + second)
    assert Hierarchy(mind(skills)).evaluate({}) == pytest.approx({"M": expected}, rel=1e-15)


# Figure 6.6 ------------------------------------------------------------------------------------
# The sensor `step` is 0.1 in step 1, … 0.5 in step 5. Where the text gives no number, the
# comment says what it does say.


def collect(step):
    if step < 0.45:
        return 1.0, 0.0
    return 0.0, 1.0  # step 5: exclusively to GoToDropZone+Avoid


def go_to_object_avoid(step):
    if step < 0.15:
        return 1.0, 0.0  # step 1: exclusively to GoToObject
    if step < 0.25:
        return 0.0, 1.0  # step 2: exclusively to Avoid
    return 0.16, 0.84  # step 3: GoToObject has 0.16, Avoid less than before


def go_to_drop_zone_avoid(step):
    return 0.6, 0.4  # step 5: keeps Avoid active


def go_to_object(step):
    if step < 0.15:
        return 0.11, 0.0, 0.0, 0.0  # step 1: 0.11 to moveForward alone
    if step < 0.35:
        return 0.0, 0.0, 0.0, 1.0  # step 3: 1.0 to turnRight
    return 0.0, 0.0, 0.0, 0.9  # step 4: the influence to turnRight decreased


def go_to_drop_zone(step):
    return 0.5, 0.0, 0.5, 0.0


def avoid(step):
    if step < 0.25:
        return 1.0, 0.0, 1.0, 0.0  # step 2: 1.0 to moveForward and turnLeft
    if step < 0.35:
        return 1.0, 0.0, 0.0, 0.0  # step 3: moveForward receives a much higher influence
    return 0.2, 0.0, 0.0, 0.0  # step 4: lowers its influence to moveForward


def move_forward():
    return 1.0, 1.0


def move_backwards():
    return 0.0, 0.0


def turn_left():
    return 0.0, 1.0


def turn_right():
    return 1.0, 0.0


@pytest.fixture
def figure_6_6():
    primitives = ["SK:moveForward", "SK:moveBackwards", "SK:turnLeft", "SK:turnRight"]
    motors = ["MO:MotL", "MO:MotR"]
    complex_skills = [
        ("Collect", ["SK:GoToObject+Avoid", "SK:GoToDropZone+Avoid"], collect),
        ("GoToObject+Avoid", ["SK:GoToObject", "SK:Avoid"], go_to_object_avoid),
        ("GoToDropZone+Avoid", ["SK:GoToDropZone", "SK:Avoid"], go_to_drop_zone_avoid),
        ("GoToObject", primitives, go_to_object),
        ("GoToDropZone", primitives, go_to_drop_zone),
        ("Avoid", primitives, avoid),
    ]
    base_skills = [
        ("moveForward", move_forward),
        ("moveBackwards", move_backwards),
        ("turnLeft", turn_left),
        ("turnRight", turn_right),
    ]
    skills = [
        Skill(name, ["SE:step"], outputs, Programmed(function))
        for name, outputs, function in complex_skills
    ]
    skills += [Skill(name, [], motors, Programmed(function)) for name, function in base_skills]
    return Hierarchy(mind(skills), "Collect")


def test_the_five_steps_of_figure_6_6(figure_6_6):
    # Step 1: full forward, with an influence of 0.11 alone.
    assert figure_6_6.evaluate({"step": 0.1}) == {"MotL": 1.0, "MotR": 1.0}
    influences = figure_6_6.influences()
    assert influences["GoToObject"] == 1.0
    assert influences["Avoid"] == 0.0
    assert influences["moveForward"] == 0.11
    assert influences["turnLeft"] == influences["turnRight"] == influences["moveBackwards"] == 0.0

    # Step 2: equation 6.1, (1.0 · 1.0 + 0.0 · 1.0) / (1.0 + 1.0) for the left wheel.
    assert figure_6_6.evaluate({"step": 0.2}) == {"MotL": 0.5, "MotR": 1.0}
    assert figure_6_6.influences()["turnLeft"] == 1.0

    # Step 3: turnRight receives 0.16 · 1.0, moveForward 0.84 · 1.0: slightly curved to the right.
    slight = figure_6_6.evaluate({"step": 0.3})
    assert figure_6_6.influences()["turnRight"] == 0.16
    assert figure_6_6.links()["GoToObject", "SK:turnRight"] == 0.16
    assert figure_6_6.outputs()["GoToObject", "SK:turnRight"] == 1.0
    assert slight == pytest.approx({"MotL": 1.0, "MotR": 0.84})

    # Step 4: turnRight 0.16 · 0.9 = 0.144, moveForward 0.84 · 0.2 = 0.168: a deliberate turn.
    turn = figure_6_6.evaluate({"step": 0.4})
    assert turn == pytest.approx({"MotL": 1.0, "MotR": 0.168 / 0.312})
    assert turn["MotR"] < slight["MotR"]

    # Step 5: what GoToObject+Avoid transmits has no effect, its own influence being 0.
    motors = figure_6_6.evaluate({"step": 0.5})
    assert figure_6_6.outputs()["GoToObject+Avoid", "SK:Avoid"] == 0.84
    assert figure_6_6.links()["GoToObject+Avoid", "SK:Avoid"] == 0.0
    influences = figure_6_6.influences()
    assert influences["GoToObject+Avoid"] == influences["GoToObject"] == 0.0
    assert influences["Avoid"] == 0.4
    # moveForward 0.6 · 0.5 + 0.4 · 0.2 = 0.38, turnLeft 0.6 · 0.5 = 0.3.
    assert influences["moveForward"] == pytest.approx(0.38)
    assert motors == pytest.approx({"MotL": 0.38 / 0.68, "MotR": 1.0})
