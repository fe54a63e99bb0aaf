"""Training a kept attempt anew, from its seed."""

import csv
import json
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.trainings import rerunning
from socialmind.experiments.trainings.rerunning import PROGRAM, Again, rerun, write_down
from socialmind.experiments.trainings.store import differences, keep, take_out
from socialmind.learning import Training
from socialmind.learning.training import archive, execution
from socialmind.learning.training.capsule import commit_of
from socialmind.runs.arrays_file import save_arrays

PLANS = "analysis.tiny_trainings"
MODULE = "from analysis.tiny_plans import PLAN\n\nPLANS = {'tiny': PLAN}\n"


@pytest.fixture
def kept(whole, tmp_path, monkeypatch):
    """A kept training beside the module that has its plan, in the folder that one works in."""
    for name in PROGRAM:
        (tmp_path / name).mkdir()
        (tmp_path / name / "kept").write_text("so that it is in a commit")
    text = Path(__file__).with_name("tiny_plans.py").read_text()
    controls = Path(__file__).parents[3] / "analysis" / "collect" / "controls.py"
    text = "\n".join(
        f"CONTROLS = {str(controls)!r}" if line.startswith("CONTROLS") else line
        for line in text.splitlines()
    )
    (tmp_path / "analysis" / "tiny_plans.py").write_text(text)
    (tmp_path / "analysis" / "tiny_trainings.py").write_text(MODULE)
    monkeypatch.chdir(tmp_path)
    folder = keep(whole, tmp_path / "kept")
    edited(folder / "manifest.json", commit=None)
    return folder


def edited(path, commit):
    """Say which commit a training was made with."""
    manifest = json.loads(path.read_text())
    manifest["versions"].pop("commit", None)
    if commit is not None:
        manifest["versions"]["commit"] = commit
    path.write_text(json.dumps(manifest))


def changed(kept, weights=0.0, **record):
    """Change what is kept of the second attempt's second lesson: its score, or its weights."""
    path = kept / "attempts" / "2" / "lesson-002.npz"
    told, arrays = archive.load(path)
    arrays = {**arrays, "winner/genome": arrays["winner/genome"] + weights}
    save_arrays(path, {**told, **record}, arrays)


def test_an_attempt_comes_out_again_by_itself(kept, tmp_path):
    found = rerun(kept, PLANS, 2, tmp_path / "rerun")
    scores = Training(kept).lessons["score"].tolist()[2:]
    assert found == [Again("GoToObject", scores[0], scores[0]),
                     Again("GoToDropZone", scores[1], scores[1])]  # fmt: skip
    again = Training(tmp_path / "rerun" / "tiny-2")
    assert again.finished == [1, 2]
    assert again.manifest.command is None  # the plan's own command goes on with another folder


def test_what_comes_out_differently_is_told(kept, tmp_path):
    changed(kept, score=9.5)  # as if it had been scored anew
    assert rerun(kept, PLANS, 2, tmp_path / "rerun")[1].before == 9.5
    changed(kept, weights=0.5)
    noted = []
    with pytest.raises(SocialmindError, match=r"again: GoToDropZone 9\.5 → .*; it was made on L"):
        rerun(kept, PLANS, 2, tmp_path / "rerun", noted.extend)
    # What came out otherwise is noted too, and by how much.
    assert [one.apart for one in noted] == [0.0, pytest.approx(0.5)]
    table = tmp_path / "reruns.csv"
    table.write_text("training,attempt,lesson,commit,score,kept\nother,1,Going,,1.0,1.0\n")
    write_down(table, "tiny", 2, noted)
    rows = list(csv.DictReader(table.open()))
    assert [(row["training"], float(row["apart"])) for row in rows] == [
        ("other", 0.0), ("tiny", 0.0), ("tiny", pytest.approx(0.5)),
    ]  # fmt: skip


def test_of_an_attempt_kept_in_part_the_finished_lessons_are_compared(kept, tmp_path):
    folder = kept / "attempts" / "1"
    record, arrays = archive.load(folder / "checkpoint.npz")
    (folder / "lesson-002.npz").unlink()
    save_arrays(folder / "checkpoint.npz", {**record, "done": 1}, arrays)
    assert rerun(kept, PLANS, 1, tmp_path / "rerun")[0].lesson == "GoToObject"


