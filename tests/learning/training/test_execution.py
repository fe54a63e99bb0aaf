"""Trainings: folders, attempts, killing and going on, other lessons than before."""

import itertools
import json
import multiprocessing
import os
import random
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.learning import Curriculum, Cycle, Training, TrainingInterrupted, learn, resume
from socialmind.learning.training import continuing, execution
from socialmind.learning.training.attempt import Attempt
from socialmind.learning.training.capsule import TrainingCapsule
from socialmind.mind import MindDescription
from socialmind.sources.loading import load_file

CHECKOUT = Path(__file__).parents[3]
MODEL = """
from socialmind import Agent, Model, Population


class Walker(Agent):
    pass


class Empty(Model):
    walkers = Population(Walker, 1)
"""
LESSONS = """
from socialmind.learning import Curriculum, Cycle, Lesson
from .slopes import Slope

COMMON = dict(generations=6, repetitions=2, finals=5, settings={"population": 12},
              parameters={"seconds": 0.02})
curriculum = Curriculum(
    [Lesson("Go", Slope, **COMMON), Lesson("Turn", "Slope", **COMMON),
     Lesson("Top", Slope, optimiser="ANNEALING", **{**COMMON, "settings": {}}),
     Cycle([Lesson("Again", Slope, "Go", "Top", start="known", **COMMON)], cycles=2)],
    mind="mind",
)
"""


@pytest.fixture
def model(tmp_path, robot):
    """A model's folder with a curriculum on slopes."""
    folder = tmp_path / "walk"
    folder.mkdir()
    (folder / "model.py").write_text(MODEL)
    (folder / "lessons.py").write_text(LESSONS)
    shutil.copy(Path(__file__).parents[1] / "slopes.py", folder)
    robot.save(folder / "mind")
    return folder


@pytest.fixture
def three(lesson, robot):
    return Curriculum([lesson("Go"), lesson("Turn"), lesson("Top")], mind=robot)


def digest(folder):
    return load_file(Path(__file__).parents[1] / "slopes.py").digest(folder)


def test_a_lesson_is_taught_on_what_the_one_before_has_taught(three, robot, tmp_path):
    results = []
    folder = learn(
        None, three, out=tmp_path / "out", on_lesson=lambda *told: results.append(told[2])
    )
    training = Training(folder)
    mind = training.mind()
    for name, result in zip(("Go", "Turn", "Top"), results, strict=True):
        assert (mind.skill(name).genome == result.winner.genome).all()
        assert (training.best(name).genome == result.best.genome).all()
    # The master's score counts the weights below it: those of the winners.
    top = training.lessons.set_index("lesson")["score"]["Top"]
    before = sum(mind.skill(name).genome.sum() for name in ("Go", "Turn"))
    assert top - before == pytest.approx(-((mind.skill("Top").genome - 0.5) ** 2).sum(), abs=0.5)
    assert robot.skill("Go").genome is None
    assert training.manifest.status == "finished"
    assert (training.manifest.finished, training.manifest.curve["rows"]) == (1, 18)
    assert {path.name for path in (folder / "figures").iterdir()} == {"curve.pdf", "curve.png"}
    assert MindDescription.load(folder / "mind").skill("Top").genome is None


def test_a_training_whose_workers_cannot_be_had_says_that_it_failed(three, tmp_path, monkeypatch):
    def nobody(*asked):
        raise SocialmindError("no Dask scheduler answers")

    monkeypatch.setattr(execution, "hired", nobody)
    with pytest.raises(SocialmindError, match="no Dask scheduler"):
        learn(None, three, out=tmp_path / "out")
    manifest = TrainingCapsule(tmp_path / "out").manifest
    assert manifest.status == "failed" and "no Dask scheduler" in manifest.error
    monkeypatch.undo()
    resume(tmp_path / "out", lessons=three)
    assert Training(tmp_path / "out").finished == [1]


