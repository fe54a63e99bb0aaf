"""The study of the farmer-artisan society runs and writes what its README shows."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pandas as pd

from coglogo_py import CognitiveScheme

ROOT = Path(__file__).parents[2]
TOPIC = "analysis.farmer_artisan"


def test_a_small_study_writes_its_results(tmp_path: Path) -> None:
    command = [sys.executable, "-m", f"{TOPIC}.study", "--seeds", "2", "--ticks", "4000"]
    done = subprocess.run(
        [*command, "--every", "200", "--workers", "1", "--out", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])},
    )
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "results.csv")
    assert table["seed"].tolist() == [0, 1]
    assert table["artisans"].between(0, 25).all()
    # The shock takes half of the artisans there are, and the society goes on from there.
    assert (table["turned"] > 0).all()
    assert (table["after_shock"] < table["before_shock"] + 1).all()
    found = json.loads((tmp_path / "summary.json").read_text())
    assert found["shock"] == 2000
    assert "| seeds with 3 to 9 artisans |" in (tmp_path / "README.md").read_text(encoding="utf-8")
    for suffix in ("pdf", "png"):
        assert (tmp_path / "figures" / f"study.{suffix}").stat().st_size > 0


def test_a_learned_mind_is_compared_and_distilled(tmp_path: Path) -> None:
    command = [sys.executable, "-m", f"{TOPIC}.learned", "--seeds", "2", "--ticks", "2000"]
    done = subprocess.run(
        [*command, "--every", "200", "--out", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])},
    )
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "learned.csv")
    assert table["society"].tolist() == ["written", "learned", "distilled"] * 2
    assert (table["prosperity"] > 0).all()
    against = pd.read_csv(tmp_path / "comparison.csv").set_index(["society", "measure"])
    # Far apart in what the scheme of others does, near where it is the mind's own.
    away = against["difference"].abs()
    assert away["distilled", "prosperity"] < away["written", "prosperity"]
    found = json.loads((tmp_path / "learned.json").read_text())
    assert found["overlap"] > 0.9
    scheme = CognitiveScheme.load(tmp_path / "distilled.yaml")
    assert sum(len(one.influence) for one in scheme.cognitons) == found["links"]
    assert "| division of labour" in (tmp_path / "README.md").read_text(encoding="utf-8")
