"""`<Agent>.layout`: where an editor draws the modules of a mind. Reader and writer.

A file of ours beside the mind's own, which EvoAgents does not read: sections as in a `.botdesc`
file, and a line `name:x:y` for each module that somebody put somewhere. It is no part of the mind:
what a mind equals, and the hashes that runs and trainings keep, do not depend on it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from coglogo_py.border.errors import shown
from socialmind.mind.files.evoagents.botdesc import ACTUATORS, SENSORS
from socialmind.mind.files.evoagents.folder_reader import agent_file
from socialmind.mind.files.evoagents.text_file import Line, Lines

LAYOUT = ".layout"
SECTIONS = {
    "sensors": SENSORS, "actuators": ACTUATORS, "variables": "VARIABLES", "skills": "SKILLS"
}  # fmt: skip
"""How the kinds of modules are called in the file."""
WHOLE_NUMBER = re.compile(r"[+-]?[0-9]{1,10}", re.A)
LARGEST = 2**31

Place = tuple[int, int]
Places = dict[str, dict[str, Place]]
"""x and y of modules by their names, by their kinds as in `SECTIONS`."""


def layout_file(mind: Path) -> Path:
    """Return the path of the layout of a mind, whether it is there or not.

    Args:
        mind: its folder, or its YAML file.

    Raises:
        ModelError: the folder holds no mind.
    """
    return (agent_file(mind) if mind.is_dir() else mind).with_suffix(LAYOUT)


def parse(text: str, file: str | Path) -> Places:
    r"""Return the places that a file gives.

    Names that the mind does not have are its own affair: a module may have gone since.

    Args:
        text: the file's content.
        file: its path, for messages.

    Raises:
        ModelError: the text is no such file; says at which line and why.

    >>> parse("SENSORS\nEYE:-190:40\nSKILLS\nSeek: 230 : 0  # in the middle\n", "a.layout")
    {'sensors': {'EYE': (-190, 40)}, 'skills': {'Seek': (230, 0)}}
    """
    kinds = {section: kind for kind, section in SECTIONS.items()}
    lines = Lines(text, file)
    found: Places = {}
    kind = None
    for line in lines.rest():
        if line.text in kinds:
            kind = kinds[line.text]
            continue
        if kind is None:
            raise lines.error(
                shown(line.text), f"one of {', '.join(kinds)}", "write a section above it",
                line.number,
            )  # fmt: skip
        name, place = _placed(lines, line)
        there = found.setdefault(kind, {})
        if name in there:
            raise lines.error(
                f"a second place of {shown(name)}", "each module once", "take one out", line.number
            )
        there[name] = place
    return found


def _placed(lines: Lines, line: Line) -> tuple[str, Place]:
    name, *numbers = line.fields
    if (
        len(numbers) == 2
        and all(map(WHOLE_NUMBER.fullmatch, numbers))
        and all(-LARGEST <= int(one) < LARGEST for one in numbers)
    ):
        return name, (int(numbers[0]), int(numbers[1]))
    raise lines.error(
        shown(line.text),
        "name:x:y, with whole numbers of 32 bits",
        "write it as EYE:-190:40, or delete the file: the modules are laid out then",
        line.number,
    )


def lines_of(places: Mapping[str, Mapping[str, Place]]) -> list[str]:
    """Return the lines of a file that gives places, which read back as equal ones.

    >>> lines_of({"skills": {"Seek": (230, 0)}, "sensors": {}})
    ['SKILLS', 'Seek:230:0']
    """
    found = []
    for kind, section in SECTIONS.items():
        some = [f"{name}:{x}:{y}" for name, (x, y) in places.get(kind, {}).items()]
        if some:
            found += [section, *some]
    return found