def git(*words):
    who = ("-c", "user.name=a", "-c", "user.email=a@b")
    done = subprocess.run(["git", *who, *words], check=True, capture_output=True, text=True)
    return done.stdout.strip()


def test_the_program_of_the_commit_that_made_it_trains(kept, tmp_path):
    git("init", "--quiet")
    git("add", *PROGRAM)
    git("commit", "--quiet", "--message", "Begin")
    edited(kept / "manifest.json", commit=git("rev-parse", "--short", "HEAD"))
    (tmp_path / "analysis" / "tiny_trainings.py").write_text("raise RuntimeError('of today')\n")
    assert len(rerun(kept, PLANS, 1, tmp_path / "rerun")) == 2
    edited(kept / "manifest.json", commit=None)
    shutil.rmtree(tmp_path / "rerun")
    with pytest.raises(SocialmindError, match="not trained to the end; the same command goes on"):
        rerun(kept, PLANS, 1, tmp_path / "rerun")


def test_lessons_that_were_added_are_learned_by_the_program_that_added_them(
    kept, tmp_path, tiny_plans
):
    def of_now(words):
        (tmp_path / "analysis" / "tiny_trainings.py").write_text(
            f"from analysis.tiny_plans import PLAN, tiny\n\nPLANS = {{'tiny': {words}}}\n"
        )
        git("add", *PROGRAM)
        git("commit", "--quiet", "--message", words)
        return git("rev-parse", "--short", "HEAD")

    git("init", "--quiet")
    first = of_now("PLAN")
    second = of_now("tiny('GoToObject', 'GoToDropZone', 'Avoid')")
    edited(kept / "manifest.json", commit=first)
    more = tiny_plans.tiny("GoToObject", "GoToDropZone", "Avoid")
    longer = tmp_path / "tiny"
    assert take_out(kept, longer)
    more.train(longer, workers=1)
    manifest = json.loads((longer / "manifest.json").read_text())
    manifest["versions"]["commit from lesson 3 to attempt 2"] = second
    (longer / "manifest.json").write_text(json.dumps(manifest))
    assert differences(Training(kept), more) == ["the lessons"]
    keep(longer, kept.parent)
    assert differences(Training(kept), more) == []
    before = {
        one: (kept / one).read_bytes() for one in ("manifest.json", "attempts/1/checkpoint.npz")
    }
    found = rerun(kept, PLANS, 2, tmp_path / "rerun")
    assert [one.commit for one in found] == [first, first, second]
    assert [one.lesson for one in found] == ["GoToObject", "GoToDropZone", "Avoid"]
    assert {one: (kept / one).read_bytes() for one in before} == before
    assert [one.lesson for one in rerun(kept, PLANS, 2, tmp_path / "rerun")] == [
        one.lesson for one in found
    ]


def test_of_a_training_with_added_lessons_earlier_attempts_are_let_pass(
    kept, tmp_path, tiny_plans, monkeypatch
):
    """Also one that is kept in the middle of them; and one who is killed loses nothing."""
    longer = tmp_path / "tiny"
    assert take_out(kept, longer)
    tiny_plans.tiny("GoToObject", "GoToDropZone", "Avoid").train(longer, workers=1)
    keep(longer, kept.parent)
    first = kept / "attempts" / "1" / "checkpoint.npz"
    record, arrays = archive.load(first)
    middle = {**record, "position": [2, 1, 0], "last": None, "done": 2}
    save_arrays(first, middle, arrays)
    trained = []

    def train(program, home, words, kernels):
        folder = Path(words[-1])
        manifest = Training(folder).manifest
        plan = tiny_plans.tiny(*[one["name"] for one in manifest.lessons])
        plan.train(folder, workers=1, on_lesson=lambda *told: trained.append(told[:2]))
        return 0

    monkeypatch.setattr(rerunning, "_trained", train)
    monkeypatch.setattr(rerunning, "_program", lambda commit, home: home)
    manifest = json.loads((kept / "manifest.json").read_text())
    manifest["versions"] |= {"commit": "a" * 7, "commit from lesson 3 to attempt 2": "b" * 7}
    (kept / "manifest.json").write_text(json.dumps(manifest))
    monkeypatch.setattr(rerunning, "remove", lambda path: pytest.fail("killed"))
    with pytest.raises(pytest.fail.Exception):
        rerun(kept, PLANS, 2, tmp_path / "rerun")
    monkeypatch.setattr(rerunning, "remove", shutil.rmtree)
    assert [one.commit[:1] for one in rerun(kept, PLANS, 2, tmp_path / "rerun")] == ["a", "a", "b"]
    names = [(attempt, lesson.name) for attempt, lesson in trained]
    assert [one for one in names if one[0] == 2] == [
        (2, "GoToObject"), (2, "GoToDropZone"), (2, "Avoid"),
    ]  # fmt: skip
    assert (1, "GoToObject") not in names
    assert not list((tmp_path / "rerun").glob("*.before"))


