"""Plans of trainings: made whole, small, or taken from what is kept."""

import re
import sys
from dataclasses import replace
from importlib.machinery import ModuleSpec

import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.studies import Way
from socialmind.experiments.trainings import plans as of_plans
from socialmind.experiments.trainings.plans import TrainingPlans, attempts_of, most_ticks
from socialmind.experiments.trainings.rerunning import Again
from socialmind.experiments.trainings.store import keep
from socialmind.learning import Curriculum, Training, pause, resume


@pytest.fixture
def plans(tiny_plans, tmp_path):
    """The plans of a topic without any trainings."""
    return TrainingPlans(
        tmp_path / "topic", {"tiny": tiny_plans.PLAN}, {"attempts": 1, "generations": 1}
    )


def test_a_plan_knows_how_long_it_takes_at_most(tiny_plans):
    (lesson,) = tiny_plans.tiny("GoToObject", generations=5).curriculum().lessons
    assert most_ticks(lesson) == 5 * 6 * 40
    # A generation that has begun is finished.
    assert most_ticks(replace(lesson, budget=500)) == 500 + 6 * 40
    assert tiny_plans.PLAN.seconds == 2 * 2 * 4 * 6 * 40 / 2_000_000
    by_default = replace(lesson, settings={})
    plan = replace(tiny_plans.PLAN, curriculum=lambda: Curriculum((by_default,)))
    assert plan.seconds > 0  # as many individuals as the optimiser takes of itself


def test_a_small_plan_has_the_same_lessons_and_less_of_all(tiny_plans):
    small = tiny_plans.PLAN.small(attempts=1, generations=3, population=8, repetitions=2, ticks=30)
    assert small.attempts == 1
    for lesson, whole in zip(
        small.curriculum().lessons, tiny_plans.PLAN.curriculum().lessons, strict=True
    ):
        assert (lesson.name, lesson.skills) == (whole.name, whole.skills)
        assert (lesson.generations, lesson.repetitions, lesson.episode_ticks) == (3, 2, 30)
        assert lesson.settings["population"] == 8


def test_a_name_that_no_plan_has_is_refused(plans):
    with pytest.raises(SystemExit, match="error: no training called 'tinny'; did you mean 'tiny'"):
        plans.main(["keep", "tinny"])
    with pytest.raises(SystemExit, match=r"error: which training\? expected all, or some of tiny"):
        plans.main([])
    assert plans.get("tinny") is None


def test_a_training_is_made_from_what_is_kept_of_it(plans, whole, tiny_plans):
    keep(whole, plans.kept)
    for path in (plans.kept / "tiny" / "attempts").glob("2/*"):
        path.unlink()
    training = plans.train_on("tiny")
    assert training.folder == plans.home / "tiny"
    assert training.finished == [1, 2]
    other = Training(whole)
    assert training.lessons.equals(other.lessons)


def test_a_study_takes_its_trainings_in_each_way(plans, whole, tmp_path, capsys):
    out = tmp_path / "out"
    assert plans.training("tiny", Way.KEPT, out) == (
        None, "`tiny`: tiny. Not kept; `python -m analysis.topic.trainings tiny` makes it.",
    )  # fmt: skip
    keep(whole, plans.kept)
    kept, line = plans.training("tiny", Way.KEPT, out)
    assert kept.folder == plans.kept / "tiny"
    assert re.match(r"`tiny`: tiny\. 2 of 2 attempts, seed 6, \d+ minutes;", line)
    assert not out.exists()
    small, line = plans.training("tiny", Way.QUICK, out)
    assert line == "`tiny`: tiny. 1 attempt, trained small, seed 6."
    assert small.folder == out / "small_trainings" / "tiny"
    assert [len(small.curve), small.finished] == [2, [1]]
    made, line = plans.training("tiny", Way.FULL, out)
    assert line == "`tiny`: tiny. 2 attempts, trained from nothing, seed 6."
    assert made.lessons.equals(Training(whole).lessons)
    assert "Ctrl-C stops, and the same command goes on" in capsys.readouterr().err


def test_a_kept_training_says_in_what_it_is_not_its_plans_any_more(plans, whole, tiny_plans):
    keep(whole, plans.kept)
    other = TrainingPlans(plans.topic, {"tiny": replace(tiny_plans.PLAN, seed=7)})
    _, line = other.training("tiny", Way.KEPT, plans.topic)
    assert line.endswith("Since then the seed changed.")


