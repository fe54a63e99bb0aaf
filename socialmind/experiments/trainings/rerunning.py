"""Whether a kept attempt comes out again when it is learned once more from its seed.

`recheck` judges the winners that are kept. Here an attempt is trained anew, from nothing, and each
lesson's winner is compared with the kept one: its weights are to be the very same. Where the
training records a commit, of the program that made it or of one that gives the same weights, that
program is taken from the repository's history: an engine that was mended since pays its robots
otherwise, and they learn something else. Lessons that were added later are learned by the program
that added them.
"""

from __future__ import annotations

import csv
import io
import json
import math
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from socialmind.errors import SocialmindError
from socialmind.learning.training import archive
from socialmind.learning.training.attempt import CHECKPOINT, results_of
from socialmind.learning.training.capsule import TrainingManifest, stages_of
from socialmind.learning.training.finalists import individual_of
from socialmind.learning.training.result import Training
from socialmind.runs.arrays_file import save_arrays
from socialmind.runs.folders import INTERRUPTED, MANIFEST
from socialmind.sources.folders import model_folder, source_hash
from socialmind.work.files import emptied, remove, replace_file


class Again(NamedTuple):
    """A kept lesson beside the same trained anew.

    Attributes:
        lesson: its name.
        before: the score that is kept.
        now: what it came to; another one only where the kept one was taken anew (`rescore`).
        commit: of the program that taught it; an empty text where none is recorded.
        apart: the largest difference of a weight; 0 where all are the very same, infinite where
            there are others.
    """

    lesson: str
    before: float
    now: float
    commit: str = ""
    apart: float = 0.0


KERNELS = {
    "znver": "Haswell", "rocketlake": "SkylakeX", "skylake-avx512": "SkylakeX",
    "cascadelake": "SkylakeX", "icelake": "SkylakeX", "sapphirerapids": "SkylakeX",
}  # fmt: skip
"""How the processors that LLVM names compute: by which of OpenBLAS's routines."""
MANY = 10**6
"""Times round a cycle, more than any has."""
LessonResult = tuple[Path, Mapping[str, Any], Mapping[str, Any]]
"""The file of a finished lesson, its record and its arrays."""
COLUMNS = ("training", "attempt", "lesson", "commit", "score", "kept", "apart")
PROGRAM = ("socialmind", "coglogo_py", "models", "analysis")
"""What of a commit a training stands on."""
TRAIN = """
import importlib, sys
from dataclasses import replace
from pathlib import Path

def told(attempt, lesson, result):
    print(f"attempt {attempt}, {lesson.name}: {result.score:.4g}", file=sys.stderr, flush=True)

if __name__ == "__main__":
    module, name, attempt, folder = sys.argv[1:]
    plan = importlib.import_module(module).PLANS[name]
    try:
        replace(plan, attempts=int(attempt)).train(Path(folder), on_lesson=told)
    except KeyboardInterrupt:
        sys.exit(130)
"""
"""Goes on with a training, by whichever program Python finds: so it calls what all of them have."""


def rerun(
    kept: Path,
    module: str,
    attempt: int,
    home: Path,
    note: Callable[[list[Again]], None] = lambda found: None,
) -> list[Again]:
    """Train a kept attempt anew, from its seed, and compare each lesson with the kept one.

    Args:
        kept: the kept training's folder, called as its plan.
        module: that has the plan in its `PLANS`.
        attempt: its number.
        home: where it is trained, in a folder of its own; gone on with where it is begun.
        note: takes the lessons, also where one came to other weights.

    Returns:
        The lessons, each with a winner of the very same weights.

    Raises:
        SocialmindError: no such attempt is kept, the program that it records is not in the
            repository's history, it was stopped, or a lesson came to other weights.
    """
    training = kept_with(kept, attempt)
    manifest = training.manifest
    folder = home / f"{kept.name}-{attempt}"
    stages = stages_of(manifest.versions, attempt, len(manifest.lessons))
    if any(not commit for commit, _ in stages[:-1]):
        raise SocialmindError(
            f"{training.folder}: lessons were added to it, and by which program those before them "
            "were taught is not recorded; they cannot be told apart"
        )
    _put_back(folder)
    for commit, lessons in stages:
        if commit and not re.fullmatch("[0-9a-f]{7,40}", commit):
            raise SocialmindError(f"{training.folder}: the commit {commit!r}; expected its digits")
        begun = len(Training(folder).manifest.lessons) if folder.is_dir() else 0
        if begun > lessons:
            continue
        if begun < lessons:
            _begin(training, attempt, lessons, folder)
        program = _program(commit, home) if commit else Path.cwd()
        _take_source(folder, program)
        words = [module, kept.name, str(attempt), str(folder.absolute())]
        if _trained(program, home, words, kernels_for(manifest.platforms)):
            raise SocialmindError(f"{folder}: not trained to the end; the same command goes on")
    again = Training(folder)
    results = [
        list(results_of(one.folder / "attempts" / str(attempt))) for one in (training, again)
    ]
    pairs = list(zip(*results, strict=False))  # fewer where it is kept in part
    found = [
        Again(
            one[1]["lesson"],
            one[1]["score"],
            two[1]["score"],
            _commit(one[1]["lesson"], manifest, stages),
            _apart(one, two),
        )
        for one, two in pairs
    ]
    note(found)
    if others := [f"{one.lesson} {one.before:.5g} → {one.now:.5g}" for one in found if one.apart]:
        made_on, here = training.manifest.platforms, again.manifest.platforms[-1:]
        raise SocialmindError(
            f"{training.folder}: attempt {attempt} does not come out again: {', '.join(others)}; "
            f"it was made on {_machines(made_on)}, this is {_machines(here)}"
        )
    return found


