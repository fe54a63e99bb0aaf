"""The tables of a sweep: the same however its runs were cut into windows."""

import itertools
import tempfile
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.tables import merging, store
from socialmind.experiments.sweeps.tables.store import RUNS, Store
from socialmind.runs.tables.growing import arrow_table
from socialmind.runs.tables.names import SERIES


def rows_of(run):
    """Two rows of a series; a column that only some runs have, whole or broken numbers."""
    extra = {"extra": [1 if run % 2 else 0.5] * 2} if run % 3 == 0 else {}
    table = {"run": [run] * 2, "tick": [0, 10], "a": [run, None], **extra}
    return arrow_table([table], SERIES)


def window(runs, status="finished"):
    table = {"run": runs, "status": [status] * len(runs), "seed": [7 * run for run in runs]}
    return {SERIES: [rows_of(run) for run in runs], RUNS: [arrow_table([table], RUNS)]}


def merged(folder, windows):
    one = Store(folder)
    one.begin()
    for runs in windows:
        one.write(window(runs))
    contents = [one.merge(SERIES, ["run", "tick"]), one.merge(RUNS, ["run"])]
    return contents, [(folder / f"{name}.parquet").read_bytes() for name in (SERIES, RUNS)]


@settings(max_examples=20)
@given(st.permutations(range(12)), st.lists(st.integers(1, 11), max_size=5, unique=True))
def test_tables_hang_on_no_order_and_no_windows(order, cuts):
    ends = [0, *sorted(cuts), 12]
    windows = [order[a:b] for a, b in itertools.pairwise(ends)]
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "a").mkdir()
        (Path(folder) / "b").mkdir()
        assert merged(Path(folder) / "a", windows) == merged(Path(folder) / "b", [list(range(12))])
        assert pq.read_table(Path(folder) / "a" / "series.parquet")["run"].to_pylist() == [
            run for run in range(12) for _ in range(2)
        ]


def test_long_tables_go_through_few_pieces_in_memory(tmp_path, monkeypatch):
    monkeypatch.setattr(merging, "ROW_GROUP", 8)
    monkeypatch.setattr(store, "ROW_GROUP", 8)
    monkeypatch.setattr(merging, "KEPT_GROUPS", 2)
    monkeypatch.setattr(merging, "MOST_PIECES", 3)
    windows = [list(range(n, 120, 3)) for n in range(3)]
    merged(tmp_path, windows)
    found = pq.read_table(tmp_path / "series.parquet").to_pydict()
    assert found["run"] == [run for run in range(120) for _ in range(2)]
    assert found["a"][::2] == list(range(120))
    assert pq.ParquetFile(tmp_path / "series.parquet").num_row_groups == 30


def test_a_later_part_stands_in_place_of_an_earlier(tmp_path):
    one = Store(tmp_path)
    one.begin()
    one.write(window([0, 1, 2], "failed"))
    one.write(window([1]))
    one.merge(RUNS, ["run"])
    found = pq.read_table(tmp_path / "runs.parquet").to_pydict()
    assert found["status"] == ["failed", "finished", "failed"]
    assert {row["run"]: row["status"] for row in one.rows(["status"])} == {
        0: "failed", 1: "finished", 2: "failed",
    }  # fmt: skip


def test_a_window_whose_runs_were_not_written_never_happened(tmp_path):
    one = Store(tmp_path)
    one.begin()
    one.write(window([0, 1]))
    one.write(window([2]))
    (tmp_path / "parts" / RUNS / "000001.parquet").unlink()
    (tmp_path / "parts" / RUNS / "000002.parquet.partial").write_bytes(b"half")
    again = Store(tmp_path)
    again.begin()
    assert [row["run"] for row in again.rows([])] == [0, 1]
    assert [path.name for path in (tmp_path / "parts" / SERIES).iterdir()] == ["000000.parquet"]
    again.write(window([2]))
    assert again.numbers() == [0, 1]


def test_a_part_that_was_cut_off_is_named(tmp_path):
    one = Store(tmp_path)
    one.begin()
    one.write(window([0, 1]))
    part = tmp_path / "parts" / RUNS / "000000.parquet"
    part.write_bytes(part.read_bytes()[:-9])
    with pytest.raises(SocialmindError, match=r"000000\.parquet: cannot be read as a table"):
        list(one.rows([]))


def test_a_part_that_comes_while_others_are_read_is_left_out(tmp_path, monkeypatch):
    one = Store(tmp_path)
    one.begin()
    one.write(window([0, 1]))
    latest = one._latest()
    one.write(window([2]))
    monkeypatch.setattr(one, "_latest", lambda: latest)
    assert [run for rows in one.so_far(RUNS) for run in rows["run"].to_pylist()] == [0, 1]
