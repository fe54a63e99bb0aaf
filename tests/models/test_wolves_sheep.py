"""Wolves and sheep: eating, starving and breeding by hand; and how their numbers go."""

import numpy as np
import pytest

from socialmind.catalogue import load_model

NEVER = {"sheep_reproduction": 0.0, "wolf_reproduction": 0.0}


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a meadow at either speed, without a birth and without grown grass unless told."""

    def made(sheep=(), wolves=(), size=3, growing=1000, **parameters):
        society = load_model("wolves_sheep")(
            1, compiled=request.param, n_sheep=len(sheep), n_wolves=len(wolves), world_size=size,
            **NEVER | parameters,
        )  # fmt: skip
        society.world.growing = growing
        society.sheep.energy = list(sheep)
        society.wolves.energy = list(wolves)
        return society

    return made


def test_a_sheep_eats_grown_grass_which_grows_anew(make):
    society = make(sheep=[4.0], growing=0, regrowth=20)
    society.advance(1)
    sheep = society.sheep[0]
    assert sheep.energy == 4 - 1 + 5
    assert society.world.patch(sheep.x, sheep.y).growing == 19  # it has grown for a tick
    assert society.series() == {"sheep": 1, "wolves": 0, "grass": 8}


def test_grass_is_grown_after_so_many_ticks(make):
    society = make(growing=3)
    for grass in (0, 0, 9, 9):
        society.advance(1)
        assert society.series()["grass"] == grass


@pytest.mark.parametrize(("energy", "lives"), [(2.0, True), (1.99, False)])
def test_a_sheep_starves_below_one(make, energy, lives):
    society = make(sheep=[energy])
    society.advance(1)
    assert len(society.sheep) == lives


def test_a_sheep_lambs_and_shares_its_energy(make):
    society = make(sheep=[9.0], sheep_reproduction=1.0)
    society.advance(1)
    assert society.sheep.energy.tolist() == [4.0, 4.0]
    mother, lamb = society.sheep
    assert (mother.x, mother.y) == (lamb.x, lamb.y)


def test_the_starving_do_not_lamb(make):
    society = make(sheep=[1.5], sheep_reproduction=1.0)
    society.advance(1)
    assert len(society.sheep) == 0


@pytest.mark.parametrize(("energy", "lives"), [(1.0, True), (0.99, False)])
def test_a_wolf_starves_below_zero(make, energy, lives):
    society = make(wolves=[energy])
    society.advance(1)
    assert len(society.wolves) == lives


def test_a_wolf_eats_one_sheep_of_its_patch(make):
    # Thirty sheep on nine patches: a wolf finds some nearly anywhere, and eats one.
    society = make(sheep=[50.0] * 30, wolves=[4.0])
    society.advance(1)
    wolf = society.wolves[0]
    eaten = 30 - len(society.sheep)
    assert wolf.energy == 4 - 1 + 13 * eaten
    assert eaten == 1


def test_a_wolf_whelps_and_shares_its_energy(make):
    society = make(wolves=[9.0], wolf_reproduction=1.0)
    society.advance(1)
    assert society.wolves.energy.tolist() == [4.0, 4.0]


def test_animals_move_to_one_of_eight_neighbours(make):
    society = make(sheep=[50.0] * 400, size=9)
    before = np.array([society.sheep.x, society.sheep.y])
    society.advance(1)
    moved = (np.array([society.sheep.x, society.sheep.y]) - before + 4) % 9 - 4
    steps, counts = np.unique(moved, axis=1, return_counts=True)
    assert np.abs(steps).max(axis=0).tolist() == [1] * 8
    assert counts.min() > 25  # 50 of each are expected


def test_the_beginning():
    society = load_model("wolves_sheep")(1, n_sheep=3000, n_wolves=3000, world_size=100)
    assert set(society.sheep.energy.tolist()) == set(range(1, 11))
    assert set(society.wolves.energy.tolist()) == set(range(1, 27))
    growing = society.world.growing
    assert set(growing.ravel().tolist()) == set(range(21))
    assert (growing == 0).mean() == pytest.approx(0.5, abs=0.02)


def ends(ticks, **parameters):
    """Return, of 30 societies, at which ticks of fifty the wolves had died out, and the rest."""
    gone, alive = [], []
    for seed in range(30):
        society = load_model("wolves_sheep")(seed, **parameters)
        while society.tick < ticks and len(society.wolves):
            society.advance(50)
        (alive if len(society.wolves) else gone).append((society.tick, len(society.sheep)))
    return gone, alive


def test_wolves_die_out_where_grass_grows_slowly_and_sheep_live_on():
    gone, _ = ends(1000, regrowth=30)
    assert len(gone) >= 29
    assert 100 <= np.mean([tick for tick, _ in gone]) <= 250
    assert min(sheep for _, sheep in gone) > 0


def test_all_three_live_on_where_it_grows_fast():
    gone, alive = ends(1000, regrowth=10)
    assert gone == []
    assert min(sheep for _, sheep in alive) > 0


def test_numbers_cycle_and_wolves_follow_sheep():
    society = load_model("wolves_sheep")(1, regrowth=10)
    society.advance(100)
    numbers = []
    for _ in range(1500):
        society.advance(1)
        numbers.append((len(society.sheep), len(society.wolves)))
    sheep, wolves = np.array(numbers).T
    later = [np.corrcoef(sheep[: 1500 - lag], wolves[lag:])[0, 1] for lag in range(80)]
    assert 18 <= int(np.argmax(later)) <= 34
    assert max(later) > 0.4
    assert np.corrcoef(sheep[:-40], sheep[40:])[0, 1] < -0.2  # half a cycle
    assert np.corrcoef(sheep[:-80], sheep[80:])[0, 1] > 0.2  # a cycle
