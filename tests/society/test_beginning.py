"""Populations that begin with a table: from files and from Python, checked, hashed, replayed."""

import csv
import json
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
from pyarrow import parquet

from socialmind import Agent, Grid, Model, Population, each, parameter
from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError
from socialmind.runs.execution import run
from socialmind.runs.verification import replay

MODEL = """
from socialmind import Agent, Grid, Model, Population, each


class Person(Agent):
    wheat: float = 1.0
    age: int = 0
    happy: bool = False
    spouse: int | None = None


def live(person, model, rng):
    person.age += 1
    person.wheat += rng.random()
    if person.spouse is not None:
        model.world.forward(person, 1.0)


class Town(Model):
    people = Population(Person, table="people.csv")
    world = Grid(9, 5, wraps=False)
    schedule = (each(people, live),)
"""
PEOPLE = "x,y,heading,wheat,age,happy,spouse\n1,2,450,2.5,30,true,\n-4,0,0,3,31,False,0\n"


@pytest.fixture
def town(tmp_path):
    folder = tmp_path / "town"
    folder.mkdir()
    (folder / "model.py").write_text(MODEL)
    (folder / "people.csv").write_text(PEOPLE)
    return load_model(str(folder))


class Person(Agent):
    wheat: float = 1.0
    age: int = 0
    spouse: int | None = None


class Village(Model):
    n_people: int = parameter(3, low=0, high=10)
    people = Population(Person, "n_people")
    world = Grid(9, 5, wraps=False)


def test_a_file_beside_the_model_says_who_there_is(town):
    for compiled in (True, False):
        society = town(seed=1, compiled=compiled)
        assert len(society.people) == 2
        assert society.people.wheat.tolist() == [2.5, 3.0]
        assert society.people.heading.tolist() == [90.0, 0.0]
        assert society.people.happy.tolist() == [True, False]
        assert society.people.spouse.tolist() == [None, 0]
        assert (society.people[1].x, society.people[0].y) == (-4.0, 2.0)


def test_a_run_records_its_hash_and_is_replayed(town, tmp_path):
    folder = run(town, ticks=5, seed=1, out=tmp_path / "run")
    manifest = json.loads((folder / "manifest.json").read_text())
    assert "model/people.csv" in manifest["model"]["sources"]["files"]
    assert (folder / "source" / "model" / "people.csv").read_text() == PEOPLE
    assert replay(folder).equal and not replay(folder).notes
    (tmp_path / "town" / "people.csv").write_text(PEOPLE.replace("2.5", "9.5"))
    again = replay(folder)
    assert not again.equal
    assert any("people.csv: is not the file that the run" in note for note in again.notes)
    assert replay(folder, kept=True, trust=True).equal


def test_a_run_refuses_a_table_that_it_could_not_repeat(tmp_path):
    with pytest.raises(SocialmindError, match=r"a table for 'people', which a run could not rep"):
        run(Village, ticks=1, parameters={"people": {"wheat": [1]}}, out=tmp_path / "run")
    assert not (tmp_path / "run").exists()


def test_the_first_ticks_are_repeated_from_a_copy(town):
    society = town(seed=2)
    society.advance(3)
    again = society.fresh()
    again.advance(3)
    for name, array in society.state().items():
        np.testing.assert_array_equal(array, again.state()[name], err_msg=name)


@pytest.mark.parametrize("form", ["frame", "arrow", "columns", "csv", "parquet"])
def test_a_table_is_given_when_a_society_is_made(form, tmp_path):
    frame = pd.DataFrame({"x": [1, 2], "wheat": [0.5, 7.0], "spouse": [None, 0]})
    given = {
        "frame": frame,
        "arrow": pa.Table.from_pandas(frame),
        "columns": {name: list(frame[name]) for name in frame},
        "csv": tmp_path / "people.csv",
        "parquet": str(tmp_path / "people.parquet"),
    }[form]
    frame.to_csv(tmp_path / "people.csv", index=False, quoting=csv.QUOTE_ALL)
    parquet.write_table(pa.Table.from_pandas(frame), tmp_path / "people.parquet")
    society = Village(people=given)
    assert society.people.wheat.tolist() == [0.5, 7.0]
    assert society.people.x.tolist() == [1.0, 2.0]
    assert society.people.spouse.tolist() == [None, 0]
    assert society.n_people == 2
    assert society.fresh().people.wheat.tolist() == [0.5, 7.0]


