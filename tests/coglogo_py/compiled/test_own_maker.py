"""What a decision maker of the modeller's own may return, and what of it numba can compile."""

import numpy as np
import pytest

from coglogo_py import CognitiveScheme, Cogniton, DecisionMaker, MindError, Society
from coglogo_py.compiled.own_maker import compiled_maker, refusal_of

TABLE = {"a": 1}


def place_of_half(weights):
    return weights[len(weights) // 2]


def maker(choosing, chances=lambda weights, bias: np.full(len(weights), 1 / len(weights))):
    class Own(DecisionMaker):
        name = "Own"
        choose = staticmethod(choosing)
        probabilities = staticmethod(chances)

    return Own


def mind_with(made):
    cogniton = Cogniton("A", start_value=1, influence={"one": 2}, conditional=("one", "two"))
    return Society(CognitiveScheme("s", (cogniton,), decision_maker=made()), seed=1).new_mind()


@pytest.mark.parametrize("found", [2, -1, 0.0, 1.5, np.nan, None, True, "0", [0], 10**30])
def test_what_is_no_position_is_refused_where_choose_stands(found):
    def choose(weights, bias, u):
        return found

    line = choose.__code__.co_firstlineno
    mind = mind_with(maker(choose))
    with pytest.raises(MindError, match=rf"test_own_maker\.py:{line}: Own\.choose\(\) returned"):
        mind.choose_next_plan()
    assert mind.society.minds.draws[mind.slot] == 0


def test_numpys_whole_numbers_are_positions():
    assert mind_with(maker(lambda weights, bias, u: np.uint8(1))).choose_next_plan() == "two"


@pytest.mark.parametrize(
    "chances", [None, 1.0, [1.0], [0.5, 0.6], [1.5, -0.5], [np.nan, 1.0], ["a", "b"], [0, 0]]
)
def test_what_are_no_probabilities_is_refused(chances):
    mind = mind_with(maker(lambda weights, bias, u: 0, lambda weights, bias: chances))
    with pytest.raises(MindError, match=r"Own\.probabilities\(\) returned .* sum 1"):
        mind.explain()


def test_a_maker_that_numba_cannot_compile_is_named_with_its_line():
    def choose(weights, bias, u):
        place = 0
        return TABLE["a"] + place

    refusal, runs = refusal_of(maker(choose))
    assert not runs
    assert refusal.line == choose.__code__.co_firstlineno + 2
    assert "TABLE" in str(refusal)
    assert "\n" not in str(refusal)


def test_a_maker_that_returns_no_whole_number_is_named_with_what_it_returns():
    def choose(weights, bias, u):
        return 0.5 * bias

    def forgets(weights, bias, u):
        return 1 if u < 0.5 else None

    refusal, runs = refusal_of(maker(choose))
    assert runs
    assert "returns float64" in str(refusal)
    assert "does not always return" in str(refusal_of(maker(forgets))[0])


def test_helpers_are_compiled_with_the_bounds_of_their_arrays():
    def choose(weights, bias, u):
        return int(place_of_half(weights))

    compiled = compiled_maker(choose)
    assert compiled(np.array([3.0, 1.0]), 1.0, 0.5) == 1
    assert refusal_of(maker(choose)) is None
    with pytest.raises(IndexError):
        compiled(np.empty(0), 1.0, 0.5)


def test_a_compiled_int_of_what_is_no_number_is_an_error():
    compiled = compiled_maker(lambda weights, bias, u: int(weights[0]))
    assert compiled(np.array([-2.9]), 1.0, 0.5) == -2
    for value in (np.nan, np.inf, 1e30, -1e30):
        with pytest.raises(OverflowError):
            compiled(np.array([value]), 1.0, 0.5)
