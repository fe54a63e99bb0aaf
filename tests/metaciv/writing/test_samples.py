"""The samples do what their pages say must happen; without them these tests pass."""

from itertools import pairwise

import pytest

from socialmind.catalogue import load_model
from socialmind.metaciv.importing import import_model

from ..reading.folders import SAMPLES

pytestmark = pytest.mark.skipif(SAMPLES is None, reason="the samples are not there")


@pytest.fixture
def sample(tmp_path):
    def imported(name):
        import_model(SAMPLES / name, tmp_path / name, strict=True)
        return load_model(tmp_path / name)

    return imported


def rows(society, ticks, *names):
    """What all agents have at the end of each of some ticks."""
    found = []
    for _ in range(ticks):
        society.advance(1)
        found.append([tuple(getattr(one, name) for name in names) for one in society.humans])
    return found


def test_one_plan_is_an_action_a_tick(sample):
    society = sample("one_plan")(seed=1, compiled=False)
    found = rows(society, 9, "energy", "coin")
    assert found == [[]] + [
        [(10.0 - k, 3 * (k // 3) + (k % 3 > 0))] for k in range(8)
    ]  # fmt: skip
    assert (society.humans[0].x, society.humans[0].y) == (2.0, 3.0)


def test_hunger_comes_and_goes_by_its_trigger(sample):
    society = sample("hunger")(seed=1, compiled=False)
    found = rows(society, 10, "energy", "coin", "crumb", "plan")
    assert [one[0] for one in found[1:]] == [
        (7.0, 0, 0, None),
        (6.0, 1, 0, "Work"), (5.0, 2, 0, "Work"), (8.0, 2, 0, "Eat"), (7.0, 2, 1, "Eat"),
        (6.0, 3, 1, "Work"), (5.0, 4, 1, "Work"), (8.0, 4, 1, "Eat"), (7.0, 4, 2, "Eat"),
    ]  # fmt: skip


def test_hunger_holds_from_birth(sample):
    model = sample("hunger")
    society = model(seed=1, compiled=False, low_energy=8.0)
    society.advance(2)
    assert society.humans[0].mind.is_active("Hungry")


def test_control_orders_actions_in_rounds_of_ten_ticks(sample):
    names = "abcdefghijkmn"
    society = sample("control")(seed=3, compiled=False)
    found = rows(society, 22, *names)
    came = []
    for before, after in pairwise(found[1:]):
        pairs = zip(names, before[0], after[0], strict=True)
        came.append("".join(name for name, old, new in pairs if new > old))
    assert came[:9] == ["a", "d", "e", "d", "e", "f", "g", "hik", ""]
    assert came[9] in ("m", "n")
    assert came[10:19] == came[:9]


def test_members_of_a_team_become_leaders_and_bear_the_next(sample):
    society = sample("team")(seed=1, compiled=False)
    found = rows(society, 22, "age", "stone", "order_carried", "child")
    assert [len(one) for one in found] == [0] + [1] * 2 + [2] * 9 + [3] * 9 + [4]
    assert [one[0][2] for one in found[1:14]] == [0, 0, 0, *range(1, 11)]
    child = [one[1] for one in found[3:14]]
    assert [one[1] for one in child] == [0, 1, 1, 2, 2, 3, 3, 4, 4, 4, 4]
    assert [one[3] for one in child] == [0] * 9 + [1, 1]
    assert child[10] == (10.0, 4, 1, 1)
    assert society.humans[1].mind.plan_weights() == {"Found": 1.0, "Lead": 10.0}
    assert society.humans[3].mind.plan_weights() == {"Found": 1.0, "Dig": 11.0}
    assert found[21][2][:2] == child[9][:2]  # the grandchild, nine ticks later


def test_berries_are_gathered_round_the_world_and_grow(sample):
    society = sample("berries")(seed=1, compiled=False)
    found = rows(society, 163, "x", "y", "berry")
    walker = {tick: one[0] for tick, one in enumerate(found[1:], 2)}
    for i in range(7):
        assert walker[3 + 2 * i] == (i, 4.0, 3 * (i + 1))
        assert walker[151 + 2 * i][2] == 22 + i
    assert all(walker[tick] == ((tick - 16) % 7, 4.0, 21) for tick in range(16, 151))
    assert walker[163] == (0.0, 4.0, 28)
    assert all(one[1][0] in (1, 2) and one[1][1] in (1, 2) for one in found[1:])
    assert society.world.patch(1, 1).berries == 4.5