def test_the_curve_has_a_row_for_each_generation(three, tmp_path):
    import pandas as pd

    folder = learn(None, three, attempts=2, out=tmp_path / "out")
    curve = Training(folder).curve
    assert list(curve.columns) == [
        "attempt", "cycle", "lesson", "generation", "best", "mean", "deviation", "best_so_far",
        "ticks", "seconds",
    ]  # fmt: skip
    assert curve.equals(pd.read_parquet(folder / "curve.parquet"))
    assert curve.groupby(["attempt", "lesson"], sort=False)["generation"].apply(list).tolist() == (
        [[1, 2, 3, 4, 5, 6]] * 6
    )


def test_nothing_hangs_on_workers_engine_or_folder(three, tmp_path):
    digests = [
        digest(learn(None, three, out=tmp_path / str(number), **options))
        for number, options in enumerate(
            [{"workers": 1}, {"workers": 3}, {"engine": "pymunk", "workers": 2}]
        )
    ]
    assert len(set(digests)) == 1
    assert digest(learn(None, three, seed=1, out=tmp_path / "other")) != digests[0]


def test_attempts_are_independent_and_can_be_added(three, tmp_path):
    together = learn(None, three, attempts=3, out=tmp_path / "together")
    added = learn(None, three, attempts=1, out=tmp_path / "added")
    resume(added, attempts=3, lessons=three)
    assert digest(added) == digest(together)
    assert Training(added).manifest.finished == Training(together).manifest.finished == 3
    genomes = [Training(added).mind(attempt).skill("Go").genome for attempt in (1, 2, 3)]
    assert not np.array_equal(genomes[0], genomes[1])
    with pytest.raises(SocialmindError, match="3 attempts were asked for before, 2 now"):
        resume(added, attempts=2, lessons=three)


def test_ticks_are_told_by_the_generation_and_time_is_added_up(lesson, robot, tmp_path):
    told = []
    two = Curriculum([lesson("Go", generations=3), lesson("Turn", generations=2)], mind=robot)
    folder = learn(
        None, two, out=tmp_path / "out", on_generation=lambda one, left: told.append(one)
    )
    curve = Training(folder).curve
    for name in ("Go", "Turn"):
        ticks = [one.ticks for one in told if one.lesson.name == name]
        assert min(ticks) > 0 and np.cumsum(ticks).tolist() == (
            curve[curve["lesson"] == name]["ticks"].tolist()
        )
    capsule = TrainingCapsule(folder)
    with capsule.locked():
        capsule.update(timings={**capsule.manifest.timings, "seconds": 1000.0})
    resume(folder, attempts=2, lessons=two)
    assert 1000.0 < Training(folder).manifest.timings["seconds"] < 1900.0


def test_cycles_go_on_from_what_they_left(lesson, robot, tmp_path):
    def round_and_round(cycles):
        again = [
            lesson("Go2", skill="Go", start="known"),
            lesson("Turn2", skill="Turn", start="known"),
        ]
        begun = [lesson("Go", generations=1), lesson("Turn", generations=1)]
        return Curriculum([*begun, Cycle(again, cycles=cycles)], mind=robot)

    at_once = learn(None, round_and_round(3), out=tmp_path / "at_once")
    longer = learn(None, round_and_round(1), out=tmp_path / "longer")
    resume(longer, lessons=round_and_round(1), cycles=3)
    assert digest(longer) == digest(at_once)
    assert digest(resume(longer, lessons=round_and_round(1))) == digest(at_once)  # it knows 3
    curve = Training(longer).curve
    assert curve[curve["lesson"] == "Turn2"]["cycle"].tolist() == [1] * 6 + [2] * 6 + [3] * 6
    # What is known is never given up for anything worse on the same worlds.
    scores = Training(longer).lessons.query("lesson == 'Go2'")["score"]
    assert scores.iloc[-1] > scores.iloc[0] - 0.1


def test_lessons_are_added_to_attempts_that_were_through(lesson, robot, tmp_path, monkeypatch):
    first = [lesson("Go"), lesson("Turn")]
    more = [*first, lesson("Go on", skill="Go", start="known")]
    at_once = learn(None, Curriculum(more, mind=robot), attempts=2, out=tmp_path / "at_once")
    longer = learn(None, Curriculum(first, mind=robot), attempts=2, out=tmp_path / "longer")
    assert Training(longer).finished == [1, 2]
    monkeypatch.setattr(continuing, "own_commit", lambda: "8e6425c")

    def stop(news, left):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        resume(longer, lessons=Curriculum(more, mind=robot), on_generation=stop)
    assert Training(longer).finished == []
    with pytest.raises(SocialmindError, match="add others behind them, or start another"):
        resume(longer, lessons=Curriculum(first, mind=robot))
    resume(longer, lessons=Curriculum(more, mind=robot))
    assert digest(longer) == digest(at_once)
    training = Training(longer)
    assert training.finished == [1, 2]
    assert training.manifest.versions["commit from lesson 3 to attempt 2"] == "8e6425c"


