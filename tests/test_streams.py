"""Random streams: known answers, distributions, and nobody's luck disturbed."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from coglogo_py.streams import philox, uniforms
from socialmind import Agent, Model, Population, each, streams
from socialmind.streams import STREAM, Stream, shuffle

ONES = 0xFFFFFFFF
KNOWN = {  # Random123's known answers: counter and key, the four words
    (0, 0, 0, 0, 0, 0): (0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8),
    (ONES, ONES, ONES, ONES, ONES, ONES): (0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD),
    (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344, 0xA4093822, 0x299F31D0): (
        *(0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1),
    ),
}


@pytest.mark.parametrize("counter", KNOWN)
def test_philox_gives_the_known_answers(counter):
    assert philox(*counter) == KNOWN[counter]
    assert numba.njit(lambda *words: philox(*words))(*counter) == KNOWN[counter]


@given(st.lists(st.integers(0, ONES), min_size=6, max_size=6))
def test_uniforms_are_in_the_unit_interval(words):
    for number in uniforms(*words):
        assert 0.0 <= number < 1.0
        assert number * 2**53 == int(number * 2**53)


def drawn(n, draw, seed=1):
    stream = Stream(seed)
    numbers = []
    for agent in range(n // 100):
        stream.begin(7, agent, 3)
        numbers += [draw(stream) for _ in range(100)]
    return np.array(numbers)


def test_distributions_have_their_moments():
    n = 40_000
    unit = drawn(n, lambda rng: rng.random())
    assert unit.mean() == pytest.approx(0.5, abs=4 / math.sqrt(12 * n))
    assert unit.var() == pytest.approx(1 / 12, rel=0.03)
    wide = drawn(n, lambda rng: rng.uniform(-2, 6))
    assert wide.min() >= -2
    assert wide.max() < 6
    assert wide.mean() == pytest.approx(2, abs=0.05)
    normal = drawn(n, lambda rng: rng.normal(3, 2))
    assert normal.mean() == pytest.approx(3, abs=0.04)
    assert normal.std() == pytest.approx(2, rel=0.03)
    assert np.mean(np.abs(normal - 3) < 2) == pytest.approx(0.6827, abs=0.01)
    waits = drawn(n, lambda rng: rng.exponential(5))
    assert waits.min() >= 0
    assert waits.mean() == pytest.approx(5, rel=0.03)
    assert np.mean(waits > 5) == pytest.approx(math.exp(-1), abs=0.01)


def test_whole_numbers_are_all_met_alike():
    faces = drawn(60_000, lambda rng: rng.integers(1, 7))
    values, counts = np.unique(faces, return_counts=True)
    assert values.tolist() == [1, 2, 3, 4, 5, 6]
    assert np.sum((counts - 10_000) ** 2 / 10_000) < 20.5  # chi-square, 5 degrees, p = 0.001
    assert set(drawn(1000, lambda rng: rng.integers(2)).tolist()) == {0, 1}
    assert set(drawn(1000, lambda rng: rng.integers(-3, -2)).tolist()) == {-3}


def test_successive_numbers_are_not_correlated():
    numbers = drawn(40_000, lambda rng: rng.random())
    assert abs(np.corrcoef(numbers[:-1], numbers[1:])[0, 1]) < 0.02
    by_agent = numbers.reshape(-1, 100)
    assert abs(np.corrcoef(by_agent[:-1, 0], by_agent[1:, 0])[0, 1]) < 0.2


@pytest.mark.parametrize(
    ("draw", "message"),
    [
        (lambda rng: rng.integers(0), "not empty"),
        (lambda rng: rng.integers(3, 3), "not empty"),
        (lambda rng: rng.integers(0, 2**53 + 1), "2\\*\\*53"),
        (lambda rng: rng.normal(0, -1), "deviation"),
        (lambda rng: rng.normal(0, math.nan), "deviation"),
        (lambda rng: rng.exponential(-1), "mean"),
    ],
)
def test_impossible_draws(draw, message):
    with pytest.raises(ValueError, match=message):
        draw(Stream(1))


def test_a_shuffle_is_a_permutation_and_fair():
    stream = Stream(5)
    firsts = np.zeros((5, 5))
    for tick in range(4000):
        places = np.arange(5)
        stream.begin(streams.ORDER_TAG, 0, tick)
        shuffle(stream, places, 5)
        assert sorted(places.tolist()) == [0, 1, 2, 3, 4]
        firsts[np.arange(5), places] += 1
    assert np.all(np.abs(firsts - 800) < 4 * math.sqrt(800))
    assert shuffle(stream, np.zeros(0, int), 0) is None


def test_compiled_streams_draw_the_same():
    @numba.njit
    def draws(states):
        stream = states[0]
        streams.begin(stream, 99, 12345678901, 2**40 + 3)
        places = np.arange(50)
        streams.shuffle(stream, places, 50)
        return (
            streams.random(stream),
            streams.uniform(stream, -2.0, 3.0),
            streams.integers(stream, -5, 2**50),
            streams.normal(stream, 1.0, 2.0),
            streams.exponential(stream, 3.0),
            places,
        )

    states = np.zeros(1, STREAM)
    stream = Stream(2**64 - 5)
    states["key_0"], states["key_1"] = stream.key_0, stream.key_1
    *fast, order = draws(states)
    stream.begin(99, 12345678901, 2**40 + 3)
    places = np.arange(50)
    shuffle(stream, places, 50)
    slow = [stream.random(), stream.uniform(-2, 3), stream.integers(-5, 2**50)]
    slow += [stream.normal(1, 2), stream.exponential(3)]
    assert fast == slow
    assert order.tolist() == places.tolist()


# Nobody's luck is disturbed


class Gambler(Agent):
    purse: float = 0.0
    games: int = 0


def play(gambler, model, rng):
    gambler.purse += rng.normal(0, 1)
    if rng.random() < 0.5:
        gambler.games += rng.integers(10)


def watch(gambler, rng):
    gambler.heading = rng.random() + rng.random()


class Casino(Model):
    gamblers = Population(Gambler, 5)
    schedule = (each(gamblers, play),)


class CrowdedCasino(Model):
    gamblers = Population(Gambler, 8)
    schedule = (each(gamblers, play),)


class WatchedCasino(Model):
    gamblers = Population(Gambler, 5)
    schedule = (each(gamblers, watch), each(gamblers, play))


@pytest.mark.parametrize("other", [CrowdedCasino, WatchedCasino])
def test_more_agents_or_rules_disturb_nobody(other):
    one, two = Casino(3, compiled=False), other(3, compiled=False)
    one.advance(20)
    two.advance(20)
    assert one.gamblers.purse.tolist() == two.gamblers.purse[:5].tolist()
    assert one.gamblers.games.tolist() == two.gamblers.games[:5].tolist()


def test_seeds_agents_and_ticks_differ():
    society = Casino(3, compiled=False)
    society.advance(1)
    first = society.gamblers.purse.tolist()
    assert len(set(first)) == 5
    society.advance(1)
    assert all(abs(b - 2 * a) > 1e-12 for a, b in zip(first, society.gamblers.purse, strict=True))
    other = Casino(4, compiled=False)
    other.advance(1)
    assert not set(first) & set(other.gamblers.purse.tolist())
    again = Casino(3, compiled=False)
    again.advance(1)
    assert again.gamblers.purse.tolist() == first
    large = Casino(3 + 2**32, compiled=False)
    large.advance(1)
    assert not set(first) & set(large.gamblers.purse.tolist())
