"""Hierarchy and monolith with the same ticks."""

import pytest

from socialmind.experiments.studies import topics
from socialmind.learning.training.course import TrainingCourse
from socialmind.sources.loading import load_file

level = load_file(topics()["collect"] / "level.py")


@pytest.mark.parametrize("name", list(level.PLANS))
def test_each_plan_fits_its_mind(name):
    plan = level.PLANS[name]
    assert plan.attempts >= 10
    TrainingCourse(plan.curriculum(), plan.mind(), plan.seed, "compiled")


def test_both_have_the_same_ticks_in_each_lesson_and_are_ended_by_them():
    ours, other = (level.PLANS[name].curriculum().lessons for name in level.PLANS)
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
    assert [one.name for one in ours] == list(level.BUDGETS)


def test_the_last_lesson_is_long_and_seen_on_common_worlds():
    for name in level.PLANS:
        *_, last = level.PLANS[name].curriculum().lessons
        assert last.budget >= 10 * 36_152_950  # what ten generations took
        assert last.validation == 64
