"""The page on papers: its code runs, its tables say what there is."""

import re
import shlex
from pathlib import Path

from socialmind.documents import tables
from socialmind.documents.odd.words import WORDS_FILE, facts_in

PAGE = (Path(__file__).parents[2] / "docs" / "papers.md").read_text("utf-8")


def test_its_code_runs():
    names = {}
    for block in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL):
        exec(block, names)
    assert names["document"].gaps == ()
    assert names["document"].pictures[0].caption == "The cognitive scheme of humans"


def test_its_way_from_a_question_to_figure_and_paragraph_can_be_gone(tmp_path, monkeypatch):
    from typer.testing import CliRunner

    from socialmind.cli import app

    monkeypatch.chdir(tmp_path)
    section = PAGE.partition("## From a question")[2].partition("\n## ")[0]
    lines = re.findall(r"^socialmind (.*)$", section, re.MULTILINE)
    assert [line.split()[0] for line in lines] == ["sweep", "plot", "methods"]
    for line in lines:
        words = shlex.split(line.partition(" > ")[0])
        words = [{"300000": "20", "0:20": "0:2"}.get(word, word) for word in words]
        if words[0] == "sweep":
            words = [word.replace("50,100,167,250,400", "50,167") for word in words]
            words = [word.replace("0.25,0.5,1.01,2,4", "0.5,1.01") for word in words]
            words += ["--interpreted", "--workers", "1"]
        result = CliRunner().invoke(app, words)
        assert result.exit_code == 0, (line, result.output)
    assert "tool_price (50, 167 wheat a tool)" in result.stdout and "8 runs" in result.stdout
    drawn = {path.name for path in (tmp_path / "surface" / "figures").iterdir()}
    for named in re.findall(r"((?:response|series|effects)-\w+)`", section):
        assert f"{named}.pdf" in drawn


def test_its_table_of_words_is_one_that_is_read():
    (table,) = (one for one in re.findall(r"```\n(.*?)```", PAGE, re.DOTALL) if "Grazers" in one)
    assert facts_in(table)[1] == {
        "energy": {
            "unit": "kJ",
            "start": "uniform in 5 … 15",
            "meaning": "what is left of what it ate",
        }
    }
    assert WORDS_FILE in PAGE


def test_it_names_all_forms_of_tables_and_what_they_hold():
    told = re.findall(r"^\| `(\w+)` \| a ", PAGE, re.MULTILINE)
    assert tuple(told) == tables.FORMS
    assert f"{tables.SHEET_ROWS - 1:,} rows a sheet" in PAGE
    assert f"{tables.PAGE_ROWS:,} rows" in PAGE
