"""The numbers behind figures 4.6 to 4.8 and 6.6, against the text of the thesis."""

import math
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from socialmind.sources.loading import load_file

ANALYSIS = Path(__file__).parents[2] / "analysis"
records = load_file(ANALYSIS / "mind_variables" / "records.py")
robot = load_file(ANALYSIS / "mind_influence" / "robot.py")


def test_the_files_are_loaded_by_path():
    assert "analysis" not in sys.modules


# Figure 4.6 ------------------------------------------------------------------------------------


def test_a_simple_variable_takes_the_mean_of_commands_by_influence():
    rows = records.simple_variable()
    assert len(rows) == 100
    for before, row in pairwise(rows):
        weight = before["influence_A"] + before["influence_B"]
        if weight:
            weighted = [before[f"command_{one}"] * before[f"influence_{one}"] for one in "AB"]
            assert row["value"] == pytest.approx(sum(weighted) / weight)
        else:
            assert row["value"] == before["value"]
    # All cases occur: either alone, both, and none while the commands change.
    cases = {(row["influence_A"] > 0, row["influence_B"] > 0) for row in rows}
    assert len(cases) == 4
    idle = [row for row in rows if math.isnan(row["input"])]
    assert len({row["value"] for row in idle[1:]}) == 1
    assert len({row["command_A"] for row in idle[1:]}) > 1


# Figure 4.7 ------------------------------------------------------------------------------------


def test_a_counter_counts_rising_edges_and_falls_to_zero():
    rows = records.counter()
    values = [row["value"] for row in rows]
    changes = [after for before, after in pairwise(values) if after != before]
    # The thesis's 0.1, 0.2, 0.0; then a slope that counts once, two edges, and the reset.
    assert changes == pytest.approx([0.1, 0.2, 0.0, 0.1, 0.2, 0.3, 0.0])
    for first, second, row in zip(rows, rows[1:], rows[2:], strict=False):
        was, now = first["input"], second["input"]
        change = row["value"] - second["value"]
        assert (change > 0) == (was <= 0.8 < now)
        assert (row["value"] == 0.0 < second["value"]) == (was >= 0.2 > now and change != 0)


# Figure 4.8 ------------------------------------------------------------------------------------


def test_the_input_of_a_wave_generator_sets_its_wavelength():
    rows = records.wave_generator()
    phase = 0.0
    for before, row in pairwise([{"input": None}, *rows]):
        # Before any command the phase grows by 1.
        phase += 1.0 if before["input"] is None else 0.001 + 2.999 * before["input"]
        assert row["value"] == pytest.approx(0.5 + math.sin(phase) / 2)
    inputs = [row["input"] for row in rows]
    assert inputs[0] == pytest.approx(0.04)
    assert max(inputs) == pytest.approx(0.2)
    assert inputs[-1] == 0.0


# Figure 6.6 ------------------------------------------------------------------------------------


def test_the_five_steps_are_those_of_the_text():
    one, two, three, four, five = (robot.evaluated(step) for step in robot.STEPS)
    # Step 1: exclusively to GoToObject (1.0 · 1.0), which transmits 0.11 to moveForward alone.
    assert one.influences()["GoToObject"] == 1.0
    primitives = {"moveForward", "moveBackwards", "turnLeft", "turnRight"}
    assert {name: one.influences()[name] for name in primitives} == {
        "moveForward": 0.11, "moveBackwards": 0.0, "turnLeft": 0.0, "turnRight": 0.0,
    }  # fmt: skip
    assert one.actuators() == {"MotL": 1.0, "MotR": 1.0}
    # Step 2: exclusively to Avoid, 1.0 to moveForward and turnLeft: equation 6.1.
    assert two.influences()["Avoid"] == 1.0
    assert two.influences()["moveForward"] == two.influences()["turnLeft"] == 1.0
    assert two.actuators() == {"MotL": 0.5, "MotR": 1.0}
    # Step 3: turnRight receives 0.16 · 1.0, moveForward much more: curved slightly to the right.
    assert three.outputs()["GoToObject", "SK:turnRight"] == 1.0
    assert three.influences()["turnRight"] == pytest.approx(0.16)
    assert three.influences()["moveForward"] > 5 * 0.16
    assert three.actuators() == pytest.approx({"MotL": 1.0, "MotR": 0.84})
    # Step 4: less to moveForward and to turnRight, and yet a sharper turn.
    for name in ("moveForward", "turnRight"):
        assert 0.0 < four.influences()[name] < three.influences()[name]
    assert four.actuators()["MotR"] == pytest.approx(0.168 / 0.312)
    # Step 5: all through GoToDropZone+Avoid; GoToObject+Avoid would leave Avoid out.
    assert five.influences()["GoToObject+Avoid"] == 0.0
    assert five.outputs()["GoToObject+Avoid", "SK:GoToObject"] == 1.0
    assert five.outputs()["GoToObject+Avoid", "SK:Avoid"] == 0.0
    assert five.influences()["GoToObject"] == 0.0
    assert five.influences()["Avoid"] == pytest.approx(0.4)


def test_a_row_holds_what_the_figure_shows():
    hierarchy = robot.evaluated(robot.STEPS[1])
    row = robot.row_of(2, hierarchy)
    assert (row["step"], row["MotL"], row["FRONT"]) == (2, 0.5, 0.8)
    assert row["influence Avoid"] == 1.0
    assert row["Avoid > SK:turnLeft given"] == row["Avoid > SK:turnLeft transmitted"] == 1.0
