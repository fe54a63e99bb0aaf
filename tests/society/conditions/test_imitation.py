"""Chance at birth, inheritance and imitation in models, alike at both speeds."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton
from socialmind import Agent, Model, ModelError, Population, each

SONG = Cogniton("Song", starting=False, start_value=1, type="meme", conditional=("sing",))
DANCE = Cogniton("Dance", start_value=3, type="meme", chance=0.4, inherited=0.5)
SHY = Cogniton("Shy", type="trait", chance=0.5, start_value=1)
FOLK = CognitiveScheme("folk", (SHY, SONG, DANCE))
LORDS = CognitiveScheme(
    "lords",
    (
        Cogniton("Dance", start_value=9, type="meme", active_while="wealth > 5"),
        Cogniton("Pride", type="meme"),
        Cogniton("Song", start_value=4),
    ),
)


class Human(Agent):
    taken: int = 0
    song: bool = False
    wealth: float = 0.0


def learn(human, model, rng):
    """Take over what one of the others and one of the lords has, if not shy."""
    other = model.folk.one_of(rng)
    lord = model.lords.one_of(rng)
    if not human.mind.is_active("Shy"):
        human.taken += human.mind.imitate_memes(other.mind)
        human.taken += human.mind.imitate_memes(lord.mind)
        human.song = human.mind.imitate("Song", lord.mind)
    if human.mind.is_active("Song"):
        human.mind.add_to_cogniton_value("Song", 1.0)
    if rng.random() < 0.2:
        human.mind.deactivate_cogniton("Dance")
    if rng.random() < 0.2:
        human.hatch()
        human.die()
    elif rng.random() < 0.1:
        model.folk.create()


def rule(lord, model, rng):
    lord.wealth = rng.uniform(0.0, 10.0)
    if rng.random() < 0.3:
        lord.mind.deactivate_cogniton("Song")
    else:
        lord.mind.activate_cogniton("Song")
        lord.mind.set_cogniton_value("Song", lord.wealth)
    lord.mind.imitate("Dance", model.folk.one_of(rng).mind)


class Village(Model):
    folk = Population(Human, 30, mind=FOLK, culture="village")
    lords = Population(Human, 3, mind=LORDS, culture="village")
    schedule = (each(folk, learn), each(lords, rule))


def test_both_speeds_agree():
    fast, slow = Village(seed=4), Village(seed=4, compiled=False)
    for _ in range(25):
        fast.advance(1)
        slow.advance(1)
        for name in ("folk", "lords"):
            one, other = fast.tables[name], slow.tables[name]
            for column in ("taken", "song", "wealth", "id"):
                np.testing.assert_array_equal(getattr(one, column), getattr(other, column))
            for cogniton in [c.name for c in one.society.scheme.cognitons]:
                np.testing.assert_array_equal(one.cogniton(cogniton), other.cogniton(cogniton))
    assert fast.folk.taken.sum() > 30 and 0 < fast.folk.song.sum() < len(fast.folk)


def test_founders_have_by_chance_what_their_seed_gives_them():
    founders = Village(seed=4).folk
    assert 5 < np.isnan(founders.cogniton("Shy")).sum() < 25
    assert np.isnan(founders.cogniton("Song")).all()
    assert set(founders.cogniton("Dance")[~np.isnan(founders.cogniton("Dance"))]) == {3.0}
    others = Village(seed=5).folk
    assert (np.isnan(others.cogniton("Shy")) != np.isnan(founders.cogniton("Shy"))).any()


# A meme that spreads, against an account ----------------------------------------------------------


class Bird(Agent):
    heard: int = -1
    turn: int = 0


TUNES = CognitiveScheme(
    "birds",
    (
        Cogniton("Low", starting=False, type="meme"),
        Cogniton("High", starting=False, type="meme"),
        Cogniton("Wing", start_value=5, type="trait"),
    ),
)


def listen(bird, model):
    if bird.turn == 0:
        bird.mind.imitate_memes(model.birds[bird.heard].mind)
    elif bird.turn == 1:
        bird.mind.imitate("High", model.birds[bird.heard].mind)
    elif bird.turn == 2:
        bird.mind.imitate("Wing", model.birds[bird.heard].mind)
    else:
        bird.mind.deactivate_cogniton("Low")


class Wood(Model):
    birds = Population(Bird, 8, mind=TUNES)
    schedule = (each(birds, listen, shuffled=False),)


def test_imitation_agrees_with_a_plain_account():
    rng = np.random.default_rng(1)
    for compiled in (True, False):
        wood = Wood(compiled=compiled)
        minds = [{"Low": None, "High": None, "Wing": 5.0} for _ in range(8)]
        for _ in range(40):
            who = int(rng.integers(8))
            name = ("Low", "High", "Wing")[rng.integers(3)]
            value = float(rng.integers(1, 100))
            wood.birds[who].mind.activate_cogniton(name)
            wood.birds[who].mind.set_cogniton_value(name, value)
            minds[who][name] = value
            heard, turns = rng.integers(0, 8, 8), rng.integers(0, 4, 8)
            wood.birds.heard, wood.birds.turn = heard, turns
            wood.advance(1)
            for mind, other, turn in zip(minds, heard.tolist(), turns.tolist(), strict=True):
                for one in (("Low", "High"), ("High",), ("Wing",), ())[turn]:
                    if minds[other][one] is not None:
                        mind[one] = minds[other][one]
                if turn == 3:
                    mind["Low"] = None
            assert [bird.mind.cognitons() for bird in wood.birds] == minds


# What is refused ----------------------------------------------------------------------------------


def unknown(human, model, rng):
    human.mind.imitate("Shy", model.lords.one_of(rng).mind)


def no_mind(human, model, rng):
    human.mind.imitate("Song", model.lords.one_of(rng))


def no_cogniton(human, model, rng):
    human.mind.imitate(model.lords.one_of(rng).mind)


def too_much(human, model, rng):
    human.mind.imitate_memes("Song", model.lords.one_of(rng).mind)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (unknown, "the cogniton 'Shy', which the scheme 'lords' does not have"),
        (no_mind, 'expected the mind of another agent; write agent.mind.imitate("Fashion", other'),
        (no_cogniton, "found mind.imitate() of something else"),
        (too_much, "write agent.mind.imitate_memes(other.mind)"),
    ],
)
def test_errors_name_the_line(wrong, message):
    class Wrong(Village):
        schedule = (each(Village.folk, wrong),)

    for compiled in (True, False):
        with pytest.raises(ModelError) as error:
            Wrong(compiled=compiled)
        assert message in str(error.value)
        assert str(error.value).startswith(f"{__file__}:{wrong.__code__.co_firstlineno + 1}: ")
