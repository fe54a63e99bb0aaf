"""Tables that grow in parts: types, content hashes, merging."""

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from socialmind.errors import SocialmindError
from socialmind.runs.tables import files, growing
from socialmind.runs.tables.files import content_of, merge, read
from socialmind.runs.tables.growing import GrowingTable

ROWS = st.lists(
    st.tuples(
        st.one_of(st.none(), st.integers(-(2**62), 2**62)),
        st.one_of(st.none(), st.floats()),
        st.one_of(st.none(), st.text(max_size=4)),
        st.booleans(),
    ),
    min_size=1,
    max_size=12,
)


def write(folder, rows, cuts):
    """One row a tick, a new part after each tick of `cuts`; merged."""
    folder.mkdir()
    table = GrowingTable("series", folder)
    for tick, (a, b, c, d) in enumerate(rows):
        table.add(tick, {"a": [a], "b": [b], "c": [c], "d": [d]})
        if tick in cuts:
            table.flush()
    table.flush()
    return merge([folder / part for part in table.parts], folder / "all.parquet", "series")


@given(ROWS, st.sets(st.integers(0, 12)))
@settings(max_examples=40)
def test_where_the_parts_are_cut_does_not_show(tmp_path_factory, rows, cuts):
    home = tmp_path_factory.mktemp("cut")
    one = write(home / "one", rows, set())
    other = write(home / "other", rows, cuts)
    assert one == other == content_of(home / "other" / "all.parquet")
    files = [(home / name / "all.parquet").read_bytes() for name in ("one", "other")]
    assert files[0] == files[1]
    back = pq.read_table(home / "one" / "all.parquet").to_pydict()
    assert back["a"] == [row[0] for row in rows]
    assert back["c"] == [row[2] for row in rows]
    assert back["tick"] == list(range(len(rows)))


@given(ROWS, ROWS)
@settings(max_examples=40)
def test_the_hash_tells_different_tables_apart(tmp_path_factory, rows, others):
    home = tmp_path_factory.mktemp("hash")
    one, other = write(home / "one", rows, set()), write(home / "other", others, set())
    same = repr(rows) == repr(others)  # repr tells -0.0 from 0.0 and equates nan with nan
    assert (one.sha256 == other.sha256) == same


def test_missing_is_not_zero_and_not_empty(tmp_path):
    filled = write(tmp_path / "one", [(0, 0.0, "", False), (1, 1.0, "x", True)], set())
    missing = write(tmp_path / "other", [(None, None, None, False), (1, 1.0, "x", True)], set())
    assert filled.columns == missing.columns
    assert filled.sha256 != missing.sha256


def test_which_bits_a_nan_has_does_not_show(tmp_path):
    """They are the processor's choice: on x86, inf - inf has the sign that np.nan has not."""
    hashes = set()
    for bits in (0x7FF8000000000000, 0xFFF8000000000000, 0x7FF8000000000001):
        folder = tmp_path / f"{bits:x}"
        folder.mkdir()
        table = GrowingTable("series", folder)
        table.add(0, {"x": np.array([0x3FF0000000000000, bits], np.uint64).view(np.float64)})
        table.flush()
        hashes.add(merge([folder / table.parts[0]], folder / "all.parquet", "series").sha256)
    assert len(hashes) == 1


def test_neighbouring_texts_are_kept_apart(tmp_path):
    one = write(tmp_path / "one", [(0, 0.0, "ab", False), (1, 1.0, "c", True)], set())
    other = write(tmp_path / "other", [(0, 0.0, "a", False), (1, 1.0, "bc", True)], set())
    assert one.sha256 != other.sha256


def test_row_groups_have_one_length_however_many_rows_come(tmp_path, monkeypatch):
    monkeypatch.setattr(files, "ROW_GROUP", 10)
    monkeypatch.setattr(growing, "WAITING_ROWS", 8)
    table = GrowingTable("agents", tmp_path)
    for tick in range(9):
        table.add(tick, {"agent": np.arange(4)})
    assert len(table.parts) == 4  # full after two ticks of four rows
    table.flush()
    merge([tmp_path / p for p in table.parts], tmp_path / "all.parquet", "agents")
    file = pq.ParquetFile(tmp_path / "all.parquet")
    groups = [file.metadata.row_group(i).num_rows for i in range(file.num_row_groups)]
    assert groups == [10, 10, 10, 6]
    assert file.read()["agent"].to_pylist() == [0, 1, 2, 3] * 9


@pytest.mark.parametrize(("left_out", "kept"), [(13, [0, 10]), (10, [0, 13]), (7, [0, 10, 13])])
def test_rows_of_one_tick_can_be_left_out(tmp_path, left_out, kept):
    table = GrowingTable("series", tmp_path)
    for tick in (0, 10, 13):
        table.add(tick, {"a": [tick]})
    table.flush()
    parts, target = [tmp_path / table.parts[0]], tmp_path / "all.parquet"
    content = merge(parts, target, "series", drop_tick=left_out)
    assert content.rows == len(kept)
    assert pq.read_table(target)["a"].to_pylist() == kept


def test_a_population_that_died_out_gives_a_table_without_rows(tmp_path):
    table = GrowingTable("agents", tmp_path)
    table.add(0, {"agent": np.array([], dtype=np.int64), "plan": []})
    table.flush()
    content = merge([tmp_path / table.parts[0]], tmp_path / "all.parquet", "agents")
    assert content.rows == 0
    assert content.columns == {"tick": "int64", "agent": "int64", "plan": "null"}
    assert content_of(tmp_path / "all.parquet") == content


