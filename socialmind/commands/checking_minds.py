"""`socialmind check` for minds of skills: what is odd, and how large the genomes are."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path

import typer
import yaml

from coglogo_py import SchemeError
from coglogo_py.files.reading import text_in
from coglogo_py.files.yaml_nodes import composed
from socialmind.errors import SocialmindError, nearest
from socialmind.mind.code.mind_code import check_program
from socialmind.mind.description import MindDescription
from socialmind.mind.files.evoagents.folder_reader import (
    ADES,
    BOTDESC,
    GENOME,
    SIMBATCH,
    VARDESC,
    files_in,
    load_tasks,
)
from socialmind.mind.files.evoagents.simbatch import Task
from socialmind.mind.files.python_file import programs_unrun
from socialmind.mind.files.yaml_reader import ACTUATORS, SENSORS, SKILLS, VARIABLES
from socialmind.mind.lint import Finding, findings, genome_sizes
from socialmind.mind.modules import Skill
from socialmind.sources.trust import programs_in
from socialmind.text_table import aligned

SUFFIXES = (BOTDESC, VARDESC, ADES, GENOME, SIMBATCH)
_SECTIONS = (SENSORS, ACTUATORS, VARIABLES, SKILLS)
_SECTION = re.compile(rf"^[\"']?({'|'.join(_SECTIONS)})[\"']?\s*:", re.MULTILINE)


def is_mind(path: Path) -> bool:
    """Whether a path is a mind's folder or YAML file; a scheme's YAML file is none.

    Raises:
        SocialmindError: it is one of the files of a mind's folder.
    """
    if path.is_dir():
        return bool(files_in(path, BOTDESC))
    if path.suffix in SUFFIXES:
        raise SocialmindError(
            f"{path}: one file of a mind; expected the mind's folder; give the folder that holds "
            f"its {BOTDESC} file"
        )
    if path.suffix.lower() not in (".yaml", ".yml") or not path.is_file():
        return False
    text = text_in(path, latin_1=True)
    try:
        root = composed(text, path)
    except SchemeError:
        # Broken or not, it is the reader of minds that should say so.
        return _SECTION.search(text) is not None
    keys = root.value if isinstance(root, yaml.MappingNode) else []
    return any(key.value in _SECTIONS for key, _ in keys)


def print_mind(path: Path, trust: bool = False) -> bool:
    """Print what is odd about a mind and how many weights it has; True when something is odd.

    Args:
        path: the mind's folder or YAML file.
        trust: run its programs, to check that they can be compiled; else they are only listed.

    Raises:
        ModelError: one of its files is wrong.
    """
    with nullcontext() if trust else programs_unrun():
        description = MindDescription.load(path)
    if not trust:
        tell_programs(path)
    tasks = load_tasks(path) if path.is_dir() else {}
    odd, masters = _of_tasks(tasks, description)
    odd += findings(description, masters or None, check_program if trust else _unchecked)
    tell([f"{path}: {finding}" for finding in odd], str(path))
    typer.echo("\n".join(table(description)))
    return bool(odd)


def tell(odd: Sequence[str], file: str) -> None:
    """Print what is odd about a file, or that nothing is."""
    typer.echo("\n".join(odd or [f"{file}: nothing odd found"]))


def _unchecked(_: Skill) -> None:
    """Check no program: nothing is run."""


def tell_programs(path: Path) -> None:
    """Say on stderr which programs there are, which were not run."""
    found = (
        programs_in(path) if path.is_dir() else programs_in(path.parent / f"{path.stem}.functions")
    )
    if found:
        typer.echo(
            f"{path}: programs, which can do whatever you can and were not run: "
            f"{', '.join(one if one.isprintable() else repr(one) for one in found)}; "
            "--trust checks their rules as well, which runs them",
            err=True,
        )


def _of_tasks(
    tasks: dict[str, Task], description: MindDescription
) -> tuple[list[Finding], tuple[str, ...]]:
    """Return what is odd about tasks, and the masters that they name."""
    odd = []
    masters: dict[str, None] = {}
    for name, task in tasks.items():
        for what, skill in (("master", task.master_skill), ("learning", task.learning_skill)):
            if skill and skill not in description.skills:
                message = f"its {what} skill is {skill!r}; {nearest(skill, description.skills)}"
                odd.append(Finding("unknown skill", f"task {name!r}", message))
            elif skill and what == "master":
                masters[skill] = None
    return odd, tuple(masters)


def table(description: MindDescription) -> list[str]:
    r"""Return the table of genome sizes, from the master down.

    >>> from socialmind.mind import Programmed, Skill
    >>> def stop():
    ...     return 0.5
    >>> still = Skill("Still", (), ["MO:MotL"], Programmed(stop))
    >>> print(*table(MindDescription("m", (), ["MotL"], skills=[still])), sep="\n")
    skill  function           inputs  outputs  weights
    Still  the function stop       0        1        0
    total                                            0
    """
    sizes = genome_sizes(description)
    rows = [("skill", "function", "inputs", "outputs", "weights")]
    for name, size in sizes.items():
        skill = description.skills[name]
        counts = (str(len(skill.inputs)), str(len(skill.outputs)), str(size))
        rows.append((name, str(skill.function), *counts))
    rows.append(("total", "", "", "", str(sum(sizes.values()))))
    return aligned(rows, right=(2, 3, 4))
