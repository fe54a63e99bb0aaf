"""Robots on a slope: what they do with items, by hand-made cases, and what programmed ones do."""

import pytest

from socialmind.catalogue import load_model
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training.course import TrainingCourse
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

NAME = "task_partitioning"
PLACES = load_file(model_folder(NAME) / "places.py")
RULES = load_file(model_folder(NAME) / "model.py")


@pytest.fixture(params=[True, False], ids=["compiled", "interpreted"])
def make(request):
    """Make a group at either speed, of one robot unless told otherwise."""

    def made(seed=4, **parameters):
        options = {"n_robots": 1, **parameters}
        return load_model(NAME)(seed, compiled=request.param, **options)

    return made


def give_item(arena, y):
    """Put the first robot at a height of the arena, with an item that it took from the source."""
    robot, item = arena.robots[0], arena.items[0]
    robot.x, robot.y = 5.0, y
    item.carried, item.fetched_by = True, robot.id
    robot.item = item.id
    arena.untouched -= 1
    return robot, item.id


def test_places_follow_one_another_from_the_nest_up():
    heights = (0.0, 3.4, 3.6, 9.4, 9.6, 23.4, 23.6, 28.0)
    found = [PLACES.place_of(y) for y in heights]
    assert found == [0, 0, 1, 1, 2, 2, 3, 3]
    assert PLACES.BORDERS[-1] == PLACES.LENGTH - 0.5


def test_items_lie_at_the_source_as_many_as_shall(make):
    arena = make(n_source=7)
    assert len(arena.items) == arena.untouched == 7
    assert all(PLACES.place_of(y) == PLACES.SOURCE for y in arena.items.y.tolist())


def test_an_item_let_go_on_the_slope_slides_into_the_cache(make):
    arena = make(n_droppers=1)
    robot, item = give_item(arena, 16.0)
    arena.advance(1)
    assert robot.item is None
    item = arena.items[item]
    assert item.sliding and item.slid and not item.carried
    # It slides on within the tick in which it was let go: 2 patches a tick, from 16.
    assert item.y == pytest.approx(14.0)
    arena.advance(9)
    assert not item.sliding
    assert PLACES.place_of(item.y) == PLACES.CACHE
    assert item.y == item.rests_at


def test_on_flat_ground_it_stays_where_it_was_let_go(make):
    arena = make(n_droppers=1, gradient=0.0)
    robot, item = give_item(arena, 16.0)
    arena.advance(1)
    assert robot.item == item  # a dropper goes on to the cache
    robot.y = 6.0
    arena.advance(2)
    item = arena.items[item]
    assert robot.item is None
    assert not item.sliding and not item.slid
    assert abs(item.y - 6.0) <= 2.0


def test_an_item_let_go_in_the_nest_is_home_and_another_lies_at_the_source(make):
    arena = make(n_generalists=1)
    robot, item = give_item(arena, 1.0)
    arena.advance(1)
    assert (robot.delivered, arena.delivered, arena.shared, arena.slid) == (1, 1, 0, 0)
    assert not arena.items.contains(item)
    assert arena.untouched == arena.n_source == len(arena.items)


def test_an_item_that_two_robots_had_is_shared(make):
    arena = make(n_robots=2, n_collectors=2)
    fetcher, item = give_item(arena, 16.0)
    other = arena.robots[1]
    fetcher.item, other.x, other.y = None, 2.0, 6.0
    lying = arena.items[item]
    lying.carried, lying.slid, lying.x, lying.y = False, True, 2.0, 6.0
    fetcher.y = 9.0
    arena.advance(40)
    assert other.delivered + fetcher.delivered == 1
    assert arena.slid == 1
    assert arena.shared == other.delivered


def test_slopes_slow_robots_down(make):
    def climbed(**parameters):
        arena = make(n_generalists=1, **parameters)
        robot = arena.robots[0]
        robot.x, robot.y = 5.0, 10.5
        arena.advance(8)
        return robot.y - 10.5

    flat, steep = climbed(gradient=0.0), climbed(gradient=1.0)
    assert flat == pytest.approx(8.0, rel=0.1)
    assert steep == pytest.approx(8.0 * 0.4, rel=0.15)


@pytest.mark.parametrize("gradient", [0.0, 1.0])
def test_generalists_share_nothing_and_specialists_everything(gradient):
    alone = load_model(NAME)(1, n_generalists=4, gradient=gradient)
    divided = load_model(NAME)(1, n_droppers=2, n_collectors=2, gradient=gradient)
    for arena in (alone, divided):
        arena.advance(1000)
        assert arena.delivered > 20
        assert arena.delivered == arena.robots.delivered.sum() == arena.score()
        held = int((arena.robots.filled("item", -1) >= 0).sum())
        lying = arena.series()["lying"]
        assert arena.robots.fetched.sum() == arena.delivered + held + lying
    assert (alone.shared, alone.slid) == (0, 0)
    assert divided.shared == divided.delivered
    assert divided.slid == (divided.delivered if gradient else 0)
    droppers, collectors = divided.robots.strategy == 2, divided.robots.strategy == 3
    assert divided.robots.delivered[droppers].sum() == 0
    assert divided.robots.fetched[collectors].sum() == 0


def test_dividing_the_way_pays_on_the_slope_and_not_on_flat_ground():
    def home(gradient, **numbers):
        found = 0
        for seed in range(5):
            arena = load_model(NAME)(seed, gradient=gradient, **numbers)
            arena.advance(1000)
            found += arena.delivered
        return found

    halves, alone = {"n_droppers": 2, "n_collectors": 2}, {"n_generalists": 4}
    assert home(1.0, **halves) > 1.3 * home(1.0, **alone)
    assert home(0.0, **halves) < 0.8 * home(0.0, **alone)


def test_no_more_items_than_there_may_be(make):
    arena = make(n_robots=4, n_droppers=4, most_items=12)
    arena.advance(600)
    assert len(arena.items) <= 12
    assert arena.delivered == 0


def test_lessons_fit_the_mind_and_are_judged_by_what_is_brought_home():
    lessons = load_file(model_folder(NAME) / "lessons.py")
    for gradient in (0.0, 1.0):
        curriculum = lessons.lessons(gradient)
        TrainingCourse(curriculum, lessons.MIND, 1, "compiled")
        for lesson in curriculum.lessons:
            assert isinstance(lesson, Lesson)
            assert lesson.parameters == {"gradient": gradient}
    assert list(lessons.MIND.sensors) == list(lessons.SENSORS)
