"""The benchmark of the classics measures, counts lines and writes tables; Mesa keeps the rules."""

from __future__ import annotations

import importlib
import json
from pathlib import Path
from types import ModuleType

import pytest

FOLDER = Path(__file__).parents[2] / "benchmarks"


@pytest.fixture
def classics(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(FOLDER))
    return importlib.import_module("classics")


def test_a_short_benchmark_writes_its_results(classics: ModuleType, tmp_path: Path) -> None:
    results = classics.measure(seeds=3, mesa_seeds=2, birds=(50, 100), ticks=2)
    classics.write(results, classics.table, "classics", tmp_path)
    found = json.loads((tmp_path / "classics.json").read_text())
    assert len(found["seconds"]) == 6
    for runs in found["seconds"].values():
        assert [len(runs[name]) for name in ("ours", "mesa", "ratio")] == [3, 2, 2]
        assert runs["ratio"][0] == pytest.approx(runs["mesa"][0] / runs["ours"][0])
        assert min(runs["ours"]) > 0
    assert [len(values) for values in found["bird_nanoseconds"].values()] == [5, 5]
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    for title in ("wolves and sheep, small", "flocking, large", "Schelling, large"):
        assert f"| {title}, 2 steps |" in text


def test_lines_are_those_of_code(classics: ModuleType, tmp_path: Path) -> None:
    file = tmp_path / "model.py"
    file.write_text(
        '"""What it is.\n\nAnd more.\n"""\n\nimport math  # for tau\n\n\n# nothing\n'
        'def turn(\n    bird,\n):\n    """Turn."""\n    bird.angle = """\nnot a docstring"""\n\n'
        '\nclass Bird:\n    """A bird."""\n'
    )
    assert classics.lines_of(file) == 1 + 3 + 2 + 1


@pytest.mark.parametrize("name", ["wolves_sheep", "flocking", "schelling"])
def test_parameters_are_those_of_the_models(classics: ModuleType, name: str) -> None:
    classic, model = classics.CLASSICS[name], classics.load_model(name)
    small = classic.sizes["small"]
    assert small == {key: model.parameters[key].default for key in small}
    assert model(seed=1, **classic.sizes["large"]).parameter_values().items() >= (
        classic.sizes["large"].items()
    )


def test_mesa_plays_by_the_same_rules(classics: ModuleType) -> None:
    classic = classics.CLASSICS["schelling"]
    town = classic.mesa(classic.sizes["small"], 1)
    town.run(20)
    assert sum(agent.happy for agent in town.agents) > 980
    classic = classics.CLASSICS["wolves_sheep"]
    meadow = classic.mesa({**classic.sizes["small"], "regrowth": 1}, 1)
    meadow.run(30)
    counts = {kind.__name__: len(agents) for kind, agents in meadow.agents_by_type.items()}
    assert counts["GrassPatch"] == 625
    assert counts["RoamingWolf"] > 40
