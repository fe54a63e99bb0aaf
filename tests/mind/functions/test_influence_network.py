"""Influence networks: equation 4.3 within a network."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind.errors import ModelError
from socialmind.mind import Skill
from socialmind.mind.functions.influence_network import InfluenceNetwork

SHARES = st.floats(0.0, 1.0)


def test_two_branches_on_paper(stepped):
    network = InfluenceNetwork(layers=0).network(1, 1)
    # Influences x and 1 - x; the branches are constant, 0.2 and 0.8.
    genome = [1.0, 0.0, -1.0, 1.0, 0.0, 0.2, 0.0, 0.8]
    mixed = stepped(network, genome, [[0.25], [1.0], [0.0]])
    assert [row[0] for row in mixed] == pytest.approx([0.65, 0.2, 0.8], abs=1e-15)


def test_gates_of_each_output_and_of_each_branch(stepped):
    # The branches give 0.1, 0.3 and 0.9, 0.7.
    values = [0.1, 0.3, 0.9, 0.7]
    each = InfluenceNetwork(layers=0).network(0, 2)
    assert stepped(each, [1.0, 0.0, 0.0, 1.0, *values], [[]])[0] == pytest.approx([0.1, 0.7])
    shared = InfluenceNetwork(layers=0, gates="branch").network(0, 2)
    assert stepped(shared, [0.25, 0.75, *values], [[]])[0] == pytest.approx([0.7, 0.6])


def test_without_influence_it_gives_the_middle(stepped):
    network = InfluenceNetwork(layers=0).network(1, 1)
    assert stepped(network, [0, -1, 0, -2, 0, 0.2, 0, 0.8], [[0.3]])[0] == [0.5]


@given(first=SHARES, second=SHARES)
def test_it_lets_one_of_two_signals_through_undistorted(stepped, first, second):
    # The third input says which of the first two is given (section 7.1.3).
    selector = InfluenceNetwork(branches=0, passes=(0, 1), layers=0)
    genome = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 1.0]
    given = stepped(selector.network(3, 1), genome, [[first, second, 1.0], [first, second, 0.0]])
    assert given == [[first], [second]]


@given(first=SHARES, second=SHARES, which=SHARES)
def test_a_mix_lies_between_its_branches(stepped, first, second, which):
    selector = InfluenceNetwork(branches=0, passes=(0, 1), layers=0)
    genome = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0, 1.0]
    mixed = stepped(selector.network(3, 1), genome, [[first, second, which]])[0][0]
    assert min(first, second) - 1e-15 <= mixed <= max(first, second) + 1e-15


@pytest.mark.parametrize(
    ("function", "inputs", "outputs", "expected"),
    [
        # Gates: 3 outputs · 2 branches = 6, over 8 neurons: 8 · 3 + 6 · 9; branches of 5 neurons:
        # 5 · 3 + 3 · 6 each.
        (InfluenceNetwork(), 2, 3, 24 + 54 + 2 * 33),
        # Gates: 2 + 1 branches, over 5 neurons: 5 · 3 + 3 · 6; the branches as before.
        (InfluenceNetwork(passes=(1,), gates="branch"), 2, 3, 33 + 2 * 33),
    ],
)
def test_sizes_on_paper(function, inputs, outputs, expected):
    assert function.genome_size(inputs, outputs) == expected


def test_its_name():
    assert repr(InfluenceNetwork()) == "an influence network of 2 branches of 1 hidden layer"
    assert repr(InfluenceNetwork(branches=1, passes=(0, 1), layers=0, gates="branch")) == (
        "an influence network of 1 branch of no hidden layer, 2 inputs let through, "
        "one gate a branch"
    )


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (
            lambda: InfluenceNetwork(branches=0),
            "found an influence network without branches; expected one branch or pass, or more",
        ),
        (
            lambda: InfluenceNetwork(gates="all"),
            "found 'all' as the gates of an influence network; expected 'output' or 'branch'",
        ),
        (
            lambda: InfluenceNetwork(passes=(1, 1)),
            "found the inputs (1, 1) let through; expected each input once",
        ),
        (
            lambda: InfluenceNetwork(passes=1),
            "found 1 as the inputs that an influence network lets through; expected a tuple of "
            "whole numbers",
        ),
        (
            lambda: InfluenceNetwork(passes=(2,)).network(2, 1),
            "found input 2 let through; expected one of 2 inputs",
        ),
        (
            lambda: Skill("Pick", ["SE:S"], ["VA:V"], InfluenceNetwork(passes=(1,))),
            "found the skill 'Pick' with input 1 let through; expected one of its 1 inputs",
        ),
    ],
)
def test_refusals(made, expected):
    with pytest.raises(ModelError) as caught:
        made()
    assert str(caught.value) == expected
