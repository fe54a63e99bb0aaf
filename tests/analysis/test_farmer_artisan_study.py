"""The study of the farmer-artisan society runs and writes what its README shows."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

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


def test_learned_minds_are_compared_and_distilled(tmp_path: Path) -> None:
    command = [sys.executable, "-m", f"{TOPIC}.learned", "--seeds", "2", "--ticks", "2000"]
    done = subprocess.run(
        [*command, "--attempts", "2", "--workers", "1", "--out", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])},
    )
    assert done.returncode == 0, done.stderr
    table = pd.read_csv(tmp_path / "learned.csv")
    runs = table.groupby("society", sort=False)["attempt"].agg(list)
    assert runs.to_dict() == {
        "written": [0, 0], "learned": [1, 1, 2, 2], "distilled": [1, 1, 2, 2], "shipped": [0, 0],
    }  # fmt: skip
    assert (table["prosperity"] > 0).all()
    # What is distilled from a mind lives much as that mind does, and not as the written scheme.
    means = table.groupby(["society", "attempt"])["prosperity"].mean()
    for attempt in (1, 2):
        own = means["learned", attempt]
        assert abs(means["distilled", attempt] - own) < abs(means["written", 0] - own)
    attempts = pd.read_csv(tmp_path / "learned-attempts.csv").set_index("attempt")
    assert attempts.index.tolist() == ["the model's", "1", "2"]
    assert attempts.loc["2", "prosperity"] == pytest.approx(means["learned", 2], rel=1e-4)
    found = json.loads((tmp_path / "learned.json").read_text())
    assert found["overlap"] > 0.9
    scheme = CognitiveScheme.load(tmp_path / "distilled.yaml")
    assert sum(len(one.influence) for one in scheme.cognitons) == found["links"]
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    assert "| division of labour" in text
    assert "| 2 | 1.22 |" in text
