"""`socialmind plot` and `replay`."""

import shutil
from pathlib import Path

import pytest

from socialmind.experiments import Run


def test_plot_draws_every_series_when_the_model_has_no_figures(socialmind, done):
    result = socialmind("plot", done)
    assert result.exit_code == 0, result.output
    assert result.stdout.split() == [
        str(done / f"figures/{name}.{suffix}")
        for name in ("series", "map")
        for suffix in ("pdf", "png")
    ]
    assert (done / "figures/series.pdf").read_bytes().startswith(b"%PDF")
    assert (done / "figures/series.png").read_bytes().startswith(b"\x89PNG")


FIGURES = """
from matplotlib import pyplot

def draw(run):
    pyplot.rcParams["lines.linewidth"] = 9
    figure, axes = pyplot.subplots()
    axes.plot(run.series["tick"], run.series["grazers"])
    return {"herd": figure}
"""


def with_figures(grazers, tmp_path, text):
    shutil.copytree(grazers, tmp_path / "drawn")
    (tmp_path / "drawn/figures.py").write_text(text)
    words = ("--ticks", 20, "--interpreted", "--figures", "--out", "out")
    return "run", "./drawn", *words


def test_a_models_own_figures_leave_no_trace_in_matplotlib(socialmind, grazers, tmp_path):
    import matplotlib as mpl
    from matplotlib import pyplot

    before = mpl.rcParams["lines.linewidth"]
    result = socialmind(*with_figures(grazers, tmp_path, FIGURES))
    assert result.exit_code == 0, result.output
    assert result.stdout == f"{tmp_path}/out\n"
    assert {p.name for p in Path("out/figures").iterdir()} == {"herd.pdf", "herd.png"}
    assert mpl.rcParams["lines.linewidth"] == before
    assert pyplot.get_fignums() == []
    (tmp_path / "drawn/figures.py").write_text(FIGURES.replace("herd", "flock"))
    assert "flock.pdf" in socialmind("plot", "out").stdout  # figures may change after the run
    assert socialmind("run", "--resume", "out", "--ticks", 25).exit_code == 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (FIGURES.replace("grazers", "cows"), "drawn/figures.py:7: draw(run) stopped with KeyError"),
        (FIGURES.replace('{"herd": figure}', "figure"), "draw(run) giving Figure; expected a dict"),
        (FIGURES.replace('"herd"', '"../herd"'), "draw(run) giving '../herd'"),
        ("x = 1", "no function draw(run)"),
        ("x = ", "figures.py:1: not valid Python"),
    ],
)
def test_figures_that_fail_are_named(socialmind, grazers, tmp_path, text, message):
    assert message in socialmind(*with_figures(grazers, tmp_path, text)).stderr
    assert Run("out").manifest.status == "finished"


def test_replay_says_equal_or_what_differs(socialmind, done, tmp_path):
    result = socialmind("replay", done)
    assert (result.exit_code, result.stdout) == (0, "equal\n")
    import pandas as pd

    shutil.copytree(done, tmp_path / "altered")
    table = pd.read_parquet("altered/agents.parquet")
    table.loc[(table["tick"] == 20) & (table["agent"] == 1), "energy"] = 99.0
    table.to_parquet("altered/agents.parquet")
    result = socialmind("replay", "altered")
    assert result.exit_code == 1
    first, second = result.stdout.splitlines()
    assert first == "different: agents: agents.parquet is not the table that the run wrote"
    assert "column energy first differs at tick 20, agent 1: 99.0 in the run" in second
