"""Minds in files: a folder as EvoAgents has it, or one YAML file."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

from socialmind.mind.files import yaml_reader, yaml_writer
from socialmind.mind.files.evoagents.folder_reader import BOTDESC, load_tasks, read_folder
from socialmind.mind.files.evoagents.folder_writer import save_tasks, write_folder
from socialmind.mind.files.python_file import runs_programs
from socialmind.mind.modules import AMind, Modules
from socialmind.sources.trust import programs_in, remember

__all__ = ["load_description", "load_tasks", "save_description", "save_tasks"]

YAML = (".yaml", ".yml")


def load_description(path: str | Path, kind: Callable[..., AMind]) -> AMind:
    """Read a mind; its programs are remembered as named by this user (`socialmind.sources.trust`).

    Args:
        path: its folder, its `.botdesc` file, or its YAML file.
        kind: the class of the mind.

    Raises:
        ModelError: there is none, or one of its files is wrong.
    """
    path = Path(path)
    if _is_yaml(path):
        return yaml_reader.load(path, kind)
    if path.suffix == BOTDESC and path.is_file():
        path = path.parent
    description = read_folder(path, kind)
    if runs_programs():
        remember(programs_in(path))
    return description


def save_description(description: Modules, path: str | Path) -> None:
    """Write a mind, so that it reads back as an equal one.

    The mind's own files are replaced where they are there. Nothing is written where the folder
    holds other skills, weights or descriptions: they would be read with the mind.

    Args:
        description: the mind.
        path: a folder, or a YAML file where the path ends in .yaml or .yml.

    Raises:
        ModelError: the mind does not go into such files, or they cannot be written.
    """
    path = Path(path)
    if _is_yaml(path):
        yaml_writer.save(description, path)
    else:
        write_folder(description, path)


def files_of(description: Modules) -> dict[str, bytes]:
    """Return the files of a mind's folder, by their paths in it."""
    with tempfile.TemporaryDirectory() as folder:
        save_description(description, folder)
        paths = sorted(path for path in Path(folder).rglob("*") if path.is_file())
        return {
            path.relative_to(folder).as_posix(): path.read_bytes()
            for path in paths
            if "__pycache__" not in path.parts  # installing leaves one beside a mind's programs
        }


def _is_yaml(path: Path) -> bool:
    return path.suffix.lower() in YAML and not path.is_dir()
