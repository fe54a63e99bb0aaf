"""The benchmark of planes compares programs that do the same, and writes its table and file."""

from __future__ import annotations

import importlib
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "benchmarks"
ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join([str(ROOT), *sys.path])}


@pytest.fixture
def plane(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module("plane")


@pytest.fixture
def plain(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module("plane_in_pymunk")


def test_robots_take_the_same_path_in_the_same_world(plane: ModuleType) -> None:
    for seed in range(3):
        ours, theirs = plane.paths(seed, 500)
        assert len(ours) == 500
        assert np.abs(ours - theirs).max() < 1e-6
        assert np.abs(ours[-1] - ours[0]).max() > 5.0  # they went somewhere


def test_worlds_are_drawn_as_the_model_draws_them(plane: ModuleType, plain: ModuleType) -> None:
    counts = [len(plain.Drawn(seed).obstacles) for seed in range(20)]
    ours = [int(plane.COLLECT(seed=seed).tables["obstacles"].alive.sum()) for seed in range(20)]
    assert abs(np.mean(counts) - np.mean(ours)) < 1.0
    drawn = plain.Drawn(3)
    for _ in range(50):
        x, y = drawn.object_place()
        assert max(abs(x), abs(y)) <= 60.0
        assert math.hypot(x + 40.0, y + 40.0) > 50.0
        gaps = [math.hypot(x - a, y - b) - half for a, b, _, half in drawn.obstacles]
        assert min(gaps) > 4.0


def test_python_collects_objects_as_well_and_ends_at_a_collision(
    plane: ModuleType, plain: ModuleType
) -> None:
    mind = plane.plain_mind(plane.trained())
    assert sum(plain.episode(seed, 4000, mind).delivered for seed in range(3)) >= 3

    class Straight(plain.Mind):  # type: ignore[name-defined]  # found as the test runs
        def commands(self, *readings: object) -> tuple[float, float, float]:
            return 1.0, 1.0, 0.5

    world = plain.World(
        [(20.0, 0.0, 0.0, 3.0)], 0.0, lambda: (0.0, 50.0), Straight({**_none(plane)})
    )
    world.run(10_000)
    assert world.collided
    x, y = world.robot.position
    assert (x, y) == (pytest.approx(16.0, abs=0.2), pytest.approx(0.0))
    # 2 · 80 units of force on 2π of mass, damped by 5 a second.
    assert world.tick == pytest.approx(30 * 16.0 / 5.09 + 6, abs=3)


def _none(plane: ModuleType) -> dict[str, list[tuple[np.ndarray, np.ndarray]]]:
    return {name: [(np.zeros((1, 1)), np.zeros(1))] for name in plane.LINKS}


@pytest.mark.study
def test_a_short_benchmark_writes_its_results(tmp_path: Path) -> None:
    command = [sys.executable, str(FOLDER / "plane.py"), "--rounds", "2", "--worlds", "4"]
    few = ["--fewer", "4", "--ticks", "100", "--compared", "1", "--out", str(tmp_path)]
    done = subprocess.run(
        [*command, *few], capture_output=True, text=True, check=False, env=ENVIRONMENT
    )
    assert done.returncode == 0, done.stderr
    results = json.loads((tmp_path / "plane.json").read_text())
    assert set(results["ticks_per_second"]) == {
        "compiled", "compiled_own_genomes", "compiled_in_threads", "pymunk", "python",
    }  # fmt: skip
    for rates in [*results["ticks_per_second"].values(), *results["microseconds_a_tick"].values()]:
        assert len(rates) == 2
        assert min(rates) > 0
    assert results["paths_apart"] < 1e-3
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    assert "| compiled: times as fast as Python over pymunk |" in text
