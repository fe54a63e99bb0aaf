"""`Tasks/<Task>.simbatch`: what is to be run with a mind (thesis, A.4). Reader and writer.

A line `KEY:VALUE` for each parameter, in any order. Keys beyond the known ones are kept; what a
task does not need it ignores.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from dataclasses import field as of_each
from pathlib import Path
from typing import Any

from socialmind.errors import ModelError, nearest
from socialmind.mind.files.evoagents.text_file import Lines, field, one_line

TYPES = (
    "DEMO2DSIM", "LEARN2DSIM", "LEARN2DSIMCONTINUOUS", "DEMO2DSIMMULTI", "LEARN2DSIMMULTI",
    "DEMO3DSIM", "LEARN3DSIM", "DEMOREMOTE", "DEMOREMOTESIM", "LEARNREMOTESIM", "OPENENDED",
)  # fmt: skip
"""The types of tasks (thesis, A.4.2)."""
OTHER_NAMES = {"DEMOSIM": "DEMO2DSIM", "LEARNSIM": "LEARN2DSIM"}
"""Names that the thesis uses as well."""
TYPE = "TYPE"
TEXTS = {
    "BOTMODEL": "bot_model", "BOTNAME": "bot_name", "MASTERSKILL": "master_skill",
    "LEARNINGSKILL": "learning_skill", "ENV": "environment", "LEARNINGMETHOD": "learning_method",
    "ROOTFOLDER": "root_folder", "DRIVEMODULE": "drive_module",
}  # fmt: skip
"""The keys whose values are texts (thesis, A.4.1), and the task's fields."""
NUMBERS = {"NUMGEN": "generations", "EVALREP": "repetitions", "TICKLIM": "tick_limit"}
"""The keys whose values are whole numbers, and the task's fields."""


@dataclass(frozen=True)
class Task:
    """What is to be run with a mind.

    Attributes:
        type: one of `TYPES`.
        bot_model: the body (BOTMODEL).
        bot_name: the mind (BOTNAME), the name of its folder.
        master_skill: the skill that steers the agent (MASTERSKILL).
        learning_skill: the skill that learns (LEARNINGSKILL).
        environment: where it happens (ENV).
        learning_method: NEAT, GENETIC, ANNEALING or another optimiser (LEARNINGMETHOD).
        root_folder: the folder in which the mind's folder lies (ROOTFOLDER).
        generations: how many generations or iterations, 0 or more (NUMGEN).
        repetitions: how often an agent is evaluated, 0 or more (EVALREP).
        tick_limit: the ticks of one evaluation, 0 or more (TICKLIM).
        drive_module: what acts before the skills (DRIVEMODULE; thesis, 5.1.3).
        others: the values of further keys.

    Texts are empty and numbers None where the file has none.
    """

    type: str
    bot_model: str = ""
    bot_name: str = ""
    master_skill: str = ""
    learning_skill: str = ""
    environment: str = ""
    learning_method: str = ""
    root_folder: str = ""
    generations: int | None = None
    repetitions: int | None = None
    tick_limit: int | None = None
    drive_module: str = ""
    others: Mapping[str, str] = of_each(default_factory=dict)

    def __post_init__(self) -> None:
        if self.type not in TYPES:
            raise ModelError(
                f"{self.type!r} as the type of a task",
                f"one of {', '.join((*TYPES, *OTHER_NAMES))}",
                nearest(self.type, (*TYPES, *OTHER_NAMES)),
            )
        for name in NUMBERS.values():
            number = getattr(self, name)
            if number is not None and (not isinstance(number, int) or number < 0):
                raise ModelError(f"{number!r} as {name} of a task", "a whole number, 0 or more")
        object.__setattr__(self, "others", dict(self.others))


def parse(text: str, file: str | Path) -> Task:
    r"""Return the task that a file describes.

    Args:
        text: the file's content.
        file: its path, for messages.

    Raises:
        ModelError: the text is no such file; says at which line and why.

    >>> task = parse("TYPE:LEARNSIM\nMASTERSKILL:Avoid\nNUMGEN:50\n", "Avoid.simbatch")
    >>> task.type, task.master_skill, task.generations
    ('LEARN2DSIM', 'Avoid', 50)
    """
    lines = Lines(text, file)
    places: dict[str, int] = {}
    values: dict[str, str] = {}
    for line in lines.rest():
        key, colon, value = (part.strip() for part in line.text.partition(":"))
        if not colon or not key:
            raise lines.error(
                repr(line.text), "KEY:VALUE", "write a colon after the key", line.number
            )
        if key in places:
            raise lines.error(
                f"a second {key}, first in line {places[key]}",
                "each key once",
                "take one of them out",
                line.number,
            )
        places[key], values[key] = line.number, value
    if TYPE not in values:
        raise lines.error(
            "a task without TYPE",
            f"a line {TYPE}:LEARN2DSIM or of another type",
            "write what kind of task it is",
            lines.last,
        )
    kind = values.pop(TYPE)
    fields: dict[str, Any] = {}
    others = {}
    for key, value in values.items():
        if key in TEXTS:
            fields[TEXTS[key]] = value
        elif key in NUMBERS:
            fields[NUMBERS[key]] = lines.whole_number(value, key, places[key])
        else:
            others[key] = value
    with lines.placing(places[TYPE], "choose one of them"):
        return Task(OTHER_NAMES.get(kind, kind), **fields, others=others)


def written(task: Task) -> str:
    """Return the file of a task, which reads back as an equal one.

    Raises:
        ModelError: a value that does not go into a line.

    >>> print(written(Task("DEMO2DSIM", master_skill="Collect", tick_limit=900)), end="")
    TYPE:DEMO2DSIM
    MASTERSKILL:Collect
    TICKLIM:900
    """
    lines = [f"{TYPE}:{task.type}"]
    for key, name in {**TEXTS, **NUMBERS}.items():
        value = getattr(task, name)
        if value not in ("", None):
            lines.append(f"{key}:{one_line(str(value), f'{key} of a task')}")
    for key, text in task.others.items():
        if not key or key in (TYPE, *TEXTS, *NUMBERS):
            raise ModelError(
                f"{key!r} as a further key of a task", "a name of its own", "rename it"
            )
        key = field(key, "a key of a task")
        lines.append(f"{key}:{one_line(text, f'{key} of a task')}")
    return "\n".join(lines) + "\n"
