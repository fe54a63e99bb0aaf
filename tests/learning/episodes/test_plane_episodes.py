"""Episodes: what they come to is what each world comes to alone, however they are run."""

import signal
import threading
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from socialmind import Model, ModelError, Population, RuleError, SocialmindError, each
from socialmind.agents.bookkeeping import NEXT_ID
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.mind import MindDescription, Perceptron, Programmed, Skill
from socialmind.sources.loading import load_file
from socialmind.worlds.plane import (
    Disc,
    Interruption,
    Plane,
    RangeFinder,
    Reward,
    Robot,
    Sense,
    wheel,
)

MENAGERIE = load_file(Path(__file__).parents[2] / "worlds" / "plane" / "menagerie" / "model.py")
SEEDS = (3, 0, 2**63 + 11, 7, 5)
RECORD = ("brought", "collisions", "scouts.generation", "clock", "born")


def episodes(model=MENAGERIE.Menagerie, **changes):
    given = {"skill": "Collect", "population": "collectors", "lanes": 4, "record": RECORD}
    return Episodes(model, **{**given, **changes})


@pytest.fixture(scope="module")
def genomes():
    near = [1, 0, 0, 0, 0.25, -1, 0, 0, 0, 1.25, 0, 0.8, 0, -1, 0.1]
    return np.random.default_rng(1).normal(near, 0.2, size=(3, len(near)))


@pytest.fixture(scope="module")
def outcome(genomes):
    return episodes().run(genomes, SEEDS)


def same(ours, theirs):
    assert ours.score.tolist() == theirs.score.tolist()
    assert ours.ticks.tolist() == theirs.ticks.tolist()
    assert ours.ended.tolist() == theirs.ended.tolist()
    assert list(ours.fields) == list(theirs.fields)
    for name, values in ours.fields.items():
        assert values.tolist() == theirs.fields[name].tolist(), name
    return True


def test_each_is_what_its_world_comes_to_alone(genomes, outcome):
    """With schemes that draw, shared variables, births beyond the room, and own genomes."""
    one = episodes()
    for place, genome in enumerate(genomes):
        for number, seed in enumerate(SEEDS):
            alone = one.model(seed, genome)
            lived = {"scouts": {}, "collectors": {}}
            while alone.over is None and alone.tick < alone.ticks:
                alone.advance(1)
                for name, robots in lived.items():
                    # The rows of the dead stay as they are until others take them.
                    rows = alone.tables[name].rows
                    used = rows["_slot"] == np.arange(len(rows))
                    robots.update((int(row["_id"]), row.copy()) for row in rows[used])
            assert len(lived["scouts"]) == alone.scouts.counters[NEXT_ID]
            alone.ground.settle()
            for robot in alone.collectors:
                lived["collectors"][robot.id]["score"] = robot.score
            scores = [row["score"] for robots in lived.values() for row in robots.values()]
            assert outcome.score[place, number] == pytest.approx(np.mean(scores), rel=1e-12)
            assert outcome.ticks[place, number] == alone.tick
            ended = [None, "crowded"][outcome.ended[place, number]]
            assert ended == alone.over
            found = {name: values[place, number] for name, values in outcome.fields.items()}
            assert found["clock"] == alone.clock and found["born"] == alone.born
            assert found["brought"].tolist() == alone.collectors.brought.tolist()
            # Of all scouts that have lived, the dead as well, whose places others have taken.
            count = outcome.lived["scouts.generation"][place, number]
            generations = [lived["scouts"][one]["generation"] for one in sorted(lived["scouts"])]
            assert found["scouts.generation"][:count].tolist() == generations
            assert not found["scouts.generation"][count:].any()


def test_worlds_differ_and_so_do_individuals(outcome):
    assert len(np.unique(outcome.score)) == outcome.score.size


@pytest.mark.parametrize("lanes", [1, 2, 7, 64])
def test_the_number_of_lanes_does_not_matter(lanes, genomes, outcome):
    assert same(episodes(lanes=lanes).run(genomes, SEEDS), outcome)


