"""What holds for every optimiser that a lesson can name."""

import random

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.learning.optimisers.neat import NeatGenome
from socialmind.learning.optimisers.registry import OPTIMISERS, optimiser_named
from socialmind.mind.functions.neat.graph import NeatGraph

SIZE = 12
INPUTS, OUTPUTS = 3, 2
CENTRE = 0.4
EVALUATIONS = 6000
LIBRARIES = {"CMAES": "cmaes", "NEAT": "neat"}


def known(keyword):
    """An optimiser, if its library is there."""
    if keyword in LIBRARIES:
        pytest.importorskip(LIBRARIES[keyword])
    return OPTIMISERS[keyword]


@pytest.fixture(params=OPTIMISERS)
def kind(request):
    return known(request.param)


@pytest.fixture(params=[key for key, one in OPTIMISERS.items() if not one.graphs])
def flat(request):
    """One whose individuals are genomes of a fixed length."""
    return known(request.param)


def made(kind, seed, *, larger=0, **others):
    """An optimiser of the size that the tests are about."""
    return kind((INPUTS + larger, OUTPUTS) if kind.graphs else SIZE + larger, seed, **others)


def near(individuals):
    """The nearer all weights are to the centre, and neurons of graphs to five, the better."""
    if isinstance(individuals, np.ndarray):
        return ellipsoid(individuals)
    return np.array(
        [
            -((one.weights - CENTRE) ** 2).mean() - abs(len(one.graph.neurons) - 5)
            for one in individuals
        ]
    )


def individuals_for(kind, count):
    """Individuals that no optimiser draws."""
    weights = 3.0 + np.random.default_rng(1).normal(0.0, 0.1, (count, SIZE))
    if not kind.graphs:
        return weights
    graph = NeatGraph.minimal(INPUTS, OUTPUTS)
    return [NeatGenome(graph, row[: graph.genome_size(INPUTS, OUTPUTS)]) for row in weights]


def sphere(genomes):
    return -((genomes - CENTRE) ** 2).sum(axis=1)


def ellipsoid(genomes):
    """Axes of a condition number of 100, turned so that none lies along a gene."""
    turned = np.linalg.qr(np.random.default_rng(99).normal(size=(SIZE, SIZE)))[0]
    return -(((genomes - CENTRE) @ turned) ** 2 * 10.0 ** np.linspace(0, 2, SIZE)).sum(axis=1)


def infinite(kind):
    """A first individual that no optimiser takes."""
    if not kind.graphs:
        return np.full((1, SIZE), np.inf)
    return [NeatGenome(NeatGraph.minimal(INPUTS, OUTPUTS), [np.inf] * 8)]


def advanced(search, judge, generations):
    """Return the generations that an optimiser asks for."""
    asked = []
    for _ in range(generations):
        asked.append(search.ask())
        search.tell(judge(asked[-1]))
    return asked


def same(one, other):
    """Whether individuals, or one of them, are those of another generation."""
    return np.array_equal(one, other) if isinstance(one, np.ndarray) else one == other


def equal(one, other):
    return len(one) == len(other) and all(same(*pair) for pair in zip(one, other, strict=True))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("judge", "factor"), [(sphere, 100), (ellipsoid, 10)])
