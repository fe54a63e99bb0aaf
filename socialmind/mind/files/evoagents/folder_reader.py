"""The folder of a mind, as EvoAgents has it (thesis, 5.1.2), read.

```
<Agent>/
  <Agent>.botdesc                 sensors and actuators
  <Agent>.vardesc                 variables; may be missing
  Skills/<Skill>/<Skill>.ades     a skill, with its program or scheme beside it
  Skills/<Skill>/<Skill>.genome   its weights; missing where they are not set
  Tasks/<Task>.simbatch           what is to be run
```
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from socialmind.errors import ModelError, of_model_file
from socialmind.mind.files.evoagents import ades, botdesc, genome_file, simbatch, vardesc
from socialmind.mind.files.evoagents.ades import GENERAL_REMEDY
from socialmind.mind.files.evoagents.simbatch import Task
from socialmind.mind.files.evoagents.text_file import MOST_BYTES, MOST_GENOME, inside, text_of
from socialmind.mind.modules import Actuator, AMind, Sensor, Skill, Variable

BOTDESC, VARDESC, ADES, GENOME, SIMBATCH = ".botdesc", ".vardesc", ".ades", ".genome", ".simbatch"
SKILLS, TASKS = "Skills", "Tasks"


def read_folder(path: Path, kind: Callable[..., AMind]) -> AMind:
    """Return the mind of a folder, of the class that is given.

    Raises:
        ModelError: there is none, or one of its files is wrong.
    """
    agent = agent_file(path)
    sensors, actuators = botdesc.parse(_text(agent, path), agent)
    variables: tuple[Variable, ...] = ()
    own = agent.with_suffix(VARDESC)
    if own.is_file():
        variables = vardesc.parse(_text(own, path), own)
    else:
        for other in files_in(path, VARDESC):
            raise ModelError(
                f"the variables of {other.stem!r} beside {agent.name}",
                own.name,
                f"rename it to {own.name}",
                other,
            )
    skills = [_skill(folder, path) for folder in skill_folders(path)]
    return whole(kind, agent.stem, sensors, actuators, variables, skills)


def whole(
    kind: Callable[..., AMind],
    name: str,
    sensors: Iterable[Sensor],
    actuators: Iterable[Actuator],
    variables: Iterable[Variable],
    skills: Iterable[Skill],
) -> AMind:
    """Return the mind of modules that were read from files.

    Raises:
        ModelError: they do not fit together; with a remedy for files.
    """
    with of_model_file(remedy=GENERAL_REMEDY):
        return kind(name, sensors, actuators, variables, skills)


def agent_file(folder: Path) -> Path:
    """Return the one `.botdesc` file of a folder.

    Raises:
        ModelError: there is no such folder, or not one such file in it.
    """
    if not folder.is_dir():
        raise ModelError("no such folder", remedy="give the folder of a mind", file=folder)
    found = files_in(folder, BOTDESC)
    if len(found) != 1:
        names = ", ".join(one.name for one in found)
        raise ModelError(
            f"{len(found)} files{' ' * bool(names)}{names}" if found else f"no {BOTDESC} file",
            f"one <Agent>{BOTDESC}",
            "leave one of them" if found else "write the sensors and actuators into one",
            folder,
        )
    return found[0]


def files_in(folder: Path, suffix: str) -> list[Path]:
    """Return the files of a kind in a folder, by name; hidden ones are none of the mind's."""
    if not folder.is_dir():
        return []
    return sorted(
        one for one in folder.iterdir()
        if one.suffix == suffix and one.is_file() and not one.name.startswith(".")
    )  # fmt: skip


def skill_folders(folder: Path) -> list[Path]:
    """Return the folders of a mind's skills, by name."""
    skills = folder / SKILLS
    if not skills.is_dir():
        return []
    return sorted(
        one
        for one in skills.iterdir()
        if one.is_dir() and not one.name.startswith((".", "__pycache__"))
    )


def _text(path: Path, mind: Path, most: int = MOST_BYTES) -> str:
    """Return the text of a file of a mind; none that lies elsewhere, behind a link."""
    return text_of(inside(mind, path.relative_to(mind).as_posix(), "the file", path), most)


def _skill(folder: Path, mind: Path) -> Skill:
    """Read the skill of a folder, with its weights if there are any."""
    path = folder / f"{folder.name}{ADES}"
    others = [one for one in files_in(folder, ADES) if one != path]
    if others or not path.is_file():
        at_fault = others[0] if others else folder
        raise ModelError(
            f"the file {at_fault.name} in the folder of a skill" if others else "no skill",
            path.name,
            f"rename it to {path.name}, or take it out" if others else f"write {path.name}",
            at_fault,
        )
    skill = ades.parse(_text(path, mind), path)
    if skill.name != folder.name:
        raise skill.refused(
            f"in the folder {folder.name}",
            f"{folder.name}, the name of its folder",
            "give both the same name",
        )
    weights = path.with_suffix(GENOME)
    for other in files_in(folder, GENOME):
        if other != weights:
            raise ModelError(
                f"the weights of {other.stem!r} in the folder of {skill.name!r}",
                weights.name,
                f"rename it to {weights.name}, or take it out",
                other,
            )
    if not weights.is_file():
        return skill
    return genome_file.parse(_text(weights, mind, MOST_GENOME), weights, skill)


def load_tasks(folder: str | Path) -> dict[str, Task]:
    """Read the tasks of a mind's folder, by name.

    Raises:
        ModelError: one of the files is wrong.
    """
    tasks = files_in(Path(folder) / TASKS, SIMBATCH)
    return {path.stem: simbatch.parse(_text(path, Path(folder)), path) for path in tasks}