def recruit(collector, model, rng):
    """Let a collector be born, now and then."""
    if len(model.collectors) < 90 and rng.random() < 0.02:
        MENAGERIE.scatter(model.collectors.create(), model, rng)


class Crowd(MENAGERIE.Menagerie):
    """More collectors than one block of lanes holds, and others who are born to them."""

    collectors = replace(MENAGERIE.Menagerie.collectors, size=70, own_genomes=False)
    schedule = (*MENAGERIE.Menagerie.schedule, each(collectors, recruit))


@pytest.mark.parametrize("lanes", [1, 3])
def test_a_crowd_is_what_it_is_alone_those_born_to_it_too(lanes, genomes):
    collect = MENAGERIE.COLLECTOR.skill("Collect").changed(genome=genomes[2])
    mind = MENAGERIE.COLLECTOR.with_modules(skills=[collect])
    one = episodes(
        model=Crowd, lanes=lanes, ticks=12, record=("x", "spin"), hierarchy={"collectors": mind}
    )
    seeds = SEEDS[:3]
    found = one.run(genomes[:2], seeds)
    as_it_is = one.run(None, seeds)
    for genome, outcome, row in (
        *((genomes[row], found, row) for row in range(2)), (None, as_it_is, 0),
    ):  # fmt: skip
        for number, seed in enumerate(seeds):
            alone = one.model(seed, genome)
            alone.advance(12)
            assert len(alone.collectors) > 75
            for name in ("x", "spin"):
                values = outcome.fields[name][row, number]
                whole = [getattr(robot, name) for robot in alone.collectors]
                assert values[: outcome.lived[name][row, number]].tolist() == whole


@pytest.mark.parametrize("room", [(1, 4096), (4096, 1)])
def test_births_may_lack_slots_or_identities_alone(room, genomes, outcome):
    one = episodes()
    one._room = dict.fromkeys(["balls", "scouts"], room)
    assert same(one.run(genomes, SEEDS), outcome)
    found = {name: one._batch.models[0].tables[name].room for name in ("balls", "scouts")}
    assert found == dict.fromkeys(found, (max(room[0], 256), max(room[1], 2048)))


def test_order_and_company_do_not_matter(genomes, outcome):
    one = episodes(lanes=3)
    order = [4, 1, 0, 3, 2]
    turned = one.run(genomes[::-1], [SEEDS[place] for place in order])
    assert turned.score.tolist() == outcome.score[::-1][:, order].tolist()
    alone = one.run(genomes[1:2], SEEDS[2:3])
    assert alone.score.tolist() == [[outcome.score[1, 2]]]
    assert same(one.run(genomes, SEEDS), outcome)  # whatever was run before


def test_threads_run_side_by_side(genomes, outcome):
    found = {}

    def work(number):
        found[number] = episodes(lanes=2).run(genomes[number : number + 1], SEEDS)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(len(genomes))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number in range(len(genomes)):
        assert found[number].score.tolist() == outcome.score[number : number + 1].tolist()


def test_by_pymunk_a_short_episode_is_nearly_the_same(genomes):
    ours = episodes(ticks=3).run(genomes, SEEDS)
    theirs = episodes(ticks=3, physics="pymunk").run(genomes, SEEDS)
    assert theirs.score == pytest.approx(ours.score, abs=1e-6)
    assert theirs.ticks.tolist() == ours.ticks.tolist()
    assert theirs.ended.tolist() == ours.ended.tolist()
    for name, values in ours.fields.items():
        assert theirs.fields[name].tolist() == values.tolist()


