"""Trainings' folders that hands or disks have damaged: right, or one line and nothing changed."""

import datetime
import json
import os
import random
import shutil
import signal
from pathlib import Path

import pytest

from coglogo_py.border.errors import CogLogoError
from socialmind.errors import SocialmindError
from socialmind.learning import Curriculum, Training, learn, resume
from socialmind.learning.training.capsule import TrainingCapsule
from socialmind.learning.training.continuing import check_folder
from socialmind.mind.files.layout import layout_file
from socialmind.sources.loading import load_file

damage = load_file(Path(__file__).parents[2] / "runs/damage.py")
SEED = os.environ.get("SOCIALMIND_FUZZ_SEED") or datetime.datetime.now(datetime.UTC).date()
ROUNDS = int(os.environ.get("SOCIALMIND_FUZZ_ROUNDS", "40"))


@pytest.fixture(scope="module")
def curriculum(slopes, robot):
    from socialmind.learning import Lesson

    few = {"generations": 2, "repetitions": 2, "finals": 3, "settings": {"population": 6}}
    return Curriculum([Lesson(name, slopes.Slope, **few) for name in ("Go", "Turn")], mind=robot)


@pytest.fixture(scope="module")
def folders(curriculum, tmp_path_factory):
    """A finished training, and it as it stood in its second lesson."""
    home = tmp_path_factory.mktemp("trainings")

    def keep(news, left):
        if (news.lesson.name, news.generation) == ("Turn", 1):
            shutil.copytree(home / "whole", home / "half")

    learn(None, curriculum, seed=3, out=home / "whole", workers=1, on_generation=keep)
    return home


@pytest.fixture(scope="module")
def wanted(folders):
    return load_file(Path(__file__).parents[1] / "slopes.py").digest(folders / "whole")


def use(folder, curriculum):
    """All that can be asked of a folder; whether it went on."""

    def read():
        training = Training(folder)
        return training.finished, training.curve, training.lessons, training.mind()

    before = damage.digest(folder)
    for task in (read, lambda: resume(folder, lessons=curriculum, workers=1)):
        try:
            task()
            done = True
        except (SocialmindError, CogLogoError, OSError) as error:
            assert "\n" not in str(error)
            assert damage.digest(folder) == before
            done = False
    return done


def test_a_damaged_folder_is_refused_in_one_line_or_comes_out_right(
    folders, curriculum, wanted, tmp_path
):
    rng = random.Random(str(SEED))
    digest = load_file(Path(__file__).parents[1] / "slopes.py").digest
    for number in range(ROUNDS):
        name = rng.choice(["whole", "half"])
        folder, elsewhere = tmp_path / str(number), tmp_path / f"elsewhere-{number}"
        shutil.copytree(folders / name, folder)
        elsewhere.mkdir()
        manifest = folder / "manifest.json"
        lasting = True
        if rng.random() < 0.6:
            files = [path for path in damage.files_of(folder) if "figures" not in path.parts]
            path, how = rng.choice(files), rng.choice(damage.HARMS)
            damage.harm_file(path, how, rng, elsewhere)
            told = f"{SEED}: {name}/{path.relative_to(folder)}: {how}"
        else:
            place = rng.choice(list(damage.fields_of(json.loads(manifest.read_text()))))
            value = rng.choice([damage.harm_record, *damage.VALUES])
            damage.harm_record(manifest, place, value)
            told = f"{SEED}: {name}: {place} = {value!r}"
            lasting = place[0] in ("error", "curve", "status", "finished", "timings", "platforms")
        try:
            if use(folder, curriculum) and lasting:
                assert digest(folder) == wanted
        except BaseException as error:
            error.add_note(told)
            raise


def test_another_mind_than_it_began_from_is_seen(folders, curriculum, tmp_path):
    shutil.copytree(folders / "half", tmp_path / "run")
    path = next(one for one in sorted((tmp_path / "run/mind").rglob("*")) if one.is_file())
    layout_file(tmp_path / "run/mind").write_text("SKILLS\nGo:1:2\n")
    check_folder(TrainingCapsule(tmp_path / "run"), curriculum)  # boxes elsewhere: the same mind
    path.write_bytes(path.read_bytes() + b"\n")
    before = damage.digest(tmp_path / "run")
    with pytest.raises(SocialmindError, match="copy of the mind that it began from"):
        resume(tmp_path / "run", lessons=curriculum)
    assert damage.digest(tmp_path / "run") == before


@pytest.mark.skipif(not hasattr(signal, "SIGXFSZ"), reason="no limit of files here")
@pytest.mark.parametrize("room", [100, 1_000])
def test_a_full_disk_stops_a_training_that_goes_on_when_there_is_room(
    curriculum, wanted, slopes, tmp_path, room
):
    import resource

    out = tmp_path / "training"
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)

    def fill(news, left):
        if news.lesson.name == "Turn":
            resource.setrlimit(resource.RLIMIT_FSIZE, (room, hard))

    try:
        with pytest.raises(SocialmindError, match=r"File too large at attempt 1; .* --resume$"):
            learn(None, curriculum, seed=3, out=out, workers=1, on_generation=fill)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert not list(out.rglob("*.partial"))
    resume(out, lessons=curriculum, workers=1)
    assert slopes.digest(out) == wanted
