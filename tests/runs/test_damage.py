"""Folders that hands or disks have damaged: all comes out right, or one line and nothing changed.

A few of many kinds of damage a time; which, the date says, or SOCIALMIND_FUZZ_SEED.
"""

import datetime
import importlib.util
import json
import os
import random
import shutil
import zipfile
from pathlib import Path

import numpy as np
import pytest

from coglogo_py.border.errors import CogLogoError
from socialmind.errors import SocialmindError
from socialmind.experiments import Interrupted, Run, replay, resume, run
from socialmind.runs import loop
from socialmind.runs.capsule import Capsule
from socialmind.runs.checkpoint import Checkpoint
from socialmind.runs.tables.files import content_of

SPEC = importlib.util.spec_from_file_location("damage", Path(__file__).parent / "damage.py")
damage = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(damage)

SEED = os.environ.get("SOCIALMIND_FUZZ_SEED") or datetime.datetime.now(datetime.UTC).date()
ROUNDS = 60
TABLES = ("series.parquet", "agents.parquet")


@pytest.fixture(scope="module")
def folders(drifters, tmp_path_factory):
    """A finished run and one that was stopped, of the same length."""
    home = tmp_path_factory.mktemp("runs")
    options = {"seed": 3, "every": 2, "agents_every": 6}
    run(drifters, 60, out=home / "whole", **options)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(loop, "CHECKPOINT_COST", 0.0)
        patch.setattr(loop, "PROGRESS_SECONDS", 0.0)
        patch.setattr(loop, "CHUNK_SECONDS", 1e-9)

        def stop(tick, length):
            if tick == 42:
                os.kill(os.getpid(), 2)

        with pytest.raises(Interrupted):
            run(drifters, 60, out=home / "half", checkpoint_every=0, on_progress=stop, **options)
    return home


def use(folder, drifters):
    """All that can be asked of a folder: each answers rightly, or in one line changing nothing."""
    tasks = [
        lambda: (Run(folder).series, Run(folder).agents, Run(folder).schemes, Run(folder).minds),
        lambda: replay(folder, drifters),
        lambda: resume(folder, model_class=drifters),
    ]
    before = damage.digest(folder)
    for number, task in enumerate(tasks):
        try:
            task()
        except (SocialmindError, CogLogoError, OSError) as error:
            assert "\n" not in str(error)
            assert not any(word in str(error) for word in ("flatbuffers", "Protocol", "magic"))
            assert damage.digest(folder) == before
        else:
            if number == 2:
                return True
    return False


def test_a_damaged_folder_is_refused_in_one_line_or_comes_out_right(folders, drifters, tmp_path):
    rng = random.Random(str(SEED))
    for number in range(ROUNDS):
        name = rng.choice(["whole", "half"])
        folder, elsewhere = tmp_path / str(number), tmp_path / f"elsewhere-{number}"
        shutil.copytree(folders / name, folder)
        elsewhere.mkdir()
        manifest = folder / "manifest.json"
        if rng.random() < 0.5:
            path = rng.choice(damage.files_of(folder))
            how = rng.choice(damage.HARMS)
            damage.harm_file(path, how, rng, elsewhere)
            told = f"{SEED}: {name}/{path.relative_to(folder)}: {how}"
            lasting = True
        else:
            places = damage.fields_of(json.loads(manifest.read_text()))
            # The stand-in does not check its parameters, as models do.
            place = rng.choice([one for one in places if one[0] != "parameters"])
            value = rng.choice([damage.harm_record, *damage.VALUES])
            damage.harm_record(manifest, place, value)
            told = f"{SEED}: {name}: {place} = {value!r}"
            lasting = place[0] not in ("ticks", "model")
        try:
            done = use(folder, drifters)
            if done and lasting:
                for table in TABLES:
                    same = content_of(folder / table) == content_of(folders / "whole" / table)
                    assert same, table
        except BaseException as error:
            error.add_note(told)
            raise


@pytest.mark.parametrize("how", damage.HARMS)
def test_a_part_that_is_not_the_runs_is_seen_before_anything_is_written(
    folders, drifters, tmp_path, how
):
    shutil.copytree(folders / "half", tmp_path / "run")
    part = sorted((tmp_path / "run/parts").iterdir())[3]
    (tmp_path / "elsewhere").mkdir()
    damage.harm_file(part, how, random.Random(1), tmp_path / "elsewhere")
    before = damage.digest(tmp_path / "run")
    with pytest.raises(SocialmindError, match=part.name):
        resume(tmp_path / "run", model_class=drifters)
    assert damage.digest(tmp_path / "run") == before