def test_without_genomes_the_mind_is_judged_as_it_is(genomes, outcome):
    collect = MENAGERIE.COLLECTOR.skill("Collect").changed(genome=genomes[2])
    mind = MENAGERIE.COLLECTOR.with_modules(skills=[collect])
    one = episodes(hierarchy=mind)
    assert one.run(None, SEEDS).score.tolist() == outcome.score[2:].tolist()
    fixed = episodes(hierarchy=mind, skill=None)
    assert fixed.genome_size == 0
    assert fixed.run(None, SEEDS).score.tolist() == outcome.score[2:].tolist()
    one.run(genomes, SEEDS)  # the weights of others
    assert one.run(None, SEEDS).score.tolist() == outcome.score[2:].tolist()


def test_nobody_and_nowhere_come_to_nothing(genomes):
    assert episodes().run(genomes[:0], SEEDS).score.shape == (0, 5)
    assert episodes().run(genomes, []).score.shape == (3, 0)


# A world of one robot ----------------------------------------------------------------------------


def speed(robot):
    return robot.vx


def far(robot, limit=5.0):
    return robot.x > limit


MIND = MindDescription(
    "goer",
    ["S"],
    ["L", "R"],
    skills=[
        Skill("Top", [], ["SK:Go"], Perceptron(layers=0), [1.0]),
        Skill("Go", ["SE:S"], ["MO:L", "MO:R"], Perceptron(layers=0)),
        Skill("Idle", ["SE:S"], ["MO:L"], Perceptron(layers=0)),
    ],
)


class Runway(Model):
    ticks = 60
    world = Plane(20.0)
    robots = Population(
        Robot,
        1,
        body=Disc(),
        sensors={"S": RangeFinder()},
        actuators={"L": wheel((0.0, 1.0)), "R": wheel((0.0, -1.0))},
        hierarchy=MIND,
        master="Top",
    )
    rewards = {"speed": Reward(speed)}  # noqa: RUF012
    interruptions = {"far": Interruption(far)}  # noqa: RUF012


def test_an_interruption_ends_an_episode_and_the_next_one_begins():
    one = Episodes(Runway, skill="Go", lanes=2)
    assert one.genome_size == 4
    fast, slow, back = [0, 1.0, 0, 1.0], [0, 0.6, 0, 0.6], [0, 0.0, 0, 0.0]
    found = one.run([fast, slow, back], [1, 2])
    assert found.ended.tolist() == [[1, 1], [0, 0], [0, 0]]
    assert found.ticks[0].max() < found.ticks[1].min() == 60
    assert (found.score[2] < 0).all() and found.score[0].tolist() == [found.score[0, 0]] * 2
    heedless = Episodes(Runway, skill="Go", lanes=2, without=("far",)).run([fast], [1])
    assert heedless.ended.tolist() == [[0]] and heedless.ticks.tolist() == [[60]]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"skill": "Goo"}, "did you mean 'Go'"),
        ({"skill": "Idle"}, "does not reach"),
        ({"record": ("speed_of_light",)}, "'speed_of_light' to record"),
        ({"population": "robot"}, "the population 'robot' of 'runway'"),
        ({"ticks": 0}, "ticks: found 0"),
        ({"lanes": 0}, "lanes: found 0"),
    ],
)
def test_what_does_not_fit_is_refused(changes, message):
    with pytest.raises(SocialmindError, match=message):
        Episodes(Runway, **{"skill": "Go", **changes})


def point_ahead(mind):
    """Write what no skill that is learned writes yet."""
    mind.set_variable("Way", 0.75)


def test_with_a_drive_skills_that_are_still_to_be_learned_are_left_out():
    """A drive reaches all skills of a mind, so those need their weights; others do not."""
    ways = ["MO:L", "MO:R"]
    steer = Skill("Steer", ["VA:Way"], ways, Perceptron(layers=0), [1, 0, 1, 0])
    decide = Skill("Decide", ["SE:S"], ["SK:Steer", "VA:Way"], Perceptron(layers=0))
    top = Skill("Top", [], ["SK:Decide"], Programmed(always))
    mind = MindDescription("m", ["S"], ["L", "R"], ["Way"], [steer, decide, top])
    driven = Episodes(Runway, hierarchy=mind, master="Steer", drive=point_ahead)
    assert list(driven.description.skills) == ["Steer"]
    alone = MindDescription("m", ["S"], ["L", "R"], ["Way"], [steer])
    same = Episodes(Runway, hierarchy=alone, master="Steer", drive=point_ahead)
    assert driven.run(None, [1, 2]).score.tolist() == same.run(None, [1, 2]).score.tolist()
    # What is reached, or ready, stays: a drive may influence it.
    ready = mind.with_modules(skills=[decide.changed(genome=[0, 1, 0, 1])])
    kept = Episodes(Runway, hierarchy=ready, master="Steer", drive=point_ahead)
    assert set(kept.description.skills) == {"Steer", "Decide", "Top"}