def test_values_are_copied_when_added(tmp_path):
    table = GrowingTable("agents", tmp_path)
    live = np.array([1.0, 2.0])
    table.add(0, {"x": live})
    live[:] = 9
    table.flush()
    assert read([tmp_path / table.parts[0]], "agents")["x"].to_pylist() == [1.0, 2.0]


@pytest.mark.parametrize(
    ("values", "kind"),
    [
        (np.array([1, 2], dtype=np.int8), "int64"),
        (np.array([1, 2], dtype=np.float32), "double"),
        (np.array([True, False]), "bool"),
        (np.array(["a", "b"]), "string"),
        (np.ma.MaskedArray([1.5, 2.5], mask=[True, False]), "double"),
        ([np.float64(1), None], "double"),
        ([1, 2.5], "double"),
        ([None, None], "null"),
    ],
)
def test_every_column_has_one_of_five_types(tmp_path, values, kind):
    table = GrowingTable("agents", tmp_path)
    table.add(0, {"x": values})
    table.flush()
    assert str(read([tmp_path / table.parts[0]], "agents").schema.field("x").type) == kind


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ([object()], "column x"),
        ([1, "a"], "column x"),
        ([[1, 2]], "column x: values of type list"),
        ([1, True], "column x: values of type bool and int"),
        (np.zeros((2, 2)), "column x: an array of 2 dimensions"),
        (np.array([2**64 - 1], dtype=np.uint64), "column x: a whole number"),
        ([2**63], "column x"),
    ],
)
def test_values_no_column_can_hold_are_named(tmp_path, values, message):
    table = GrowingTable("series", tmp_path)
    with pytest.raises(SocialmindError, match=f"series at tick 0: {message}"):
        table.add(0, {"x": values})
        table.flush()


def test_a_column_of_two_kinds_is_named(tmp_path):
    table = GrowingTable("series", tmp_path)
    table.add(0, {"x": [1.0]})
    table.flush()
    table.add(1, {"x": ["a"]})
    with pytest.raises(SocialmindError, match="x holds double at one tick and string at another"):
        table.flush()


def test_columns_of_unequal_length_or_other_names_are_named(tmp_path):
    table = GrowingTable("agents", tmp_path)
    with pytest.raises(SocialmindError, match="column y has 1 values, x has 2"):
        table.add(5, {"x": [1, 2], "y": [1]})
    table.add(5, {"x": [1, 2]})
    with pytest.raises(SocialmindError, match="same columns at every tick"):
        table.add(6, {"y": [1, 2]})


def test_a_table_that_goes_on_keeps_its_columns(tmp_path):
    table = GrowingTable("agents", tmp_path)
    table.add(5, {"x": [1, 2]})
    table.flush()
    later = GrowingTable("agents", tmp_path, table.parts)
    assert later.columns == ("x",)
    with pytest.raises(SocialmindError, match="same columns at every tick"):
        later.add(6, {"y": [1, 2]})


class TwoColumnsAlike:
    """As a pandas table can be."""

    def items(self):
        return [("x", [1]), ("x", [2])]


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ([1, 2], "found [1, 2]; expected a dictionary of columns by name"),
        (None, "found None; expected a dictionary of columns by name"),
        (TwoColumnsAlike(), "two columns 'x'; give each a name"),
        ({3: [1]}, "a column called 3; expected a name"),
        ({"x\n": [1]}, "a column called 'x\\n'; expected a name"),
        ({"x": 3.5}, "column x: found 3.5; expected a sequence with one value for each row"),
        ({"x": "abc"}, "column x: found 'abc'; expected a sequence with one value for each row"),
        ({"x": {1, 2}}, "column x: found {1, 2}; expected a sequence with one value for each row"),
        (
            {"x": np.zeros(())},
            "column x: an array of 0 dimensions; expected one value for each row",
        ),
        (
            {"x": [1, 2], "y": [1]},
            "column y has 1 values, x has 2; give every column one value a row",
        ),
        (
            {"tick": [6], "x": [1]},
            "a column tick of other values than the tick; the run adds its own, so "
            "give it another name",
        ),
        ({"x": ["\ud800"]}, "column x: a text with half a character, which UTF-8 does not hold"),
    ],
)
def test_what_is_no_row_is_named_with_the_method_that_gave_it(tmp_path, columns, message):
    table = GrowingTable("agents", tmp_path, source="farm/model.py:12: agents()")
    with pytest.raises(SocialmindError) as caught:
        table.add(7, columns)
        table.flush()
    assert str(caught.value) == f"farm/model.py:12: agents() at tick 7: {message}"


def test_a_model_may_give_the_tick_as_well(tmp_path):
    table = GrowingTable("agents", tmp_path)
    table.add(7, {"tick": [7, 7], "x": [1, 2]})
    table.flush()
    assert read([tmp_path / table.parts[0]], "agents").to_pydict() == {"tick": [7, 7], "x": [1, 2]}


def test_what_is_no_table_is_named(tmp_path):
    (tmp_path / "x.parquet").write_bytes(b"no table")
    with pytest.raises(SocialmindError, match=r"x.parquet: cannot be read"):
        content_of(tmp_path / "x.parquet")
    with pytest.raises(SocialmindError, match="cannot be read"):
        read([tmp_path / "missing.parquet"], "series")


def test_strings_of_a_slice_hash_as_themselves(tmp_path):
    """Arrow slices share the buffers of the whole; the hash must see the slice alone."""
    whole = pa.table({"c": ["aa", "b", None, "ccc"]})
    digests = []
    for cut in (0, 1, 3):
        digest = files.ContentDigest(whole.schema)
        digest.update(whole.slice(0, cut))
        digest.update(whole.slice(cut))
        digests.append(digest.content())
    assert digests[0] == digests[1] == digests[2]
