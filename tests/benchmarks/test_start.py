"""The benchmark of beginnings measures societies as they are anyway, and writes its table."""

from __future__ import annotations

import importlib
import json
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

FOLDER = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def start(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module("start")


def test_a_setup_that_is_timed_leaves_the_society_as_it_was(start: ModuleType) -> None:
    society, other = (start.models()["walkers"](3) for _ in range(2))
    assert start.setup_seconds(society) > 0.0
    for one in (society, other):
        one.advance(20)
    assert np.array_equal(society.walkers.x, other.walkers.x)
    assert (society.walkers.walked == 20.0).all()
    assert society.world.trodden.sum() == 2000


def test_the_table_says_what_is_beyond_setup_and_ticks(start: ModuleType, tmp_path: Path) -> None:
    milliseconds = {
        "begin": [0.5, 0.7, 0.6], "whole": [2.0, 2.0, 3.0], "one by one": [3.0, 2.0, 4.0],
        "at once": [1.0, 1.0, 1.0],
        "setup": [0.1, 0.1, 0.1], "first": [0.1, 0.2, 0.1],
        "ticks": [0.9, 0.9, 0.9],
    }  # fmt: skip
    results = {
        "machine": start.describe_machine("numba", "numpy"),
        "seeds": 3,
        "ticks": 100,
        "milliseconds": {"walkers": milliseconds},
    }
    start.write(results, start.table, "start", tmp_path)
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    for row in (
        "beyond its own setup and tick | 0.400 ms | 0.300 – 0.400 |",
        "its own setup and first tick | 0.200 ms | 0.200 – 0.300 |",
        "times its own setup and ticks | 2.00 | 2.00 – 3.00 |",
        "a call of `advance(1)`, beyond its tick | 0.0200 ms | 0.0100 – 0.0300 |",
    ):
        assert row in text
    assert json.loads((tmp_path / "start.json").read_text())["milliseconds"]["walkers"]
