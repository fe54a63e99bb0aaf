"""The benchmark of hierarchies measures what it says, and writes its table and its file."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "benchmarks"
ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])}


@pytest.fixture
def collect(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module("collect_hierarchy")


def test_the_hierarchy_is_that_of_figure_6_1(collect: ModuleType) -> None:
    description = collect.collect_hierarchy()
    assert len(description.skills) == 6
    assert description.masters == ("Collect",)
    bases = [name for name, skill in description.skills.items() if not skill.is_complex]
    assert sorted(bases) == ["Avoid", "GoToDropZone", "GoToObject"]
    # 12 → 14 → 14 → 2 and 13 → 15 → 15 → 2 twice; 1 → 4 → 4 → 2 twice; 2 → 5 → 5 → 3
    assert collect.size(description) == 422 + 2 * 482 + 2 * 38 + 63
    assert collect.size(description) == pytest.approx(1510, rel=0.01)


@pytest.mark.study
def test_a_short_benchmark_writes_its_results(tmp_path: Path) -> None:
    pytest.importorskip("torch")
    command = [sys.executable, str(FOLDER / "mind.py"), "--agents", "20", "--rounds", "2"]
    done = subprocess.run(
        [*command, "--seconds", "0.01", "--crowds", "5", "30", "--out", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        env=ENVIRONMENT,
    )
    assert done.returncode == 0, done.stderr
    results = json.loads((tmp_path / "mind.json").read_text())
    for rates in results["evaluations_per_second"].values():
        assert len(rates) == 2
        assert min(rates) > 0
    assert results["share_of_skills_influenced"] > 0.95
    assert [row["agents"] for row in results["scaling"]["agents"]] == [5, 30]
    memory = results["memory"]
    assert memory["peak_bytes_in_10000"] < 2 * memory["peak_bytes_in_1000"]
    assert memory["blocks_after_10000"] < 100
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    assert "| a genome each: times as fast as torch |" in text
