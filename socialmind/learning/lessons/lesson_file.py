"""Lessons in `.simbatch` files (thesis, A.4): the file's keys as a lesson's arguments."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from socialmind.errors import ModelError, nearest, of_model_file
from socialmind.learning.lessons.lesson import Lesson
from socialmind.learning.optimisers.registry import OPTIMISERS, optimiser_named
from socialmind.mind.files.evoagents import simbatch
from socialmind.mind.files.evoagents.text_file import Lines, text_of

LEARNING = "LEARN2DSIM"
"""The type of task that is a lesson."""
FURTHER: Mapping[str, Callable[[Lines, str, str, int], Any]] = {
    **dict.fromkeys(("BUDGET", "FINALISTS", "FINALS", "VALIDATION"), Lines.whole_number),
    **dict.fromkeys(("WORLDS", "START"), lambda lines, value, key, line: value.lower()),
    "SPREAD": Lines.number,
}
"""Further keys that are arguments of a lesson, and how their values are read."""

Finder = Callable[[str, Callable[..., ModelError]], Any]


def load_lesson(path: str | Path, find: Finder) -> Lesson:
    """Read a lesson.

    ENV names a class of the model's `lessons.py`, DRIVEMODULE a function of it. LEARNINGSKILL may
    name several skills with commas between them. Further keys are BUDGET, WORLDS, START, SPREAD,
    FINALISTS, FINALS and VALIDATION, and the settings of optimisers, such as POPULATION; those of
    other optimisers than the lesson's count for nothing. The lesson has the file's name.

    Args:
        path: the file.
        find: gives the class or function of a name, or raises what its second argument makes.

    Raises:
        ModelError: the file is missing or wrong; says at which line and why.
    """
    path = Path(path)
    text = text_of(path)
    return lesson_of(simbatch.parse(text, path), _places(text, path), path, find)


def _places(text: str, path: Path) -> dict[str, int]:
    """Return the lines at which keys stand."""
    lines = Lines(text, path).rest()
    return {line.text.partition(":")[0].strip(): line.number for line in lines}


def lesson_of(task: simbatch.Task, places: Mapping[str, int], path: Path, find: Finder) -> Lesson:
    """Return the lesson that a task describes.

    Args:
        task: the task.
        places: the lines at which its keys stand, by key.
        path: the file, which gives the lesson its name.
        find: as for `load_lesson`.

    Raises:
        ModelError: the task is no lesson, or one of its values is wrong.
    """

    def refusing(key: str) -> Callable[..., ModelError]:
        def refused(found: str, expected: str | None = None, remedy: str | None = None) -> Any:
            return ModelError(f"{key} {found}", expected, remedy, path, places.get(key))

        return refused

    if task.type != LEARNING:
        raise refusing("TYPE")(task.type, f"{LEARNING}, for a lesson")
    for key, value in (("ENV", task.environment), ("LEARNINGSKILL", task.learning_skill)):
        if not value:
            raise ModelError(f"a lesson without {key}", f"a line {key}:…", None, path)
    arguments: dict[str, Any] = {
        "name": path.stem,
        "environment": find(task.environment, refusing("ENV")),
        "skill": tuple(one.strip() for one in task.learning_skill.split(",")),
        "master": task.master_skill,
        "file": str(path),
    }
    if task.learning_method:
        arguments["optimiser"] = task.learning_method.upper()
    with of_model_file(path, places.get("LEARNINGMETHOD")):
        kind = optimiser_named(arguments.get("optimiser", Lesson.optimiser))
    given = {
        "generations": ("NUMGEN", task.generations),
        "repetitions": ("EVALREP", task.repetitions),
        "ticks": ("TICKLIM", task.tick_limit),
    }
    for name, (key, number) in given.items():
        if number == 0:
            raise refusing(key)("0", "1 or more")
        if number is not None:
            arguments[name] = number
    if task.drive_module:
        arguments["drive"] = find(task.drive_module, refusing("DRIVEMODULE"))
    settings: dict[str, float] = {}
    anybody = {name for one in OPTIMISERS.values() for name in one.known_settings}
    lines = Lines("", path)
    for key, value in task.others.items():
        line, name = places.get(key, 0), key.lower()
        if key.upper() in FURTHER:
            arguments[name] = FURTHER[key.upper()](lines, value, key, line)
        elif name in kind.known_settings:
            amount = lines.number(value, key, line)
            with of_model_file(path, line):
                settings[name] = kind.known_settings[name].checked(name, amount)
        elif name not in anybody:
            known = [*FURTHER, *(one.upper() for one in kind.known_settings)]
            raise ModelError(
                f"the key {key!r} of a lesson",
                f"a setting of {kind.keyword} or another key of lessons",
                nearest(key.upper(), known),
                path,
                line,
            )
    with of_model_file(path):
        return Lesson(**arguments, settings=settings)
