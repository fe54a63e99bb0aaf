"""The folder of a mind written, as `folder_reader` reads it."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from socialmind.errors import ModelError
from socialmind.mind.files.companion_files import add_function, file_name, write
from socialmind.mind.files.evoagents import ades, botdesc, genome_file, simbatch, vardesc
from socialmind.mind.files.evoagents.folder_reader import (
    ADES,
    BOTDESC,
    GENOME,
    SIMBATCH,
    SKILLS,
    TASKS,
    VARDESC,
    files_in,
    skill_folders,
)
from socialmind.mind.files.evoagents.simbatch import Task
from socialmind.mind.files.evoagents.text_file import write_text
from socialmind.mind.functions.cogniton_scheme import CognitonScheme
from socialmind.mind.functions.programmed import Programmed
from socialmind.mind.modules import Modules
from socialmind.mind.regulation import Regulated


def write_folder(description: Modules, path: Path) -> None:
    """Write a mind's folder; see `folder.save_description`."""
    agent = path / file_name(description.name, BOTDESC)
    _refuse_strangers(description, path, agent)
    texts = {agent: botdesc.written(description.sensors.values(), description.actuators.values())}
    variables, own = description.variables.values(), agent.with_suffix(VARDESC)
    files = {
        one.name: add_function(one.regulation.function, path, texts)
        for one in variables
        if isinstance(one.regulation, Regulated)
    }
    if variables or own.exists():
        texts[own] = vardesc.written(variables, files)
    schemes: dict[Path, CognitonScheme] = {}
    for skill in description.skills.values():
        folder = path / SKILLS / file_name(skill.name, "")
        texts[folder / f"{skill.name}{ADES}"] = ades.written(skill)
        if skill.genome is not None:
            texts[folder / f"{skill.name}{GENOME}"] = genome_file.written(skill)
        if isinstance(skill.function, Programmed):
            names = ades.program_name(skill.function), skill.name
            add_function(skill.function.function, folder, texts, names)
        if isinstance(skill.function, CognitonScheme):
            schemes[folder / ades.scheme_name(skill, skill.function)] = skill.function
    write(texts, schemes)


def save_tasks(tasks: Mapping[str, Task], folder: str | Path) -> None:
    """Write tasks into a mind's folder, each into a file of its name.

    Raises:
        ModelError: a task does not go into a file, or it cannot be written.
    """
    for name, task in tasks.items():
        write_text(Path(folder) / TASKS / file_name(name, SIMBATCH), simbatch.written(task))


def _refuse_strangers(description: Modules, path: Path, agent: Path) -> None:
    """Refuse a folder whose other files would be read with the mind's."""
    strangers = [
        one
        for one in (*files_in(path, BOTDESC), *files_in(path, VARDESC))
        if one.stem != agent.stem
    ]
    for folder in skill_folders(path):
        skill = description.skills.get(folder.name)
        if skill is None:
            strangers.append(folder)
            continue
        wanted = [ADES] if skill.genome is None else [ADES, GENOME]
        kept = [f"{skill.name}{suffix}" for suffix in wanted]
        both = (*files_in(folder, ADES), *files_in(folder, GENOME))
        strangers += [one for one in both if one.name not in kept]
    for stranger in strangers:
        raise ModelError(
            f"{stranger.name}, which is not of the mind {description.name!r} to be saved",
            "a folder with no other mind in it",
            "take it out, or save into another folder",
            stranger,
        )
