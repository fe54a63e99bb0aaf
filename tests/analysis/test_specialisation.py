"""The comparison of programmed and learned specialisation, on tiny worlds and made-up numbers."""

import re
import shutil
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.measures import crossed, intervals
from socialmind.experiments.studies import studies_in
from socialmind.learning import Training
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "specialisation"
making = load_file(FOLDER / "making.py")
PACKAGE = making.__name__
budgets, claims, farmers, page_module, report, runs, societies, tables, worlds = (
    sys.modules[f"{PACKAGE}.{name}"]
    for name in (
        "budgets",
        "claims",
        "farmers",
        "page",
        "report",
        "runs",
        "societies",
        "tables",
        "worlds",
    )
)
RESAMPLES = 200  # enough to see that intervals are the same
TINY = societies.Size(2, 2, 2000, 2, (3,), 2, 2, 1500)
COMMAND = "socialmind reproduce specialisation --quick"
PARTS = ("summary", "attempts", *societies.CONDITIONS, "mixed", "farmers", "limits")


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """A folder in which a tiny study was made."""
    folder = tmp_path_factory.mktemp("study")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(intervals, "RESAMPLES", RESAMPLES)
        patch.setattr(crossed, "RESAMPLES", RESAMPLES)
        making.make(folder, TINY, COMMAND, workers=1)
    return folder


# All of it ----------------------------------------------------------------------------------------


def test_the_page_holds_all_that_it_shows(home):
    page = (home / "specialisation.html").read_text(encoding="utf-8")
    sources = re.findall(r'<img [^>]*src="([^"]{0,30})', page)
    assert len(sources) == 8
    assert all(source.startswith("data:image/svg+xml,") for source in sources)
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
        "attempts",
        "course",
        "robots",
        "measures",
        "mixed",
        "farmers",
        "schemes",
    }


def test_a_small_study_draws_no_conclusions(home):
    page = (home / "specialisation.html").read_text(encoding="utf-8")
    assert "It draws no conclusions" in page
    for part in PARTS:
        for claim in claims.claims_of(part):
            assert claim.text[:40] not in page


def test_tables_are_tidy_and_worlds_are_paired(home):
    made = home / "specialisation"
    table = pd.read_csv(made / "worlds.csv")
    assert {*tables.RUN, *tables.MEASURED} <= set(table.columns)
    pure = table[table["society"] != "mixed"]
    seeds = pure.groupby(["society", "attempt", "condition"])["seed"].apply(tuple)
    learned = [one for one in societies.SOCIETIES.values() if one.lesson]
    assert len(seeds) == len(societies.CONDITIONS) * (len(societies.SOCIETIES) + len(learned))
    assert set(seeds) == {(societies.SEED, societies.SEED + 1)}
    assert set(table.loc[table["society"] == "mixed", "share"].round(3)) == {0.333}
    each = pd.read_csv(made / "attempts.csv")
    assert len(each) == len(seeds)
    # Until half-time nothing is known of the shock.
    course = pd.read_csv(made / "course.csv")
    before = course[course["tick"] < TINY.half]
    assert before.groupby(["society", "tick"])["distance"].nunique().eq(1).all()
    kinds = pd.read_csv(made / "mixed-kinds.csv")
    assert set(kinds["kind"]) == {"programmed", "learned"}
    robots = pd.read_csv(made / "robots.csv")
    assert list(robots.columns[-5:]) == ["agent", "since", "until", "role", "programmed"]
    assert robots[robots["society"] == "programmed"]["programmed"].all()


def test_the_same_is_made_twice(home, tmp_path, monkeypatch):
    monkeypatch.setattr(intervals, "RESAMPLES", RESAMPLES)
    monkeypatch.setattr(crossed, "RESAMPLES", RESAMPLES)
    cells = runs.cells_of(TINY)
    for again in (cells[0], cells[-1]):
        runs.run([again], TINY, tmp_path, workers=1)
    kept = [one for one in sorted(tmp_path.rglob("*")) if one.is_file()]
    assert len(kept) == 2 * len(runs.TABLES)
    worlds_home = home / "specialisation-worlds"
    for one in kept:
        assert one.read_bytes() == (worlds_home / one.relative_to(tmp_path)).read_bytes()
    records = runs.run(cells, TINY, worlds_home, workers=1)
    made = tmp_path / "specialisation"
    village = farmers.found(TINY, made, workers=1)
    for name, table in report.tables_of(records, village, TINY).items():
        assert len(table) == len(pd.read_csv(home / "specialisation" / f"{name}.csv"))


