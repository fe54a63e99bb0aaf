"""Data: read from files, frames and options; distances by hand; what is refused."""

import math

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.calibration.target import Target, check_columns, target_of
from socialmind.experiments.sweeps.one_run import Outcome

SERIES = "tick,place,height\n0,1.0,\n10,3.0,7.0\n20,5.0,7.0\n"


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "seen.csv"
    path.write_text(SERIES)
    return path


def test_the_distance_of_statistics_by_hand():
    target = target_of(["settled=5±0.5", "gini = 0.25 +- 0.1"])
    assert target.columns == ("settled", "gini") and target.errors == (0.5, 0.1)
    found = np.array([[6.0, 0.15]])  # 2 errors, and 1
    assert target.distance(found) == pytest.approx(math.sqrt((4 + 1) / 2))


def test_the_distance_of_a_series_by_hand(file):
    target = target_of(str(file))
    assert target.ticks == (0, 10, 20) and target.name == "seen.csv"
    # The spread of 1, 3, 5 is √(8/3); of 7, 7 there is none, so its size, 7, is the scale.
    found = np.array([[1.0, 99.0], [4.0, 7.0], [5.0, 14.0]])
    place, height = (1 / 3) / (8 / 3), (1 / 2) * 1.0
    assert target.distance(found) == pytest.approx(math.sqrt((place + height) / 2))
    assert target.notes() == ["height: 1 of 3 ticks are empty and not compared"]


def test_parquet_frames_and_some_columns_do_as_well(file, tmp_path):
    frame = pd.read_csv(file)
    frame.to_parquet(tmp_path / "seen.parquet")
    for given in (frame, tmp_path / "seen.parquet", f"{file}:place,height"):
        assert target_of(given).values.tobytes() == target_of(file).values.tobytes()
    alone = target_of(f"{file}:height")
    assert alone.columns == ("height",) and alone.values.shape == (3, 1)


def test_a_folder_s_copy_is_the_same_to_the_last_bit(file):
    for target in (target_of(file), target_of({"x": (1 / 3, 0.1), "y": (2, 1)})):
        copy = Target.of_csv(target.csv(), target.name)
        assert copy.csv() == target.csv()
        assert copy.values.tobytes() == target.values.tobytes()
        assert (copy.kind, copy.ticks, copy.errors) == (target.kind, target.ticks, target.errors)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("settled=5", "write settled=5±ERROR"),
        ("settled=5±", "expected two numbers"),
        ("settled=5±0", "found an error of 0; expected one above 0"),
        ("settled=5±-1", "found an error of -1"),
        ("settled=x±1", "expected two numbers"),
        ("settled=nan±1", "expected a value and its error"),
        ("nowhere.csv", "No such file"),
        ("nowhere.csv:a", "No such file"),
    ],
)
def test_odd_options_are_refused(text, said):
    with pytest.raises(SocialmindError) as refused:
        target_of([text])
    assert said in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("time,place\n0,1\n", "no column called tick"),
        ("tick\n0\n", "no data"),
        ("tick,place\n0,1\n,2\n", "row 2: tick: found nan; expected a whole number"),
        ("tick,place\n0,1\n2.5,2\n", "row 2: tick: found 2.5"),
        ("tick,place\n5,1\n5,2\n", "row 2: tick 5 after 5; expected each tick once"),
        ("tick,place\n5,1\n4,2\n", "row 2: tick 4 after 5"),
        ("tick,place\n0,1\n1,far\n", "row 2: place: found 'far'; expected a number"),
        ("tick,place\n0,\n1,\n", "place has no value at any tick"),
        ("run,tick,place\n0,0,1\n", "several runs"),
        ("tick,place\n0,inf\n", "row 1: place: found inf"),
    ],
)
def test_odd_files_are_refused(tmp_path, content, said):
    path = tmp_path / "odd.csv"
    path.write_text(content)
    with pytest.raises(SocialmindError) as refused:
        target_of(str(path))
    assert said in str(refused.value) and str(path) in str(refused.value)


def test_mixtures_and_doubles_are_refused(file):
    with pytest.raises(SocialmindError, match="a file beside others; give it alone"):
        target_of(["x=1±1", str(file)])
    with pytest.raises(SocialmindError, match="x: stands twice"):
        target_of(["x=1±1", "x=2±1"])
    with pytest.raises(SocialmindError, match="no column 'hight'; did you mean 'height'"):
        target_of(f"{file}:hight")
    with pytest.raises(SocialmindError, match="target: found"):
        target_of([5])
    with pytest.raises(SocialmindError, match="expected a file of a series, or NAME=VALUE±ERROR"):
        target_of([])


def test_what_the_model_has_not_is_refused(file):
    target = target_of(file)
    check_columns(target, ["place", "height"], [])
    with pytest.raises(SocialmindError, match=r"the model's series has no column 'place'"):
        check_columns(target, ["height"], ["place"])
    with pytest.raises(SocialmindError, match=r"say what it is: --measure settled=EXPRESSION"):
        check_columns(target_of(["settled=1±1"]), ["place"], [])


def test_what_a_run_shows_is_found_or_missed_in_words(file):
    target = target_of(f"{file}:place")
    run = Outcome(0, series={"tick": np.arange(0, 21, 10), "place": [1, 2, 3]}, ticks=20)
    assert target.observed(run).tolist() == [[1], [2], [3]]
    run.series["place"][1] = math.nan
    with pytest.raises(SocialmindError, match="place at tick 10 is nan"):
        target.observed(run)
    early = Outcome(0, series={"tick": np.array([0, 10, 13]), "place": [1, 2, 3]}, ticks=13)
    with pytest.raises(SocialmindError, match="ended at tick 13, before the data do, at 20"):
        target.observed(early)
    statistic = target_of(["m=1±1"])
    assert statistic.observed(Outcome(0, measured={"m": True})).tolist() == [[1.0]]
    with pytest.raises(SocialmindError, match="m is nan"):
        statistic.observed(Outcome(0, measured={"m": math.nan}))


def test_known_data_are_made_as_the_data_are(file):
    rng = np.random.default_rng(1)
    series = target_of(file).of_data(np.ones((4, 3, 2)), rng)
    assert np.isnan(series.values[0, 1]) and series.values[1].tolist() == [1.0, 1.0]
    assert series.scales.tolist() == [1.0, 1.0]  # their own spread, not that of the file
    runs = np.zeros((20, 1, 1))
    made = [target_of(["m=9±0.5"]).of_data(runs, rng).values[0, 0] for _ in range(2000)]
    assert np.std(made) == pytest.approx(0.5, rel=0.06) and abs(np.mean(made)) < 0.04
