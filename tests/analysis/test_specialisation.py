"""The comparison of programmed and learned specialisation, on tiny worlds and made-up numbers."""

import re
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.measures import intervals
from socialmind.experiments.studies import studies_in
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "specialisation"
making = load_file(FOLDER / "making.py")
PACKAGE = making.__name__
farmers, page_module, report, runs, societies, tables, worlds = (
    sys.modules[f"{PACKAGE}.{name}"]
    for name in ("farmers", "page", "report", "runs", "societies", "tables", "worlds")
)
RESAMPLES = 200  # enough to see that intervals are the same
TINY = societies.Size(2, 2000, (0.0, 1 / 3, 1.0), 2, 1500)
COMMAND = "socialmind reproduce specialisation --quick"


@pytest.fixture(scope="module")
def thesis():
    trainings = load_file(FOLDER.parent / "foraging_roles" / "trainings.py")
    size = trainings.mind_of("thesis").skill("ForageRole").genome_size
    return np.random.default_rng(1).normal(size=size).tolist()


@pytest.fixture(scope="module")
def home(tmp_path_factory, thesis):
    """A folder in which a tiny study was made."""
    folder = tmp_path_factory.mktemp("study")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(making, "thesis_weights", lambda *_: thesis)
        patch.setattr(intervals, "RESAMPLES", RESAMPLES)
        making.make(folder, TINY, COMMAND, workers=1)
    return folder


# All of it ----------------------------------------------------------------------------------------


def test_the_page_holds_all_that_it_shows(home):
    page = (home / "specialisation.html").read_text(encoding="utf-8")
    sources = re.findall(r'<img [^>]*src="([^"]{0,30})', page)
    assert len(sources) == 7
    assert all(source.startswith("data:image/svg+xml;base64,") for source in sources)
    assert not re.search(r'(?:src|href)="(?!data:|#)', page)
    assert "http" not in re.sub(r'src="data:[^"]*"', "", page)
    assert "<script" not in page
    assert COMMAND in page
    assert "nan" not in re.sub(r'src="data:[^"]*"', "", page).lower().split()
    for name in ("socialmind", "NumPy", "numba"):
        assert re.search(rf"{name} \d", page)


def test_every_figure_is_a_file_too(home):
    names = {path.stem for path in (home / "specialisation").glob("*.pdf")}
    assert names == {
        "programmed",
        "course",
        "robots",
        "measures",
        "mixed",
        "farmers",
        "schemes",
    }


def test_tables_are_tidy_and_worlds_are_paired(home):
    made = home / "specialisation"
    table = pd.read_csv(made / "worlds.csv")
    assert {"society", "condition", "share", "seed", *tables.MEASURED} <= set(table.columns)
    pure = table[table["society"] != "mixed"]
    seeds = pure.groupby(["society", "condition"])["seed"].apply(tuple)
    assert len(seeds) == len(societies.SOCIETIES) * len(societies.CONDITIONS)
    assert set(seeds) == {(societies.SEED, societies.SEED + 1)}
    assert set(table.loc[table["society"] == "mixed", "share"].round(3)) == {0.333}
    # Until half-time nothing is known of the shock.
    course = pd.read_csv(made / "course.csv")
    course = course[course["measure"] == "distance"]
    before = course[course["tick"] < TINY.half]
    assert before.groupby(["society", "tick"])["mean"].nunique().eq(1).all()
    fixed = course[(course["society"] == "fixed") & (course["tick"] >= TINY.half)]
    assert fixed[fixed["condition"] == "undisturbed"]["mean"].lt(1e-9).all()
    assert fixed[fixed["condition"] == "turned"]["mean"].between(2.99, 3.01).all()
    kinds = pd.read_csv(made / "mixed-kinds.csv")
    assert set(kinds["kind"]) == {"programmed", "learned"}
    robots = pd.read_csv(made / "robots.csv")
    assert list(robots.columns[-5:]) == ["agent", "since", "until", "role", "programmed"]
    assert robots[robots["society"] == "programmed"]["programmed"].all()


def test_the_same_is_made_twice(home, thesis, tmp_path, monkeypatch):
    monkeypatch.setattr(intervals, "RESAMPLES", RESAMPLES)
    cells = runs.cells_of(TINY, thesis)
    for again in (cells[0], cells[5]):
        runs.run([again], TINY, tmp_path, workers=1)
    kept = [one for one in sorted(tmp_path.rglob("*")) if one.is_file()]
    assert len(kept) == 2 * len(runs.TABLES)
    worlds_home = home / "specialisation-worlds"
    for one in kept:
        assert one.read_bytes() == (worlds_home / one.relative_to(tmp_path)).read_bytes()
    records = runs.run(cells, TINY, worlds_home, workers=1)
    village = farmers.found(TINY, tmp_path, workers=1)
    page = report.made(records, village, TINY, COMMAND).page
    assert page == (home / "specialisation.html").read_text(encoding="utf-8")


def test_what_is_kept_is_not_run_again(home, thesis, monkeypatch):
    monkeypatch.setattr(runs, "lived", None)
    cells = runs.cells_of(TINY, thesis)
    found = runs.run(cells, TINY, home / "specialisation-worlds", workers=1)
    assert len(found.worlds) == 2 * sum(len(cell.conditions) for cell in cells)
    changed = runs.Cell("programmed", 1.0, cells[0].conditions, {"programmed": 0.5})
    assert runs.stamp(changed, TINY.ticks) != runs.stamp(cells[0], TINY.ticks)
    assert runs.stamp(cells[0], 2 * TINY.ticks) != runs.stamp(cells[0], TINY.ticks)


