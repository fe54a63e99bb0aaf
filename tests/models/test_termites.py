"""Termites: what they take, where they put it down, and how piles are counted."""

import numpy as np
import pytest

from socialmind.catalogue import load_model
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

NAME = "termites"
RULES = load_file(model_folder(NAME) / "model.py")


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make bare ground with one termite in the middle, at either speed."""

    def made(chip=0, placing=False, **parameters):
        society = load_model(NAME)(
            5, compiled=request.param, n_termites=1, density=0.0, world_size=9, **parameters
        )
        termite = society.termites[0]
        termite.x = termite.y = 0.0
        termite.chip, termite.placing = chip, placing
        return society, termite

    return made


def test_a_chip_is_picked_up_and_carried_away(make):
    society, termite = make(away=3)
    society.world.chip = 1
    society.advance(1)
    assert (termite.chip, termite.leaving, termite.moved) == (1, 3, 0)
    assert (society.world.chip == 0).sum() == 1
    heading = termite.heading
    society.advance(3)
    # Straight on, over chips, which it neither takes nor notices.
    assert (termite.leaving, termite.heading, termite.placing) == (0, heading, False)
    society.advance(1)
    assert termite.placing
    assert (society.world.chip == 0).sum() == 1


def test_a_pile_of_another_kind_is_none(make):
    society, termite = make(chip=2)
    society.world.chip = 1
    society.advance(20)
    assert (termite.chip, termite.placing) == (2, False)
    society.world.chip = 2
    society.advance(1)
    assert termite.placing
    society.world.chip = 1
    society.advance(1)
    assert not termite.placing


def test_a_chip_is_put_down_where_there_is_room(make):
    society, termite = make(chip=3, placing=True, n_kinds=3, away=5)
    society.world.chip = 3
    society.advance(10)
    assert (termite.chip, termite.placing) == (3, True)
    society.world.chip = 0
    society.advance(1)
    assert (termite.chip, termite.placing, termite.leaving, termite.moved) == (0, False, 5, 1)
    assert society.world.patch(termite.x, termite.y).chip == 3
    assert (society.world.chip > 0).sum() == 1


def test_chips_are_kept(make):
    society = load_model(NAME)(7, n_kinds=3, world_size=21, density=0.3)
    kinds = np.bincount(society.world.chip.ravel(), minlength=4)[1:]
    assert kinds.sum() == round(0.3 * 441)
    assert kinds.min() > 20
    society.advance(500)
    lying = np.bincount(society.world.chip.ravel(), minlength=4)[1:]
    carried = np.bincount(society.termites.chip, minlength=4)[1:]
    assert (lying + carried).tolist() == kinds.tolist()
    assert society.series()["carried"] == carried.sum()


def flooded(chips):
    """Count piles as one would by hand: from each chip on, to all that lie beside."""
    width, height = chips.shape
    left = {(x, y) for x in range(width) for y in range(height) if chips[x, y]}
    sizes = []
    while left:
        edge, size = [left.pop()], 0
        while edge:
            x, y = edge.pop()
            size += 1
            for dx, dy in RULES.AROUND:
                beside = ((x + dx) % width, (y + dy) % height)
                if beside in left and chips[beside] == chips[x, y]:
                    left.remove(beside)
                    edge.append(beside)
        sizes.append(size)
    return sorted(sizes)


@pytest.mark.parametrize("density", [0.0, 0.1, 0.3, 0.5, 0.9])
@pytest.mark.parametrize("kinds", [1, 3])
def test_piles_are_those_that_one_would_count(density, kinds):
    rng = np.random.default_rng(11)
    for side in (3, 8, 20):
        for _ in range(10):
            chips = rng.integers(1, kinds + 1, (side, side)) * (rng.random((side, side)) < density)
            assert sorted(RULES.pile_sizes(chips).tolist()) == flooded(chips)


def test_togetherness_by_hand():
    chips = np.zeros((5, 5), int)
    assert RULES.togetherness(chips) == (0.0, 0.0)
    chips[0, 0] = chips[0, 4] = 1  # beside each other, round the world
    chips[2, 2] = 2
    together, by_chance = RULES.togetherness(chips)
    assert together == pytest.approx((1 / 8 + 1 / 8 + 0) / 3)
    # Each of the two has one other of its kind on 24 patches.
    assert by_chance == pytest.approx(2 / 3 * 1 / 24)


def test_chance_is_what_scattering_gives():
    rng = np.random.default_rng(3)
    chips = np.repeat([0, 1, 2], [60, 25, 15])
    found = [RULES.togetherness(rng.permutation(chips).reshape(10, 10)) for _ in range(400)]
    together, by_chance = np.mean(found, axis=0)
    assert together == pytest.approx(by_chance, rel=0.03)


def test_chips_are_gathered_and_sorted():
    for kinds, piles, together in ((1, 10, 0.8), (3, 45, 0.5)):
        society = load_model(NAME)(2, n_kinds=kinds)
        before = society.series()
        society.advance(20_000)
        after = society.series()
        assert after["piles"] <= piles < before["piles"] / 5
        assert after["together"] > together
        assert after["largest"] > 5 * before["largest"]
