"""The study of calibration: what its page says is what its kept tables hold."""

from pathlib import Path

import pandas as pd
import pytest

from socialmind.experiments.calibration.reporting import identifying
from socialmind.experiments.studies import find
from socialmind.sources.loading import load_file

TOPIC = Path(__file__).parents[2] / "analysis" / "calibration"


@pytest.fixture(scope="module")
def kept():
    recovery = pd.read_csv(TOPIC / "results" / "weights-recovery.csv")
    return pd.read_csv(TOPIC / "results" / "weights.csv").set_index("parameter"), recovery


def test_its_page_says_what_its_tables_hold(kept):
    table, recovery = kept
    page = (TOPIC / "README.md").read_text("utf-8").replace("−", "-")
    first, second = page.split("## Four methods")
    rows = [line.split("|") for line in first.splitlines() if line.startswith("| `")]
    assert len(rows) == len(table) == 6
    for _, name, known, found, _, missed, verdict, _ in rows:
        row = table.loc[name.strip().strip("`")]
        assert float(known) == row["known"]
        assert float(found) == pytest.approx(row["found"], rel=0.02)
        assert int(missed.split("%")[0]) == round(100 * row["error"])
        assert verdict.strip() == row["verdict"]
    assert recovery["covers"].all() and len(recovery) == 48
    inside = (table["low"] <= table["known"]) & (table["known"] <= table["high"])
    assert inside.sum() == 5
    methods = pd.read_csv(TOPIC / "results" / "methods-recovery.csv")
    for name, some in methods.groupby("method"):
        assert f"| `{name}` |" in second and f"{some['covers'].sum()} of {len(some)} |" in second


def test_its_verdicts_follow_from_its_recoveries(kept):
    table, recovery = kept
    summary = identifying.summary(recovery).set_index("parameter")
    assert summary["verdict"].to_dict() == table["verdict"].to_dict()
    ((one, other, both),) = identifying.combinations(recovery)
    assert {one, other} == {
        "reinforcement.Farmer.TradeWheatForTools", "reinforcement.Farmer.TradeToolsForWheat",
    }  # fmt: skip
    assert both == pytest.approx(-0.89, abs=0.005)


def test_each_recovery_of_a_method_is_a_dot():
    recoveries = pd.read_csv(TOPIC / "results" / "methods-recovery.csv")
    panels = load_file(TOPIC / "page.py").draw_methods(recoveries).axes
    assert len(panels) == 2 and panels[0].get_ylim() == panels[1].get_ylim()
    for axes in panels:
        dots = [line for line in axes.lines if line.get_marker() == "o"]
        assert [len(line.get_ydata()) for line in dots] == [6] * 4


@pytest.mark.study
def test_small_versions_can_be_made(tmp_path):
    for study, _ in find("calibration"):
        assert all(path.stat().st_size > 0 for path in study.quick(tmp_path))
