"""Schelling's segregation: who stays, who moves and where to; and that kinds part."""

import numpy as np
import pytest

from socialmind.catalogue import load_model


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a town at either speed; persons, of kinds 0, 1, 0, …, live where they are told."""

    def made(*places, **parameters):
        society = load_model("schelling")(
            1, compiled=request.param, n_agents=len(places), world_size=9, **parameters
        )
        # Out of the way first: two cannot stand on one patch.
        spare = [(x, y) for x in range(-4, 5) for y in range(-4, 5)]
        spare = [one for one in spare if one not in places and society.world.is_free(*one)]
        for person in society.people:
            society.world.move_to(person, *spare.pop())
        for person, place in zip(society.people, places, strict=True):
            society.world.move_to(person, *place)
        return society

    return made


def places(society):
    return list(zip(society.people.x.tolist(), society.people.y.tolist(), strict=True))


# Three of kind 0 about one of kind 1, and another of kind 1 alone.
SQUARE = ((0, 0), (1, 0), (0, 1), (3, -3), (1, 1))


def test_enough_of_ones_kind_and_one_stays(make):
    society = make(*SQUARE, minimum=2)
    society.advance(1)
    assert places(society)[0] == (0, 0)
    assert places(society)[2] == (0, 1)
    assert places(society)[4] == (1, 1)
    assert society.people.happy.tolist() == [True, False, True, False, True]
    assert places(society)[1] != (1, 0)  # beside three of the other kind only
    assert places(society)[3] != (3, -3)  # alone
    assert society.series() == {"happy": 3, "people": 5}


def test_one_too_few_and_all_move(make):
    society = make(*SQUARE, minimum=3)
    society.advance(1)
    assert society.series()["happy"] == 0
    assert all(now != before for now, before in zip(places(society), SQUARE, strict=True))
    assert len(set(places(society))) == 5


def test_who_wants_nobody_stays(make):
    society = make(*SQUARE, minimum=0)
    society.advance(3)
    assert places(society) == [tuple(map(float, place)) for place in SQUARE]
    assert society.people.happy.all()


@pytest.mark.parametrize(("radius", "happy"), [(1, False), (2, True)])
def test_the_radius_is_of_kings_moves(make, radius, happy):
    # Persons 0 and 2 are of one kind, two steps apart by the diagonal.
    society = make((0, 0), (-4, -4), (2, 2), minimum=1, radius=radius)
    society.advance(1)
    assert bool(society.people.happy[0]) == happy


def test_nobody_lives_beyond_the_walls(make):
    society = make((-4, 0), (0, 0), (4, 0), minimum=1)
    society.advance(1)
    assert not society.people.happy.any()


def test_who_moves_takes_the_only_free_place():
    # Nobody has nine neighbours: all 80 move in turn, each onto what the one before it left.
    society = load_model("schelling")(1, n_agents=80, world_size=9, minimum=9)
    before = places(society)
    society.advance(1)
    after = places(society)
    assert len(set(after)) == 80
    assert all(old != new for old, new in zip(before, after, strict=True))
    assert len(set(after) & set(before)) >= 79
    assert not society.people.happy.any()


def test_half_of_the_persons_are_of_each_kind():
    society = load_model("schelling")(2)
    assert np.bincount(society.people.kind).tolist() == [500, 500]
    assert len(set(places(society))) == 1000
    assert society.series()["happy"] == 0


def test_kinds_part_further_than_anybody_wants():
    for seed in range(10):
        society = load_model("schelling")(seed)
        society.advance(20)
        assert society.series()["happy"] > 980
        kinds = dict(zip(places(society), society.people.kind.tolist(), strict=True))
        pairs = [
            kind == kinds[x + dx, y + dy]
            for (x, y), kind in kinds.items()
            for dx, dy in ((1, 0), (0, 1), (1, 1), (1, -1))
            if (x + dx, y + dy) in kinds
        ]
        assert np.mean(pairs) > 0.78  # three of eight would be enough


def test_who_wants_too_many_of_its_kind_is_never_content():
    society = load_model("schelling")(3, minimum=7)
    society.advance(100)
    assert society.series()["happy"] < 20
