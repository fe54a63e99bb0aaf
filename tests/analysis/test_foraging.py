"""The comparison of foraging robots: its trainings, its table, and the steps of figure 8.3."""

import csv
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.experiments.studies import studies_in
from socialmind.experiments.trainings.plans import most_ticks
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "foraging"
TRAININGS = load_file(FOLDER / "trainings.py")
COMPARISON = load_file(FOLDER / "comparison.py")
STEPS = load_file(FOLDER / "steps.py")


def lessons(name):
    return {lesson.name: lesson for lesson in TRAININGS.PLANS[name].curriculum().lessons}


def test_its_studies_are_found():
    assert [one.name for one in studies_in(FOLDER)] == ["foraging-table", "figure-8.3"]


# Trainings ----------------------------------------------------------------------------------------


def test_a_small_training_has_short_episodes_and_few_of_them():
    plan = TRAININGS.PLANS["foraging"].small(**TRAININGS.PLANS.small)
    taught = plan.curriculum().lessons
    assert [one.name for one in taught] == list(lessons("foraging"))
    assert all(one.episode_ticks <= 2000 for one in taught)
    assert sum(map(most_ticks, taught)) < 2_000_000


@pytest.mark.parametrize(("name", "parameter"), [("deaf", "hearing"), ("blind", "company")])
def test_what_is_taken_away_is_missing_in_all_lessons_of_the_group(name, parameter):
    taught = lessons(name)
    assert list(taught) == list(lessons("foraging"))
    for title, lesson in taught.items():
        before = dict(lessons("foraging")[title].parameters)
        own = {} if title == "ReachSignal" else {parameter: 0.0}
        assert dict(lesson.parameters) == before | own
        assert lesson.skills == lessons("foraging")[title].skills


def test_who_walks_at_random_learns_all_but_search():
    taught = lessons("random")
    assert list(taught) == ["ReachSignal", "Search+Avoid", "Forage", "All in context"]
    assert not any("Search" in lesson.skills for lesson in taught.values())
    mind = TRAININGS.PLANS["random"].mind()
    assert mind.skills["Search"].genome_size == 0
    assert [str(one) for one in mind.skills["Search"].inputs] == ["SE:NOISE"]


class Finished:
    """A training of three attempts, of which the second did best."""

    lessons = pd.DataFrame(
        {
            "attempt": [1, 1, 2, 2, 3, 3],
            "lesson": ["Forage", "All in context"] * 3,
            "score": [9.0, 2.0, 1.0, 3.0, 1.0, 3.0],
        }
    )


def test_the_best_attempt_is_that_of_the_last_lessons_finals():
    assert TRAININGS.best_of(Finished()) == 2


# The table ----------------------------------------------------------------------------------------


def result(condition, more=0.0):
    """Return twenty worlds, in which a condition comes to so much more than the first one."""
    draws = np.random.default_rng(3).random(20)
    whole = pd.DataFrame(
        {"objects": 10 * draws + more, "first_find": 1000 * draws, "collisions": draws}
    )
    return COMPARISON.Result(condition, whole, pd.DataFrame({"area": draws / 2}))


def test_the_table_has_means_and_differences_world_by_world(tmp_path):
    first, second, third = COMPARISON.CONDITIONS[:3]
    results = [(first, result(first)), (second, result(second, -2.0)), (third, None)]
    page, numbers = COMPARISON.write_table(results, ["Said above."], tmp_path)
    text = page.read_text("utf-8")
    assert "Said above." in text
    # Where all worlds differ by the same, the interval has no width.
    assert "| no signals | -2.0 (-2.0 … -2.0) | 0 (0 … 0) |" in text
    assert "| no signals, learned without | not trained | not trained |" in text
    with numbers.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4 + 8
    compared = [row for row in rows if row["compared"] and row["measure"] == "objects"]
    assert [(row["robots"], float(row["mean"])) for row in compared] == [("no signals", -2.0)]
    area = next(row for row in rows if row["measure"] == "area")
    assert float(area["mean"]) == pytest.approx(
        50 * np.random.default_rng(3).random(20).mean(), 1e-3
    )
    figure = COMPARISON.draw(results)
    assert [len(axes.lines) for axes in figure.axes] == [4] * 4


def test_every_measure_of_the_table_is_one_of_the_model():
    names = {one.name for one in COMPARISON.MEASURED}
    assert names == set(COMPARISON.load_model("foraging").measures)


# Figure 8.3 ---------------------------------------------------------------------------------------


def records(*stretches):
    """Return what a robot senses: so many moments of each combination of sensors."""
    found, tick = [], 0
    for moments, on in stretches:
        for _ in range(moments):
            tick += STEPS.EVERY
            found.append((tick, {name: name in on for name in ("ACTOBJ", "ACTSIG", "HOLDS")}))
    return found


def test_the_steps_are_the_thesiss():
    told = records(
        (40, ()), (10, ("ACTOBJ",)), (5, ("ACTOBJ", "HOLDS")), (30, ("HOLDS",)), (5, ()),
        (60, ("ACTSIG",)), (3, ("ACTSIG", "ACTOBJ")),
    )  # fmt: skip
    assert STEPS._steps_of(told) == (105, 205, 255, 280, 430, 555, 655, 755)
    assert len(STEPS.TOLD) == 8


@pytest.mark.parametrize("length", range(6))
def test_a_robot_that_does_not_come_back_has_no_steps(length):
    whole = [(40, ()), (10, ("ACTOBJ",)), (5, ("ACTOBJ", "HOLDS")), (30, ("HOLDS",)), (5, ())]
    assert STEPS._steps_of(records(*whole[:length])) is None