def test_a_table_without_rows_is_a_population_without_agents(tmp_path):
    (tmp_path / "none.csv").write_text("wheat\n")
    assert len(Village(people=tmp_path / "none.csv").people) == 0


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "wheat,age\n1,2\n\n3,many\n",
            r"people\.csv, column 'age' of line 4: found 'many'; expected",
        ),
        ("wheat\n1\nnan\n", r"column 'wheat' of line 3: found nan; expected a finite number"),
        ("wheat,age\n1,2.5\n", r"column 'age' of line 2: found 2\.5; expected a whole number"),
        (
            "wheet\n1\n",
            r"people\.csv: the column 'wheet' is no field of 'people'; did you mean 'wh",
        ),
        ("wheat,age\n1,2\n3\n", r"people\.csv, line 3: found 1 values; expected 2"),
        ("wheat,wheat\n1,2\n", r"people\.csv: found the column 'wheat' twice"),
        ("", r"people\.csv: found nothing; expected names of fields"),
        ("x\n1\n7\n", r"x of .*people\.csv, line 3: found 7.0, which lies outside the world"),
        ("wheat\n\xff\n", "expected a table"),
    ],
)
def test_what_does_not_fit_is_named(text, expected, tmp_path):
    (tmp_path / "people.csv").write_bytes(text.encode("latin-1"))
    with pytest.raises(SocialmindError, match=expected):
        Village(people=str(tmp_path / "people.csv"))


def test_what_is_no_table_is_refused(tmp_path):
    with pytest.raises(SocialmindError, match=r"No such file.*expected a table, a CSV or Parquet"):
        Village(people="gone.csv")
    (tmp_path / "people.parquet").write_text("no")
    with pytest.raises(SocialmindError, match=r"people\.parquet: .*expected a table"):
        Village(people=tmp_path / "people.parquet")
    with pytest.raises(SocialmindError, match="people=7, which is a population of village"):
        Village(people=7)
    with pytest.raises(SocialmindError, match=r"n_people=3 where .* has 2 rows; leave it out"):
        Village(people={"wheat": [1, 2]}, n_people=3)
    with pytest.raises(SocialmindError, match="n_people"):
        Village(people={"wheat": [1.0] * 11})
    with pytest.raises(SocialmindError, match=r"column 'wheat' of row 1: found 'x'"):
        Village(people={"wheat": [1, "x"]})


@pytest.mark.parametrize(
    ("declared", "expected"),
    [
        ({"size": 3, "table": "people.csv"}, "a size and a table of 'people'"),
        ({}, "neither size nor table nor civilisations of 'people'; .*table='people.csv'"),
        ({"table": "people"}, "the table 'people' for 'people'; expected a CSV"),
    ],
)
def test_wrong_declarations_are_refused(declared, expected):
    with pytest.raises(ModelError, match=expected):
        type("Wrong", (Model,), {"people": Population(Person, **declared)})


def stay(person):
    person.age += 1


class Crowd(Model):
    people = Population(Person, 2)
    world = Grid(9, 5, wraps=False, one_per_patch=True)
    schedule = (each(people, stay),)


def test_who_begins_with_a_place_stands_on_it():
    society = Crowd(people={"x": [1, 2, 3], "y": [0, 0, 0]})
    society.advance(1)
    assert not society.world.is_free(2, 0) and society.world.free_count == 42
    with pytest.raises(
        SocialmindError, match=r"row 1: found an agent on <patch 1 0>, where agent 0"
    ):
        Crowd(people={"x": [1, 1.2], "y": [0, 0]})
    with pytest.raises(SocialmindError, match="stands nowhere"):
        Crowd(people={"x": [1, 2]})


def test_files_are_found_from_the_working_folder(tmp_path, monkeypatch):
    (tmp_path / "people.csv").write_text("wheat\n4\n")
    monkeypatch.chdir(tmp_path)
    assert Village(people="people.csv").people.wheat.tolist() == [4.0]
    assert Path("people.csv").exists()
