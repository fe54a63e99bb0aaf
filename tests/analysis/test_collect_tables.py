"""Tables 6.1 to 6.3 and figures 6.2 to 6.5: the numbers, and what is made of them."""

import csv
import math
from dataclasses import replace
from importlib import import_module
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.experiments.trainings.plans import TrainingPlans, most_ticks
from socialmind.learning import Curriculum, Training
from socialmind.sources.loading import load_file

COLLECT = Path(__file__).parents[2] / "analysis" / "collect"
trainings = load_file(COLLECT / "trainings.py")
curricula = load_file(COLLECT / "curricula.py")
standings = load_file(COLLECT / "standings.py")
tables = load_file(COLLECT / "tables.py")
figures = load_file(COLLECT / "figures.py")
pages = load_file(COLLECT / "figure_pages.py")
studies = load_file(COLLECT / "studies.py")

MODULES = ("tables", "trainings", "standings")
OBJECTS = {1: (4.0, 6.0, 8.0), 2: (2.0, 2.0, 2.0)}
"""By attempt, in three worlds."""
SURVIVED = {1: (1.0, 0.5, 0.75), 2: (1.0, 1.0, 1.0)}


def made(structure, benchmark):
    rows = [
        {
            "attempt": attempt, "world": world, "collisions": 0,
            "objects": OBJECTS[attempt][world], "survived": SURVIVED[attempt][world],
        }
        for attempt, world in product(OBJECTS, range(3))
    ]  # fmt: skip
    return standings.Standing(structure, benchmark, pd.DataFrame(rows), {1: 0.5, 2: 0.7})


(TABLE,) = (one for one in tables.TABLES if one.name == "table-6.2")
ROW = next(one for one in TABLE.blocks[0].structures if one.name == "Avoid in context")
STANDING = made(ROW, tables.ENDS)


# Trainings -------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", trainings.PLANS)
def test_every_plan_teaches_what_its_mind_has(name):
    plan = trainings.PLANS[name]
    mind, curriculum = plan.mind(), plan.curriculum()
    for lesson in curriculum.lessons:
        assert set(lesson.skills) <= set(mind.below(lesson.master))
    main = name in ("hierarchy", "monolith", "base_skills", "hierarchy_level", "monolith_level")
    assert plan.attempts == (10 if main else 5)
    small = plan.small()
    assert small.attempts == 2
    assert small.seconds < 60
    assert [one.name for one in small.curriculum().lessons] == [
        one.name for one in curriculum.lessons
    ]


def test_structures_that_are_compared_learn_for_as_many_ticks():
    def budget(name, *left_out):
        lessons = trainings.PLANS[name].curriculum().lessons
        return {one.name: most_ticks(one) for one in lessons if one.name not in left_out}

    hierarchy, monolith = budget("hierarchy"), budget("monolith")
    context = hierarchy.pop(curricula.CONTEXT.name)
    assert monolith.pop(curricula.MORE) == context
    # The monolith's base lessons have its own optimiser's population, which is half as large.
    larger = {name for name in hierarchy if hierarchy[name] != monolith[name]}
    assert larger <= {"GoToObject", "GoToDropZone"}
    longer = budget("longer_avoid")
    assert longer["Avoid"] - hierarchy["Avoid"] > 0.9 * context - hierarchy["Avoid"]


def test_either_way_of_power_management_keeps_what_was_learned_but_the_old_master():
    known = trainings.power().known("collect_retrained")
    for variant, gone in (("encapsulated", set()), ("retrained", {"Collect"})):
        mind = trainings.power_mind(variant, "collect_retrained")
        assert set(known.skills) - set(mind.skills) == gone
        for name in set(known.skills) - gone:
            genome = known.skills[name].genome
            assert genome is None or (mind.skills[name].genome == genome).all()
        assert mind.below("CollectPower")


# Standings -------------------------------------------------------------------------------------


