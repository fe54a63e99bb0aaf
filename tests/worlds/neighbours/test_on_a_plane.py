"""Who is near whom on a plane: at both speeds, against asking everybody, and in lockstep."""

from pathlib import Path

import numpy as np

from socialmind import each
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.sources.loading import load_file

MENAGERIE = load_file(Path(__file__).parents[1] / "plane" / "menagerie" / "model.py")


def meet(scout, model):
    """Add up who is near, and change who is there meanwhile."""
    for ball in model.balls.near(scout, 6.0):
        model.clock += ball.x - 0.5 * ball.y
        if ball.id % 7 == 3:
            ball.die()
        elif ball.id % 5 == 1:
            ball.x = 0.5 * ball.x
    other = model.scouts.nearest(scout)
    if other is not None:
        model.clock += 0.125 * other.x
    model.clock += 100 * len(model.collectors.near(scout, model.half_width))


class Meeting(MENAGERIE.Menagerie):
    """The menagerie, in which scouts meet the others."""

    schedule = (*MENAGERIE.Menagerie.schedule, each(MENAGERIE.Menagerie.scouts, meet))


def meeting(seed, **given):
    genome = np.random.default_rng(seed).normal(0, 0.5, 15)
    collect = MENAGERIE.COLLECTOR.skill("Collect").changed(genome=genome)
    mind = MENAGERIE.COLLECTOR.with_modules(skills=[collect])
    return Meeting(seed=seed, hierarchy={"collectors": mind}, **given)


def test_both_speeds_find_the_same():
    for seed in (1, 2):
        fast, slow = meeting(seed), meeting(seed, compiled=False)
        for _ in range(4):
            fast.advance(8)
            slow.advance(8)
            assert fast.clock == slow.clock
            assert fast.balls.x.tolist() == slow.balls.x.tolist()
    assert fast.clock != 0


def test_users_find_those_near():
    society = meeting(3)
    society.advance(5)
    for scout in society.scouts:
        found = [one.id for one in society.scouts.near(scout, 8.0)]
        away = np.hypot(society.scouts.x - scout.x, society.scouts.y - scout.y)
        near = society.scouts.id[(away <= 8.0) & (society.scouts.id != scout.id)]
        assert found == near.tolist()
        others = [one for one in society.scouts if one != scout]
        first = min(others, key=lambda one: (one.x - scout.x) ** 2 + (one.y - scout.y) ** 2)
        assert society.scouts.nearest(scout).id == first.id


def test_worlds_in_lockstep_find_what_each_finds_alone():
    seeds = (3, 11, 5)
    given = {"skill": "Collect", "population": "collectors", "record": ("clock",), "ticks": 40}
    genomes = np.random.default_rng(1).normal(0, 0.5, size=(2, 15))
    episodes = Episodes(Meeting, lanes=4, **given)
    outcome = episodes.run(genomes, seeds)
    for place, genome in enumerate(genomes):
        for number, seed in enumerate(seeds):
            alone = episodes.model(seed, genome)
            while alone.over is None and alone.tick < 40:
                alone.advance(1)
            assert outcome.fields["clock"][place, number] == alone.clock