def always():
    """Give all influence."""
    return 1.0


def test_genomes_and_seeds_that_do_not_fit_are_refused():
    one = Episodes(Runway, skill="Go")
    for genomes, message in (
        ([[1.0, 2.0]], r"genomes of the shape \(1, 2\)"),
        ([1.0, 2.0, 3.0, 4.0], r"genomes of the shape \(4,\)"),
        ([[1.0, np.nan, 0.0, 0.0]], "not finite"),
    ):
        with pytest.raises(ModelError, match=message):
            one.run(genomes, [1])
    with pytest.raises(SocialmindError, match="seed: found -1"):
        one.run([[0.0] * 4], [-1])


def test_a_model_without_a_plane_has_no_episodes():
    class Flat(Model):
        pass

    with pytest.raises(ModelError, match="a model on a plane"):
        Episodes(Flat)


# What fails --------------------------------------------------------------------------------------


def weak(robot, model):
    return 1.0 / (robot.battery - 0.5)


def drain(robot, rng):
    robot.battery -= 0.125 * (rng.random() < 0.2)


def test_an_episode_that_fails_says_where_and_why():
    sensors = {"S": Sense(weak)}
    robots = Population(
        Robot, 1, body=Disc(), sensors=sensors, actuators=Runway.robots.actuators,
        hierarchy=MIND, master="Top",
    )  # fmt: skip
    schedule = (each(robots, drain),)
    attributes = {"world": Plane(20.0), "robots": robots, "schedule": schedule, "ticks": 200}
    failing = type("Failing", (Model,), attributes)
    with pytest.raises(
        RuleError, match=r"test_plane_episodes.py:\d+: ZeroDivisionError.*the sensor 'S'"
    ):
        Episodes(failing, skill="Go", lanes=3).run(np.zeros((2, 4)), [1, 2, 3])


def test_a_mind_that_fails_says_where():
    def steer(s):
        return 1.0 / (s - 1.0)

    broken = MIND.with_modules(
        skills=[Skill("Top", ["SE:S"], ["SK:Go"], Programmed(steer))], sensors=[]
    )
    with pytest.raises(SocialmindError, match=r"test_plane_episodes.py:\d+: ZeroDiv.*agent 0"):
        Episodes(Runway, hierarchy=broken, skill="Go", lanes=2).run(np.zeros((1, 4)), [1, 2])


def test_ctrl_c_is_heard_and_the_next_run_is_as_ever():
    one = Episodes(Runway, skill="Go", ticks=2**40, lanes=2)
    back = [[0, 0.0, 0, 0.0]]
    known = Episodes(Runway, skill="Go", ticks=500, lanes=2).run(back, [1, 2])

    def interrupt():
        time.sleep(1.0)
        signal.raise_signal(signal.SIGINT)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        Episodes(Runway, skill="Go", ticks=5, lanes=2).run(back, [1])  # compiled by now
        threading.Thread(target=interrupt).start()
        begin = time.perf_counter()
        with pytest.raises(KeyboardInterrupt):
            one.run(back, [1, 2])
        assert time.perf_counter() - begin < 10
    finally:
        signal.signal(signal.SIGINT, before)
    one.ticks = 500
    assert one.run(back, [1, 2]).score.tolist() == known.score.tolist()
