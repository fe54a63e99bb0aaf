"""`socialmind score`: its table, its JSON, and what it refuses."""

import json
import re
from pathlib import Path

import pytest

from socialmind.catalogue import load_model
from socialmind.experiments.scoring import Score, score

ROVERS = Path(__file__).parents[2] / "runs" / "rovers"


def test_json_is_all_that_goes_to_stdout(socialmind):
    result = socialmind("score", ROVERS, "--episodes", 4, "--seed", 2, "--json")
    assert (result.exit_code, result.stderr) == (0, "")
    assert json.loads(result.stdout) == score(load_model(ROVERS), episodes=4, seed=2).record()
    (line,) = result.stdout.splitlines()
    assert line.startswith('{"episodes": 4, "ticks": ')


def test_one_episode_has_no_interval(socialmind):
    words = ("--episodes", 1, "--workers", 1, "--on-collision", "continue")
    record = json.loads(socialmind("score", ROVERS, *words, "--json").stdout)
    assert record["survived"] == {"mean": 1.0, "low": None, "high": None}
    assert "–" in socialmind("score", ROVERS, *words).stdout


def test_the_table_has_a_row_for_each_measure(socialmind):
    result = socialmind("score", ROVERS, "--episodes", 6)
    assert result.exit_code == 0
    found: Score = score(load_model(ROVERS), episodes=6)
    assert "rovers, 6 episodes" in result.stdout and f"{found.ticks} ticks" in result.stdout
    for name, one in found.intervals.items():
        pattern = rf"{name} +{one.mean:.2f} +{one.low:.2f} … {one.high:.2f}"
        assert re.search(pattern, result.stdout)


def test_options_go_to_the_episodes(socialmind, tmp_path):
    model = load_model(ROVERS)
    model.populations["rovers"].hierarchy.save(tmp_path / "mind")
    words = (
        "--set", "half-width=30", "--ticks", 50, "--engine", "pymunk", "--mind", tmp_path / "mind",
    )  # fmt: skip
    result = socialmind("score", ROVERS, "--episodes", 2, "--workers", 1, *words, "--json")
    assert json.loads(result.stdout)["ticks"] == 100


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("boids",), "the model boids has no plane"),
        (("rover",), "no model called rover"),
        ((ROVERS, "--on-collision", "stop"), "'stop'; there is end, continue"),
        ((ROVERS, "--engine", "pymnk"), "did you mean 'pymunk'?"),
        ((ROVERS, "--set", "size=3"), "no parameter called size"),
        ((ROVERS, "--mind", "nowhere"), "nowhere: no such file or folder"),
    ],
)
def test_what_is_wrong_is_one_line(refused, words, said):
    assert said in refused("score", *words)
