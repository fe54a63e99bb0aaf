"""The page on papers: its code runs, its tables say what there is."""

import re
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
