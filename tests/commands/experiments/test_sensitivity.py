"""`socialmind sensitivity`: what it prints and writes, and what it refuses."""

from pathlib import Path

import pandas as pd
import pytest

QUICK = (
    "--measure",
    "energy=mean(agents.energy)",
    "--ticks",
    10,
    "--interpreted",
    "--workers",
    1,
    "--every",
    0,
    "--quiet",
)
RANGES = ("--ranges", "n_grazers=2:9", "--ranges", "regrowth=0.01:0.2")


@pytest.fixture(scope="module")
def swept(socialmind, grazers, tmp_path_factory):
    """Sweep the model that `new` writes over a design; gives the folder."""

    def over(*words):
        out = tmp_path_factory.mktemp("swept") / "sweep"
        result = socialmind("sweep", grazers, *words, *QUICK, "--out", out)
        assert result.exit_code == 0, result.output
        return out

    return over


def test_tables_a_figure_and_a_sentence(socialmind, swept):
    folder = swept("--sample", "saltelli:8", *RANGES, "--seeds", "0:2")
    result = socialmind("sensitivity", folder)
    assert result.exit_code == 0, result.output
    assert result.stderr == ""
    lines = result.stdout.splitlines()
    names = ["indices.csv", "luck.csv", "sensitivity.txt", "sensitivity.pdf", "sensitivity.png"]
    assert lines[-5:] == [str(folder / "sensitivity" / name) for name in names]
    assert "48 points (saltelli), 96 runs, mean " in lines[0]
    assert lines[1].startswith("luck: ") and "of the variance of single runs" in lines[1]
    assert any(line.startswith("parameter") and "total order" in line for line in lines)
    assert any(line.startswith("Sobol indices share out the variance") for line in lines)
    assert "Ranges: n_grazers 2 … 9, regrowth 0.01 … 0.2." in lines
    assert "8 blocks alone: the intervals are rough, 16 or more would do." in lines
    told = (folder / "sensitivity" / "sensitivity.txt").read_text("utf-8")
    assert told.splitlines() == lines[:-5]
    table = pd.read_csv(folder / "sensitivity" / "indices.csv")
    assert list(table) == ["output", "index", "parameter", "other", "value", "low", "high"]
    again = socialmind("sensitivity", folder, "--out", "again", "--quiet")
    assert again.stdout.splitlines() == [f"again/{name}" for name in names]
    for name in names[:-1]:
        assert (folder / "sensitivity" / name).read_bytes() == Path("again", name).read_bytes()


def test_what_is_asked_for(socialmind, swept, tmp_path):
    folder = swept("--sample", "morris:4", *RANGES)
    words = ("--of", "energy", "--unit", "energy=food", "--level", 0.9, "--seed", 3)
    result = socialmind("sensitivity", folder, *words, "--out", tmp_path / "s")
    assert result.exit_code == 0, result.output
    assert "Morris's design screens" in result.stdout and "mu*" in result.stdout
    assert set(pd.read_csv(tmp_path / "s" / "indices.csv")["output"]) == {"energy"}
    result = socialmind("sensitivity", folder, "--regression", "--out", tmp_path / "r")
    assert "R² of the line" in result.stdout


def test_what_is_refused_stands_in_a_line(socialmind, refused, swept, tmp_path):
    folder = swept("--sample", "lhs:8", *RANGES)
    assert "did you mean 'energy'" in refused("sensitivity", folder, "--of", "enrgy")
    assert refused("sensitivity", folder, "--level", 2).endswith("a number between 0 and 1")
    assert "expected NAME=VALUE" in refused("sensitivity", folder, "--unit", "food")
    assert "unit of food" in refused("sensitivity", folder, "--unit", "food=kg")
    assert refused("sensitivity", tmp_path / "nowhere")
    assert not (folder / "sensitivity").exists()