def test_attempts_and_worlds_are_units_each():
    attempts, worlds = STANDING.over_attempts("objects"), STANDING.over_worlds("objects")
    assert attempts.mean == worlds.mean == 4.0  # of 6 and 2; of 3, 4 and 5
    assert (STANDING.attempts, STANDING.worlds) == (2, 3)
    # Student's t: 12.706 times 2 of two attempts, 4.303 times 1 / √3 of three worlds.
    assert (attempts.low, attempts.high) == pytest.approx((4 - 25.412, 4 + 25.412), abs=0.01)
    assert (worlds.low, worlds.high) == pytest.approx((4 - 2.484, 4 + 2.484), abs=0.001)


def test_the_best_attempt_is_chosen_by_its_finals_and_not_by_the_benchmark():
    assert STANDING.best == 2
    found = STANDING.of_best("objects")
    assert (found.mean, found.low, found.high) == (2.0, 2.0, 2.0)
    assert [row["best"] for row in STANDING.by_attempt()] == [False, True]


def test_a_structure_without_training_has_no_attempts():
    none = standings.standing(None, ROW, tables.ENDS)
    assert (none.attempts, none.worlds, none.by_attempt()) == (0, 0, [])
    (objects, survived) = tables.rows_of(none, TABLE)
    assert (objects["thesis"], survived["thesis"]) == (6.03, 0.9)
    assert objects["mean"] == objects["best_high"] == objects["best_attempt"] == ""


# Tables ----------------------------------------------------------------------------------------


def test_ours_stand_beside_the_thesis(tmp_path):
    paths = tables.write_table(TABLE, [STANDING], ["Made by hand."], tmp_path)
    assert [path.name for path in paths] == [
        "table-6.2.md", "table-6.2.csv", "table-6.2-attempts.csv",
    ]  # fmt: skip
    text = paths[0].read_text()
    (line,) = (one for one in text.splitlines() if one.startswith("| Avoid in context"))
    cells = [one.strip() for one in line.split("|")[1:-1]]
    assert cells[1:3] == ["6.03 (90 %)", "2"]
    assert cells[3].startswith("4.00 [")
    assert "(88 % [" in cells[3]
    assert cells[5] == "2.00 [2.00 to 2.00] (100 % [100 to 100])"
    with paths[1].open() as file:
        objects, survived = csv.DictReader(file)
    assert (objects["thesis"], objects["mean"], objects["best_mean"]) == ("6.03", "4.0", "2.0")
    assert float(survived["mean"]) == pytest.approx(0.875)
    with paths[2].open() as file:
        first, second = csv.DictReader(file)
    assert (first["objects"], second["survived"], first["seed"]) == ("6.0", "1.0", "61")


def test_the_tables_hold_what_the_thesis_reports_and_trainings_that_there_are():
    reported = {
        (table.name, one.name, block.benchmark.title): one.thesis
        for table in tables.TABLES
        for block in table.blocks
        for one in block.structures
    }
    assert reported["table-6.1", "hierarchical, curriculum", "no interruption"]["objects"] == 9.55
    for table in tables.TABLES:
        for block in table.blocks:
            for one in block.structures:
                lessons = trainings.PLANS[one.plan].curriculum().lessons
                assert one.after in [lesson.name for lesson in lessons]
                assert set(one.thesis) <= set(block.measures)


def test_numbers_that_nobody_knows_are_dashes():
    alone = standings.interval_of([3.0])
    assert math.isnan(alone.low)
    assert tables._interval("objects", alone) == "3.00 [– to –]"


# Figures ---------------------------------------------------------------------------------------

FIGURE_63 = figures.FIGURES[1]
COMPLEX = ("GoToObject+Avoid", "GoToDropZone+Avoid")


def curve(values, lesson="GoToObject", attempt=1, **more):
    count = len(values)
    return pd.DataFrame(
        {
            "attempt": attempt, "lesson": lesson, "generation": np.arange(1, count + 1),
            "best": values, "mean": values, "ticks": 100 * np.arange(1, count + 1),
            "seconds": 1.0, **more,
        }
    )  # fmt: skip


class Kept:
    """A training as `Training` tells it."""

    def __init__(self, *curves):
        self.curve = pd.concat(curves, ignore_index=True)
        done = self.curve[["attempt", "lesson"]].drop_duplicates()
        self.lessons = done.assign(score=1.5, deviation=0.5)


