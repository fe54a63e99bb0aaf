"""Learning into a folder, and going on with it: the attempts of a training, one after the other."""

from __future__ import annotations

import os
import platform
import signal
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError
from socialmind.learning.episodes.evaluation import COMPILED, PYMUNK
from socialmind.learning.episodes.evaluators import Evaluators
from socialmind.learning.lessons.curriculum import Curriculum, Cycle
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.training import continuing
from socialmind.learning.training.attempt import Attempt, News
from socialmind.learning.training.capsule import (
    MIND,
    TrainingCapsule,
    TrainingManifest,
    with_commit,
)
from socialmind.learning.training.course import SIMBATCH, TrainingCourse, curriculum_of, mind_of
from socialmind.learning.training.curve import draw_curve, read_curve, write_curve
from socialmind.learning.training.forecast import Forecast
from socialmind.learning.training.pausing import Asked, requests
from socialmind.learning.training.teaching import Result
from socialmind.learning.training.telling import OnGeneration, told_of_generations
from socialmind.mind.description import MindDescription
from socialmind.mind.files.packing import files_of
from socialmind.model import Model
from socialmind.runs import folders
from socialmind.runs.execution import whole
from socialmind.runs.loop import NO_ROOM, no_room
from socialmind.runs.sources import model_source
from socialmind.sources.commit import own_commit
from socialmind.sources.trust import programs_in, remember, require
from socialmind.work.files import remove
from socialmind.work.signals import deferred_signals
from socialmind.work.workers import Stopped, hired

OnLesson = Callable[[int, Lesson, Result], None]


class TrainingInterrupted(KeyboardInterrupt):
    """A training was stopped or paused; its folder stands and can be gone on with.

    Args:
        folder: the training's.
        attempt: the attempt in hand.
        lesson: the lesson in hand.
        generation: how many of its generations are safe.
        signal_number: what stopped it; that of Ctrl-C where somebody asked for a pause.
        asker: who asked for a pause (`socialmind.learning.pause`); None for a signal.

    Attributes:
        where: what happened in which generation, without how to go on.
    """

    def __init__(
        self,
        folder: Path,
        attempt: int,
        lesson: str,
        generation: int,
        signal_number: int,
        asker: str | None = None,
    ) -> None:
        stopped = "stopped" if asker is None else f"paused by {asker}"
        self.where = f"{stopped} in attempt {attempt}, {lesson}, after generation {generation:,}"
        super().__init__(f"{self.where}; resume({str(folder)!r}) goes on")
        self.folder = folder
        self.attempt = attempt
        self.lesson = lesson
        self.generation = generation
        self.signal_number = signal_number
        self.asker = asker


def learn(
    model: str | Path | type[Model] | None,
    lessons: Any = None,
    mind: str | Path | MindDescription | None = None,
    attempts: int = 1,
    seed: int = 0,
    out: str | Path | None = None,
    engine: str = COMPILED,
    optimiser: str | None = None,
    settings: Mapping[str, float] | None = None,
    generations: int | None = None,
    budget: int | None = None,
    cycles: int | None = None,
    workers: int | None = None,
    cluster: str | None = None,
    on_generation: OnGeneration | None = None,
    on_lesson: OnLesson | None = None,
    progress: bool | None = None,
    plan: Mapping[str, str] | None = None,
) -> Path:
    """Teach a mind a curriculum, into a folder of its own.

    Args:
        model: a model's name or folder, or its class; None where the lessons say all.
        lessons: a `Curriculum`, a `Lesson` or several; or names of the model's lessons or the name
            of one of its curricula, or paths of `.simbatch` files. By default the model's whole
            curriculum, the first where it has several.
        mind: the mind to begin from; by default the curriculum's, or that of the model's robots.
        attempts: how many independent attempts, 1 or more.
        seed: of every draw, 0 … 2**64 − 1.
        out: folder to make, or an empty one; by default the next number under ``trainings/``.
        engine: `compiled` or `pymunk`.
        optimiser: in place of the lessons' own; their settings do not go over to another one.
        settings: of the optimisers, in place of the lessons' own, by name.
        generations: of each lesson, in place of the lessons' own.
        budget: ticks after which no other generation of a lesson begins; of a cycle, those of all
            its lessons together.
        cycles: how often cycles go round.
        workers: how many evaluate side by side; one for each processor by default.
        cluster: the address of a Dask scheduler, whose workers evaluate then.
        on_generation: called after each generation with its `News` and the seconds left, if they
            are known.
        on_lesson: called after each lesson with the attempt, the lesson and its `Result`.
        progress: whether a line tells of each generation; by default in notebooks and on
            terminals, unless `on_generation` is given.
        plan: ``module`` and ``name`` of the study's plan that it is of, if it is of one.

    Returns:
        The training's folder.

    Raises:
        SocialmindError: lessons and mind do not fit together, a folder in use, …
        TrainingInterrupted: Ctrl-C, or a `pause`; all but the generation in hand is safe, `resume`
            goes on.
    """
    attempts = whole("attempts", attempts, 1)
    generations, budget, cycles = (
        None if value is None else whole(name, value, 1)
        for name, value in (("generations", generations), ("budget", budget), ("cycles", cycles))
    )
    seed = whole("seed", seed, 0, 2**64 - 1)
    if engine not in (COMPILED, PYMUNK):
        raise SocialmindError(f"engine {engine!r}; expected {COMPILED} or {PYMUNK}")
    target = None if out is None else Path(out)
    if target is not None:
        folders.refuse_unless_free(target.expanduser())
    curriculum, folder = curriculum_of(model, lessons)
    begun = mind_of(model, curriculum, folder, mind)
    changes = {
        "optimiser": optimiser, "settings": dict(settings or {}), "generations": generations,
        "budget": budget, "cycles": cycles,
    }  # fmt: skip
    curriculum = continuing.with_changes(curriculum, changes)
    TrainingCourse(curriculum, begun, seed, engine)  # which refuses what does not fit together
    files = files_of(begun)
    remember({path: content for path, content in files.items() if path.endswith(".py")})
    manifest = TrainingManifest(
        model=_source(model),
        lessons=continuing.as_json(curriculum.record()),
        chosen=_chosen(lessons),
        changes=changes,
        plan=dict(plan or {}),
        mind={"name": begun.name, "sha256": continuing.hash_of(files)},
        seed=seed,
        engine=engine,
        attempts=attempts,
        timings={"created": datetime.now(UTC).isoformat(timespec="seconds"), "seconds": 0.0},
        versions=folders.versions(),
        platforms=[folders.fingerprint()],
    )
    copy = {f"{MIND}/{path}": content for path, content in files.items()}
    capsule = TrainingCapsule.create(target, manifest, copy)
    kind = f"learn {manifest.model['name']}"
    with (
        capsule.locked(),
        requests(capsule.folder) as asked,
        told_of_generations(progress, kind, on_generation) as tell,
    ):
        _go(capsule, curriculum, workers, cluster, asked, tell, on_lesson)
    return capsule.folder


