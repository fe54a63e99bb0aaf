"""Robots that are steered from outside, and interruptions that are not heeded."""

from pathlib import Path

import numpy as np
import pytest

from socialmind import Model
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError

ROVERS = Path(__file__).parent / "experiments" / "rovers"
SPEEDS = pytest.mark.parametrize("compiled", [True, False], ids=["compiled", "interpreted"])


@pytest.fixture(scope="module")
def rovers():
    return load_model(ROVERS)


def end(model, ticks=60):
    """Run on to the end of the episode."""
    while model.over is None and model.tick < ticks:
        model.advance()
    return model


@SPEEDS
def test_commands_stand_in_for_minds_until_they_are_given_back(rovers, compiled):
    model = rovers(seed=1, compiled=compiled)
    model.advance(3)
    commands = model.tables["rovers"].rows["commands"]
    assert commands.tolist() == [[1.0, 1.0]]
    model.steer("rovers", [0.25, 0.5])
    model.advance(2)
    # They stay until others are given.
    assert commands.tolist() == [[0.25, 0.5]]
    assert model.tables["rovers"].spin[0] > 0
    model.steer("rovers", np.array([[0.0, 1.0]]))
    model.advance()
    assert commands.tolist() == [[0.0, 1.0]]
    model.steer("rovers", None)
    model.advance()
    assert commands.tolist() == [[1.0, 1.0]]


@SPEEDS
def test_without_minds_robots_stand_still_until_they_are_steered(rovers, compiled):
    model = rovers(seed=1, compiled=compiled, hierarchy=False)
    model.advance(10)
    row = model.tables["rovers"].rows[0]
    assert (row["x"], row["y"], row["commands"].tolist()) == (0.0, 0.0, [0.5, 0.5])
    model.steer("rovers", [1.0, 1.0])
    model.advance(10)
    assert np.hypot(row["x"], row["y"]) > 0.5
    assert model.fresh().tables["rovers"].rows["commands"].tolist() == [[0.5, 0.5]]
    with pytest.raises(SocialmindError, match="robots of rovers without minds"):
        model.steer("rovers", None)


def test_steering_is_part_of_the_state(rovers):
    model = rovers(seed=1)
    model.steer("rovers", [0.0, 1.0])
    model.advance(5)
    other = rovers(seed=1)
    other.restore(model.state())
    for one in (model, other):
        one.advance(5)
    assert (other.tables["rovers"].rows == model.tables["rovers"].rows).all()
    assert other.tables["rovers"].rows["commands"].tolist() == [[0.0, 1.0]]


def test_what_is_wrong_with_commands_is_said(rovers):
    model = rovers()
    for given, said in [
        (("rover", [0, 0]), "no robots called 'rover' in rovers; did you mean 'rovers'"),
        (("rovers", [0.5]), r"commands of shape \(1,\); expected \(1, 2\), .* MotL, MotR"),
        (("rovers", [[0.5, 0.5]] * 2), r"commands of shape \(2, 2\)"),
        (("rovers", [0.5, 1.5]), "expected numbers, 0 … 1"),
        (("rovers", [0.5, np.nan]), "expected numbers, 0 … 1"),
    ]:
        with pytest.raises(SocialmindError, match=said):
            model.steer(*given)
    with pytest.raises(SocialmindError, match="boids has no plane with robots to steer"):
        load_model("boids")(n_boids=3).steer("boids", [0.5])
    with pytest.raises(SocialmindError, match="no hierarchies for 'boids', whose agents are no"):
        load_model("boids")(hierarchy=False)


@SPEEDS
@pytest.mark.parametrize("physics", ["compiled", "pymunk"])
def test_an_interruption_that_is_not_heeded_ends_nothing(rovers, compiled, physics):
    made = {"seed": 1, "compiled": compiled, "physics": physics}
    assert end(rovers(**made)).over == "collision"
    assert end(rovers(without="battery", **made)).over == "collision"
    model = end(rovers(without=["collision"], **made))
    assert (model.over, model.tick) == (None, 60)
    assert model.tables["rovers"].collisions[0] == 1
    # The others are heeded, and what is not heeded stays so in a copy.
    model.tables["rovers"].columns["battery"][0] = 0.0
    model.advance()
    assert model.over == "battery"
    again = model.fresh()
    assert (again.without, end(again).over) == (("collision",), None)


def test_an_interruption_that_there_is_not_is_refused(rovers):
    with pytest.raises(SocialmindError, match="no interruption called 'collisions' in rovers; did"):
        rovers(without=["collisions"])
    with pytest.raises(SocialmindError, match="no interruption called 'collision' in plain"):
        type("Plain", (Model,), {})(without="collision")
