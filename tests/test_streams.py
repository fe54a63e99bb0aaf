"""Random streams: known answers, distributions, and nobody's luck disturbed."""

import math
import zlib

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

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


@pytest.mark.parametrize("mean", [0.0, 0.3, 4.0, 9.99, 10.0, 37.5, 5000.0])
def test_poisson_counts_are_as_likely_as_scipy_says(mean):
    n = 20_000
    counts = drawn(n, lambda rng: rng.poisson(mean), seed=11)
    assert counts.min() >= 0
    assert counts.mean() == pytest.approx(mean, abs=4 * math.sqrt(mean / n))
    law = stats.poisson(mean)
    edges = np.unique(law.ppf(np.linspace(0.02, 0.98, 15))) if mean else np.array([0.0])
    expected = n * np.diff(law.cdf(edges), prepend=0, append=1)
    places = np.searchsorted(edges, counts)
    observed = np.bincount(places, minlength=len(expected))
    kept = expected > 0
    assert observed[~kept].sum() == 0
    chi_square = np.sum((observed[kept] - expected[kept]) ** 2 / expected[kept])
    assert chi_square < stats.chi2.ppf(0.999, max(1, kept.sum() - 1))


def test_poisson_means_from_nothing_to_the_largest():
    assert set(drawn(100, lambda rng: rng.poisson(0.0)).tolist()) == {0}
    large = drawn(2000, lambda rng: rng.poisson(1e9))
    assert large.mean() == pytest.approx(1e9, abs=4 * math.sqrt(1e9 / 2000))
    assert large.std() == pytest.approx(math.sqrt(1e9), rel=0.1)


def poisson_numbers(stream, mean, n):
    numbers = np.zeros(n, np.int64)
    for i in range(n):
        numbers[i] = streams.poisson(stream, mean)
    return numbers


def test_poisson_numbers_stay_as_they_are():
    """Many, since some of the method's constants decide about one number in thousands only."""
    fast = numba.njit(poisson_numbers)
    for mean, sum_of_few, kept_few, sum_of_many, kept_many in KEPT_POISSON:
        stream = Stream(31)
        stream.begin(5, 2, 1)
        states = np.zeros(1, STREAM)
        for name in STREAM.names:
            states[name] = getattr(stream, name)
        few, many = poisson_numbers(stream, mean, 1000), fast(states[0], mean, 300_000)
        assert few.tolist() == many[:1000].tolist()
        assert (few.sum(), many.sum()) == (sum_of_few, sum_of_many), mean
        assert (zlib.crc32(few.tobytes()), zlib.crc32(many.tobytes())) == (kept_few, kept_many)
        # The sum is Poisson too, of 300,000 times the mean: nearly normal.
        expected = 300_000 * mean
        assert abs(sum_of_many - expected) < 4 * math.sqrt(expected)


KEPT_POISSON = [
    (9.999, 9957, 529304690, 2999235, 2879148381),
    (10.0, 9851, 3746215337, 2997851, 1548546825),
    (10.5, 10436, 824349103, 3147380, 871419416),
    (12.0, 11864, 646223512, 3597635, 2103558195),
    (40.0, 39808, 4249393087, 11993768, 4192745474),
    (300.0, 299759, 1528314384, 89982121, 1185004954),
    (1e9, 999999893182, 454182155, 299999962930486, 3660341721),
]


def test_factorials():
    for k in (0, 1, 2, 9, 10, 11, 57, 1000, 10**9):
        assert streams.log_factorial(k) == pytest.approx(math.lgamma(k + 1), rel=1e-13, abs=1e-13)


@pytest.mark.parametrize("shape", [0.05, 0.5, 1.0, 2.5, 40.0, 1e6])
def test_gamma_numbers_are_distributed_as_scipy_says(shape):
    n = 10_000
    numbers = drawn(n, lambda rng: rng.gamma(shape, 3.0), seed=12)
    law = stats.gamma(shape, scale=3.0)
    assert stats.kstest(numbers, law.cdf).pvalue > 0.001
    assert numbers.mean() == pytest.approx(law.mean(), abs=4 * law.std() / math.sqrt(n))
    assert set(drawn(100, lambda rng: rng.gamma(shape, 0)).tolist()) == {0.0}


def test_choices_are_as_likely_as_their_weights():
    n = 40_000
    weights = [0.0, 1.0, 2.5, 0.0, 0.5, 0.0]
    places = drawn(n, lambda rng: rng.choice(6, p=weights), seed=13)
    counts = np.bincount(places, minlength=6)
    assert counts[[0, 3, 5]].tolist() == [0, 0, 0]
    expected = n * np.array([1.0, 2.5, 0.5]) / 4
    assert np.sum((counts[[1, 2, 4]] - expected) ** 2 / expected) < stats.chi2.ppf(0.999, 2)
    assert drawn(3000, lambda rng: rng.choice((7, 8, 9))).mean() == pytest.approx(8, abs=0.07)
    assert set(drawn(100, lambda rng: rng.choice((7, 8), p=(0, 3))).tolist()) == {8}
    assert set(drawn(100, lambda rng: rng.choice((1.5, 2.5), p=(5e-324, 0))).tolist()) == {1.5}


def test_permutations_are_fair():
    stream = Stream(5)
    firsts = np.zeros((4, 4))
    for tick in range(4000):
        stream.begin(3, 0, tick)
        order = stream.permutation(4)
        assert sorted(order) == [0, 1, 2, 3]
        firsts[np.arange(4), order] += 1
    assert np.all(np.abs(firsts - 1000) < 4 * math.sqrt(750))
    assert stream.permutation(0) == []
    assert stream.permutation(1) == [0]
    stream.begin(3, 0, 1)
    deck = np.arange(4)
    stream.shuffle(deck)
    stream.begin(3, 0, 1)
    assert stream.permutation(4) == deck.tolist()