def test_a_training_that_was_rechecked_is_trained_by_the_model_of_its_program(kept, tmp_path):
    """The hash that is kept is then of other files than those of the commit."""
    shutil.copytree(rerunning.model_folder("collect"), tmp_path / "models" / "collect")
    with (tmp_path / "models" / "collect" / "lessons.py").open("a") as file:
        file.write("# a word\n")
    folder = shutil.copytree(kept, tmp_path / "rerun" / "tiny-1")
    rerunning._take_source(folder, tmp_path)
    model = Training(folder).manifest.model
    assert model["source_sha256"] == rerunning.source_hash(tmp_path / "models" / "collect")
    assert model["source_sha256"] != Training(kept).manifest.model["source_sha256"]
    assert "sources" not in model


def test_lessons_of_unknown_programs_before_added_ones_are_not_trained_anew(kept, tmp_path):
    manifest = json.loads((kept / "manifest.json").read_text())
    manifest["versions"]["commit from lesson 2 to attempt 2"] = "8e6425c"
    (kept / "manifest.json").write_text(json.dumps(manifest))
    with pytest.raises(SocialmindError, match="by which program those before them"):
        rerun(kept, PLANS, 2, tmp_path / "rerun")


def test_a_training_records_by_which_program_each_attempt_was_begun(
    tiny_plans, tmp_path, monkeypatch
):
    plan = tiny_plans.tiny("GoToObject", generations=1)
    commits = iter(["3d4ad57", "8e6425c", "8e6425c"])
    monkeypatch.setattr(execution, "own_commit", lambda: next(commits))
    for attempts in (1, 2, 3):
        replace(plan, attempts=attempts).train(tmp_path / "tiny", workers=1)
    versions = Training(tmp_path / "tiny").manifest.versions
    assert [commit_of(versions, attempt) for attempt in (1, 2, 3)] == [
        "3d4ad57", "8e6425c", "8e6425c",
    ]  # fmt: skip
    assert "commit from attempt 3" not in versions


def test_a_commit_that_is_not_in_the_history_is_told(kept, tmp_path):
    edited(kept / "manifest.json", commit="0123456789")
    with pytest.raises(SocialmindError, match="of commit 0123456789, cannot be had here"):
        rerun(kept, PLANS, 1, tmp_path / "rerun")


def test_what_is_no_commit_is_not_given_to_git(kept, tmp_path):
    edited(kept / "manifest.json", commit="--remote=elsewhere")
    with pytest.raises(SocialmindError, match="the commit '--remote=elsewhere'; expected its dig"):
        rerun(kept, PLANS, 1, tmp_path / "rerun")


def test_what_a_killed_one_had_begun_to_copy_is_made_anew(kept, tmp_path):
    begun = tmp_path / "rerun" / "tiny-1.begun"
    begun.mkdir(parents=True)
    (begun / "manifest.json").write_text("half")
    assert len(rerun(kept, PLANS, 1, tmp_path / "rerun")) == 2
    assert not begun.exists()


def test_an_attempt_that_is_not_there_is_refused(kept, tmp_path):
    with pytest.raises(SocialmindError, match="no attempt 3 is kept; expected 1, 2"):
        rerun(kept, PLANS, 3, tmp_path / "rerun")
