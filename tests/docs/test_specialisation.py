"""The page on measuring specialisation: its code runs, and its table says what there is."""

import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[2] / "docs" / "specialisation.md").read_text("utf-8")


@pytest.fixture(scope="module")
def page():
    """The names that the page's code leaves."""
    names = {"__name__": "page"}
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
    exec(compile(code, "docs/specialisation.md", "exec"), names)
    return names


def test_the_society_settles_and_recovers(page):
    measures = page["measures"]
    assert measures["settling_ticks"] == 6000
    assert measures["recovery_ticks_1"] == 4000
    assert measures["within"] == 1.0


def test_the_table_names_all_measures(page):
    told = PAGE.split("| measure | definition |")[1].split("\n\n")[0]
    assert re.findall(r"^\| `(\w+)`", told, re.MULTILINE) == list(page["measures"])


def test_societies_are_compared(page):
    table = page["table"].set_index("measure")
    assert table.loc["delivered", "difference"] == page["difference"].mean == 8.25
    assert table.loc["settling_ticks", "delta"] == 1.0
