"""What a measure takes and gives, and where a model may declare one."""

import math

import numpy as np
import pytest

from socialmind import Agent, Model, Population
from socialmind.errors import ModelError
from socialmind.worlds.plane import Measure, Plane, against, ratio, survived, total


def pace(ticks, length, over):
    """Return the length a tick, or 0 of an episode that was ended."""
    return 0.0 if over else length / ticks


def test_a_measure_takes_what_its_function_names():
    measure = Measure(pace)
    assert measure.takes == ("ticks", "length", "over")
    assert measure.records == ("length",)
    assert measure.of({"ticks": 4, "length": 10, "over": None, "other": 1}) == 2.5
    assert measure.of({"ticks": 4, "length": 10, "over": "collision"}) == 0.0


def test_a_total_adds_up_robots_and_survival_is_a_share():
    assert total("scouts.delivered").records == ("scouts.delivered",)
    assert total("delivered").of({"delivered": np.array([1, 0, 4])}) == 5.0
    assert survived().records == ()
    assert survived().of({"ticks": 30, "limit": 120}) == 0.25


def test_a_ratio_is_one_of_totals():
    measure = ratio("correct", "scouts.ended")
    assert measure.records == ("correct", "scouts.ended")
    values = {"correct": np.array([1, 1]), "scouts.ended": np.array([4])}
    assert measure.parts(values) == (2.0, 4.0)
    assert measure.of(values) == 0.5
    assert measure.combined((3.0, 4.0)) == 0.75
    assert math.isnan(measure.combined((0.0, 0.0)))


def test_a_measure_is_set_against_another_mind():
    measure = against(ratio("path", "delivered"), mind="plain")
    assert measure.records == ("path", "delivered")
    assert measure.combined((120.0, 4.0), (100.0, 5.0)) == 1.5
    assert math.isnan(measure.combined((120.0, 4.0), (100.0, 0.0)))
    assert total("delivered").combined((6.0,), (8.0,)) == 6.0  # set against none
    lead = against(total("delivered"), "plain", compare=lambda own, other: own - other)
    assert lead.combined((6.0,), (8.0,)) == -2.0
    with pytest.raises(ModelError, match="a measure against a mind, set against another"):
        against(measure, mind="other")
    with pytest.raises(ModelError, match="a measure against no mind"):
        against(survived(), mind=None)


def test_what_is_wrong_is_refused_when_the_class_is_made():
    with pytest.raises(ModelError, match="3 as the function of a measure; expected a function"):
        Measure(3)
    with pytest.raises(ModelError, match="3 as the combine of a measure; expected a function"):
        Measure(pace, ("ticks",), combine=3)
    for given, where, said in [
        ({"objects": 3}, Plane(), "3 as 'objects'; expected one of the measures"),
        ({"ticks": survived()}, Plane(), "a measure called 'ticks'"),
        ({"survived": survived()}, None, "measures without a plane"),
        ([survived()], Plane(), "expected measures by name"),
    ]:
        parts = {"measures": given, **({"world": where} if where else {})}
        with pytest.raises(ModelError, match=said):
            type("Wrong", (Model,), {**parts, "agents_": Population(Agent, 1)})


def test_measures_are_inherited():
    first = type("First", (Model,), {"measures": {"survived": survived()}, "world": Plane()})
    assert list(type("Second", (first,), {}).measures) == ["survived"]