def test_with_added_rounds_attempts_are_through_when_they_have_been_round(lesson, robot, tmp_path):
    turns = Curriculum([Cycle([lesson("Go"), lesson("Turn")], cycles=1)], mind=robot)
    folder = learn(None, turns, attempts=2, out=tmp_path / "out")
    assert Training(folder).finished == [1, 2]

    def stop(news, left):
        if news.attempt == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        resume(folder, lessons=turns, cycles=2, on_generation=stop)
    assert Training(folder).finished == [1]
    resume(folder, lessons=turns)
    assert Training(folder).finished == [1, 2]
    assert Training(folder).manifest.finished == 2


def test_with_added_lessons_a_training_goes_on_by_itself(model, tmp_path, monkeypatch):
    folder = learn(model, lessons=["Go"], attempts=1, out=tmp_path / "out")

    def stop(news, left):
        manifest = Training(folder).manifest
        assert (manifest.finished, manifest.status) == (0, "running")
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        resume(folder, lessons=["Go", "Turn"], on_generation=stop)
    resume(folder, attempts=2)
    assert Training(folder).lessons["lesson"].tolist() == ["Go", "Turn"] * 2


def test_cycles_that_attempts_are_behind_stay_as_many(lesson, robot, tmp_path):
    first = [lesson("Go"), Cycle([lesson("Turn")], cycles=1)]
    folder = learn(None, Curriculum(first, mind=robot), out=tmp_path / "out")
    more = Curriculum([*first, lesson("Top")], mind=robot)
    with pytest.raises(SocialmindError, match="do not go back; expected as many cycles as before"):
        resume(folder, lessons=more, cycles=2)
    resume(folder, lessons=more)
    assert Training(folder).lessons["lesson"].tolist() == ["Go", "Turn", "Top"]


def test_a_cycle_without_end_ends_with_its_budget(lesson, robot, tmp_path):
    again = [lesson("Go2", skill="Go", start="known"), lesson("Turn2", skill="Turn")]
    endless = Curriculum([lesson("Go"), Cycle(again)], mind=robot)
    folder = learn(None, endless, budget=15_000, generations=5, out=tmp_path / "out")
    lessons = Training(folder).lessons
    assert lessons["lesson"].tolist()[:3] == ["Go", "Go2", "Turn2"]
    spent = lessons[lessons["cycle"] >= 1].iloc[1:]["ticks"].sum()
    assert 15_000 <= spent < 15_000 + 12 * 2 * 50 + 5 * 5 * 50
    begun = Training(folder).manifest.lessons[1]
    assert (begun["budget"], begun["cycles"]) == (15_000, None)
    assert digest(resume(folder, lessons=endless)) == digest(folder)


def stopped_after(generations):
    """What stops a training after some generations, as Ctrl-C does."""
    told = []

    def interrupt(news, left):
        told.append(news)
        if len(told) == generations:
            signal.raise_signal(signal.SIGINT)

    return interrupt


@pytest.mark.parametrize("after", [5, 9])
def test_stopped_within_a_cycle_it_has_spent_what_it_had_spent(lesson, robot, tmp_path, after):
    again = [lesson("Go2", skill="Go"), lesson("Turn2", skill="Turn")]
    # A generation takes about 1150 ticks and a lesson 5260: the third lesson is cut short.
    curriculum = Curriculum([Cycle(again, budget=12_000)], mind=robot)
    undisturbed = learn(None, curriculum, generations=4, out=tmp_path / "undisturbed")
    lengths = Training(undisturbed).curve.groupby(["cycle", "lesson"], sort=False).size()
    assert lengths.tolist() == [4, 4, 2]
    with pytest.raises(TrainingInterrupted):
        learn(None, curriculum, generations=4, out=tmp_path / "out",
              on_generation=stopped_after(after))  # fmt: skip
    resume(tmp_path / "out", lessons=curriculum)
    assert digest(tmp_path / "out") == digest(undisturbed)


