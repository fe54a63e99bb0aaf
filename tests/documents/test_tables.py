"""Tables for other programs: what is written reads back, what does not fit is refused."""

import numpy as np
import openpyxl
import pandas as pd
import pytest

from socialmind.documents import tables
from socialmind.documents.tables import STATA_NAME, STATA_TAKEN, export, for_stata, stata_names
from socialmind.errors import SocialmindError

AGENTS = pd.DataFrame(
    {
        "tick": pd.array([0, 0, 10], "Int64"),
        "cows.agent": pd.array([2**40, None, 3], "Int64"),
        "plan": pd.array(["Grow 50 % & sell_it", None, "é|ü"], "string"),
        "happy": pd.array([True, False, None], "boolean"),
        "in": [0.1, np.nan, -1e300],
        "nothing": pd.array([None, None, None], "object"),
    }
)
SERIES = pd.DataFrame({"tick": [0, 10], "farmers": [3, 4]})


@pytest.fixture
def folder(tmp_path):
    home = tmp_path / "run-001"
    home.mkdir()
    (home / "manifest.json").write_text("{}")
    AGENTS.to_parquet(home / "agents.parquet")
    SERIES.to_parquet(home / "series.parquet")
    return home


def test_csv_holds_every_number_to_the_last_bit(folder):
    made = export(folder, "csv")
    assert [path.name for path in made.files] == ["agents.csv", "series.csv"]
    read = pd.read_csv(folder / "export/agents.csv")
    assert read["in"].tolist()[::2] == [0.1, -1e300]
    assert read["cows.agent"].tolist()[::2] == [2**40, 3]
    assert read["plan"].tolist()[::2] == ["Grow 50 % & sell_it", "é|ü"]
    assert read.isna().sum().to_dict() == AGENTS.isna().sum().to_dict()


def test_a_workbook_has_a_sheet_for_each_table(folder):
    (path,) = export(folder, "xlsx").files
    assert path.name == "run-001.xlsx"
    book = openpyxl.load_workbook(path)
    assert book.sheetnames == ["agents", "series"]
    rows = list(book["agents"].values)
    assert rows[0] == tuple(AGENTS)
    assert rows[2] == (0, None, None, False, None, None)
    assert rows[1][1] == 2**40


def test_stata_reads_what_is_written_by_names_that_it_can_hold(folder):
    made = export(folder, "dta", only=["agents"])
    assert made.renamed == {"agents": {"cows.agent": "cows_agent", "in": "_in"}}
    with pd.read_stata(made.files[0], iterator=True) as file:
        labels = file.variable_labels()
        read = file.read()
    assert (labels["cows_agent"], labels["_in"]) == ("cows.agent", "in")
    assert read["cows_agent"].tolist()[::2] == [2**40, 3]
    assert read["plan"].tolist() == ["Grow 50 % & sell_it", "", "é|ü"]
    assert read["happy"].tolist()[:2] == [1, 0]
    assert read["_in"].tolist()[::2] == [0.1, -1e300]
    assert read.isna().sum()[["cows_agent", "happy", "_in", "nothing"]].tolist() == [1, 1, 1, 3]


def test_latex_is_a_table_whose_texts_are_escaped(folder):
    (path,) = export(folder, "latex", only=["agents"]).files
    text = path.read_text("utf-8")
    assert r"Grow 50 \% \& sell\_it" in text
    assert text.startswith(r"\begin{longtable}")


@pytest.mark.parametrize(("to", "limit"), [("xlsx", "SHEET_ROWS"), ("latex", "PAGE_ROWS")])
def test_too_many_rows_are_refused_before_anything_is_written(folder, monkeypatch, to, limit):
    monkeypatch.setattr(tables, limit, 3 if to == "xlsx" else 2)
    with pytest.raises(SocialmindError, match=r"the table agents has 3 rows; .* holds 2; nothing"):
        export(folder, to)
    assert not (folder / "export").exists()
    assert export(folder, to, only=["series"]).files


