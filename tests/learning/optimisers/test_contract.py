"""What holds for every optimiser that a lesson can name."""

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.learning.optimisers.registry import OPTIMISERS, optimiser_named

SIZE = 12
CENTRE = 0.4
EVALUATIONS = 6000


@pytest.fixture(params=OPTIMISERS)
def kind(request):
    if request.param == "CMAES":
        pytest.importorskip("cmaes")
    return OPTIMISERS[request.param]


def sphere(genomes):
    return -((genomes - CENTRE) ** 2).sum(axis=1)


def ellipsoid(genomes):
    """Axes of a condition number of 100, turned so that none lies along a gene."""
    turned = np.linalg.qr(np.random.default_rng(99).normal(size=(SIZE, SIZE)))[0]
    return -(((genomes - CENTRE) @ turned) ** 2 * 10.0 ** np.linspace(0, 2, SIZE)).sum(axis=1)


def advanced(search, judge, generations):
    """Return the generations that an optimiser asks for."""
    asked = []
    for _ in range(generations):
        asked.append(search.ask())
        search.tell(judge(asked[-1]))
    return asked


def equal(one, other):
    return len(one) == len(other) and all(
        np.array_equal(*pair) for pair in zip(one, other, strict=True)
    )


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("judge", "factor"), [(sphere, 100), (ellipsoid, 10)])
def test_it_gets_many_times_nearer_than_its_first_generation(kind, judge, factor, seed):
    search = kind(SIZE, seed)
    advanced(search, judge, 1)
    start = search.best_score
    advanced(search, judge, EVALUATIONS // search.population)
    assert search.best_score > start / factor
    assert search.best_score == pytest.approx(judge(search.best[None])[0], rel=1e-9, abs=0.0)


def test_the_seed_decides_all_draws(kind):
    runs = [advanced(kind(SIZE, seed), ellipsoid, 20) for seed in (5, 5, 6)]
    assert equal(runs[0], runs[1])
    assert not (runs[0][0] == runs[2][0]).all()


def test_the_best_is_that_of_all_generations(kind):
    search = kind(SIZE, 1)
    noise = np.random.default_rng(3)
    highest, holder = -np.inf, None
    for _ in range(30):
        genomes = search.ask()
        scores = noise.normal(size=len(genomes))
        search.tell(scores)
        if scores.max() > highest:
            highest, holder = scores.max(), genomes[scores.argmax()]
        assert search.best_score == highest
        assert (search.best == holder).all()


@pytest.mark.parametrize("after_ask", [False, True])
def test_killed_and_restored_equals_undisturbed_at_every_generation(kind, tmp_path, after_ask):
    undisturbed = advanced(kind(SIZE, 7), ellipsoid, 25)
    search = kind(SIZE, 7)
    file = tmp_path / "state.npz"
    for expected in undisturbed:
        if after_ask:
            search.ask()
        np.savez(file, **search.state())
        best = search.best_score
        search = kind(SIZE, 1000)
        with np.load(file) as state:
            search.restore(state)
        assert search.best_score == best
        genomes = search.ask()
        assert np.array_equal(genomes, expected)
        search.tell(ellipsoid(genomes))
    assert search.generation == 25


def test_a_state_is_of_its_own_time(kind):
    search = kind(SIZE, 7)
    advanced(search, sphere, 3)
    state = search.state()
    following = advanced(search, sphere, 5)
    for _ in range(2):
        again = kind(SIZE, 8)
        again.restore(state)
        assert again.generation == 3
        assert equal(advanced(again, sphere, 5), following)


def test_weights_are_first_drawn_between_minus_one_and_one():
    genomes = OPTIMISERS["GENETIC"](50, 1).ask()
    assert np.abs(genomes).max() <= 1.0
    assert genomes.min() < -0.99
    assert genomes.max() > 0.99


@pytest.mark.parametrize("count", [1, 3, 300])
def test_first_individuals_head_the_first_generation(kind, count):
    first = 3.0 + np.random.default_rng(1).normal(0.0, 0.1, (count, SIZE))
    search = kind(SIZE, 1, first=first)
    genomes = search.ask()
    fitting = min(count, search.population)
    assert genomes.shape == (search.population, SIZE)
    assert (genomes[:fitting] == first[:fitting]).all()
    assert not (genomes[fitting:, None] == first[None]).all(axis=2).any()


def test_a_lead_that_is_given_is_kept(kind):
    first = np.full((1, SIZE), CENTRE) + 0.001
    search = kind(SIZE, 1, first=first)
    advanced(search, sphere, 1)
    assert (search.best == first[0]).all()


@pytest.mark.parametrize("keyword", ["GENETIC", "CMAES"])
def test_only_the_order_of_scores_counts(keyword):
    if keyword == "CMAES":
        pytest.importorskip("cmaes")
    kind = OPTIMISERS[keyword]

    def stretched(genomes):
        return 1e-9 * np.exp(ellipsoid(genomes) / 50.0) - 7e-9

    runs = [advanced(kind(SIZE, 2), judge, 40) for judge in (ellipsoid, stretched)]
    assert equal(*runs)


@pytest.mark.parametrize("size", [1, 2])
def test_small_genomes_are_searched_too(kind, size):
    search = kind(size, 3)
    advanced(search, sphere, 300)
    assert search.best == pytest.approx(np.full(size, CENTRE), abs=0.02)


def test_flat_scores_do_no_harm(kind):
    search = kind(SIZE, 3)
    for genomes in advanced(search, lambda genomes: np.zeros(len(genomes)), 200):
        assert np.isfinite(genomes).all()
    assert search.best_score == 0.0


def test_what_is_asked_for_belongs_to_the_caller(kind):
    search, other = kind(SIZE, 3), kind(SIZE, 3)
    genomes = search.ask()
    scores = sphere(genomes)
    genomes[:] = 0.0
    search.tell(scores)
    advanced(other, sphere, 1)
    assert np.array_equal(search.ask(), other.ask())
    assert np.array_equal(search.best, other.best)


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
        (lambda one: one.restore(type(one)(SIZE + 1, 1).state()), "same genome size"),
        (lambda one: one.restore(one.state() | {"generator": np.zeros(6)}), "uint64"),
        (lambda one: type(one)(0, 1), "genome size=0"),
        (lambda one: type(one)(SIZE, -1), "seed=-1"),
        (lambda one: type(one)(SIZE, 1, {"colour": 1}), "'colour'"),
        (lambda one: type(one)(SIZE, 1, {"step": "wide"}), "step='wide'"),
        (lambda one: type(one)(SIZE, 1, first=np.zeros(SIZE)), "first individuals of shape"),
        (lambda one: type(one)(SIZE, 1, first=np.full((1, SIZE), np.inf)), "not finite"),
    ],
)
def test_what_does_not_fit_is_refused_in_one_line(kind, wrong, message):
    search = kind(SIZE, 1)
    with pytest.raises(SocialmindError) as refused:
        wrong(search)
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_refused_score_can_be_told_anew(kind):
    search, other = kind(SIZE, 1), kind(SIZE, 1)
    genomes = search.ask()
    with pytest.raises(SocialmindError):
        search.tell(np.full(len(genomes), np.nan))
    search.tell(sphere(genomes))
    advanced(other, sphere, 1)
    assert np.array_equal(search.ask(), other.ask())


def test_a_state_of_another_kind_is_refused():
    genetic = OPTIMISERS["GENETIC"](SIZE, 1, {"population": 5})
    with pytest.raises(SocialmindError, match="restore a state of GENETIC"):
        genetic.restore(OPTIMISERS["ANNEALING"](SIZE, 1).state())


def test_keywords_are_found_in_any_case():
    assert optimiser_named("Annealing") is OPTIMISERS["ANNEALING"]
    with pytest.raises(SocialmindError, match="'NEWTON'; expected one of GENETIC, ANNEALING, CMA"):
        optimiser_named("NEWTON")
