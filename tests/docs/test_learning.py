"""The page on learning: its code runs, its tables say what there is."""

import re
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from socialmind.learning import Lesson
from socialmind.learning.lessons.lesson_file import FURTHER
from socialmind.learning.training.teaching import COLUMNS
from socialmind.mind.files.evoagents import simbatch

PAGE = (Path(__file__).parents[2] / "docs" / "learning.md").read_text("utf-8")


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The names that the page's code leaves."""
    names = {"__name__": "page"}
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(tmp_path_factory.mktemp("learning"))
        exec(compile(code, "docs/learning.md", "exec"), names)
    return names


def test_the_example_learns(page):
    assert np.abs(page["genome"] - 0.5).max() < 0.05
    assert page["training"].attempts == [1, 2]
    assert (page["training"].lessons["score"] > -0.01).all()


def test_the_table_of_arguments_is_whole_and_true():
    table = PAGE.split("| argument | meaning | default |")[1].split("\n\n")[0]
    named = [name for row in table.splitlines() for name in re.findall(r"`(\w+)`", row[:30])]
    assert sorted(named) == sorted(
        one.name for one in fields(Lesson) if one.name not in ("file", "line")
    )
    defaults = {one.name: one.default for one in fields(Lesson)}
    for name, told in re.findall(r"\| `(\w+)` \|.*\| ([\d.]+) \|\n", table):
        assert defaults[name] == float(told)
    assert (defaults["finalists"], defaults["finals"]) == (10, 32)


def test_the_table_of_keys_is_whole():
    table = PAGE.split("| key | argument |")[1].split("\n\n")[0]
    keys = set(re.findall(r"`([A-Z]{3,})`", table))
    own = {*FURTHER, *simbatch.NUMBERS, *simbatch.TEXTS, "TYPE"}
    elsewhere = {"BOTMODEL", "BOTNAME", "ROOTFOLDER"}
    assert own - elsewhere <= keys
    assert all(f"`{key}`" in PAGE for key in elsewhere)


def test_the_columns_are_those_of_the_curve(page):
    told = " ".join(PAGE.split("`curve` has the columns")[1].split("seconds.")[0].split())
    assert all(name in told for name in COLUMNS if name != "seconds")
    assert list(page["training"].curve.columns) == ["attempt", "cycle", "lesson", *COLUMNS]