def test_every_lesson_and_every_round_has_draws_of_its_own(lesson, robot, tmp_path):
    """The same skill from scratch, under another name or another time around."""
    one, other = lesson("Go", generations=1), lesson("Go2", skill="Go", generations=1)
    curriculum = Curriculum([one, Cycle([other], cycles=2)], mind=robot)
    curve = Training(learn(None, curriculum, attempts=2, out=tmp_path / "out")).curve
    assert curve["lesson"].tolist() == ["Go", "Go2", "Go2"] * 2
    assert curve["best"].nunique() == curve["mean"].nunique() == 6


def test_a_graph_that_was_learned_is_kept_when_the_next_lesson_is_stopped(lesson, robot, tmp_path):
    pytest.importorskip("neat")
    grown = lesson("Go", optimiser="NEAT", settings={"population": 10}, generations=2)
    curriculum = Curriculum([grown, lesson("Turn", generations=2), lesson("Top")], mind=robot)
    undisturbed = learn(None, curriculum, out=tmp_path / "undisturbed")
    with pytest.raises(TrainingInterrupted):
        learn(None, curriculum, out=tmp_path / "out", on_generation=stopped_after(3))
    resume(tmp_path / "out", lessons=curriculum)
    assert digest(tmp_path / "out") == digest(undisturbed)


def test_what_can_be_made_again_is_and_what_cannot_is_missed_before_anything_is_written(
    three, tmp_path
):
    folder = learn(None, three, attempts=2, out=tmp_path / "out")
    before = digest(folder)
    shutil.rmtree(TrainingCapsule(folder).learned(2))  # as if killed before it was written
    assert digest(resume(folder, lessons=three)) == before
    for attempt, number in ((2, 1), (1, 3)):
        shutil.copytree(folder, tmp_path / f"{attempt}-{number}")
        hurt = tmp_path / f"{attempt}-{number}"
        lost = hurt / "attempts" / str(attempt) / f"lesson-{number:03d}.npz"
        lost.unlink()
        manifest = (hurt / "manifest.json").read_bytes()
        with pytest.raises(SocialmindError, match=lost.name):
            resume(hurt, lessons=three)
        assert (hurt / "manifest.json").read_bytes() == manifest


@pytest.mark.parametrize("after", [1, 6, 7, 20])
def test_stopped_between_generations_it_goes_on_to_the_same_end(three, tmp_path, after):
    undisturbed = learn(None, three, out=tmp_path / "undisturbed")
    interrupt = stopped_after(after)
    if after <= 18:
        with pytest.raises(TrainingInterrupted) as stopped:
            learn(None, three, out=tmp_path / "out", on_generation=interrupt)
        assert stopped.value.signal_number == signal.SIGINT
        assert Training(tmp_path / "out").manifest.status == "interrupted"
        assert len(Training(tmp_path / "out").curve) == after
        resume(tmp_path / "out", lessons=three)
    else:
        learn(None, three, out=tmp_path / "out", on_generation=interrupt)
    assert digest(tmp_path / "out") == digest(undisturbed)


def test_killed_at_any_moment_it_goes_on_to_the_same_end(model, tmp_path):
    undisturbed = learn(model, attempts=2, out=tmp_path / "undisturbed")
    out = tmp_path / "out"
    command = [sys.executable, "-m", "socialmind.cli", "learn", "--quiet"]
    environment = {**os.environ, "PYTHONPATH": str(CHECKOUT)}
    moments = random.Random(5)
    kills = 0
    while True:
        begun = out.exists()
        words = ["--resume", out] if begun else [model, "--attempts", 2, "--out", out]
        process = subprocess.Popen(
            [*command, *map(str, words)], env=environment, stdout=subprocess.DEVNULL
        )
        if kills < 6:
            generations = done(out)
            while process.poll() is None and done(out) == generations:
                time.sleep(0.005)
            time.sleep(moments.uniform(0.0, 0.4))
            process.kill()
            kills += 1
        if process.wait() == 0:
            break
        assert process.returncode == -signal.SIGKILL
    assert digest(out) == digest(undisturbed)


