"""What a training teaches: the lessons of a model, and the mind that they begin from."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from socialmind.catalogue import load_model
from socialmind.errors import ModelError, SocialmindError, nearest
from socialmind.learning.lessons.curriculum import Curriculum, Cycle
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.lessons.lesson_file import load_lesson
from socialmind.learning.training.teaching import check_fits
from socialmind.mind.description import MindDescription
from socialmind.model import Model
from socialmind.sources.folders import file_of_class, model_folder
from socialmind.sources.loading import load_file

LESSONS_FILE = "lessons.py"
CURRICULA_FILE = "curricula.py"
SIMBATCH = ".simbatch"


@dataclass(frozen=True, eq=False)
class TrainingCourse:
    """What all attempts of a training have in common.

    Attributes:
        curriculum: the lessons.
        mind: the mind to begin from.
        seed: of the training.
        engine: `compiled` or `pymunk`.
    """

    curriculum: Curriculum
    mind: MindDescription
    seed: int
    engine: str

    def __post_init__(self) -> None:
        learned: list[str] = []
        for lesson in self.curriculum.lessons:
            check_fits(lesson, self.mind, learned)
            learned += lesson.skills


def lessons_module(folder: Path) -> ModuleType | None:
    """Return the module of a model's `lessons.py`; None where there is none."""
    path = folder / LESSONS_FILE
    return load_file(path) if path.is_file() else None


def can_be_taught(folder: Path) -> bool:
    """Return whether a model's folder holds lessons."""
    return (folder / LESSONS_FILE).is_file() or bool(_several(folder))


def curricula_of(folder: Path | None) -> Mapping[str, Curriculum]:
    """Return the curricula of a model by name, the one that is taught where none is named first.

    They are the `curricula` of its `curricula.py`, or else the one `curriculum` of its
    `lessons.py`, which has no name.

    Raises:
        SocialmindError: there are none.
        ModelError: what stands in their place is something else.
    """
    if folder is None:
        return {"": _own(None, None)}
    return _several(folder) or {"": _own(lessons_module(folder), folder)}


def _several(folder: Path) -> Mapping[str, Curriculum]:
    """The `curricula` of a model's `curricula.py`; none where it sets none, or there is no file."""
    path = folder / CURRICULA_FILE
    curricula = getattr(load_file(path), "curricula", None) if path.is_file() else None
    if curricula is None:
        return {}
    values = list(curricula.values()) if isinstance(curricula, Mapping) else []
    if values and all(isinstance(one, Curriculum) for one in values):
        return dict(curricula)
    raise ModelError(
        f"`curricula` set to {curricula!r}",
        'curricula = {"a name": Curriculum(...), ...}',
        "write it at the end",
        path,
    )


def curriculum_of(
    model: str | Path | type[Model] | None, lessons: Any = None
) -> tuple[Curriculum, Path | None]:
    """Return a curriculum whose lessons are whole, and the folder that its paths are relative to.

    Args:
        model: a model's name or folder, or its class; None where the lessons say all.
        lessons: a curriculum, a lesson or several; the name of one of the model's curricula, names
            of lessons of one of them, or paths of `.simbatch` files; the model's first curriculum
            where none are given.

    Raises:
        SocialmindError: there are no lessons, or none of a name.
        ModelError: a lesson's file or environment is wrong.
    """
    folder = _folder_of(model)
    module = None if folder is None else lessons_module(folder)
    finder = _finder(module, folder)

    def whole(one: Lesson | str | Path) -> Lesson:
        if isinstance(one, str | Path):
            path = Path(one)
            if folder is not None and not path.is_file():
                path = folder / path
            return load_lesson(path, finder)
        if isinstance(one.environment, str):
            return one.changed(environment=finder(one.environment, one.refused))
        return one

    if isinstance(lessons, Lesson | Cycle | str | Path):
        lessons = [lessons]
    if isinstance(lessons, Curriculum):
        curriculum = lessons
    elif lessons is None:
        curriculum = next(iter(curricula_of(folder).values()))
    elif names := [one for one in lessons if isinstance(one, str) and not one.endswith(SIMBATCH)]:
        curriculum = _named(names, list(lessons), curricula_of(folder), whole)
    else:
        several = {} if folder is None else _several(folder)
        first = next(iter(several.values()), getattr(module, "curriculum", None))
        curriculum = Curriculum(lessons, getattr(first, "mind", None))
    return curriculum.with_lessons(whole), folder


def _folder_of(model: str | Path | type[Model] | None) -> Path | None:
    if model is None:
        return None
    if isinstance(model, type):
        file = file_of_class(model)
        return None if file is None else file.resolve().parent
    return model_folder(model)


