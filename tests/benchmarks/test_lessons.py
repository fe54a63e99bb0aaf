"""The benchmark of lessons: both programs give the same; its table says what it should."""

from __future__ import annotations

import importlib
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from socialmind.learning.training.course import curriculum_of
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder

FOLDER = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def lessons(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module("lessons")


def test_a_copy_of_all_weights_gives_the_same_scores(lessons: ModuleType) -> None:
    mind = MindDescription.load(model_folder(lessons.MODEL) / "mind")
    lesson = next(one for one in curriculum_of(lessons.MODEL)[0].lessons if one.name == "Search")
    both = lessons.programs(lesson, mind, ticks=40, individuals=2)
    (shared, ticks), (copied, others) = (run(range(3)) for run in both.values())
    assert shared.shape == (2, 3)
    assert ticks == others == 2 * 3 * 40
    np.testing.assert_array_equal(shared, copied)


def test_the_table_says_how_many_times_as_fast(lessons: ModuleType) -> None:
    rates = {"Search": {"shared": [3.0, 4.0, 6.0], "copied": [2.0, 2.0, 2.0]}}
    machine = {"processor": "P", "cores": 2, "system": "S", "python": "3", "numba": "0"}
    text = lessons.table(
        {"machine": machine, "rounds": 3, "individuals": 64, "ticks": 1000,
         "million_ticks_per_second": rates}
    )  # fmt: skip
    assert "3 rounds of 64 individuals, episodes of at most 1,000 ticks" in text
    assert "| Search | 2.00 | 1.50 – 3.00 | 4.000 |" in text
