"""The benchmark harness measures, and writes its table and its file."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HARNESS = ROOT / "benchmarks" / "farmer_artisan.py"


@pytest.mark.study
def test_a_short_benchmark_writes_its_results(tmp_path: Path) -> None:
    command = [sys.executable, str(HARNESS), "--ticks", "2000", "--mesa-ticks", "500"]
    done = subprocess.run(
        [*command, "--rounds", "2", "--crowd", "500", "--out", str(tmp_path)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])},
    )
    assert done.returncode == 0, done.stderr
    results = json.loads((tmp_path / "farmer_artisan.json").read_text())
    for name in ("loop_seconds", "mesa_loop_seconds", "process_seconds", "mesa_process_seconds"):
        assert len(results[name]) == 2
        assert min(results[name]) > 0
    assert results["crowd"]["villages"] == 20
    assert results["crowd"]["share_with_land"] > 0.9
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    assert "| loop: times as fast as Mesa |" in text
    assert "its loop is extrapolated to 2,000" in text