def _own(module: ModuleType | None, folder: Path | None) -> Curriculum:
    if module is None:
        raise SocialmindError(
            f"{folder}: no {LESSONS_FILE}, so there is nothing to learn; write one with "
            "`curriculum = Curriculum(...)`"
            if folder is not None
            else "no lessons; give some, or a model with a lessons.py"
        )
    curriculum = getattr(module, "curriculum", None)
    if not isinstance(curriculum, Curriculum):
        raise ModelError(
            "no curriculum" if curriculum is None else f"`curriculum` set to {curriculum!r}",
            "curriculum = Curriculum(...)",
            "write it at the end",
            module.__file__,
        )
    return curriculum


def _named(
    names: Sequence[str],
    lessons: Sequence[Any],
    curricula: Mapping[str, Curriculum],
    whole: Callable[[Any], Lesson],
) -> Curriculum:
    """Return the curriculum of a name, or that of names of lessons, and lessons between them.

    Args:
        names: those among the lessons.
        lessons: what was asked for.
        curricula: of the model.
        whole: gives the lesson of a path.
    """
    if len(lessons) == 1 and names[0] in curricula:
        return curricula[names[0]]
    own = _with_lessons(names, curricula, whole).only(names)
    if len(names) == len(lessons):
        return own
    known = {one.name: one for one in own.lessons}
    return Curriculum([known.get(one, one) for one in lessons], own.mind)


def _with_lessons(
    names: Sequence[str], curricula: Mapping[str, Curriculum], whole: Callable[[Any], Lesson]
) -> Curriculum:
    """Return the first curriculum that has all lessons of these names."""
    lessons: list[str] = []
    for one in curricula.values():
        curriculum = one.with_lessons(whole)
        own = [lesson.name for lesson in curriculum.lessons]
        if {*names} <= {*own}:
            return curriculum
        lessons += own
    known = [name for name in dict.fromkeys([*curricula, *lessons]) if name]
    for name in names:
        if name in lessons:
            continue
        if name in curricula:
            raise SocialmindError(f"{name} is a whole curriculum; name it alone, or its lessons")
        raise SocialmindError(f"no lesson called {name!r}; {nearest(name, known)}")
    raise SocialmindError(f"the lessons {', '.join(names)} are not all of one curriculum")


def _finder(module: ModuleType | None, folder: Path | None) -> Callable[..., Any]:
    """Return what finds the classes and functions that lessons name."""

    def find(name: str, refused: Callable[..., ModelError]) -> Any:
        if module is None:
            place = f"a {LESSONS_FILE} beside it" if folder is None else str(folder / LESSONS_FILE)
            raise refused(f"of {name!r}", f"{place}, where it is defined", "write that file")
        found = getattr(module, name, None)
        if not callable(found):
            known = [key for key, one in vars(module).items() if _is_environment(one)]
            raise refused(
                f"of {name!r}, which {module.__file__} does not define",
                "a class or function of it",
                nearest(name, known),
            )
        return found

    return find


def _is_environment(one: Any) -> bool:
    if not inspect.isclass(one) or one is Model:
        return False
    return issubclass(one, Model) or hasattr(one, "run")


def mind_of(
    model: str | Path | type[Model] | None,
    curriculum: Curriculum,
    folder: Path | None,
    given: str | Path | MindDescription | None,
) -> MindDescription:
    """Return the mind that a training begins from.

    Args:
        model: the model.
        curriculum: the lessons.
        folder: what the curriculum's path is relative to.
        given: the user's, which comes first; then the curriculum's, then that of the model's
            robots.

    Raises:
        SocialmindError: there is none, or the model has several.
    """
    if given is None and curriculum.mind is not None:
        given = curriculum.mind
        if isinstance(given, str | Path) and folder is not None:
            given = folder / given
    if isinstance(given, MindDescription):
        return given
    if given is not None:
        return MindDescription.load(Path(given).expanduser())
    found = _minds_in(model)
    if len(found) != 1:
        raise SocialmindError(
            f"{len(found)} minds in the model; say which one learns: --mind DIR, or "
            "Curriculum(..., mind=...)"
        )
    one, home = found[0]
    return one if isinstance(one, MindDescription) else MindDescription.load(home / one)


def _minds_in(model: str | Path | type[Model] | None) -> list[tuple[Any, Path]]:
    """Return the minds of a model's populations, and the folder that they are relative to."""
    if model is None:
        return []
    cls = load_model(model)
    given = [one.hierarchy for one in cls.populations.values()]
    return [(one, cls.folder()) for one in given if one is not None]
