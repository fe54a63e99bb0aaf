"""Imprinting on a plane: what a demonstrator does with a robot becomes a skill."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, WeightedStochastic
from socialmind import Model, Population
from socialmind.errors import ModelError, SocialmindError
from socialmind.learning import Lesson, Training, learn
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.learning.imprinting.controllers import controller_of
from socialmind.learning.imprinting.imprint import first_population, imprint, imprint_in, record
from socialmind.learning.imprinting.plane_world import PlaneWorld
from socialmind.learning.imprinting.recording import Recording
from socialmind.learning.training.course import lessons_module
from socialmind.learning.training.teaching import evaluation_of
from socialmind.mind import (
    CognitonScheme,
    Hierarchy,
    MindDescription,
    Perceptron,
    Programmed,
    Skill,
)
from socialmind.sources.folders import model_folder
from socialmind.worlds.plane import Disc, Plane, Robot, constant, wheel

FOLDER = model_folder("collect")
LESSONS = lessons_module(FOLDER)
MIND = MindDescription.load(FOLDER / "mind")


def proportional(inputs):
    """Turn towards the object, the faster the further aside it is; else ahead."""
    right = 8.0 * (inputs[0] - 0.5)
    return 1.0 + right, 1.0 - right


def keep_clear(inputs):
    """Let Avoid steer where something is near ahead, else go on: S1 … S3 and S10 look ahead."""
    near = min(inputs[0], inputs[1], inputs[2], inputs[9]) < 0.25
    return (0.1, 1.0) if near else (1.0, 0.0)


def crawl(inputs):
    """Go ahead slowly, whatever is read."""
    return 0.2, 0.2


@pytest.fixture(scope="module")
def world():
    return PlaneWorld.of("collect", "GoToObject")


def scored(world, source, seeds):
    controller = controller_of(source, world.skill)
    found = []
    for seed in seeds:
        controller.reset()
        found.append(world(controller, seed))
    return found


def test_a_curriculum_is_no_lesson():
    with pytest.raises(SocialmindError, match="delivered_anew is a curriculum; expected one of it"):
        PlaneWorld.of("foraging_roles", "delivered_anew")


# An episode ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("lesson", "environment"),
    [("GoToObject", "GoToObject"), ("Avoid", "Avoid"), ("GoToObject+Avoid", "GoToObjectAvoid")],
)
def test_who_answers_as_the_skill_does_gets_its_score(lesson, environment):
    world = PlaneWorld.of("collect", lesson)
    episodes = Episodes(getattr(LESSONS, environment), master=lesson, skill=lesson)
    skill = MIND.skills[lesson]
    expected = episodes.run(skill.genome[None], [3, 2**64 - 1]).score[0].tolist()
    # Not the skill by itself: its function among the others of the mind, where it reads a wave.
    assert scored(world, skill, [3, 2**64 - 1]) == expected
    assert world.skill.genome is None


def test_so_it_is_with_skills_that_stand_in_for_others():
    avoid = MIND.skills["Avoid"]
    slow = avoid.changed(function=Programmed(crawl), genome=None)
    name = "GoToObject+Avoid"
    lesson = Lesson(name, LESSONS.GoToObjectAvoid, ticks=600, stand_ins=(slow,))
    genome = MIND.skills[name].genome[None]
    expected = evaluation_of(lesson, MIND, "compiled").episodes().run(genome, [3, 4]).score[0]
    assert scored(PlaneWorld.of("collect", lesson), MIND.skills[name], [3, 4]) == expected.tolist()
    alone = PlaneWorld.of("collect", replace(lesson, stand_ins=()))
    assert scored(alone, MIND.skills[name], [3, 4]) != expected.tolist()


def test_so_it_is_below_a_scheme_that_draws():
    scheme = CognitiveScheme(
        "chooses",
        (
            Cogniton("Seeks", start_value=1.0, influence={"GoToObject": 1.0},
                     conditional=("GoToObject",)),
            Cogniton("Shuns", start_value=1.0, influence={"Avoid": 0.5}, conditional=("Avoid",)),
            Cogniton("Near", start_value=0.0, influence={"Avoid": 0.0}),
        ),
        decision_maker=WeightedStochastic(),
    )  # fmt: skip
    chooser = Skill(
        "Chooser", ["SE:S1"], ["SK:GoToObject", "SK:Avoid"],
        CognitonScheme(scheme, {"SE:S1": "Near"}),
    )  # fmt: skip
    mind = MIND.with_modules(skills=[chooser])
    world = PlaneWorld(LESSONS.GoToObject, "GoToObject", "Chooser", mind, ticks=600)
    shown = mind.skills["GoToObject"]
    episodes = Episodes(LESSONS.GoToObject, None, mind, "Chooser", "GoToObject", None, 600)
    expected = episodes.run(shown.genome[None], [3, 4, 5]).score[0].tolist()
    assert scored(world, shown, [3, 4, 5]) == expected


def test_so_it_is_with_the_reference_engine():
    world = PlaneWorld(LESSONS.GoToObject, "GoToObject", ticks=150, physics="pymunk")
    compiled = PlaneWorld(LESSONS.GoToObject, "GoToObject", ticks=150)
    found, expected = (scored(one, MIND.skills["GoToObject"], [5]) for one in (world, compiled))
    assert found == pytest.approx(expected, abs=1e-9)


def test_a_hierarchy_demonstrates_as_its_skill_does(world):
    source = Hierarchy(MIND, "GoToObject")
    assert scored(world, source, [1]) == scored(world, MIND.skills["GoToObject"], [1])


def test_the_demonstrator_is_told_what_the_skill_reads():
    world = PlaneWorld.of("collect", "GoToObject+Avoid")
    told = record(world, keep_clear, world.skill, [4])
    wave, movement = told.inputs[:, 11], told.inputs[:, 10]
    ticks = np.arange(1, len(told) + 1)
    assert wave == pytest.approx(0.5 + np.sin(ticks) / 2)
    assert movement[0] == 0.0 < movement.max()
    assert (told.inputs[:, :10].min(axis=1) < 0.25).any()
    assert set(map(tuple, told.outputs.tolist())) == {(0.1, 1.0), (1.0, 0.0)}


def test_a_skill_in_context_is_asked_where_it_is_influenced():
    world = PlaneWorld(LESSONS.CollectObjects, "GoToObject", master="Collect", ticks=300)
    told = record(world, MIND.skills["GoToObject"], world.skill, [0])
    assert 0 < len(told) <= 299
    episodes = Episodes(LESSONS.CollectObjects, ticks=300)
    assert (
        scored(world, MIND.skills["GoToObject"], [0]) == episodes.run(None, [0]).score[0].tolist()
    )


def test_an_interruption_ends_it():
    world = PlaneWorld(LESSONS.Avoid, "Avoid")
    told = record(world, lambda inputs: (1.0, 1.0), world.skill, [0])
    assert len(told) < 600  # straight into something
    assert told.inputs[-1, :10].min() < 0.1


# Imprinting ---------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def imprinted(world):
    pytest.importorskip("torch")
    return imprint_in(
        world, proportional, world.skill, 1, tolerance=0.1, rounds=3, episodes=4, scored=8,
        epochs=30,
    )  # fmt: skip


def test_a_perceptron_learns_from_a_proportional_controller(world, imprinted):
    assert imprinted.reached
    fresh = range(100, 110)
    episodes = Episodes(LESSONS.GoToObject, master="GoToObject", skill="GoToObject")
    found = episodes.run(imprinted.skill.genome[None], fresh).score.mean()
    shown = np.mean(scored(world, proportional, fresh))
    assert shown > 2.5  # two objects and more
    assert found > 0.9 * shown


def test_a_skill_learns_from_another_network():
    torch = pytest.importorskip("torch")
    torch.set_num_threads(1)
    world = PlaneWorld.of("collect", "Avoid")
    shorter = world.skill.changed(function=Perceptron(layers=1))
    told = record(world, MIND.skills["Avoid"], shorter, range(2))
    done = imprint(shorter, told, seed=1, epochs=15)
    assert done.losses[-1] < 0.5 * done.losses[0]


def test_it_is_a_first_population(world, imprinted, tmp_path):
    first = first_population(imprinted, 20, 0.05, seed=1)
    settings = {"population": 20, "elite": 2}
    lesson = Lesson(
        "GoToObject", LESSONS.GoToObject, generations=1, repetitions=8, settings=settings,
        first=first, finalists=2, finals=4,
    )  # fmt: skip
    training = Training(learn("collect", lesson, out=tmp_path / "imprinted", workers=1))
    shown = np.mean(scored(world, proportional, range(8)))
    assert training.curve["best"].iloc[0] > 0.9 * shown
    scratch = Training(
        learn("collect", lesson.changed(first=None), out=tmp_path / "scratch", workers=1)
    )
    assert scratch.curve["best"].iloc[0] < 0.7 * shown


# Commands of a person -----------------------------------------------------------------------------


def test_commands_that_were_recorded_are_played_again(world, tmp_path):
    driven = record(world, proportional, world.skill, [7])
    claw = np.full((len(driven), 1), 0.5)
    told = world.played(np.hstack([driven.outputs, claw]), seed=7)
    assert (told.inputs == driven.inputs).all()
    assert (told.outputs == driven.outputs).all()
    # In another world the same commands meet other things.
    other = world.played(np.hstack([driven.outputs, claw]), seed=8)
    assert not (other.inputs == driven.inputs).all()
    told.write(tmp_path / "driven.csv", world.skill)
    assert (Recording.read(tmp_path / "driven.csv", world.skill).inputs == told.inputs).all()


def test_an_episode_ends_with_the_commands(world):
    assert len(world.played(np.full((25, 3), 0.5), seed=1)) == 25
    assert len(world.played(np.full((900, 3), 0.5), seed=1)) == 599


def test_actions_of_a_gymnasium_environment_are_played(world):
    pytest.importorskip("gymnasium")
    from socialmind.envs.plane_env import PlaneEnv

    environment = PlaneEnv("collect", "GoToObject")
    seen, _ = environment.reset(options={"world": 11})
    orientation = list(LESSONS.SENSORS).index("RADOBJ")
    actions, read = [], []
    for _ in range(60):
        read.append(seen[orientation])
        actions.append([*np.clip(proportional([seen[orientation]]), 0.0, 1.0), 0.5])
        seen, *_ = environment.step(np.array(actions[-1]))
    told = world.played(actions, seed=11)
    assert told.inputs[:, 0] == pytest.approx(np.array(read), abs=1e-6)


# What is refused ----------------------------------------------------------------------------------


def test_what_does_not_fit_is_refused(world):
    with pytest.raises(ModelError, match=r"commands of the shape \(5, 2\).*MotL, MotR, EMAG"):
        world.played(np.zeros((5, 2)), seed=1)
    with pytest.raises(ModelError, match="commands outside their range"):
        world.played(np.full((5, 3), 1.5), seed=1)
    complex_world = PlaneWorld.of("collect", "GoToObject+Avoid")
    with pytest.raises(ModelError, match="to be shown by commands"):
        complex_world.played(np.zeros((5, 3)), seed=1)
    with pytest.raises(ModelError, match="GoToObjekt"):
        PlaneWorld(LESSONS.GoToObject, "GoToObjekt")
    both = Lesson("both", LESSONS.CollectObjects, skill=("Avoid", "GoToObject"), master="Collect")
    with pytest.raises(ModelError, match="the lesson 'both' with the skills Avoid, GoToObject"):
        PlaneWorld.of("collect", both)


def test_several_robots_are_refused():
    class Two(Model):
        world = Plane(20.0)
        robots = Population(
            Robot,
            2,
            body=Disc(),
            sensors={"RADOBJ": constant(0.5)},
            actuators={"MotL": wheel((0.0, 1.0)), "MotR": wheel((0.0, -1.0))},
            hierarchy=MIND,
        )

    world = PlaneWorld(Two, "GoToObject")
    with pytest.raises(SocialmindError, match="has 2 robots in 'robots'; expected one"):
        world(lambda inputs: (0.5, 0.5), 1)