def test_the_page_is_made_of_the_tables_beside_it(home, tmp_path):
    for one in (home / "specialisation").glob("*.[cy]*"):
        (tmp_path / "specialisation").mkdir(exist_ok=True)
        shutil.copy(one, tmp_path / "specialisation")
    making.show(tmp_path, TINY, COMMAND)
    names = {one.relative_to(home) for one in home.glob("specialisation*/*.*")}
    names = {one for one in names if one.parts[0] == "specialisation"} | {
        Path("specialisation.html")
    }
    for name in names:
        assert (tmp_path / name).read_bytes() == (home / name).read_bytes()


def test_what_is_kept_is_not_run_again(home, monkeypatch):
    monkeypatch.setattr(runs, "lived", None)
    cells = runs.cells_of(TINY)
    found = runs.run(cells, TINY, home / "specialisation-worlds", workers=1)
    assert len(found.worlds) == sum(cell.worlds * len(cell.conditions) for cell in cells)
    changed = replace(cells[0], parameters={"programmed": 0.5})
    assert runs.stamp(changed, TINY.ticks) != runs.stamp(cells[0], TINY.ticks)
    assert runs.stamp(cells[0], 2 * TINY.ticks) != runs.stamp(cells[0], TINY.ticks)
    first, second = [one for one in cells if one.society == "supervised"]
    assert runs.stamp(first, TINY.ticks) != runs.stamp(second, TINY.ticks)


