"""A scheme that changes on the way may bring columns and take them: they are missing elsewhere."""

from dataclasses import replace

import pytest

from coglogo_py import CognitiveScheme, Cogniton
from socialmind.catalogue import load_model
from socialmind.experiments import Change, Run, branch, replay, resume, run
from socialmind.runs.tables.files import merge, read
from socialmind.runs.tables.growing import GrowingTable

OWN = CognitiveScheme.load("models/farmer_artisan/scheme.yaml")
MORE = replace(OWN, cognitons=(Cogniton("Hope", start_value=2.0), *OWN.cognitons))
CHANGES = [Change(20, {}, {"humans": MORE}), Change(40, {}, {"humans": OWN})]
MODEL = load_model("farmer_artisan")
SETTINGS = {"n_agents": 4}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs") / "whole"
    return run(
        MODEL,
        60,
        1,
        SETTINGS,
        every=5,
        agents_every=5,
        out=folder,
        interventions=CHANGES,
        progress=False,
    )


def hashes(folder):
    return {name: one["sha256"] for name, one in Run(folder).manifest.tables.items()}


def test_what_a_scheme_lacks_is_missing(whole):
    agents = Run(whole).agents
    there = agents[agents["cogniton_Hope"].notna()]
    # A change at a tick shows from the next one on.
    assert sorted(set(there["tick"])) == [25, 30, 35, 40]
    assert set(there["cogniton_Hope"]) == {2.0}
    assert agents["cogniton_Farmer"].notna().all()
    assert replay(whole).equal


def test_a_run_that_was_stopped_goes_on_to_the_same_tables(whole, tmp_path):
    for every in (5, None):
        told = {"every": 5, "agents_every": every, "interventions": CHANGES, "progress": False}
        other = run(MODEL, 60, 1, SETTINGS, out=tmp_path / f"{every} whole", **told)
        for length in (15, 32, 50):
            folder = run(MODEL, length, 1, SETTINGS, out=tmp_path / f"{every} {length}", **told)
            resume(folder, 60, progress=False)
            assert hashes(folder) == hashes(other)


def test_a_branch_takes_another_scheme_with_more_cognitons(whole, tmp_path):
    MORE.save(tmp_path / "more.yaml")
    out = branch(whole, at=50, scheme=tmp_path / "more.yaml", ticks=70, out=tmp_path / "branch")
    agents = Run(out).agents
    assert sorted(set(agents[agents["cogniton_Hope"].notna()]["tick"])) == [
        25,
        30,
        35,
        40,
        *range(55, 71, 5),
    ]
    assert replay(out).equal


def test_columns_come_in_the_order_in_which_they_first_appear(tmp_path):
    table = GrowingTable("series", tmp_path, changing=True)
    for tick, row in enumerate([{"a": [1]}, {"b": [2.5], "a": [3]}, {"b": [4.5]}, {"c": ["x"]}]):
        table.add(tick, row)
    table.flush()
    parts = [tmp_path / part for part in table.parts]
    merge(parts, tmp_path / "all.parquet", "series")
    for paths in (parts, [tmp_path / "all.parquet"]):
        assert read(paths, "series").to_pydict() == {
            "tick": [0, 1, 2, 3],
            "a": [1, 3, None, None],
            "b": [None, 2.5, 4.5, None],
            "c": [None, None, None, "x"],
        }
    again = GrowingTable("series", tmp_path, table.parts, changing=True)
    assert again.columns == ("a", "b", "c")
