"""`socialmind plot` and `compare` of sweeps: files, words, what is refused."""

import pandas as pd
import pytest

QUICK = ("--ticks", 10, "--interpreted", "--workers", 1, "--every", 5, "--quiet")


@pytest.fixture(scope="module")
def swept(socialmind, grazers, tmp_path_factory):
    out = tmp_path_factory.mktemp("swept") / "sweep"
    words = ("--grid", "n_grazers=3,5", "--seeds", "0:3", "--measure", "end=last(tick)")
    result = socialmind("sweep", grazers, *words, *QUICK, "--out", out)
    assert result.exit_code == 0, result.output
    return out


def test_a_sweep_is_drawn_into_its_folder(socialmind, swept):
    result = socialmind("plot", swept, "--format", "pdf,svg,png")
    assert result.exit_code == 0, result.output
    written = result.stdout.split()
    names = {path.rpartition("/")[2] for path in written}
    assert {f"response-end.{form}" for form in ("pdf", "svg", "png")} <= names
    assert (swept / "figures" / "effects-end.pdf").stat().st_size > 1000
    assert "response-end: Means, 95 % intervals by Student's t; 3 runs a point." in result.stderr


def test_options_choose_what_is_drawn_and_where(socialmind, swept, tmp_path):
    result = socialmind(
        "plot", swept, "--of", "end", "--statistic", "median", "--interval", 0.8, "--width",
        "double", "--format", "svg", "--out", "drawn", "--label", "end=the last tick",
        "--unit", "end=ticks", "--no-captions", "--baseline", "n_grazers=5",
    )  # fmt: skip
    assert result.exit_code == 0, result.output
    text = (tmp_path / "drawn" / "response-end.svg").read_text()
    assert "the last tick (ticks)" in text and 'width="510' in text
    assert "Medians" not in text and "80 % of the runs" in result.stderr
    assert "effects are differences of means" in result.stderr
    assert "from n grazers 5" in result.stderr or "from grazers" in result.stderr
    again = socialmind("plot", swept, "--of", "end", "--format", "svg", "--out", "again", "--width",
                       "double", "--statistic", "median", "--interval", 0.8, "--label",
                       "end=the last tick", "--unit", "end=ticks", "--no-captions")  # fmt: skip
    assert again.exit_code == 0
    assert (tmp_path / "again" / "response-end.svg").read_text() == text


def test_what_has_no_unit_is_said(socialmind, swept, tmp_path):
    result = socialmind("plot", swept, "--out", "drawn", "--format", "png")
    assert "no unit is known of" in result.stderr and "=UNIT gives one" in result.stderr


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("--of nothing", "no measure or end of a series called 'nothing'"),
        ("--of ende", "did you mean 'end'?"),
        ("--statistic mode", "expected mean or median"),
        ("--interval 95", "expected above 0 and below 1, as 0.95"),
        ("--width wide", "expected column (85 mm), double (180 mm) or 60 … 400"),
        ("--format gif", "expected some of pdf,svg,png"),
        ("--baseline n_grazers=9", "no point with n_grazers = 9; values of n_grazers: 3, 5"),
        ("--baseline n_grazers", "--baseline n_grazers: expected NAME=…"),
    ],
)
def test_what_is_refused(refused, swept, words, said):
    assert said in refused("plot", swept, *words.split(), "--out", "drawn")


def test_a_run_has_its_model_s_figures_and_no_options(socialmind, refused, done, tmp_path):
    assert socialmind("plot", done).exit_code == 0
    assert "--of, --width: for sweeps" in refused("plot", done, "--of", "end", "--width", "double")
    assert "no such folder" in refused("plot", tmp_path / "none")
    assert "holds no manifest.json" in refused("plot", tmp_path)


def test_sweeps_are_compared(socialmind, refused, swept, done, grazers, tmp_path):
    words = ("--grid", "n_grazers=5,3", "--seeds", "0:3", "--measure", "end=2 * last(tick)")
    assert socialmind("sweep", grazers, *words, *QUICK, "--out", "other").exit_code == 0
    result = socialmind("compare", swept, "other", "--out", "beside")
    assert result.exit_code == 0, result.output
    table = pd.read_csv(tmp_path / "beside" / "comparison.csv")
    assert table.loc[table["sweep"] == "other", "difference"].tolist() == [10.0, 10.0]
    assert (tmp_path / "beside" / "comparison-end.svg").is_file()
    assert "+10" in result.stdout
    assert "sweeps are compared with sweeps" in refused("compare", swept, done)
    assert "leave out --against" in refused("compare", swept, "other", "--against", "other")
    assert "stands twice" in refused("compare", swept, swept)