def test_without_an_attempt_at_a_lesson_it_says_what_makes_it(monkeypatch):
    monkeypatch.setattr(runs.MINDS, "minds_of", lambda _: {})
    with pytest.raises(SocialmindError, match=r"role_trainings delivered_anew makes them"):
        runs.cells_of(TINY)


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
    model = worlds.RULES.ForagingByThresholds(seed=3, **parameters, **what.parameters(ticks // 2))
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


def runs_of(society, values, condition="calm"):
    """Runs with a value for each attempt and world, and within one robot where it is 1 or more."""
    return pd.DataFrame(
        [
            {"society": society, "attempt": attempt, "condition": condition, "seed": seed,
             **dict.fromkeys(tables.MEASURED, value), "within": float(value >= 1)}
            for attempt, several in enumerate(values, 1)
            for seed, value in enumerate(several)
        ]
    )  # fmt: skip


def test_means_are_over_attempts_and_worlds():
    table = runs_of("a", [[1, 2, 3], [3, 4, 5], [8, 9, 10]])
    row = tables.means(table, ["society"], ["changes"]).iloc[0]
    assert (row["mean"], row["least"], row["most"]) == (5, 2, 9)
    assert (row["attempts"], row["worlds"]) == (3, 3)
    assert row["low"] < 2.5
    assert row["high"] > 8
    one = tables.means(table[table["attempt"] == 1], ["society"], ["changes"]).iloc[0]
    assert one["high"] - one["low"] < row["high"] - row["low"]


def test_a_share_of_worlds_has_a_width_where_all_are_alike():
    row = tables.means(runs_of("a", [[1] * 20]), ["society"], ["within"]).iloc[0]
    assert (row["mean"], row["high"]) == (1, 1)
    assert row["low"] == pytest.approx(0.839, abs=1e-3)


def test_differences_are_in_equal_worlds():
    base = np.array([1, 5, 9, 2, 7, 3])
    reference = runs_of("programmed", [base.tolist()])
    above = runs_of("a", [(base + more).tolist() for more in (1.0, 1.2, 1.0, 1.2, 1.0, 1.2)])
    found = tables.differences(pd.concat([reference, above]))
    row = found[found["measure"] == "changes"].iloc[0]
    assert row["difference"] == pytest.approx(1.1)
    # The worlds differ by far more than the societies do, and that is gone.
    assert 0.7 < row["low"] < row["high"] < 1.5


def test_kinds_are_compared_within_their_society():
    rows = [
        {"condition": "calm", "attempt": attempt, "seed": seed, "share": share, "kind": kind,
         "changes": 10 * seed + attempt + (kind == "learned") * (1 + share)}
        for attempt in (1, 2) for seed in (1, 2, 3) for share in (0.25, 0.75)
        for kind in ("programmed", "learned")
    ]  # fmt: skip
    (found,) = tables.between_kinds(pd.DataFrame(rows), ["changes"]).to_dict("records")
    assert found["difference"] == pytest.approx(-1.5)


# What is said -------------------------------------------------------------------------------------


@pytest.fixture
def made_up(monkeypatch):
    """Tables in which the society `a` has 1 more than the programmed one, and `b` 2 more."""
    monkeypatch.setattr(tables, "COMPARED_WITH", (("b", "a"),))
    worlds = pd.concat(
        [
            runs_of("programmed", [[0.2, 0.4, 0.3]]),
            runs_of("a", [[1.2, 1.4, 1.3], [1.2, 1.4, 1.3]]),
            runs_of("b", [[2.2, 2.4, 2.3], [2.2, 2.4, 2.3]]),
        ]
    )
    return {
        "means": tables.means(worlds, ["society", "condition"], list(tables.MEASURED)),
        "differences": tables.differences(worlds),
    }


@pytest.mark.parametrize(
    ("check", "so"),
    [
        ("at least 0.3 changes programmed calm", True),
        ("at least 0.31 changes programmed calm", False),
        ("at most 0.31 changes programmed calm", True),
        ("worst at least 1.2 changes a calm", True),
        ("worst at least 1.4 changes a calm", False),
        ("worst at most 1.31 changes a calm", True),
        ("best at most 1.31 changes a calm", True),
        ("best at most 1.29 changes a calm", False),
        ("best at least 1.31 changes a calm", False),
        ("more changes a calm", True),
        ("less changes a calm", False),
        ("untold changes a calm", False),
        ("more changes b calm than a", True),
        ("untold changes b calm than a", False),
        ("unchecked", True),
    ],
)
def test_checks_hold_or_do_not(made_up, check, so):
    assert claims.holds(check, made_up) == so


def test_a_claim_has_its_numbers_and_says_where_it_does_not_hold(made_up):
    text = "{changes a calm}, {difference changes a calm}, {worst changes a calm}, {attempts a}"
    further = "{difference changes b calm than a}, {within a calm}"
    beside = claims.told(claims.Claim(("unchecked",), further), made_up)
    assert beside.text.startswith("1.00")
    assert beside.text.endswith(", 100 %")
    lacking = claims.told(claims.Claim(("unchecked",), "{lack changes a calm}"), made_up)
    assert lacking.text.startswith("−1.00")
    told = claims.told(claims.Claim(("more changes a calm",), text), made_up)
    assert told.holds
    assert told.text.startswith("1.30 (")
    assert told.text.endswith(", 1.30, 2")
    assert not claims.told(claims.Claim(("less changes a calm",), "x"), made_up).holds


def test_shares_that_may_be_below_a_bound_are_counted():
    shares = {"turned_reported": [1.0, 0.9, 0.875], "removed_reported": [0.8, 1.0, 0.95]}
    chosen = pd.DataFrame({"choice": "again", **shares})
    found = {"chosen": chosen, "means": tables.further(chosen, 40)}
    text = "{unsure 0.75 again} of {shares again}"
    # Of 36 of 40 the interval begins at 0.77, of 35 at 0.74.
    assert claims.told(claims.Claim(("unchecked",), text), found).text == "2 of 6"


@pytest.mark.parametrize(
    "wrong",
    [
        "changes a calm",
        "more changes",
        "more chang a calm",
        "more changes c calm",
        "more changes a calm than b",
    ],
)
def test_a_check_that_is_none_is_an_error(made_up, wrong):
    with pytest.raises(SocialmindError):
        claims.holds(wrong, made_up)


@pytest.mark.parametrize("part", PARTS)
def test_all_that_is_said_holds_of_the_kept_tables_and_stands_on_the_kept_page(part):
    kept = FOLDER / "results"
    found = {path.stem: pd.read_csv(path) for path in (kept / "specialisation").glob("*.csv")}
    said = [claims.told(claim, found) for claim in claims.claims_of(part)]
    assert said
    assert [one.text for one in said if not one.holds] == []
    page = (kept / "specialisation.html").read_text(encoding="utf-8")
    for one in said:
        assert page_module.html.bullets([one.text])[5:-6] in page


# Budgets ------------------------------------------------------------------------------------------


def test_an_attempt_that_had_several_trainings_had_the_ticks_of_all():
    table = budgets.budgets(societies.FULL).set_index("society")
    lessons = Training(budgets.FIRST.PLANS.kept / "like_bodies").lessons
    ticks = lessons.groupby("attempt")["ticks"].sum()
    own = budgets.FIRST.trainings_of(budgets.FIRST.read())
    each = [sum(ticks[one] for one in several) / 1e9 for several in own.values()]
    assert table.loc["chosen", ["least", "greatest"]].tolist() == [min(each), max(each)]
    assert table.loc["chosen", "trainings"] == sum(map(len, own.values())) > 10
    # Of the lesson as declared: individuals x worlds x generations, and the finals.
    assert table.loc["picked", "median"] == pytest.approx((40 * 16 * 300 + 20 * 256) * 6e4 / 1e9)
    assert table.loc["supervised", "median"] == table.loc["picked", "median"]


def test_a_small_study_tells_the_budget_of_its_own_attempts():
    table = budgets.budgets(TINY).set_index("society")
    assert table["attempts"].tolist() == [2, 2, 2, 2, 1, 2]
    assert (table["trainings"] >= table["attempts"]).all()
