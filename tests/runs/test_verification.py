"""Replay: a run made again, and what is said when it comes out otherwise."""

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments import replay, run
from socialmind.runs.capsule import Capsule
from socialmind.runs.verification import compare


@pytest.fixture
def folder(drifters, tmp_path):
    return run(drifters, 200, seed=8, out=tmp_path / "run")


def tamper(path, change):
    table = pd.read_parquet(path)
    change(table)
    table.to_parquet(path)


def test_a_run_is_reproduced(drifters, folder):
    found = replay(folder, drifters)
    assert found.equal
    assert found.exact
    assert found.notes == ()


def test_a_changed_value_is_found_by_hash_and_by_place(drifters, folder):
    def change(table):
        table.loc[table["tick"].isin([150, 160]), "population"] += 1

    tamper(folder / "series.parquet", change)
    found = replay(folder, drifters)
    assert [d.table for d in found.differences] == ["series", "series"]
    assert "is not the table that the run wrote" in str(found.differences[0])
    population = 5 + (149 // 7) % 4
    assert found.differences[1].message == (
        f"column population first differs at tick 150: {population + 1} in the run, "
        f"{population} now"
    )


def test_a_changed_agent_is_named(drifters, folder):
    def change(table):
        table.loc[(table["tick"] == 20) & (table["agent"] == 3), "x"] = 0.5

    tamper(folder / "agents.parquet", change)
    message = str(replay(folder, drifters).differences[1])
    assert message.startswith("agents: column x first differs at tick 20, agent 3: 0.5 in the run")


def test_a_value_in_place_of_none_is_found(drifters, folder):
    def change(table):
        table.loc[table["tick"] == 7, "late"] = 0.0

    tamper(folder / "series.parquet", change)
    message = str(replay(folder, drifters).differences[1])
    assert message == "series: column late first differs at tick 7: 0.0 in the run, None now"


def test_missing_rows_and_columns_are_found(drifters, folder):
    path = folder / "series.parquet"
    table = pq.read_table(path)
    pq.write_table(table.slice(0, 100), path)
    assert str(replay(folder, drifters).differences[1]) == "series: 100 rows in the run, 201 now"
    pq.write_table(table.drop_columns(["mean"]), path)
    assert "columns tick, population, late" in str(replay(folder, drifters).differences[1])
    pq.write_table(table.set_column(1, "population", pa.array(["many"] * 201)), path)
    assert "column types differ" in str(replay(folder, drifters).differences[1])


def test_another_seed_is_another_run(drifters, folder):
    Capsule(folder).update(seed=9)
    found = replay(folder, drifters)
    assert "first differs at tick 1" in str(found.differences[0])


def test_another_platform_is_compared_within_the_tolerance(drifters, folder):
    Capsule(folder).update(platforms=[{"processor": "another"}])
    found = replay(folder, drifters)
    assert found.equal
    assert not found.exact


def test_other_versions_are_noted(drifters, folder):
    capsule = Capsule(folder)
    capsule.update(versions={**capsule.manifest.versions, "socialmind": "0.0.1"})
    (note,) = replay(folder, drifters).notes
    assert note.endswith("here, 0.0.1 in the run")


def test_an_unfinished_run_is_refused(drifters, folder):
    Capsule(folder).update(status="interrupted")
    with pytest.raises(SocialmindError, match="finish it with --resume"):
        replay(folder, drifters)


@pytest.mark.parametrize(
    ("stored", "again", "exact", "near"),
    [
        (1.0, 1.0, True, True),
        (1.0, np.nextafter(1.0, 2.0), False, True),
        (1e9, 1e9 + 999, False, True),
        (1e9, 1e9 + 1001, False, False),
        (0.0, 1e-10, False, True),
        (0.0, 1e-8, False, False),
        (0.0, -0.0, False, True),
        (np.nan, np.nan, True, True),
        (np.nan, 1.0, False, False),
        (np.inf, np.inf, True, True),
        (np.inf, -np.inf, False, False),
        (np.inf, 1e300, False, False),
        (None, None, True, True),
        (None, np.nan, False, False),
    ],
)
def test_exact_and_within_tolerance(tmp_path, stored, again, exact, near):
    for name, value in (("a", stored), ("b", again)):
        values = pa.array([0.0, value], pa.float64())
        pq.write_table(pa.table({"tick": [0, 1], "v": values}), tmp_path / name)
    assert (compare(tmp_path / "a", tmp_path / "b", "series", exact=True) is None) == exact
    assert (compare(tmp_path / "a", tmp_path / "b", "series", exact=False) is None) == near


def test_whole_numbers_and_texts_have_no_tolerance(tmp_path):
    for name, number, text in (("a", 10**9, "x"), ("b", 10**9 + 1, "x"), ("c", 10**9, "y")):
        columns = {"tick": [0], "number": [number], "text": [text]}
        pq.write_table(pa.table(columns), tmp_path / name)
    assert "column number" in str(compare(tmp_path / "a", tmp_path / "b", "t", exact=False))
    assert "column text" in str(compare(tmp_path / "a", tmp_path / "c", "t", exact=False))