def test_a_worker_that_is_killed_is_replaced_and_nothing_else_changes(model, tmp_path):
    undisturbed = learn(model, "Go", generations=3, out=tmp_path / "undisturbed")
    killed = []

    def kill(news, left):
        if not killed:
            killed.append(multiprocessing.active_children()[-1])
            killed[0].kill()

    folder = tmp_path / "out"
    out = learn(
        model, "Go", generations=3, out=folder, engine="pymunk", workers=2, on_generation=kill
    )
    assert killed[0].exitcode == -signal.SIGKILL
    assert digest(out) == digest(undisturbed)
    assert not multiprocessing.active_children()


def test_a_clock_that_leaps_changes_nothing(three, tmp_path, monkeypatch):
    undisturbed = learn(None, three, out=tmp_path / "undisturbed")
    for name in ("time", "perf_counter", "monotonic"):
        leaps = itertools.cycle([0.01] * 4 + [3 * 86_400.0] + [0.01] * 5 + [-4 * 86_400.0])
        told = itertools.accumulate(leaps, initial=1e6)
        monkeypatch.setattr(time, name, lambda told=told: next(told))
    out = learn(None, three, out=tmp_path / "out")
    assert digest(out) == digest(undisturbed)
    assert (Training(out).curve["seconds"] >= 0.0).all()
    assert Training(out).manifest.timings["seconds"] >= 0.0


def done(folder):
    """How many times checkpoints were written, as far as that shows."""
    return [path.stat().st_mtime_ns for path in sorted(folder.glob("attempts/*/checkpoint.npz"))]


def test_a_file_that_was_cut_off_is_named(three, tmp_path):
    folder = learn(None, three, out=tmp_path / "out")
    checkpoint = folder / "attempts" / "1" / "checkpoint.npz"
    checkpoint.write_bytes(checkpoint.read_bytes()[:1000])
    with pytest.raises(SocialmindError, match=r"checkpoint\.npz: not a whole file of a training"):
        resume(folder, lessons=three)


def test_it_goes_on_with_what_it_was_begun_with_alone(model, three, lesson, robot, tmp_path):
    given = learn(None, three, out=tmp_path / "given")
    with pytest.raises(SocialmindError, match="its lessons were given in Python"):
        resume(given)
    other = Curriculum([lesson("Go", finals=6), lesson("Turn"), lesson("Top")], mind=robot)
    with pytest.raises(SocialmindError, match="lessons are not those that the training was begun"):
        resume(given, lessons=other)
    begun = learn(model, "Go", generations=1, out=tmp_path / "begun")
    (model / "lessons.py").write_text(LESSONS + "# a word\n")
    with pytest.raises(SocialmindError, match="is not the file that the run was made with"):
        resume(begun)
    (model / "lessons.py").write_text(LESSONS)
    manifest = json.loads((begun / "manifest.json").read_text())
    manifest["versions"]["socialmind"] = "0.0.1"
    (begun / "manifest.json").write_text(json.dumps(manifest))
    with pytest.raises(SocialmindError, match=r"made by socialmind 0\.0\.1"):
        resume(begun)