def resume(
    folder: str | Path,
    attempts: int | None = None,
    cycles: int | None = None,
    lessons: Any = None,
    workers: int | None = None,
    cluster: str | None = None,
    on_generation: OnGeneration | None = None,
    on_lesson: OnLesson | None = None,
    trust: bool = False,
    progress: bool | None = None,
    plan: Mapping[str, str] | None = None,
) -> Path:
    """Go on with a training that was stopped, or add attempts, cycles or lessons to it.

    It becomes the training that was never stopped.

    Args:
        folder: the training's.
        attempts: how many there are to be in all; as it was by default.
        cycles: how often cycles go round in all; as it was by default.
        lessons: the lessons, where `learn` was given them in Python; others may follow them, which
            all attempts go on with.
        workers: as for `learn`.
        cluster: likewise.
        on_generation: likewise.
        on_lesson: likewise.
        trust: run programs that this user has neither named nor run before.
        progress: as for `learn`.
        plan: likewise; as it was by default.

    Returns:
        The training's folder.

    Raises:
        SocialmindError: no training's folder, in use, or its model or lessons were changed since.
        TrainingInterrupted: Ctrl-C, or a `pause`; all but the generation in hand is safe.
    """
    attempts = None if attempts is None else whole("attempts", attempts, 1)
    cycles = None if cycles is None else whole("cycles", cycles, 1)
    capsule = TrainingCapsule(folder)
    with (
        capsule.locked(),
        requests(capsule.folder) as asked,
        told_of_generations(progress, "learn", on_generation) as tell,
    ):
        manifest = capsule.manifest
        if attempts is not None and attempts < manifest.attempts:
            raise SocialmindError(
                f"{capsule.folder}: {manifest.attempts} attempts were asked for before, "
                f"{attempts} now; attempts can be added, not taken away"
            )
        require(programs_in(capsule.mind), trust, f"{capsule.folder}: its copy of a mind")
        curriculum = continuing.recorded_curriculum(capsule, lessons, trust)
        changes = dict(manifest.changes)
        if cycles is not None:
            continuing.refuse_cycles_within(capsule, curriculum, cycles)
            changes["cycles"] = cycles
            curriculum = curriculum.with_cycles(cycles)
        continuing.check_folder(capsule, curriculum)
        longer = len(curriculum.items) > len(manifest.lessons)
        asked_for = continuing.as_json(curriculum.record())
        added = asked_for != manifest.lessons  # lessons, or rounds of a cycle
        capsule.update(
            chosen=_chosen(lessons) if longer else manifest.chosen,
            finished=0 if added else manifest.finished,
            status=folders.INTERRUPTED if added else manifest.status,
            attempts=attempts or manifest.attempts,
            lessons=asked_for,
            changes=changes,
            plan=manifest.plan if plan is None else dict(plan),
            versions=continuing.with_added_lessons(capsule, curriculum),
            platforms=folders.with_this_machine(manifest.platforms),
        )
        _go(capsule, curriculum, workers, cluster, asked, tell, on_lesson)
    return capsule.folder


