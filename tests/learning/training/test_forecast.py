"""How long a training will take."""

import pytest

from socialmind.learning import Curriculum, Cycle
from socialmind.learning.lessons.curriculum import Position
from socialmind.learning.training.attempt import News
from socialmind.learning.training.course import TrainingCourse
from socialmind.learning.training.forecast import Forecast


@pytest.fixture
def news():
    def told(lesson, generation, seconds, attempt=1, item=0, cycle=1):
        position = Position(item, cycle)
        return News(attempt, lesson, position, generation, 0.0, 0.0, 1, seconds, 12)

    return told


def test_time_goes_with_the_ticks_ahead(lesson, robot, news):
    go = lesson("Go", ticks=10)
    turn = lesson("Turn", ticks=20, generations=3, settings={"population": 6})
    forecast = Forecast(TrainingCourse(Curriculum([go, turn]), robot, 0, "compiled"), attempts=2)
    # A generation of Go is 240 ticks, one of Turn as many: 9 generations an attempt.
    assert forecast.seconds_left(news(go, 1, 60.0)) == pytest.approx(60.0 * (8 + 9))
    assert forecast.seconds_left(news(go, 2, 2.0)) == pytest.approx(2.0 * (7 + 9))
    assert forecast.seconds_left(news(go, 3, 4.0)) == pytest.approx(3.0 * (6 + 9))
    assert forecast.seconds_left(news(turn, 3, 1.0, item=1)) == pytest.approx(9.0)
    assert forecast.seconds_left(news(turn, 3, 1.0, attempt=2, item=1)) == 0.0


def test_attempts_that_were_begun_have_less_ahead(lesson, robot, news):
    go, turn = lesson("Go", ticks=10), lesson("Turn", ticks=10)
    course = TrainingCourse(Curriculum([go, turn]), robot, 0, "compiled")
    # Two attempts behind attempt 1: one at the second lesson, one behind the end.
    begun = {1: Position(1), 2: Position(1), 3: None}
    forecast = Forecast(course, 3, begun)
    assert forecast.seconds_left(news(turn, 1, 2.0, item=1)) == pytest.approx(2.0 * (5 + 6))


def test_a_budget_shortens_it(lesson, robot, news):
    go = lesson("Go", ticks=10, budget=480)
    forecast = Forecast(TrainingCourse(Curriculum([go]), robot, 0, "compiled"), attempts=1)
    assert forecast.seconds_left(news(go, 1, 5.0)) == pytest.approx(5.0)


def test_nobody_knows_how_long_a_cycle_without_end_takes(lesson, robot, news):
    go = lesson("Go")
    endless = Curriculum([Cycle([go])])
    assert (
        Forecast(TrainingCourse(endless, robot, 0, "compiled"), 1).seconds_left(news(go, 1, 1.0))
        is None
    )
    twice = endless.with_cycles(2)
    left = Forecast(TrainingCourse(twice, robot, 0, "compiled"), 1).seconds_left(news(go, 1, 1.0))
    assert left == pytest.approx(11.0)