def test_numbers_of_the_draws_stay_as_they_are():
    stream = Stream(2024)
    stream.begin(7, 3, 5)
    numbers = [stream.random(), stream.uniform(-1, 1), stream.integers(1000)]
    numbers += [stream.normal(0, 1), stream.exponential(2)]
    assert [float(one).hex() for one in numbers] == KEPT
    stream.begin(7, 3, 5)
    numbers = [stream.gamma(2.5, 3), stream.gamma(0.5, 1), stream.poisson(4), stream.poisson(40)]
    numbers += [stream.choice(5, p=(1, 2, 3, 4, 5)), *stream.permutation(4), stream.random()]
    assert [float(one).hex() for one in numbers] == KEPT_TOO


KEPT = [
    "0x1.cb36660b68700p-6",
    "0x1.988f9daa29ba2p-1",
    "0x1.b800000000000p+9",
    "0x1.0fa00e0a16533p-1",
    "0x1.41b68cd94cc62p-2",
]
KEPT_TOO = [
    "0x1.d8a8ac5b2e69cp+2",
    "0x1.2e91faf02024ep-8",
    "0x1.8000000000000p+2",
    "0x1.1800000000000p+5",
    "0x1.0000000000000p+0",
    "0x1.8000000000000p+1",
    "0x1.0000000000000p+1",
    "0x1.0000000000000p+0",
    "0x0.0p+0",
    "0x1.74efecbb6f788p-2",
]


def test_orders_and_a_gamma_number_of_shape_one_stay_as_they_are():
    stream = Stream(2024)
    stream.begin(7, 3, 5)
    assert stream.gamma(1.0, 1.0).hex() == "0x1.ac0f12466fa09p-1"
    assert 0 <= stream.integers(0, 2**53) < 2**53
    places = np.arange(11)
    stream.begin(streams.ORDER_TAG, 0, 3)
    shuffle(stream, places, 11)
    assert places.tolist() == [8, 1, 0, 6, 10, 5, 7, 2, 9, 3, 4]


def test_a_stream_is_that_of_an_agent_a_tick_and_a_phase():
    stream = Stream(2**40 + 3)
    assert (stream.key_0, stream.key_1) == (3, 2**8)
    stream.random()
    stream.begin(7, 2**32 + 9, 2**40 + 5)
    assert (stream.agent, stream.tick, stream.tag, stream.draws) == (9, 5, 7 * 2**16 + 2**8, 0)


def test_phases_of_one_name_have_tags_of_their_own():
    first = 0x8000 + 11439  # the CRC-32 of "live", of 0x4000
    found = streams.phase_tags(streams.SCHEDULE_TAG, ["live", "live", "live"])
    assert found == [first, first + 1, first + 2]
    # This name's is the last tag there is: the next is the first.
    found = streams.phase_tags(streams.SCHEDULE_TAG, ["rule_12890"] * 2)
    assert found == [0xBFFF, 0x8000]


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
        (lambda rng: rng.poisson(-0.5), "mean of 0"),
        (lambda rng: rng.poisson(math.nan), "mean of 0"),
        (lambda rng: rng.poisson(math.inf), "mean of 0"),
        (lambda rng: rng.poisson(math.nextafter(1e9, 2e9)), "mean of 0"),
        (lambda rng: rng.gamma(0, 1), "shape above 0"),
        (lambda rng: rng.gamma(-1, 1), "shape above 0"),
        (lambda rng: rng.gamma(math.nan, 1), "shape above 0"),
        (lambda rng: rng.gamma(math.inf, 1), "shape above 0"),
        (lambda rng: rng.gamma(1, -1), "scale of 0 or more"),
        (lambda rng: rng.gamma(1, math.nan), "scale of 0 or more"),
        (lambda rng: rng.choice(2, p=(0, 0)), "a sum above 0"),
        (lambda rng: rng.choice(2, p=(1, -1)), "weights of 0 or more"),
        (lambda rng: rng.choice(2, p=(1, math.nan)), "weights of 0 or more"),
        (lambda rng: rng.choice(2, p=(1, math.inf)), "not infinite"),
        (lambda rng: rng.choice(2, p=(1e308, 1e308)), "not infinite"),
        (lambda rng: rng.permutation(-1), "number of 0"),
        (lambda rng: rng.permutation(10**9), "number of 0"),
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
            streams.gamma(stream, 0.7, 2.0),
            streams.gamma(stream, 7.5, 2.0),
            streams.poisson(stream, 3.0),
            streams.poisson(stream, 3e4),
            streams.weighted(stream, (0.5, 0.0, 2.0, 1.0)),
            places,
            streams.permutation(stream, 9),
        )

    states = np.zeros(1, STREAM)
    stream = Stream(2**64 - 5)
    states["key_0"], states["key_1"] = stream.key_0, stream.key_1
    *fast, order, permuted = draws(states)
    stream.begin(99, 12345678901, 2**40 + 3)
    places = np.arange(50)
    shuffle(stream, places, 50)
    slow = [stream.random(), stream.uniform(-2, 3), stream.integers(-5, 2**50)]
    slow += [stream.normal(1, 2), stream.exponential(3)]
    slow += [stream.gamma(0.7, 2), stream.gamma(7.5, 2), stream.poisson(3), stream.poisson(3e4)]
    slow += [stream.weighted((0.5, 0.0, 2.0, 1.0))]
    assert fast == slow
    assert permuted.tolist() == stream.permutation(9)
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