def test_the_largest_sheet_is_excels():
    assert tables.SHEET_ROWS == 2**20


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({"to": "sas"}, "--to sas: expected one of csv, xlsx, dta, latex"),
        ({"to": "csv", "only": ["agent"]}, "no table 'agent'; did you mean 'agents'"),
    ],
)
def test_what_there_is_not_is_refused(folder, arguments, told):
    with pytest.raises(SocialmindError, match=told):
        export(folder, **arguments)


def test_a_folder_without_tables_says_why(tmp_path):
    with pytest.raises(SocialmindError, match="holds no manifest"):
        export(tmp_path, "csv")
    (tmp_path / "manifest.json").write_text("{}")
    with pytest.raises(SocialmindError, match="no tables yet"):
        export(tmp_path, "csv")


def test_a_table_in_parts_is_one_table(folder):
    whole = folder / "series.parquet"
    whole.unlink()
    whole.mkdir()
    for part in (0, 1):
        SERIES.iloc[part : part + 1].to_parquet(whole / f"part-{part}.parquet")
    export(folder, "csv", only=["series"])
    assert pd.read_csv(folder / "export/series.csv").equals(SERIES)


def test_numbers_that_stata_does_not_have_are_refused():
    with pytest.raises(SocialmindError, match="infinite"):
        for_stata("agents", pd.DataFrame({"number": [np.inf]}))


@pytest.mark.parametrize("to", ["xlsx", "dta"])
def test_seeds_that_a_form_would_round_are_texts(folder, to):
    seeds = [2**63 - 1, 7]
    table = {"run": [0, 1], "seed": seeds, "big": pd.array([-(2**60), None], "Int64"), "n": [1, 2]}
    pd.DataFrame(table).to_parquet(folder / "runs.parquet")
    (path,) = export(folder, to, only=["runs"]).files
    read = pd.read_stata(path) if to == "dta" else pd.read_excel(path, dtype=object)
    assert read["seed"].tolist() == [str(one) for one in seeds]
    assert (read["big"][0], read["n"].tolist()) == (str(-(2**60)), [1, 2])


def test_what_begins_with_an_equals_sign_is_no_formula(folder):
    texts = pd.DataFrame({"=1+1": ['=HYPERLINK("x")', None], "n": [1, 2]})
    texts.to_parquet(folder / "series.parquet")
    (path,) = export(folder, "xlsx", only=["series"]).files
    cells = [one for row in openpyxl.load_workbook(path)["series"] for one in row]
    assert "f" not in {one.data_type for one in cells}
    assert [one.value for one in cells[:3]] == ["=1+1", "n", '=HYPERLINK("x")']


def test_control_characters_that_excel_lacks_are_replaced(folder):
    texts = pd.DataFrame({"error": ["bad \x07 bell", "two\nlines"], "n": [1, 2]})
    texts.to_parquet(folder / "series.parquet")
    (path,) = export(folder, "xlsx", only=["series"]).files
    read = pd.read_excel(path, sheet_name="series")
    assert read["error"].tolist() == ["bad \N{REPLACEMENT CHARACTER} bell", "two\nlines"]
    assert read["n"].tolist() == [1, 2]


def test_names_for_stata_are_short_plain_and_each_once():
    long = "weight_TradeWheatForToolsInTheVillage"
    names = [long + "1", long + "2", "tick", "a b", "a_b", "str12", "", "é", "é!", *STATA_TAKEN]
    renamed = stata_names(names)
    final = [renamed.get(name, name) for name in names]
    assert len(set(final)) == len(final)
    assert all(len(name) <= STATA_NAME and name.isascii() and name.isidentifier() for name in final)
    assert not STATA_TAKEN.intersection(final)
    assert "tick" not in renamed and "a_b" not in renamed
    assert stata_names(final) == {}
