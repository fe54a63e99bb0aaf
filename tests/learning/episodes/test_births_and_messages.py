"""Rules at birth and messages in worlds that run in lockstep: as in a world alone."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from socialmind import Message, Messages, each
from socialmind.learning.episodes.plane_episodes import Episodes
from socialmind.sources.loading import load_file

MENAGERIE = load_file(Path(__file__).parents[2] / "worlds" / "plane" / "menagerie" / "model.py")
Menagerie = MENAGERIE.Menagerie
SEEDS = (3, 0, 7)


class Greeting(Message):
    loudness: int = 0


def come(scout, model, rng):
    model.welcomed += 1
    model.luck += rng.random()


def greet(scout, model, rng):
    for greeting in model.greetings.to(scout):
        model.heard += greeting.loudness * (1 + scout.id)
        greeting.die()
    greeting = model.greetings.send(scout, model.scouts.one_of(rng))
    greeting.loudness = rng.integers(5)


class Greeters(Menagerie):
    welcomed: int = 0
    heard: int = 0
    luck: float = 0.0

    scouts = replace(Menagerie.scouts, at_birth=come)
    greetings = Messages(Greeting, to=scouts)
    schedule = (*Menagerie.schedule, each(scouts, greet))


RECORD = ("welcomed", "heard", "luck", "born")


def test_each_world_is_as_it_is_alone():
    episodes = Episodes(
        Greeters, skill="Collect", population="collectors", lanes=2, record=RECORD, ticks=100
    )
    genomes = np.zeros((1, 15))
    outcome = episodes.run(genomes, SEEDS)
    for number, seed in enumerate(SEEDS):
        alone = episodes.model(seed, genomes[0])
        while alone.over is None and alone.tick < 100:
            alone.advance(1)
        for name in RECORD:
            assert outcome.fields[name][0, number] == getattr(alone, name), name
        assert alone.welcomed >= len(alone.scouts)
        assert alone.heard > 0
