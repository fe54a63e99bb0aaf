"""Which runs there are, and their seeds."""

import itertools

import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.replicates import Replicates, Until, Waiting, read_seeds


def test_a_share_has_a_width_where_all_are_alike():
    assert not Until(0.2, "settled").reached([0.0] * 5)  # 0 to 43 %
    assert Until(0.2, "settled").reached([0.0] * 15)
    # Of two values t is 12.706, the standard error 0.1.
    assert not Until(1.27, "x").reached([0.0, 0.2]) and Until(1.28, "x").reached([0.0, 0.2])


def value_of(run):
    """What a run comes to: at even points always the same, at odd ones far apart."""
    return float(run % 7) if (run // 30) % 2 else 1.0


def worked_off(waiting, done, order):
    """Do all runs that wait, taking them in turns from the front and the back of what is given."""
    hand = list(itertools.islice(waiting, 4))
    for turn in itertools.count():
        if not hand:
            break
        run = hand.pop(0 if order >> (turn % 8) & 1 else -1)
        done[run] = value_of(run)
        waiting.note(run, done[run])
        hand += itertools.islice(waiting, 4 - len(hand))
    return done


@given(st.integers(0, 255), st.integers(0, 60))
def test_what_is_added_hangs_on_no_order_and_no_interruption(order, before):
    replicates = Replicates((0, 1), until=Until(1.0, "x"), most=30)
    straight = worked_off(Waiting(4, replicates, {}), {}, 255)
    assert sorted(run for run in straight if run < 30) == list(range(5))
    assert len([run for run in straight if 30 <= run < 60]) > 10
    known = dict(list(straight.items())[:before])
    waiting = Waiting(4, replicates, known)
    assert worked_off(waiting, dict(known), order) == straight
    assert waiting.total == len(straight)


def test_an_interval_in_hundredths_of_the_mean():
    assert Until.read("5%:x").reached([99, 100, 101, 100])
    assert not Until.read("5%:x").reached([9, 10, 11, 10])
    assert str(Until.read("0.5:x")) == "0.5:x"
    for text in ("x", "0:x", "-1:x", "1:", "nan:x"):
        with pytest.raises(SocialmindError, match="expected HALF_WIDTH:MEASURE"):
            Until.read(text)


def test_numbers_seeds_and_records():
    replicates = Replicates((7, 3), common=True)
    assert [replicates.place_of(run) for run in range(4)] == [(0, 0), (0, 1), (1, 0), (1, 1)]
    assert [replicates.seed_of(run) for run in range(4)] == [7, 3, 7, 3]
    own = Replicates(tuple(range(50)))
    seeds = [own.seed_of(run) for run in range(5_000)]
    assert len(set(seeds)) == 5_000 and max(seeds) < 2**63
    adding = Replicates((4, 5), until=Until(1.0, "x"), most=9)
    assert adding.seed_of(adding.run_of(1, 6)) == Replicates(tuple(range(4, 13))).seed_of(15)
    assert Replicates.of_record(adding.record()) == adding


def test_seeds_as_they_are_written():
    assert read_seeds("0:3") == (0, 1, 2) and read_seeds("5") == (5,)
    for text in ("", "a", "3:1", "1.5"):
        with pytest.raises(SocialmindError, match="expected a range"):
            read_seeds(text)