def test_the_command_makes_keeps_and_judges_again(plans, capsys):
    plans.main(["all"])
    plans.main(["keep", "tiny"])
    plans.main(["recheck", "all"])
    told = capsys.readouterr().out.splitlines()
    assert told == [
        f"tiny {plans.home / 'tiny'}",
        str(plans.kept / "tiny"),
        "tiny: 4 lessons come to the same scores",
    ]


def test_the_command_trains_kept_attempts_again(plans, whole, monkeypatch, capsys):
    keep(whole, plans.kept)
    asked = []
    found = [Again("Going", 1.25, 1.25, "3d4ad57"), Again("Bringing", 3.5, 3.0, "8e6425c")]

    def again(*words):
        asked.append(words)
        words[4](found)
        return found

    monkeypatch.setattr(of_plans, "rerun", again)
    plans.main(["rerun", "tiny", "2", "1"])
    plans.main(["rerun", "tiny", "2"])
    assert [words[2] for words in asked] == [2, 1, 2]
    assert asked[0][0] == plans.kept / "tiny"
    assert capsys.readouterr().out.splitlines()[0] == (
        "tiny, attempt 2: the same weights; Going 1.25, Bringing 3 (kept 3.5)"
    )
    assert (plans.kept.parent / "reruns.csv").read_text().splitlines() == [
        "training,attempt,lesson,commit,score,kept,apart",
        "tiny,1,Going,3d4ad57,1.25,1.25,0.0",
        "tiny,1,Bringing,8e6425c,3.0,3.5,0.0",
        "tiny,2,Going,3d4ad57,1.25,1.25,0.0",
        "tiny,2,Bringing,8e6425c,3.0,3.5,0.0",
    ]
    with pytest.raises(SystemExit, match=r"which attempts\? expected `rerun tiny` and their num"):
        plans.main(["rerun", "tiny", "two"])
    with pytest.raises(SystemExit, match=r"which training\? expected one of tiny"):
        plans.main(["rerun", "all", "1"])
    with pytest.raises(SystemExit, match=r"which training\? expected one of tiny"):
        plans.main(["rerun"])
    with pytest.raises(SystemExit, match="no attempt 99 is kept; expected 1, 2"):
        plans.main(["rerun", "tiny", "1", "99"])
    assert len(asked) == 3  # nothing was trained before all words were known


def test_the_command_says_what_it_does(plans, capsys):
    plans.main(["--help"])
    told = capsys.readouterr().out
    assert "rerun NAME NUMBER" in told
    assert "some of tiny" in told


def test_paused_from_elsewhere_the_command_says_so_and_goes_on(plans, whole, capsys, monkeypatch):
    folder = plans.home / "tiny"
    spec = ModuleSpec("analysis.tiny.trainings", None)
    monkeypatch.setattr(sys.modules["__main__"], "__spec__", spec)
    monkeypatch.setattr(of_plans, "print_lesson", lambda *told: pause(folder, "the studio"))
    with pytest.raises(SystemExit) as stop:
        plans.main(["tiny"])
    assert stop.value.code == 130  # as after Ctrl-C
    assert capsys.readouterr().err.splitlines()[-1] == (
        "paused by the studio in attempt 1, GoToDropZone, after generation 0; the same command "
        "goes on"
    )
    manifest = Training(folder).manifest
    assert manifest.command == "python -m analysis.tiny.trainings tiny"
    with pytest.raises(SocialmindError, match=f"go on with `{manifest.command}`"):
        resume(folder)
    monkeypatch.undo()
    plans.main(["tiny"])
    assert Training(folder).lessons.equals(Training(whole).lessons)


def test_attempts_that_are_not_finished_are_left_out(whole, tmp_path, tiny_plans):
    def stop(news, left):
        if (news.attempt, news.lesson.name) == (2, "GoToDropZone"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        tiny_plans.PLAN.train(tmp_path / "tiny", workers=1, on_generation=stop)
    stopped = Training(tmp_path / "tiny")
    assert stopped.attempts == [1, 2]
    assert stopped.finished == [1]
    found = attempts_of({"whole": Training(whole), "none": None, "stopped": stopped})
    assert [(name, attempt) for name, attempt, _ in found] == [
        ("whole", 1), ("whole", 2), ("stopped", 1),
    ]  # fmt: skip