def judged(given, **scores):
    """What the winners of trainings come to in the worlds that all share; 1.2 by default."""
    return {
        plan: {
            (attempt, lesson): scores.get(f"of_{attempt}", 1.2)
            for attempt, lesson in zip(one.lessons["attempt"], one.lessons["lesson"], strict=True)
        }
        for plan, one in given.items()
    }


def test_of_an_attempt_in_two_trainings_the_longest_curve_is_shown():
    short, long = curve([1.0, 2.0], "Avoid"), curve([1.0, 2.0, 3.0], "Avoid")
    other = curve([5.0, 6.0], "Avoid", attempt=2)
    given = {"hierarchy": Kept(short, other), "longer_avoid": Kept(long)}
    found = figures.curves_of(figures.FIGURES[1], given)
    assert list(found["best"]) == [1.0, 2.0, 3.0, 5.0, 6.0]
    rows = figures.attempts_of(found, given, judged(given))
    assert [row["training"] for row in rows] == ["longer_avoid", "hierarchy"]
    assert [row["generations"] for row in rows] == [3, 2]
    (line,) = pages.findings(rows)
    assert "2 attempts of 2 to 3 generations (1 of `longer_avoid`, 2 of `hierarchy`" in line
    assert "A dot is where an attempt's lesson ends" in " ".join(pages.caption(FIGURE_63, rows))


def test_when_an_attempt_is_near_its_end_is_judged_on_common_worlds():
    lucky = [9.0] + [4.0] * 199
    steady = np.concatenate([np.linspace(1.0, 3.9, 119), [3.9] * 80, [4.0]])
    own = curve(lucky, validated=steady)
    given = {"base_skills": Kept(own, curve([4.0] * 200, attempt=2, validated=4.0))}
    found = figures.curves_of(figures.FIGURES[0], given)
    rows = figures.attempts_of(found, given, judged(given))
    assert [row["judged"] for row in rows] == ["on common worlds"] * 2
    first = int(np.argmax(steady >= 0.95 * 3.905)) + 1  # the mean of the last twenty
    assert [row["near_end_from"] for row in rows] == [first, 1]
    assert first > 100
    (line,) = pages.findings(rows)
    assert "1 of 2 are within 5% of what they come to in the end by generation 100" in line
    assert "0 of 2 fell short" in line


def test_attempts_fall_short_by_the_worlds_that_all_share_and_not_by_their_own_finals():
    given = {"base_skills": Kept(*(curve([4.0], attempt=n) for n in range(3)))}
    given["base_skills"].lessons["score"] = [4.0, 2.9, 4.0]
    found = figures.curves_of(figures.FIGURES[0], given)
    shared = judged(given, of_0=4.0, of_1=4.0, of_2=2.9)
    rows = figures.attempts_of(found, given, shared)
    assert [(row["finals"], row["shared"]) for row in rows] == [(4.0, 4.0), (2.9, 4.0), (4.0, 2.9)]
    assert (
        "1 of 3 fell short (below 75% of the median, 4.00: attempt 2, 2.90)"
        in (pages.findings(rows)[0])
    )
    told = " ".join(pages.caption(figures.FIGURES[0], rows))
    assert "red where its winner fell short" in told
    assert "A dot" not in told  # all end alike


def test_budgets_that_are_not_the_thesiss_are_marked():
    figure = figures.FIGURES[1]
    row = {"lesson": "Avoid", "generations": 60, "ticks": 61_000_000}
    told = pages.budget(figure, [row, {**row, "generations": 206}])
    assert "Avoid 60 to 206 generations, up to 61 million ticks" in told
    assert "2,500 generations" in told
    assert "not equal" in told
    assert "not equal" not in pages.budget(figure, [{**row, "generations": 2500}])


