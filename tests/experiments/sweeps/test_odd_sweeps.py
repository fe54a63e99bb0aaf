"""Sweeps of models and tables that behave oddly: each says so in its place, and others go on."""

import shutil

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments import Sweep, resume_sweep, sweep
from socialmind.experiments.sweeps.tables.store import Store

ODD = '''"""A model that does one odd thing."""

import sys

from socialmind import Agent, Model, Population, each, parameter


class Somebody(Agent):
    age: int = 0


def live(somebody, model):
    somebody.age += 1
    if model.deadly and somebody.age > 2:
        somebody.die()
    if model.breaks and somebody.age > 3:
        somebody.age = 1 // (somebody.age - 4)


class Odd(Model):
    """Somebody grows older."""

    how: str = parameter("well", choices=(
        "well", "interrupt", "exit", "changing", "text", "lines", "huge", "taken",
    ))
    deadly: bool = parameter(False)
    breaks: bool = parameter(False)
    status: float = parameter(1.0)
    run: int = parameter(1)
    people = Population(Somebody, 3)
    schedule = (each(people, live),)

    def series(self):
        how, tick = self.how, self.tick
        if how == "interrupt" and tick > 1:
            raise KeyboardInterrupt
        if how == "exit" and tick > 1:
            sys.exit(3)
        if how == "lines" and tick > 1:
            raise RuntimeError("two\\nlines")
        taken = {"run": 7, "status": 5, "seed": 3, "point": 4, "ticks": 9} if how == "taken" else {}
        another = {"b": 2} if how == "changing" and tick > 1 else {}
        value = {"text": "red", "huge": 2**70 if tick > 1 else 1}.get(how, tick)
        return {"a": value, **taken, **another}
'''
OPTIONS = {"ticks": 5, "every": 1, "workers": 1, "compiled": False}


@pytest.fixture(scope="module")
def odd(tmp_path_factory):
    folder = tmp_path_factory.mktemp("odd") / "odd"
    folder.mkdir()
    (folder / "model.py").write_text(ODD)
    return folder


@pytest.mark.parametrize("together", [0.0, 0.5])
def test_what_one_run_does_others_do_not_suffer_from(odd, tmp_path, together, monkeypatch):
    monkeypatch.setattr("socialmind.experiments.sweeps.leading.JOB_SECONDS", together)
    hows = ["well", "interrupt", "exit", "changing", "lines", "huge", "well"]
    found = Sweep(sweep(odd, {"how": hows}, out=tmp_path / "s", **OPTIONS))
    assert found.runs["status"].tolist() == ["finished", *["failed"] * 5, "finished"]
    errors = found.runs["error"].tolist()[1:-1]
    line = ODD.splitlines().index("            raise KeyboardInterrupt") + 1
    assert errors[0].startswith(f"run: {odd}/model.py:{line}: the run at tick 2 stopped with Key")
    assert errors[1].endswith("the run at tick 2 stopped with SystemExit: 3")
    assert errors[2].startswith("record: series() gave the columns a, b after a")
    assert errors[3].endswith("the run at tick 2 stopped with RuntimeError: two lines")
    assert errors[4].startswith(
        "record: series(): column a: found 1180591620717411303424; expected"
    )
    assert found.series["run"].unique().tolist() == [0, 6]


def test_a_column_may_be_a_number_in_one_run_and_a_text_in_another(odd, tmp_path):
    found = Sweep(sweep(odd, {"how": ["well", "text"]}, out=tmp_path / "s", **OPTIONS))
    assert found.runs["a"].tolist() == ["5", "red"]
    assert found.series["a"].tolist() == ["0", "1", "2", "3", "4", "5", *["red"] * 6]


def test_columns_of_one_name_are_told_apart(odd, tmp_path):
    design = {"how": ["taken"], "status": [2.0], "run": [8]}
    found = Sweep(sweep(odd, design, out=tmp_path / "s", **OPTIONS))
    row = found.runs.iloc[0]
    assert (row["parameter.status"], row["series.status"], row["status"]) == (2.0, 5, "finished")
    assert (row["parameter.run"], row["series.run"], row["run"]) == (8, 7, 0)
    assert list(found.series) == [
        "run",
        "tick",
        "a",
        "series.run",
        "status",
        "seed",
        "point",
        "ticks",
    ]


def test_who_has_died_out_has_no_greatest_age(odd, tmp_path):
    measures = {
        "oldest": "max(agents.age)", "mean": "mean(agents.age)", "first": "first(agents.age)",
        "half": "quantile(agents.age, 0.5)", "alive": "count(agents.age)",
    }  # fmt: skip
    found = sweep(odd, {"deadly": [True, False]}, measures=measures, out=tmp_path / "s", **OPTIONS)
    runs = Sweep(found).runs
    assert runs["oldest"].isna().tolist() == runs["half"].isna().tolist() == [True, False]
    assert runs["mean"].isna().tolist() == runs["first"].isna().tolist() == [True, False]
    assert runs["alive"].tolist() == [0, 3]


