"""Which lessons and which mind a training has: a model's own, or those that are given."""

import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.learning import Curriculum
from socialmind.learning.training.course import (
    TrainingCourse,
    can_be_taught,
    curricula_of,
    curriculum_of,
    mind_of,
)

MODEL = """
from socialmind import Agent, Model, Population


class Walker(Agent):
    pass


class Empty(Model):
    walkers = Population(Walker, 1)
"""


@pytest.fixture
def empty(tmp_path):
    """A model's folder without lessons."""
    (tmp_path / "model.py").write_text(MODEL)
    return tmp_path


def test_a_model_without_lessons_says_so(empty):
    with pytest.raises(SocialmindError, match=r"no lessons\.py, so there is nothing to learn"):
        curriculum_of(empty)
    (empty / "lessons.py").write_text("curriculum = 3\n")
    with pytest.raises(ModelError, match="`curriculum` set to 3; expected curriculum = Curr"):
        curriculum_of(empty)
    (empty / "lessons.py").write_text("")
    with pytest.raises(ModelError, match="no curriculum"):
        curriculum_of(empty)


CURRICULA = """
from socialmind.learning import Curriculum, Lesson

class Field:
    def run(self):
        pass

def taught(*names):
    return Curriculum([Lesson(name, Field) for name in names])

curricula = {"long": taught("Go", "Turn"), "short": taught("Go"), "other": taught("Stop")}
"""


def test_a_model_with_several_curricula_has_them_and_their_lessons_by_name(empty):
    (empty / "curricula.py").write_text(CURRICULA)

    def names(lessons=None):
        return [one.name for one in curriculum_of(empty, lessons)[0].lessons]

    assert list(curricula_of(empty)) == ["long", "short", "other"]
    assert names() == ["Go", "Turn"], "the first"
    assert names("short") == ["Go"]
    assert names("Stop") == ["Stop"], "of whichever has it"
    assert names(["Turn", "Go"]) == ["Go", "Turn"]
    with pytest.raises(SocialmindError, match="no lesson called 'shrt'; did you mean 'short'"):
        names("shrt")
    with pytest.raises(SocialmindError, match="the lessons Go, Stop are not all of one curricul"):
        names(["Go", "Stop"])
    with pytest.raises(SocialmindError, match="short is a whole curriculum; name it alone"):
        names(["short", "Turn"])


def test_other_curricula_need_not_be_whole(empty):
    (empty / "curricula.py").write_text(
        CURRICULA.replace('"other": taught("Stop")', '"other": Curriculum(["lost.simbatch"])')
    )
    for name in ("short", "Turn"):
        assert [one.name for one in curriculum_of(empty, name)[0].lessons][-1] in ("Go", "Turn")
    with pytest.raises(SocialmindError, match="lost"):
        curriculum_of(empty, "other")


def test_a_file_of_that_name_that_sets_none_is_no_matter(empty, lesson):
    assert not can_be_taught(empty)
    (empty / "curricula.py").write_text("def taught():\n    pass\n")
    assert not can_be_taught(empty)
    with pytest.raises(SocialmindError, match=r"no lessons\.py"):
        curriculum_of(empty)
    (empty / "curricula.py").write_text(CURRICULA)
    assert can_be_taught(empty)


@pytest.mark.parametrize("text", ["curricula = {}", "curricula = [1]", "curricula = {'a': 1}"])
def test_what_are_no_curricula_is_refused(empty, text):
    (empty / "curricula.py").write_text(text)
    with pytest.raises(ModelError, match=r"curricula.*; expected curricula = {"):
        curriculum_of(empty)


def test_environments_by_name_are_those_of_the_lessons(empty, lesson):
    (empty / "lessons.py").write_text("class Field:\n    def run(self):\n        pass\n")
    named = lesson("Go").changed(environment="Field")
    curriculum, folder = curriculum_of(empty, named)
    assert curriculum.lessons[0].environment.__name__ == "Field"
    assert folder == empty
    with pytest.raises(ModelError, match=r"lesson 'Go' of 'Fild', .*did you mean 'Field'"):
        curriculum_of(empty, named.changed(environment="Fild"))
    with pytest.raises(ModelError, match="where it is defined"):
        curriculum_of(None, named)


def test_the_mind_is_the_given_one_then_the_curriculum_s_then_the_model_s(empty, lesson, robot):
    other = robot.with_modules(sensors=["S9"])
    plain, own = Curriculum([lesson("Go")]), Curriculum([lesson("Go")], mind=robot)
    assert mind_of(None, own, None, other) is other
    assert mind_of(None, own, None, None) is robot
    robot.save(empty / "mind")
    there = mind_of(None, Curriculum([lesson("Go")], mind="mind"), empty, None)
    assert there.order == robot.order
    with pytest.raises(SocialmindError, match="0 minds in the model; say which one learns"):
        mind_of(empty, plain, empty, None)
    (empty / "model.py").write_text(
        MODEL.replace("Walker, 1)", "Walker, 1, hierarchy='mind', master='Top')")
    )
    assert mind_of(empty, plain, empty, None).name == "robot"


def test_lessons_are_held_against_the_mind_in_their_order(lesson, robot):
    go, turn, top = lesson("Go"), lesson("Turn"), lesson("Top")
    TrainingCourse(Curriculum([go, turn, top]), robot, 0, "compiled")
    with pytest.raises(ModelError, match="the lesson 'Top' with the skill 'Turn' below 'Top'"):
        TrainingCourse(Curriculum([go, top, turn]), robot, 0, "compiled")