def kept_with(kept: Path, attempt: int) -> Training:
    """Return a kept training that has an attempt.

    Raises:
        SocialmindError: it is not kept, or has no such attempt.
    """
    training = Training(kept)
    if attempt not in training.attempts:
        known = ", ".join(map(str, training.attempts))
        raise SocialmindError(f"{training.folder}: no attempt {attempt} is kept; expected {known}")
    return training


def write_down(file: Path, name: str, attempt: int, found: Sequence[Again]) -> None:
    """Write what came out again, and what did not, into a table (CSV): a row for each lesson.

    Args:
        file: of the table; rows of this training and attempt are replaced.
        name: of the training.
        attempt: its number.
        found: its lessons.
    """
    rows = [
        {"training": name, "attempt": str(attempt), "lesson": one.lesson, "commit": one.commit,
         "score": repr(one.now), "kept": repr(one.before), "apart": repr(one.apart)}
        for one in found
    ]  # fmt: skip
    if file.is_file():
        with file.open(encoding="utf-8", newline="") as opened:
            before = list(csv.DictReader(opened))
        rows += [one for one in before if (one["training"], one["attempt"]) != (name, str(attempt))]
    rows.sort(key=lambda one: (one["training"], int(one["attempt"])))
    text = io.StringIO(newline="")
    writer = csv.DictWriter(text, COLUMNS, restval="0.0", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    replace_file(file, text.getvalue().encode())


def _commit(lesson: str, manifest: TrainingManifest, stages: Sequence[tuple[str, int]]) -> str:
    """Return the commit of the program that taught a lesson."""
    place = next(
        number
        for number, item in enumerate(manifest.lessons)
        if lesson in [one["name"] for one in item.get("lessons", [item])]
    )
    return next(commit for commit, lessons in stages if place < lessons)


def _begin(training: Training, attempt: int, lessons: int, folder: Path) -> None:
    """Copy a kept training, but of the attempt only what was trained anew, in one step.

    Args:
        training: that is kept.
        attempt: that is trained anew; those behind it are left out.
        lessons: how many its program knows; those before it are through with as many.
        folder: the one to make, or to make anew.
    """
    later = [str(one) for one in training.attempts if one >= attempt]
    made = emptied(folder)
    shutil.copytree(training.folder, made, ignore=lambda path, names: _of(path, later, names))
    if lessons < len(training.manifest.lessons):
        for checkpoint in made.glob(f"attempts/*/{CHECKPOINT}"):
            _let_pass(checkpoint, training.manifest.lessons[:lessons])
    if folder.is_dir():
        own = Path("attempts", str(attempt))
        shutil.copytree(folder / own, made / own)
    manifest = json.loads((made / MANIFEST).read_text(encoding="utf-8"))
    for field in ("plan", "process"):  # whose command and process go on with another folder
        manifest.pop(field, None)
    manifest.update(
        attempts=attempt,
        finished=attempt - 1,
        status=INTERRUPTED,
        lessons=manifest["lessons"][:lessons],
    )
    replace_file(made / MANIFEST, json.dumps(manifest, indent=2).encode())
    before = _aside(folder)
    if folder.is_dir():
        folder.rename(before)
    made.rename(folder)
    if before.is_dir():
        remove(before)


def _take_source(folder: Path, program: Path) -> None:
    """Let a training be of the model as a program has it.

    A kept one may name the model's files of later on, by which its winners were judged again
    (`recheck`); whether it was made by these comes out by the weights.
    """
    manifest = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    model = program / "models" / model_folder(manifest["model"]["name"]).name
    if model.is_dir() and source_hash(model) != manifest["model"]["source_sha256"]:
        manifest["model"]["source_sha256"] = source_hash(model)
        manifest["model"].pop("sources", None)
        replace_file(folder / MANIFEST, json.dumps(manifest, indent=2).encode())


def _aside(folder: Path) -> Path:
    """Return where a folder is put until the one in its place is there."""
    return folder.with_name(f"{folder.name}.before")


def _put_back(folder: Path) -> None:
    """Put a folder back that one who was killed had put aside."""
    before = _aside(folder)
    if before.is_dir():
        if folder.is_dir():
            remove(before)
        else:
            before.rename(folder)


def _let_pass(checkpoint: Path, items: Sequence[Mapping[str, Any]]) -> None:
    """Let an attempt be behind the last of some items of its curriculum, so that none trains it."""
    record, arrays = archive.load(checkpoint)
    names = {one["name"] for item in items for one in item.get("lessons", [item])}
    taught = [told["lesson"] in names for _, told, _ in results_of(checkpoint.parent)]
    last = [len(items) - 1, MANY, len(items[-1].get("lessons", [0])) - 1]
    record = {**record, "position": None, "last": last, "in_hand": None, "done": sum(taught)}
    save_arrays(checkpoint, record, arrays)


def _of(path: str, attempts: list[str], names: list[str]) -> list[str]:
    return [one for one in names if one in attempts] if Path(path).name == "attempts" else []


def _program(commit: str, home: Path) -> Path:
    """Return the folder of the program as it was at a commit, taken from the history."""
    folder = home / f"program-{commit}"
    if not folder.is_dir():
        packed = home / f"{commit}.tar"
        home.mkdir(parents=True, exist_ok=True)
        try:
            subprocess.run(
                ["git", "archive", f"--output={packed}", commit, *PROGRAM],
                check=True, capture_output=True, text=True,
            )  # fmt: skip
        except (OSError, subprocess.CalledProcessError) as error:
            why = str(getattr(error, "stderr", None) or error).strip()
            raise SocialmindError(
                f"its program, of commit {commit}, cannot be had here: {why}; "
                "expected git, and a clone with the whole history"
            ) from error
        made = emptied(folder)
        shutil.unpack_archive(packed, made)
        made.rename(folder)
        packed.unlink()
    return folder


def kernels_for(platforms: Sequence[Mapping[str, str]]) -> dict[str, str]:
    """Return the environment in which OpenBLAS computes as on the machines that led a training.

    It has routines for each kind of processor, which differ in their last bits; through the
    eigenvectors of CMA-ES an attempt then goes another way. Of kinds that `KERNELS` does not know,
    or of several, nothing is asked for.

    >>> kernels_for([{"processor": "znver5"}]), kernels_for([{"processor": "znver5"}, {}])
    ({'OPENBLAS_CORETYPE': 'Haswell'}, {})
    """
    names = [one.get("processor", "") for one in platforms]
    cores = {core for kind, core in KERNELS.items() for one in names if one.startswith(kind)}
    known = all(one.startswith(tuple(KERNELS)) for one in names)
    return {"OPENBLAS_CORETYPE": cores.pop()} if known and len(cores) == 1 else {}


def _trained(program: Path, home: Path, words: list[str], kernels: Mapping[str, str]) -> int:
    """Go on with a training by another process; return its exit status."""
    script = home / "train.py"
    script.write_text(TRAIN, encoding="utf-8")
    path = os.pathsep.join([str(program.absolute()), os.environ.get("PYTHONPATH", "")])
    with subprocess.Popen(
        [sys.executable, str(script.absolute()), *words],
        cwd=program,
        env={**kernels, **os.environ, "PYTHONPATH": path},
    ) as process:
        try:
            return process.wait()
        except KeyboardInterrupt:  # which the other one has heard as well, and stops by
            return process.wait() or 130


def _apart(before: LessonResult, now: LessonResult) -> float:
    """Return how far the weights of a lesson's winners are apart; 0 where both are one."""
    one, other = (individual_of(archive.part(arrays, "winner/")) for _, _, arrays in (before, now))
    if one.same(other):
        return 0.0
    differ = one.genome.shape == other.genome.shape and one.graph == other.graph
    return float(np.abs(one.genome - other.genome).max()) if differ else math.inf


def _machines(platforms: list[dict[str, Any]]) -> str:
    return ", ".join(" ".join(map(str, one.values())) for one in platforms)