def test_a_model_as_a_class_of_any_file(three, slopes, tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(MODEL)
    folder = learn(load_file(path).Empty, three, out=tmp_path / "out")
    assert Training(folder).manifest.model["path"] == str(path)
    assert digest(resume(folder, lessons=three)) == digest(folder)
    path.write_text(MODEL + "# a word\n")
    with pytest.raises(SocialmindError, match=r"mine\.py: is not the file"):
        resume(folder, lessons=three)


def test_a_lesson_alone_begins_from_the_mind_as_given(model, robot, tmp_path):
    with pytest.raises(ModelError, match="skill 'Go' below 'Top', which has no weights yet"):
        learn(model, "Top", out=tmp_path / "none")
    assert not (tmp_path / "none").exists()
    able = robot.with_modules(
        skills=[robot.skill(one).changed(genome=np.ones(size)) for one, size in
                (("Go", 6), ("Turn", 4))]
    )  # fmt: skip
    able.save(tmp_path / "able")
    folder = learn(model, "Top", mind=tmp_path / "able", out=tmp_path / "top")
    mind = Training(folder).mind()
    assert (mind.skill("Go").genome == 1.0).all()
    assert mind.skill("Top").genome is not None


def test_lessons_of_files_beside_the_model(model, tmp_path):
    tasks = model / "mind" / "Tasks"
    tasks.mkdir()
    (tasks / "Turning.simbatch").write_text(
        "TYPE:LEARN2DSIM\nENV:Slope\nMASTERSKILL:Turn\nLEARNINGSKILL:Turn\nNUMGEN:3\n"
        "POPULATION:8\nFINALS:2\n"
    )
    folder = learn(model, str(tasks / "Turning.simbatch"), out=tmp_path / "out")
    assert Training(folder).curve["lesson"].tolist() == ["Turning"] * 3
    assert digest(resume(folder)) == digest(folder)
    both = learn(model, ["mind/Tasks/Turning.simbatch", "Go"], out=tmp_path / "both")
    assert set(Training(both).curve["lesson"]) == {"Turning", "Go"}
    (tasks / "Turning.simbatch").write_text("TYPE:LEARN2DSIM\nENV:Slop\nLEARNINGSKILL:Turn\n")
    with pytest.raises(ModelError, match="did you mean 'Slope'"):
        learn(model, str(tasks / "Turning.simbatch"))


def test_other_optimisers_and_settings_than_the_lessons_own(model, tmp_path):
    changes = {"optimiser": "annealing", "settings": {"neighbours": 3}, "generations": 2}
    folder = learn(model, "Go", out=tmp_path / "out", **changes)
    (record,) = Training(folder).manifest.lessons
    assert (record["optimiser"], record["generations"]) == ("ANNEALING", 2)
    assert record["settings"]["neighbours"] == 3
    assert digest(resume(folder)) == digest(folder)
    fewer = learn(model, "Go", out=tmp_path / "fewer", settings={"population": 7}, generations=1)
    (record,) = Training(fewer).manifest.lessons
    assert (record["optimiser"], record["settings"]["population"]) == ("GENETIC", 7)


def test_a_broken_environment_leaves_a_folder_that_says_so(lesson, robot, slopes, tmp_path):
    broken = Curriculum([lesson("Go").changed(environment=slopes.Broken)], mind=robot)
    with pytest.raises(ModelError, match="no finite numbers"):
        learn(None, broken, out=tmp_path / "out")
    manifest = Training(tmp_path / "out").manifest
    assert manifest.status == "failed"
    assert "no finite numbers" in manifest.error


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"attempts": 0}, "attempts: found 0; expected a whole number, 1 … "),
        ({"seed": -1}, "seed: found -1"),
        ({"engine": "jet"}, "engine 'jet'; expected compiled or pymunk"),
        ({"mind": "nowhere"}, "nowhere: no such folder"),
        ({"out": "."}, "is not empty"),
    ],
)
def test_wrong_options_are_refused(three, tmp_path, monkeypatch, options, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "something").touch()
    with pytest.raises(SocialmindError) as raised:
        learn(None, three, **options)
    assert said in str(raised.value)


def test_a_folder_is_one_process_s_alone(three, tmp_path):
    folder = tmp_path / "out"
    refused = []

    def meddle(news, left):
        if not refused:
            with pytest.raises(SocialmindError, match="another process is running"):
                resume(folder, lessons=three)
            refused.append(news)

    learn(None, three, out=folder, on_generation=meddle)
    assert refused


def test_outside_the_main_thread(three, tmp_path):
    thread = threading.Thread(target=lambda: learn(None, three, out=tmp_path / "out"))
    thread.start()
    thread.join()
    assert Training(tmp_path / "out").manifest.status == "finished"


def test_an_attempt_reads_where_it_was(three, lesson, robot, tmp_path):
    from socialmind.learning.training.course import TrainingCourse

    folder = learn(None, three, out=tmp_path / "out")
    attempt = Attempt(folder / "attempts" / "1", 1, TrainingCourse(three, robot, 0, "compiled"))
    assert attempt.finished
    assert attempt.done == 3
    assert attempt.seconds > 0.0  # as it was when it was left