def returns_only(value):
    return lambda series: value


def test_what_measures_return(odd, tmp_path):
    def measured(function):
        out = tmp_path / f"s{len(list(tmp_path.iterdir()))}"
        runs = Sweep(sweep(odd, None, measures={"m": function}, out=out, **OPTIONS)).runs
        return runs["m"][0] if "m" in runs else runs["error"][0]

    assert measured(lambda series: np.float32(1.5)) == 1.5
    assert measured(lambda series: np.int64(3)) == 3
    assert bool(measured(lambda series: np.bool_(True))) is True
    assert measured(lambda series: float("inf")) == np.inf
    for odd_one, shown in ((None, "None"), ("x", "'x'"), (np.array(2.0), "array(2.)")):
        said = f"measure: measure m: returned {shown}; expected a number"
        assert measured(returns_only(odd_one)) == said
    assert measured(lambda series: 2**80).startswith("record: measure m: found 12089")


def test_an_error_in_a_short_stretch_of_compiled_code_has_its_line(odd, tmp_path):
    options = {**OPTIONS, "compiled": True}
    out = sweep(odd, {"breaks": [False, True]}, out=tmp_path / "s", **options)
    line = ODD.splitlines().index("        somebody.age = 1 // (somebody.age - 4)") + 1
    assert Sweep(out).runs["status"].tolist() == ["finished", "failed"]
    assert f"model.py:{line}:" in Sweep(out).runs["error"][1]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "run,status\n3,1,2\n",
            r"points\.csv:2: found 3 values; expected 2, one for each",
        ),
        ("run,status\n3\n", r"points\.csv:2: found 1 values; expected 2"),
        ("run,status\n\n3,\n", r"points\.csv:3: status: found ''; expected a value"),
        ("run,status\n3,nan\n", r"points\.csv:2: parameter status: found nan"),
        ("run;status\n3;0,5\n", r"points\.csv:2: parameter status: found '0,5'"),
        ("run,run\n3,4\n", r"points\.csv: run is set twice"),
        ("run,größe\n3,4\n", r"points\.csv: odd has nothing called 'größe'"),
        ("run\n", r"points\.csv: no points"),
        ("", r"points\.csv: no points"),
    ],
)
def test_a_table_of_points_that_cannot_be(odd, tmp_path, text, said):
    (tmp_path / "points.csv").write_text(text, encoding="utf-8")
    with pytest.raises(SocialmindError, match=said):
        sweep(odd, tmp_path / "points.csv", out=tmp_path / "s", **OPTIONS)


def test_a_table_of_points_as_other_programs_write_it(odd, tmp_path):
    file = tmp_path / "points.csv"
    file.write_text(' run ;"status"\r\n3; 0.5\r\n\r\n', encoding="utf-8-sig", newline="")
    out = sweep(odd, file, out=tmp_path / "s", **OPTIONS)
    assert Sweep(out).design.values.tolist() == [[0, 3, 0.5]]


def test_what_is_no_sequence_is_refused(odd, tmp_path):
    with pytest.raises(SocialmindError, match=r"seeds: found 5; expected several, as range\(20\)"):
        sweep(odd, None, seeds=5, out=tmp_path / "s", **OPTIONS)
    with pytest.raises(SocialmindError, match=r"measures: found .* by their names"):
        sweep(odd, None, measures=["a"], out=tmp_path / "s", **OPTIONS)


def test_parts_that_a_finished_sweep_left_do_not_count(odd, tmp_path, contents):
    """Killed while it took the parts away: what is left of them is no result."""
    out = sweep(odd, {"how": ["well", "lines", "well"]}, out=tmp_path / "s", **OPTIONS)
    before = contents(out)
    one = Store(out)
    one.begin(again=True)
    (out / "parts/runs/000000.parquet").rename(out / "parts/runs/000003.parquet")
    (out / "parts/series/000000.parquet").unlink()
    resume_sweep(out, retry=True, workers=1)
    assert contents(out) == before


def test_a_folder_that_was_moved_is_gone_on_with(odd, tmp_path, contents, monkeypatch):
    class Enough(Exception):
        pass

    def tell(done, _):
        if done >= 2:
            raise Enough

    monkeypatch.setattr("socialmind.experiments.sweeps.leading.JOB_SECONDS", 0.0)
    monkeypatch.chdir(tmp_path)
    design = {"how": ["well", "lines", "well", "well"]}
    whole = contents(sweep(odd, design, out="whole", **OPTIONS))
    with pytest.raises(Enough):
        sweep(odd, design, out="a folder/ünter", on_progress=tell, **OPTIONS)
    (tmp_path / "elsewhere").mkdir()
    shutil.move("a folder/ünter", "elsewhere/moved")
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert contents(resume_sweep("moved", workers=1)) == whole


def test_duplicate_points_are_points(odd, tmp_path):
    out = sweep(odd, pd.DataFrame({"run": [3, 3]}), out=tmp_path / "s", **OPTIONS)
    assert Sweep(out).runs["seed"].nunique() == 2
