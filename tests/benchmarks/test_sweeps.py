"""The benchmark of sweeps: its bare loop has the same societies; its table says what it should."""

from __future__ import annotations

import importlib
from pathlib import Path
from types import ModuleType

import pytest

from socialmind.experiments import Sweep, sweep

FOLDER = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def sweeps(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module("sweeps")


def test_the_bare_loop_has_the_societies_of_the_sweep(sweeps: ModuleType, tmp_path: Path) -> None:
    made = []

    class Noted:
        def __init__(self, seed: int, tool_price: float) -> None:
            made.append((tool_price, seed))

        def advance(self, ticks: int) -> None:
            assert ticks == 1

    sweeps.bare(Noted, 2, 1)
    out = sweep(
        sweeps.MODEL, sweeps.DESIGN, 0, range(2), compiled=False, workers=1, out=tmp_path / "s"
    )
    assert list(Sweep(out).runs[["tool_price", "seed"]].itertuples(index=False, name=None)) == made


def test_the_table_says_what_is_beyond_the_ticks(sweeps: ModuleType) -> None:
    one = {"a second": 100.0, "a run": 1.5, "here": 200.0, "workers": 300.0, "files": 9}
    results = {
        "machine": sweeps.describe_machine("numba", "numpy"),
        "ticks": 1000,
        "runs": 20_000,
        "workers": 2,
        "beyond": {
            "bare": [6.0, 6.0, 6.1], "no series": [2.0, 2.5, 3.0],
            "bare recorded": [9.0, 9.0, 9.0], "series and agents": [1.0, 2.0, 3.0],
        },
        "long": {"first": one, "last": one},
        "side by side": {"ticks": 300_000, "1": [200.0, 210.0], "2": [100.0, 100.0]},
    }  # fmt: skip
    text = sweeps.table(results)
    assert "| a run of a sweep beyond that, no series | 2.50 ms | 2.00 – 3.00 |" in text
    assert "| last twentieth | 100 | 1.50 ms | 200 MB | 300 MB | 9 |" in text
    assert "| times as fast with two | 2.05 | 2.00 – 2.10 |" in text
