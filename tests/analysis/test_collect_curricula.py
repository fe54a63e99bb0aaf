"""Lessons of equal length for hierarchy and monolith, and whether they level off."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from socialmind.learning.training.course import TrainingCourse
from socialmind.sources.loading import load_file

COLLECT = Path(__file__).parents[2] / "analysis" / "collect"
trainings = load_file(COLLECT / "trainings.py")
curricula = load_file(COLLECT / "curricula.py")
equal_ticks = load_file(COLLECT / "equal_ticks.py")
BOTH = ("hierarchy_level", "monolith_level")
PLANS = {name: trainings.PLANS[name] for name, *_ in equal_ticks.PANELS}


@pytest.mark.parametrize("name", PLANS)
def test_each_plan_fits_its_mind(name):
    plan = PLANS[name]
    TrainingCourse(plan.curriculum(), plan.mind(), plan.seed, "compiled")


def test_both_have_the_same_ticks_in_each_lesson_and_are_ended_by_them():
    ours, (*other, alone) = (PLANS[name].curriculum().lessons for name in BOTH)
    assert (alone.name, alone.start) == (curricula.EVEN_MORE, "known")  # the monolith's
    for one, two in zip(ours, other, strict=True):
        assert (one.name, one.budget, one.episode_ticks) == (
            two.name,
            two.budget,
            two.episode_ticks,
        )
        assert one.environment is two.environment
        for lesson in (one, two):
            generation = lesson.settings["population"] * lesson.repetitions
            assert lesson.generations * generation * lesson.episode_ticks > 10 * lesson.budget
    assert [one.name for one in ours] == [*curricula.EQUAL, curricula.MORE, curricula.STILL_MORE]


def test_the_final_task_alone_has_the_ticks_of_the_six_lessons():
    for name in PLANS:
        six = PLANS[name].curriculum().lessons[:6]
        assert sum(one.budget for one in six) == 866_000_000


def test_more_of_collect_goes_on_from_what_collect_taught():
    for name in BOTH:
        collect, more, *others = PLANS[name].curriculum().lessons[5:]
        assert (more.start, more.budget) == ("known", 400_000_000)
        for one in others:
            assert (one.start, one.budget) == ("known", 600_000_000)
        for one in (more, *others):
            assert (one.environment, one.validation) == (collect.environment, collect.validation)
            assert (one.skills, one.finals) == (collect.skills, collect.finals)


def test_steps_are_narrow_again_at_the_end_of_each_lesson_of_collect():
    for name in BOTH:
        for lesson in PLANS[name].curriculum().lessons[5:]:
            generation = 100 * lesson.repetitions * lesson.episode_ticks  # a population of 100
            narrowed = lesson.settings["narrowing"] ** (lesson.budget / generation)
            assert narrowed < 0.1


def test_the_last_lesson_is_long_and_seen_on_common_worlds():
    for plan in PLANS.values():
        *_, last = plan.curriculum().lessons
        assert last.budget >= 10 * 36_152_950  # what ten generations took
        assert last.validation == 64


def test_what_is_said_of_a_curve_that_levels_off_and_of_one_that_does_not():
    level = np.array([1.0, 2.0, 3.0, *[4.0] * 37])
    rising = np.arange(1.0, 41.0)
    assert equal_ticks.gained(level) == 0.0
    # The mean of 37 to 40 against that of 27 to 30.
    assert equal_ticks.gained(rising) == pytest.approx(38.5 / 28.5 - 1)
    both = equal_ticks.Learned("both", {1: level, 2: rising}, {1: 4.0, 2: 40.0})
    assert both.late_gain.mean == pytest.approx((38.5 / 28.5 - 1) / 2)
    (line,) = equal_ticks.findings([both])
    assert "2 attempts of 400 million ticks" in line
    assert "+17.5%" in line
    alone = equal_ticks.Learned("alone", {1: level}, {1: 4.0})
    assert (
        "1 attempt of 400 million ticks; the last quarter of them added +0.0% to"
        in (equal_ticks.findings([alone])[0])
    )


def test_who_fell_short_is_seen_beside_the_better_of_two_panels():
    good = equal_ticks.Learned("good", {1: np.ones(4), 2: np.ones(4)}, {1: 4.0, 2: 3.1})
    poor = equal_ticks.Learned("poor", {1: np.ones(4), 2: np.ones(4)}, {1: 1.0, 2: 1.1})
    assert equal_ticks.fallen_short([good, poor], 0) == [False, False]
    assert equal_ticks.fallen_short([good, poor], 1) == [True, True]
    assert equal_ticks.fallen_short([good, good, poor], 2) == [False, False]  # a row of its own


def test_the_curves_of_several_lessons_are_one_that_meets_where_each_budget_ends():
    ticks = {"Collect": [8e6, 17e6, 26e6], "More": [9e6, 18e6, 25e6], "Still": [9e6, 11e6]}
    rows = [
        {"attempt": 1, "lesson": lesson, "ticks": one, "validated": float(place)}
        for lesson, several in ticks.items()
        for place, one in enumerate(several)
    ]
    budgets = {"Collect": 20_000_000, "More": 20_000_000, "Still": None}
    training = SimpleNamespace(
        lessons=pd.DataFrame(
            {"attempt": [1, 1, 1], "lesson": list(ticks), "score": [2.0, 2.5, 3.0]}
        ),
        curve=pd.DataFrame(rows),
        manifest=SimpleNamespace(
            lessons=[{"name": name, "budget": one} for name, one in budgets.items()]
        ),
    )
    found = equal_ticks.learned(training, list(ticks), "one", 1500)
    # The third generations of the first two lessons are behind their budgets.
    assert found.curves[1].tolist() == [0.0, 1.0, 0.0, 1.0, 0.0, 1.0]
    assert (found.seams, found.generations, found.finals) == ((20, 40), (8, 8), {1: 3.0})