def test_it_gets_many_times_nearer_than_its_first_generation(flat, judge, factor, seed):
    search = flat(SIZE, seed)
    advanced(search, judge, 1)
    start = search.best_score
    advanced(search, judge, EVALUATIONS // search.population)
    assert search.best_score > start / factor
    assert search.best_score == pytest.approx(judge(search.best[None])[0], rel=1e-9, abs=0.0)


def test_the_seed_decides_all_draws(kind):
    runs = [advanced(made(kind, seed), near, 20) for seed in (5, 5, 6)]
    assert equal(runs[0], runs[1])
    assert not same(runs[0][0], runs[2][0])


def test_the_best_is_that_of_all_generations(kind):
    search = made(kind, 1)
    noise = np.random.default_rng(3)
    highest, holder = -np.inf, None
    for _ in range(30):
        genomes = search.ask()
        scores = noise.normal(size=len(genomes))
        search.tell(scores)
        if scores.max() > highest:
            highest, holder = scores.max(), genomes[scores.argmax()]
        assert search.best_score == highest
        assert same(search.best, holder)


@pytest.mark.parametrize("after_ask", [False, True])
def test_killed_and_restored_equals_undisturbed_at_every_generation(kind, tmp_path, after_ask):
    undisturbed = advanced(made(kind, 7), near, 25)
    search = made(kind, 7)
    file = tmp_path / "state.npz"
    for expected in undisturbed:
        if after_ask:
            search.ask()
        np.savez(file, **search.state())
        killed, search = search, made(kind, 1000)
        with np.load(file) as state:
            search.restore(state)
        assert search.best_score == killed.best_score
        assert search.generation == 0 or same(search.best, killed.best)
        genomes = search.ask()
        assert same(genomes, expected)
        search.tell(near(genomes))
    assert search.generation == 25


def test_a_state_is_of_its_own_time(kind):
    search = made(kind, 7)
    advanced(search, near, 3)
    state = search.state()
    following = advanced(search, near, 5)
    for _ in range(2):
        again = made(kind, 8)
        again.restore(state)
        assert again.generation == 3
        assert equal(advanced(again, near, 5), following)


def test_a_state_is_arrays_and_numbers_and_comes_back_bit_by_bit(kind, tmp_path):
    search, restored = made(kind, 7), made(kind, 8)
    advanced(search, near, 6)
    np.savez(tmp_path / "state.npz", **search.state())
    with np.load(tmp_path / "state.npz", allow_pickle=False) as state:
        assert {array.dtype.kind for array in state.values()} <= set("iuf")
        restored.restore(state)
    given, expected = restored.state(), search.state()
    assert sorted(given) == sorted(expected)
    for name, value in expected.items():
        assert np.asarray(given[name]).tobytes() == np.asarray(value).tobytes()


def test_nothing_global_is_drawn_from_or_seeded(kind):
    random.gauss(0.0, 1.0)  # keeps half of a pair for the next draw
    before = random.getstate(), np.random.get_state()[1].tobytes()  # noqa: NPY002
    search = made(kind, 7)
    advanced(search, near, 3)
    made(kind, 8).restore(search.state())
    assert (random.getstate(), np.random.get_state()[1].tobytes()) == before  # noqa: NPY002


def test_what_others_draw_makes_no_difference(kind):
    search, other = made(kind, 7), made(kind, 7)
    for seed in range(5):
        genomes = other.ask()
        assert same(search.ask(), genomes)
        search.tell(near(genomes))
        random.seed(seed)
        other.tell(near(genomes))


def test_weights_are_first_drawn_between_minus_one_and_one():
    genomes = OPTIMISERS["GENETIC"](50, 1).ask()
    assert np.abs(genomes).max() <= 1.0
    assert genomes.min() < -0.99
    assert genomes.max() > 0.99


@pytest.mark.parametrize("count", [1, 3, 300])
def test_first_individuals_head_the_first_generation(kind, count):
    first = individuals_for(kind, count)
    search = made(kind, 1, first=first)
    genomes = search.ask()
    fitting = min(count, search.population)
    assert len(genomes) == search.population
    assert same(genomes[:fitting], first[:fitting])
    assert not any(same(one, given) for one in genomes[fitting:] for given in first)


def test_a_lead_that_is_given_is_kept(kind):
    first = individuals_for(kind, 1)
    search = made(kind, 1, first=first)
    advanced(search, lambda genomes: np.array([float(same(one, first[0])) for one in genomes]), 1)
    assert same(search.best, first[0])


@pytest.mark.parametrize("keyword", ["GENETIC", "CMAES"])
def test_only_the_order_of_scores_counts(keyword):
    kind = known(keyword)

    def stretched(genomes):
        return 1e-9 * np.exp(ellipsoid(genomes) / 50.0) - 7e-9

    runs = [advanced(kind(SIZE, 2), judge, 40) for judge in (ellipsoid, stretched)]
    assert equal(*runs)


@pytest.mark.parametrize("size", [1, 2])
def test_small_genomes_are_searched_too(flat, size):
    search = flat(size, 3)
    advanced(search, sphere, 300)
    assert search.best == pytest.approx(np.full(size, CENTRE), abs=0.02)


def test_flat_scores_do_no_harm(kind):
    search = made(kind, 3)
    for genomes in advanced(search, lambda genomes: np.zeros(len(genomes)), 200):
        assert len(genomes) == search.population
        for one in genomes:
            assert np.isfinite(one.weights if kind.graphs else one).all()
    assert search.best_score == 0.0


def test_the_greatest_scores_do_no_harm(kind):
    search = made(kind, 3)
    noise = np.random.default_rng(1)
    with np.errstate(over="ignore"):
        for _ in range(10):
            genomes = search.ask()
            search.tell(noise.choice([-1.7e308, 1.7e308, 0.0], len(genomes)))
    assert search.best_score == 1.7e308
    assert all(np.isfinite(one.weights if kind.graphs else one).all() for one in search.ask())


def test_what_is_asked_for_belongs_to_the_caller(kind):
    search, other = made(kind, 3), made(kind, 3)
    genomes = search.ask()
    scores = near(genomes)
    genomes[:] = genomes[::-1]
    search.tell(scores)
    advanced(other, near, 1)
    assert same(search.ask(), other.ask())
    assert same(search.best, other.best)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (lambda one: one.tell(np.zeros(one.population)), "not asked for"),
        (lambda one: (one.ask(), one.ask()), "asked for twice"),
        (lambda one: (one.ask(), one.tell(np.zeros(one.population + 1))), "scores of shape"),
        (lambda one: (one.ask(), one.tell(["high"] * one.population)), "table of numbers"),
        (lambda one: (one.ask(), one.tell(np.full(one.population, np.nan))), "nan of genome 0"),
        (lambda one: (one.ask(), one.tell(np.full(one.population, -np.inf))), "-inf of genome 0"),
        (lambda one: one.best, "no best genome before"),
        (lambda one: one.restore({}), "expected one of"),
        (lambda one: one.restore(made(type(one), 1, larger=1).state()), "same genome size"),
        (lambda one: one.restore(one.state() | {"generator": np.zeros(6)}), "uint64"),
        (lambda one: type(one)(0, 1), "genome size=0"),
        (lambda one: made(type(one), -1), "seed=-1"),
        (lambda one: made(type(one), 1, settings={"colour": 1}), "'colour'"),
        (lambda one: made(type(one), 1, settings={"step": "wide"}), "step='wide'"),
        (lambda one: made(type(one), 1, first=np.zeros(SIZE)), "first individuals of"),
        (lambda one: made(type(one), 1, first=infinite(type(one))), "not finite"),
    ],
)
def test_what_does_not_fit_is_refused_in_one_line(kind, wrong, message):
    search = made(kind, 1)
    with pytest.raises(SocialmindError) as refused:
        wrong(search)
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_refused_score_can_be_told_anew(kind):
    search, other = made(kind, 1), made(kind, 1)
    genomes = search.ask()
    with pytest.raises(SocialmindError):
        search.tell(np.full(len(genomes), np.nan))
    search.tell(near(genomes))
    advanced(other, near, 1)
    assert same(search.ask(), other.ask())


def test_a_state_of_another_kind_is_refused():
    genetic = OPTIMISERS["GENETIC"](SIZE, 1, {"population": 5})
    with pytest.raises(SocialmindError, match="restore a state of GENETIC"):
        genetic.restore(OPTIMISERS["ANNEALING"](SIZE, 1).state())


def test_keywords_are_found_in_any_case():
    assert optimiser_named("Annealing") is OPTIMISERS["ANNEALING"]
    with pytest.raises(SocialmindError, match="'NEWTON'; expected one of GENETIC, NEAT, ANN"):
        optimiser_named("NEWTON")