def _go(
    capsule: TrainingCapsule,
    curriculum: Curriculum,
    workers: int | None,
    cluster: str | None,
    asked: Asked,
    on_generation: OnGeneration | None,
    on_lesson: OnLesson | None,
) -> None:
    """Make all attempts that are not finished, and leave a finished folder."""
    manifest = capsule.manifest
    # From the copy, so that what is resumed begins from the very same.
    mind = MindDescription.load(capsule.mind)
    course = TrainingCourse(curriculum, mind, manifest.seed, manifest.engine)
    begun_before = {
        number: Attempt(capsule.attempt(number), number, course).position
        for number in range(1, manifest.attempts + 1)
        if capsule.attempt(number).is_dir()
    }
    forecast = Forecast(course, manifest.attempts, begun_before)
    begun = time.perf_counter() - float(manifest.timings.get("seconds", 0.0))
    process = {"host": platform.node(), "pid": os.getpid()}
    capsule.update(status=folders.RUNNING, error=None, process=process)

    def so_far(status: str, error: str | None = None) -> None:
        numbers = range(1, capsule.manifest.attempts + 1)
        curve = read_curve([(number, capsule.attempt(number)) for number in numbers])
        content = write_curve(curve, capsule.curve)
        if status != folders.RUNNING:
            from socialmind.drawing import style as paper

            paper.save({"curve": draw_curve(curve)}, capsule.figures)
        seconds = round(max(0.0, time.perf_counter() - begun), 3)
        capsule.update(
            status=status,
            error=error,
            process=process if status == folders.RUNNING else {},
            finished=finished,
            curve=content,
            timings={**manifest.timings, "seconds": seconds},
        )

    def pause_if_asked() -> None:
        """At a checkpoint: stop as by Ctrl-C, with nothing in hand."""
        if asked() is not None:
            raise Stopped

    def report(news: News) -> None:
        left = forecast.seconds_left(news)
        if on_generation is not None:
            on_generation(news, left)
        pause_if_asked()

    def conclude(attempt: Attempt, lesson: Lesson, result: Result) -> None:
        _save_mind(capsule, attempt)
        so_far(folders.RUNNING)
        if on_lesson is not None:
            on_lesson(attempt.number, lesson, result)
        if not attempt.finished:
            pause_if_asked()

    finished, commit = 0, own_commit()
    attempt: Attempt | None = None
    compiled = manifest.engine == COMPILED
    with deferred_signals() as arrived:
        try:
            with hired(workers, compiled, cluster) as team:
                for number in range(1, manifest.attempts + 1):
                    if not capsule.attempt(number).is_dir():
                        versions = with_commit(capsule.manifest.versions, number, commit)
                        capsule.update(versions=versions)
                    attempt = Attempt(capsule.attempt(number), number, course)
                    _save_mind(capsule, attempt)
                    if not attempt.finished:
                        pause_if_asked()
                    attempt.go(Evaluators(team), lambda: bool(arrived), report, conclude)
                    finished += 1
        except Stopped:
            asker = None if arrived else asked()
            so_far(folders.INTERRUPTED)
            if attempt is None or attempt.position is None:
                raise KeyboardInterrupt from None
            lesson = curriculum.at(attempt.position).name
            raise TrainingInterrupted(
                capsule.folder,
                attempt.number,
                lesson,
                attempt.generation,
                arrived[0] if arrived else signal.SIGINT,
                asker,
            ) from None
        except Exception as error:
            with suppress(OSError):  # there may be no room to say so
                so_far(folders.FAILED, f"{type(error).__name__}: {error}")
            if isinstance(error, OSError) and error.errno in NO_ROOM:
                raise no_room(error, capsule.folder, f"attempt {finished + 1}") from error
            raise
        so_far(folders.FINISHED)


def _save_mind(capsule: TrainingCapsule, attempt: Attempt) -> None:
    """Write the mind that an attempt has learned, which its checkpoint holds as well."""
    if not attempt.done:
        return
    folder = capsule.learned(attempt.number)
    if not folder.is_dir() or any(path.is_symlink() for path in folder.rglob("*")):
        remove(folder)
    try:
        attempt.mind.save(folder)
    except (ModelError, OSError):
        # A folder in the place of a file, or a file in that of a folder; the checkpoint has all.
        remove(folder)
        attempt.mind.save(folder)


def _source(model: str | Path | type[Model] | None) -> dict[str, Any]:
    if model is None:
        return {"name": None, "path": None, "source_sha256": None}
    return model_source(load_model(model))


def _chosen(lessons: Any) -> list[str] | None:
    """Return lessons by name and path, as a resumed training finds them; none for those given."""
    if lessons is None:
        return None
    given: Sequence[Any] = [lessons] if isinstance(lessons, Lesson | Cycle | str | Path) else []
    if not given and not isinstance(lessons, Curriculum):
        given = list(lessons)
    if not given or not all(isinstance(one, str | Path) for one in given):
        return []
    texts = [str(one) for one in given]
    return [
        str(Path(one).absolute()) if one.endswith(SIMBATCH) and Path(one).is_file() else one
        for one in texts
    ]
