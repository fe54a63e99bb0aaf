"""`socialmind branch`, `compare`, and `run --shock`."""

import json
from pathlib import Path

import pytest

from socialmind.experiments import Run

PLAGUE = """
def strike(society):
    society.grazers.energy = 0.5

def wrong(society):
    society.grazers.enrgy = 0.5
"""


@pytest.fixture
def plague(tmp_path):
    file = tmp_path / "plague.py"
    file.write_text(PLAGUE)
    return file


def test_a_branch_and_its_comparison(socialmind, done, plague):
    words = ("branch", done, "--at", 20, "--set", "n_grazers=3", "--set", "start.Hunger=1")
    result = socialmind(*words, "--do", f"{plague}:strike", "--ticks", 50, "--out", "b")
    assert result.exit_code == 0, result.output
    assert result.stdout == f"{Path('b').absolute()}\n"
    assert Run("b").ticks == 50
    assert socialmind("replay", "b").stdout == "equal\n"
    result = socialmind("compare", done, "b", "--out", "both")
    assert result.exit_code == 0, result.output
    assert result.stdout.startswith("at tick 40, differences in pairs of equal seeds:\n")
    names = {"comparison.csv", "comparison.pdf", "comparison.png", "comparison.svg"}
    assert {path.name for path in Path("both").iterdir()} == names
    columns = Path("both/comparison.csv").read_text().partition("\n")[0]
    assert columns.startswith("column,group,tick,runs,mean,low,high,difference,")


def test_groups_of_runs_are_compared(socialmind, grazers, plague):
    for seed in (1, 2, 3):
        words = ("run", grazers, "--ticks", 12, "--seed", seed, "--interpreted", "--quiet")
        assert socialmind(*words, "--out", f"a{seed}").exit_code == 0
        assert socialmind("branch", f"a{seed}", "--at", 5, "--do", f"{plague}:strike",
                          "--out", f"b{seed}").exit_code == 0  # fmt: skip
    result = socialmind("compare", "b1", "b2", "b3", "--against", "a3", "--against", "a1",
                        "--against", "a2", "--quiet")  # fmt: skip
    assert result.exit_code == 0, result.output
    assert (Path("comparison") / "comparison.pdf").is_file()
    assert "a3 and 2 more" in Path("comparison/comparison.csv").read_text()


def test_shocks_of_a_run_are_kept(socialmind, grazers, plague):
    words = ("run", grazers, "--ticks", 12, "--interpreted", "--shock", f"5:{plague}:strike")
    assert socialmind(*words, "--shock", f"8:{plague}:strike", "--out", "r").exit_code == 0
    plague.unlink()
    assert socialmind("run", "--resume", "r", "--ticks", 15).exit_code == 0
    assert socialmind("replay", "r").stdout == "equal\n"
    manifest = json.loads(Path("r/manifest.json").read_text())
    assert [one["tick"] for one in manifest["interventions"]] == [5, 8]


def test_errors_are_one_line(refused, grazers, done, plague):
    run = ("run", grazers, "--ticks", 9, "--interpreted", "--quiet")
    line = refused(*run, "--shock", f"3:{plague}:wrong")
    assert f"{plague}:6: the shock wrong at tick 3: " in line
    assert "did you mean 'energy'" in line
    assert "expected TICK:FILE.py:FUNCTION" in refused(*run, "--shock", "strike")
    assert "--shock" in refused("run", "--resume", done, "--shock", f"3:{plague}:strike")
    assert "expected NAME=VALUE" in refused("branch", done, "--at", 3, "--set", "n_grazers")
    assert "one run alone" in refused("compare", done)
    assert "holds no manifest" in refused("branch", "..", "--at", 3)
