"""The comparison of foraging robots: its trainings, its table, and the steps of figure 8.3."""

import csv
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.catalogue import model_folder
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


WORLDS = 20


def result(condition, more=0.0, attempts=3):
    """Return what attempts come to in some worlds; so much more than the first condition."""
    draws = np.random.default_rng(3).random((attempts, WORLDS))
    worlds = {
        number: pd.DataFrame(
            {
                "world": range(WORLDS),
                "objects": 10 * one + more,
                "first_find": 1000 * one,
                "nothing": one > 0.9,
                "collisions": one,
                "area": one / 2,
            }
        )
        for number, one in enumerate(draws, 1)
    }
    return COMPARISON.Result(condition, worlds, best=attempts)


def test_the_table_has_means_over_attempts_and_worlds_and_differences(tmp_path):
    first, second, third, _, fifth = COMPARISON.CONDITIONS[:5]
    results = [
        (first, result(first)),
        (second, result(second, -2.0)),
        (third, None),
        (fifth, result(fifth, attempts=1)),
    ]
    page, numbers, worlds = COMPARISON.write_table(results, ["Said above."], tmp_path)
    text = page.read_text("utf-8")
    assert "Said above." in text
    # What is taken from the same minds is compared mind by mind, in the same worlds.
    assert "| no signals | -2.0 (-2.0 … -2.0) | 0 (0 … 0) | 0 (0 … 0) |" in text
    assert "| no signals, learned without | not trained | not trained |" in text
    draws = np.random.default_rng(3).random((3, WORLDS))
    alone = np.random.default_rng(3).random((1, WORLDS))
    assert f"learned without | {10 * alone.mean():.1f} (one attempt) |" in text
    assert f"| foraging together, 3 | **{10 * draws[2].mean():.1f}** |" in text
    assert f"| foraging together, 1 | {10 * draws[0].mean():.1f} |" in text
    with numbers.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 5 + 10 + 10
    compared = [row for row in rows if row["compared"] and row["measure"] == "objects"]
    # The other training's one attempt met the draws of the first attempt: these are a pair.
    assert [row["robots"] for row in compared] == [second.name, fifth.name]
    assert [float(row["mean"]) for row in compared] == [-2.0, 0.0]
    area = next(row for row in rows if row["measure"] == "area")
    assert float(area["mean"]) == pytest.approx(50 * draws.mean(), abs=1e-4)
    whole = COMPARISON.crossed_interval(50 * draws)
    assert [float(area[end]) for end in ("low", "high")] == pytest.approx(
        [whole.low, whole.high], abs=1e-4
    )
    kept = pd.read_csv(worlds)
    assert kept.groupby(["robots", "attempt"]).size().tolist() == [WORLDS] * 7
    assert kept["objects"][:WORLDS].to_numpy() == pytest.approx(10 * draws[0])
    figure = COMPARISON.draw(results)
    assert [len(axes.lines) for axes in figure.axes] == [2 + 3 + 2 + 3 + 2 + 1] * 5


def test_every_measure_of_the_table_is_one_of_the_model():
    names = {one.name for one in COMPARISON.MEASURED} - {"nothing"}
    assert names == set(COMPARISON.load_model("foraging").measures)


def test_nothing_is_found_where_the_first_find_takes_the_whole_run():
    mind = COMPARISON.MindDescription.load(model_folder("foraging") / "mind")
    found = COMPARISON.measured_in(mind, COMPARISON.EMPTY, 1)
    assert found["nothing"].tolist() == [1.0] and found["first_find"].tolist() == [10_000]


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
