"""What varies: ranges on every scale, and those that are refused."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.space import read_vary, space_of
from socialmind.experiments.sweeps.preparing import nameable

PLACES = st.floats(0.0, 1.0)


@pytest.fixture(scope="module")
def farmers():
    return nameable(load_model("farmer_artisan"))


@pytest.fixture(scope="module")
def there(hill):
    return nameable(load_model(hill))


@given(place=PLACES)
def test_places_and_values_go_both_ways(there, place):
    straight, ratio, whole = space_of(
        {"first": (0.5, 2.0), "pace": (0.01, 1.0, "log"), "steps": (2, 5)}, there
    ).dimensions
    for one in (straight, ratio):
        assert one.place(one.value(place)) == pytest.approx(place, abs=1e-9)
        assert one.low <= one.value(place) <= one.high
    assert ratio.value(0.5) == pytest.approx(0.1)
    found = whole.value(place)
    assert isinstance(found, int) and 2 <= found <= 5
    assert whole.value(whole.place(found)) == found


def test_whole_numbers_get_equal_shares(there):
    (whole,) = space_of({"steps": (1, 9)}, there).dimensions
    assert [whole.value(at / 90) for at in range(0, 90, 10)] == list(range(1, 10))
    (ratio,) = space_of({"steps": (1, 8, "log")}, there).dimensions
    assert all(ratio.value(ratio.place(n)) == n for n in range(1, 9))


def test_words_of_schemes_vary_and_declared_borders_count(farmers):
    found = space_of({"influence.Farmer.GrowWheat": (1, 10), "food_decay": None}, farmers)
    assert found.names == ["influence.Farmer.GrowWheat", "food_decay"]
    assert found.values([0.5, 0.5]) == (5.5, 0.5)


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        ({}, "nothing varies; give --vary NAME=LOW:HIGH"),
        ({"tool_prise": (1, 2)}, "did you mean 'tool_price'"),
        ({"tool_price": (200, 100)}, "expected the lower end first; write 100:200"),
        ({"tool_price": (100, 100)}, "use --set tool_price=100"),
        ({"tool_price": None}, "no lower and upper border is declared; give --vary tool_price=LOW"),
        ({"tool_price": (-5, 100)}, "tool_price"),
        ({"tool_price": (100, 200, "ln")}, "found 'ln'; expected log"),
        ({"demand_intensity": (0.0, 2.0, "log")}, "expected ends above 0 for log"),
        ({"tool_price": ("a", 2)}, "expected two numbers"),
        ({"starvation": (0, 1)}, "a fit varies numbers, and this is none"),
        ({"scheme": (0, 1)}, "a fit varies numbers, and this is none"),
        ({"at_birth.Farmer": (0, 1)}, "a fit varies numbers, and this is none"),
        ({"decision_maker.name": (0, 1)}, "a fit varies numbers, and this is none"),
        ({"n_agents": (2.5, 5)}, "n_agents"),
        ({"tool_price": (1, 2), "tool-price": (1, 2)}, "set twice"),
    ],
)
def test_what_cannot_vary_is_refused(farmers, vary, said):
    with pytest.raises(SocialmindError) as refused:
        space_of(vary, farmers)
    assert said in str(refused.value)


@pytest.mark.parametrize("text", ["=1:2", "a=1", "a=1:x", "a=1:2:log:3"])
def test_options_are_read_or_refused(text):
    with pytest.raises(SocialmindError, match="--vary"):
        read_vary([text])
    with pytest.raises(SocialmindError, match="stands twice"):
        read_vary(["a=1:2", "a=1:3"])
    assert read_vary(["a"]) == {"a": None}
