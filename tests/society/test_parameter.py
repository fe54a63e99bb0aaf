"""Parameters: what they take, refuse and say."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from socialmind import Model, ModelError, Parameter, SocialmindError, parameter

PRICE = Parameter(167.0, unit="wheat", low=0.0, high=500.0, name="price")
COUNT = Parameter(25, unit="agents", low=1, name="count")
SWITCH = Parameter(False, name="switch")


@given(st.floats(0.0, 500.0))
def test_a_number_within_the_range_is_taken(value):
    assert PRICE.checked(value) == value
    assert PRICE.read(repr(value)) == value


@given(st.floats(allow_nan=True, allow_infinity=True).filter(lambda x: not 0 <= x <= 500))
def test_a_number_outside_is_refused(value):
    with pytest.raises(SocialmindError, match="parameter price: found"):
        PRICE.checked(value)
    with pytest.raises(SocialmindError, match="parameter price: found"):
        PRICE.read(repr(value))


@given(st.integers(1, 2**63 - 1))
def test_a_whole_number_is_taken_exactly(value):
    assert COUNT.checked(value) == value
    assert COUNT.read(str(value)) == value


def test_values_become_the_parameter_s_type():
    assert type(PRICE.checked(3)) is float
    assert type(COUNT.checked(30.0)) is int
    assert COUNT.read("30.0") == 30
    assert COUNT.read("1e3") == 1000
    assert SWITCH.checked(True) is True


@pytest.mark.parametrize(
    ("one", "value", "expected"),
    [
        (PRICE, -1, "expected 0 … 500 wheat"),
        (PRICE, "3", "expected a number"),
        (PRICE, True, "expected a number"),
        (PRICE, None, "expected a number"),
        (PRICE, math.inf, "expected a finite number"),
        (COUNT, 0, "expected 1 or more agents"),
        (COUNT, 2.5, "expected a whole number"),
        (COUNT, False, "expected a whole number"),
        (COUNT, math.nan, "expected a finite number"),
        (COUNT, 2**63, "expected at most 64 bits"),
        (SWITCH, 1, "expected true or false"),
    ],
)
def test_a_wrong_value_is_refused_with_what_was_expected(one, value, expected):
    with pytest.raises(SocialmindError) as error:
        one.checked(value)
    assert str(error.value) == f"parameter {one.name}: found {value!r}; {expected}"


@pytest.mark.parametrize(
    ("text", "value"),
    [("true", True), ("Yes", True), ("on", True), ("1", True), ("FALSE", False), ("off", False)],
)
def test_switches_are_read_from_words(text, value):
    assert SWITCH.read(text) is value


@pytest.mark.parametrize(
    ("one", "text"),
    [(SWITCH, "maybe"), (COUNT, "many"), (COUNT, ""), (PRICE, "12,5"), (COUNT, "nan")],
)
def test_a_wrong_text_is_refused(one, text):
    with pytest.raises(SocialmindError, match=f"parameter {one.name}: found"):
        one.read(text)


@pytest.mark.parametrize(
    ("one", "words"),
    [
        (PRICE, "0 … 500"),
        (COUNT, "1 or more"),
        (SWITCH, "true or false"),
        (Parameter(0.5, high=1), "up to 1"),
        (Parameter(0.5), "any"),
    ],
)
def test_the_range_in_words(one, words):
    assert one.range == words


class Shop(Model):
    price: float = parameter(167, unit="wheat", low=0.0)
    clients: int = parameter(3, low=0)
    open_late: bool = parameter(False)


def test_a_whole_default_of_a_float_is_a_float():
    assert Shop.parameters["price"].kind is float
    assert Shop(compiled=False, price=0.5).price == 0.5


def test_a_society_has_the_values_it_was_given():
    shop = Shop(compiled=False, clients=7, open_late=True)
    assert shop.parameter_values() == {"price": 167.0, "clients": 7, "open_late": True}
    assert Shop(compiled=False).clients == 3


def test_parameters_stay_as_they_are_in_a_run():
    shop = Shop(compiled=False)
    with pytest.raises(AttributeError, match="'price' stays as it is in a run"):
        shop.price = 3.0
    assert shop.price == 167.0


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"prise": 3}, "shop has no parameter 'prise'; .*price"),
        ({"price": -1}, "parameter price: found -1; expected 0 or more wheat"),
        ({"price": "3"}, "parameter price: found '3'; expected a number"),
        ({"clients": 1.5}, "parameter clients: found 1.5; expected a whole number"),
        ({"open_late": 1}, "parameter open_late: found 1; expected true or false"),
    ],
)
def test_a_society_with_a_wrong_value_is_refused(given, message):
    with pytest.raises(SocialmindError, match=message):
        Shop(compiled=False, **given)


def test_declarations_with_a_wrong_default_are_refused():
    with pytest.raises(
        ModelError, match=r"default of the parameter price: found -1\.0; expected 0"
    ):

        class Cheap(Model):
            price: float = parameter(-1.0, low=0.0)

    with pytest.raises(ModelError, match="'dear' as the default of the parameter 'price'"):

        class Dear(Model):
            price: float = parameter("dear")

    with pytest.raises(ModelError, match=r"found 1\.5 as the default .*; expected a value of int"):

        class Halves(Model):
            clients: int = parameter(1.5)

    with pytest.raises(ModelError, match="expected float, int or bool"):

        class Words(Model):
            clients: str = parameter(1)