def test_a_budget_is_all_that_led_to_what_is_judged():
    given = Kept(curve([1.0] * 3, "Avoid"), curve([1.0] * 2, "Collect"), curve([1.0] * 9, "More"))
    assert standings.spent_on(given, "Collect") == (5.0, 500 / 1e6)
    begun = Kept(curve([1.0] * 3, "Avoid"), curve([1.0] * 2, "Collect"),
                 curve([1.0] * 9, "Avoid", attempt=2))  # fmt: skip
    assert standings.spent_on(begun, "Collect") == (5.0, 500 / 1e6)
    assert math.isnan(standings.spent_on(None, "Collect")[0])


def test_a_figure_comes_with_its_numbers(tmp_path):
    lessons = ("GoToObject", "GoToDropZone")
    given = {"base_skills": Kept(*(curve([1.0, 2.0], one, validated=1.5) for one in lessons))}
    made = ["Made by hand."]
    written = pages.write_curves(figures.FIGURES[0], given, judged(given), made, tmp_path)
    assert [path.name.removeprefix("figure-6.2") for path in written] == [
        ".pdf", ".png", ".md", ".csv", "-attempts.csv",
    ]  # fmt: skip
    with (tmp_path / "figure-6.2.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [row["best"] for row in rows] == ["1", "2"] * 2
    assert "Thesis: most of 10 attempts" in (tmp_path / "figure-6.2.md").read_text()


def test_winners_of_lessons_without_a_panel_are_told_of_beside(tmp_path):
    given = {"hierarchy": Kept(*(curve([1.0, 2.0], one) for one in COMPLEX))}
    shared = judged(given)
    shared["hierarchy"][1, "Avoid"] = 40.5
    written = pages.write_curves(figures.FIGURES[2], given, shared, ["By hand."], tmp_path)
    assert written[-1].name == "figure-6.4-lessons.csv"
    assert written[-1].read_text().splitlines()[-1] == "hierarchy,1,Avoid,40.5"


# Studies ---------------------------------------------------------------------------------------


def test_there_is_a_study_for_each_with_a_small_and_a_kept_version():
    assert [one.name for one in studies.studies] == [
        "figure-6.2", "figure-6.3", "figure-6.4", "figure-6.5", "figure-6.5-equal-ticks",
        "table-6.1", "table-6.1-equal-ticks", "table-6.2", "table-6.3",
    ]  # fmt: skip
    assert all(one.quick and one.kept for one in studies.studies)
    made = {one.name for one in (*tables.TABLES, *figures.FIGURES)}
    assert made | {"figure-6.5-equal-ticks"} == {one.name for one in studies.studies}


def test_a_study_goes_from_training_to_table(tmp_path, monkeypatch):
    lesson = curricula.SIX[-1].changed(
        name="All at once", skill="Monolith", master="Monolith", ticks=30, generations=1,
        repetitions=1, finals=2, settings={"population": 4, "elite": 1},
    )  # fmt: skip
    plan = replace(
        trainings.PLANS["monolith_at_once"], attempts=2, curriculum=lambda: Curriculum((lesson,))
    )
    structure = tables.Structure("monolithic", "monolith_at_once", "All at once", {"objects": 0.3})
    # The modules that the study imports, beside its own.
    near = {one: import_module(f"{studies.__name__}.{one}") for one in MODULES}
    block = near["tables"].Block(near["tables"].ENDS, ("objects",), (structure,))
    table = near["tables"].Table("table-6.1", "one row", (block,))
    monkeypatch.setattr(near["tables"], "TABLES", (table,))
    plans = TrainingPlans(tmp_path, {"monolith_at_once": plan})
    monkeypatch.setattr(near["trainings"], "PLANS", plans)
    monkeypatch.setattr(near["standings"], "WORLDS", 2)
    (study,) = (one for one in studies.studies if one.name == "table-6.1")
    text, numbers, attempts = study.make(tmp_path)
    assert "2 attempts, trained from nothing, seed 6" in text.read_text()
    assert len(attempts.read_text().splitlines()) == 3
    assert Training(tmp_path / "trainings" / "monolith_at_once").manifest.finished == 2
    before = numbers.read_text()
    study.make(tmp_path)  # goes on with what is there
    assert numbers.read_text() == before
