"""The page on the studio says what the program does, and its code runs."""

import re
from pathlib import Path

import pytest

from socialmind.experiments import Run
from socialmind.interventions.edit import PARTS

PAGE = (Path(__file__).parents[2] / "docs" / "studio.md").read_text("utf-8")


def test_its_code_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.S)
    space = {}
    exec(code, space)
    run = Run(space["folder"])
    promoted = run.agents.query("tick == 1000 and agent == 6")
    assert promoted["farmer"].item() == pytest.approx(25.0, abs=5.0)


def test_it_names_every_part_that_can_be_edited():
    for part in PARTS:
        assert f"`{part} " in PAGE