@pytest.mark.parametrize(
    ("place", "value", "said"),
    [
        (("schemes",), {"humans": {}}, "schemes.humans.file: found nothing; expected a name"),
        (("tables", "series", "sha256"), damage.harm_record, "series.sha256: found nothing"),
        (("seed",), "3", "seed: found '3'; expected a whole number, 0 … 2**64 - 1"),
        (("seed",), 2**64, "seed: found 18446744073709551616; expected"),
        (("every",), 0, "every: found 0; expected a whole number, 1 or more"),
        (("status",), "done", "status: found 'done'; expected running or interrupted or failed"),
        (("ticks_done",), 61, "ticks_done: found 61; expected a whole number, 0 … 60"),
        (("model", "path"), "a\0b", "model.path: found 'a\\x00b'; expected a path, or null"),
        (("minds",), [], "minds: found []; expected a record of fields"),
        (
            ("schemes",),
            {"humans": {"name": "x", "file": "../x.yaml", "sha256": "0" * 64}},
            "schemes.humans.file: found '../x.yaml'; expected a name within the folder",
        ),
    ],
)
def test_a_manifest_is_checked_as_a_whole(folders, drifters, tmp_path, place, value, said):
    shutil.copytree(folders / "whole", tmp_path / "run")
    damage.harm_record(tmp_path / "run/manifest.json", place, value)
    with pytest.raises(SocialmindError) as caught:
        Run(tmp_path / "run")
    assert said in str(caught.value)


def test_a_seed_changed_by_hand_does_not_go_on(folders, drifters, tmp_path):
    shutil.copytree(folders / "half", tmp_path / "run")
    damage.harm_record(tmp_path / "run/manifest.json", ("seed",), 4)
    with pytest.raises(SocialmindError, match=r"its seed, parameters or schemes are not those"):
        resume(tmp_path / "run", model_class=drifters)


def test_a_changed_table_is_not_read_nor_made_longer(folders, drifters, tmp_path):
    shutil.copytree(folders / "whole", tmp_path / "run")
    other = tmp_path / "other"
    run(drifters, 60, seed=4, every=2, agents_every=6, out=other)
    shutil.copy(other / "series.parquet", tmp_path / "run")
    for task in (lambda: Run(tmp_path / "run").series, lambda: resume(tmp_path / "run", 70)):
        with pytest.raises(SocialmindError, match="is not the table that the run wrote"):
            task()


def test_a_checkpoint_of_before_knows_no_hashes_and_goes_on(folders, drifters, tmp_path):
    shutil.copytree(folders / "half", tmp_path / "run")
    checkpoint = Checkpoint.load(tmp_path / "run/checkpoint.npz")
    record = {
        name: getattr(checkpoint, name)
        for name in ("tick", "recorded", "parts", "idle", "loop_seconds", "seconds")
    }
    arrays = {f"state/{name}": array for name, array in checkpoint.state.items()}
    np.savez(tmp_path / "run/checkpoint.npz", checkpoint=np.array(json.dumps(record)), **arrays)
    resume(tmp_path / "run", model_class=drifters)
    for table in TABLES:
        assert content_of(tmp_path / "run" / table) == content_of(folders / "whole" / table)


def test_parts_in_another_order_are_no_checkpoint(folders, tmp_path):
    shutil.copytree(folders / "half", tmp_path / "run")
    path = tmp_path / "run/checkpoint.npz"
    checkpoint = Checkpoint.load(path)
    checkpoint.parts["series"].reverse()
    checkpoint.save(path)
    with pytest.raises(SocialmindError, match="its parts of series are not numbered"):
        Checkpoint.load(path)


def test_a_file_that_unfolds_to_more_than_it_can_hold_is_not_unfolded(folders, tmp_path):
    shutil.copytree(folders / "half", tmp_path / "run")
    with zipfile.ZipFile(tmp_path / "run/checkpoint.npz", "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("bomb.npy", bytes(200_000_000))
    with pytest.raises(SocialmindError, match="it claims to hold 200,000,000 bytes"):
        Run(tmp_path / "run").series  # noqa: B018


def test_what_was_left_unfinished_is_not_written_through(folders, drifters, tmp_path):
    """A link where a file is about to be written leads nowhere."""
    shutil.copytree(folders / "half", tmp_path / "run")
    theirs = tmp_path / "theirs"
    theirs.write_text("precious")
    for name in ("manifest.json.partial", "checkpoint.npz.partial", "series.parquet.partial"):
        (tmp_path / "run" / name).symlink_to(theirs)
    resume(tmp_path / "run", model_class=drifters)
    assert theirs.read_text() == "precious"


@pytest.mark.parametrize("kind", ["a folder", "a link"])
def test_the_lock_is_a_file(folders, drifters, tmp_path, kind):
    shutil.copytree(folders / "half", tmp_path / "run")
    lock = tmp_path / "run/.lock"
    lock.unlink(missing_ok=True)
    if kind == "a folder":
        lock.mkdir()
    else:
        lock.symlink_to(tmp_path / "run/manifest.json")
    before = (tmp_path / "run/manifest.json").read_bytes()
    with pytest.raises(SocialmindError, match="expected the file of a lock; remove it"):
        resume(tmp_path / "run", model_class=drifters)
    assert (tmp_path / "run/manifest.json").read_bytes() == before
    assert Capsule(tmp_path / "run").manifest.status == "interrupted"