def test_without_the_thesis_s_mind_it_says_what_makes_it(monkeypatch, tmp_path):
    others = load_file(FOLDER.parent / "foraging_roles" / "trainings.py")
    results = load_file(FOLDER.parent / "foraging_roles" / "results.py")
    monkeypatch.setattr(others, "kept", dict)
    monkeypatch.setattr(results, "kept", dict)
    with pytest.raises(SocialmindError, match=r"foraging_roles\.trainings thesis makes it"):
        making.thesis_weights(tmp_path, train_small=False)


def test_there_is_a_quick_one():
    (study,) = studies_in(FOLDER)
    assert study.name == "specialisation"
    assert study.quick is not None


# One world ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("condition", ["turned", "added"])
def test_what_goes_on_from_half_time_is_what_would_have_come_of_it(condition):
    parameters, ticks = {"programmed": 0.5}, 2000
    what = societies.CONDITIONS[condition]
    found = worlds.lived(["undisturbed", condition], 3, ticks, parameters)
    model = worlds.load_model("foraging_roles")(seed=3, **parameters, **what.parameters(ticks // 2))
    alone = worlds.watched(model, range(0, ticks + 1, worlds.EVERY))
    expected = worlds.looked_at(alone, what, ticks // 2)
    for table, rows in found.items():
        own = [row for row in rows if row["condition"] == condition]
        assert own == [{"condition": condition, "seed": 3, **row} for row in expected[table]]


def seen(rows):
    return pd.DataFrame(rows, columns=["tick", "agent", "role", "programmed", "a", "b"])


def test_deliveries_of_those_who_come_and_go():
    table = seen(
        [
            (0, 0, "A", True, 0, 0), (0, 1, "B", False, 0, 0),
            (100, 0, "A", True, 1, 0), (100, 1, "B", False, 0, 0),
            (200, 1, "B", False, 0, 2), (200, 2, "A", True, 1, 0),
        ]
    )  # fmt: skip
    found = worlds.deliveries(table)
    assert found.to_dict("split")["data"] == [
        [100, 0, "A", 1], [200, 1, "B", 2], [200, 2, "A", 1],
    ]  # fmt: skip


def test_kinds_are_told_apart():
    table = seen(
        [(tick, agent, "AB"[(agent + tick // 100) % 2] if agent else "B", agent > 0, 0, tick // 100)
         for tick in (0, 100, 200, 300) for agent in (0, 1, 2)]
    )  # fmt: skip
    found = {row["kind"]: row for row in worlds.kinds(table, worlds.deliveries(table), 200)}
    assert found["learned"]["robots"] == 1
    assert found["programmed"]["robots"] == 2
    assert found["learned"]["changes"] == 0
    assert found["programmed"]["changes"] == pytest.approx(100)  # one in each 100 ticks
    assert found["learned"]["in_b"] == 1
    assert found["programmed"]["in_b"] == 0.5
    assert found["programmed"]["delivered"] == 3


def test_goods_in_the_ratio_are_counted_by_halves():
    tasks = pd.DataFrame(
        {"tick": [1, 2, 3, 51, 52, 53], "agent": 0, "task": list("ABBAAB"), "amount": 10}
    )
    turned, calm = (societies.CONDITIONS[one] for one in ("turned", "undisturbed"))
    assert worlds.in_ratio(tasks, turned, 50) == pytest.approx(60)
    assert worlds.in_ratio(tasks, calm, 50) == pytest.approx(30 + 15)


# Tables -------------------------------------------------------------------------------------------


def test_mixtures_beyond_both_kinds():
    rng = np.random.default_rng(0)
    rows = []
    for condition in societies.MIXED:
        for share in (0.0, 0.5, 1.0):
            for seed in range(8):
                worse = 5.0 if share == 0.5 and condition == "turned" else 0.0
                level = {name: rng.normal() / 10 for name in tables.OVER_SHARES}
                level["last_distance"] += worse
                rows.append({"condition": condition, "share": share, "seed": seed, **level})
    found = tables.beyond_both(pd.DataFrame(rows))
    assert found["turned", "last_distance"] == [(0.5, 1)]
    assert found["undisturbed", "last_distance"] == []
    slopes = tables.slopes(pd.DataFrame(rows), ["last_distance"])
    assert (slopes["low"] < 0).all()
    assert (slopes["high"] > 0).all()
    shown = page_module.beyond_table(found)
    assert "<td>ratio turned round</td><td>Distance</td><td>4</td><td>more</td>" in shown
    assert page_module.beyond_table({}) == ""


# What was found -----------------------------------------------------------------------------------


@pytest.mark.parametrize("section", ["summary", "mixed", "farmers", *societies.CONDITIONS])
def test_what_was_found_is_written_for_each_part_and_stands_on_the_kept_page(section):
    written = page_module.findings(section)
    assert written.count("<li>") >= 4
    assert written in (FOLDER / "results" / "specialisation.html").read_text(encoding="utf-8")


def test_effects_that_are_written_are_those_of_the_kept_tables():
    made = FOLDER / "results" / "specialisation"
    differences = pd.read_csv(made / "differences.csv")
    pairs = differences.query("society == 'programmed' and reference == 'learned'")
    for condition in societies.CONDITIONS:
        written = page_module.findings(condition)
        row = pairs.query(f"condition == '{condition}' and measure == 'changes'").iloc[0]
        low, high = row["difference_low"], row["difference_high"]
        told = f"(difference {row['difference']:.2f} ({low:.2f} to {high:.2f}); g {row['g']:.1f})"
        assert told.replace("-", "−") in written
