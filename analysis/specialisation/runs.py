"""All worlds of the study, run side by side; a block of a society's worlds is kept when it is done.

What is kept lies in a folder named by a hash of the model, the minds and what is measured. So a
study that was stopped goes on where it was, and nothing of other rules, minds or measures is taken
for a result; the engine is known by the program's version.
"""

from __future__ import annotations

import hashlib
import re
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd

import socialmind
from socialmind.catalogue import load_file, model_folder
from socialmind.errors import SocialmindError
from socialmind.work.side_by_side import side_by_side

from .societies import (
    CONDITIONS,
    MIXED,
    MIXED_WITH,
    ROBOTS,
    SEED,
    SOCIETIES,
    TRAINED,
    Size,
)
from .worlds import EVERY, SHOWN_EVERY, lived

MINDS = load_file(TRAINED / "minds.py")
TABLES = ("worlds", "course", "kinds", "spells")
KEYS = ("society", "attempt", "share")
BLOCK = 5
"""Worlds of a society that are kept together."""


@dataclass(frozen=True)
class Cell:
    """A society of robots with one mind, and what happens to it.

    Attributes:
        society: its name; "mixed" for one of both kinds.
        attempt: of the lesson; 0 where nothing was learned.
        share: of programmed robots.
        conditions: their names.
        worlds: how many.
        parameters: of the model.
        lesson: whose mind it has; empty for none.
    """

    society: str
    attempt: int
    share: float
    conditions: tuple[str, ...]
    worlds: int
    parameters: Mapping[str, float] = field(default_factory=dict)
    lesson: str = ""

    @property
    def name(self) -> str:
        """How its folder is called."""
        return f"{self.society}-{self.attempt}-{self.share:.3f}"

    @property
    def blocks(self) -> list[range]:
        """The seeds of its worlds, block by block."""
        last = SEED + self.worlds
        return [range(first, min(first + BLOCK, last)) for first in range(SEED, last, BLOCK)]


def cells_of(size: Size) -> list[Cell]:
    """Return all there is to run, each once.

    Args:
        size: of the study.
    """
    every, found = tuple(CONDITIONS), []
    for one in SOCIETIES.values():
        share = float(one.parameters.get("programmed", 0.0))
        worlds = size.attempt_worlds if one.lesson else size.worlds
        found += [
            Cell(one.name, attempt, share, every, worlds, one.parameters, one.lesson)
            for attempt in (attempts_at(one.lesson, size) if one.lesson else (0,))
        ]
    learned = SOCIETIES[MIXED_WITH]
    found += [
        Cell(
            "mixed", attempt, programmed / ROBOTS, MIXED, size.mixed_worlds,
            {**learned.parameters, "programmed": programmed / ROBOTS}, learned.lesson,
        )
        for attempt in attempts_at(learned.lesson, size)
        for programmed in size.mixed
    ]  # fmt: skip
    return found


def attempts_at(lesson: str, size: Size) -> list[int]:
    """Return the attempts at a lesson that are looked at.

    Raises:
        SocialmindError: none is kept; it says what makes them.
    """
    found = MINDS.attempts_at(lesson)[: size.attempts]
    if not found:
        what = f"no attempt at {lesson} is kept in analysis/foraging_roles/results"
        raise SocialmindError(f"{what}; {MINDS.command_for(lesson)} makes them")
    return found


@dataclass(frozen=True)
class Records:
    """What was seen of all worlds.

    Attributes:
        worlds: `society`, `attempt`, `share`, `condition`, `seed` and the measures, a row a run.
        course: likewise `seed`, `tick`, `distance`, `specialised`.
        kinds: likewise `seed`, `kind` and what became of it.
        spells: likewise `seed`, `agent`, `since`, `until`, `role`, of the first world.
    """

    worlds: pd.DataFrame
    course: pd.DataFrame
    kinds: pd.DataFrame
    spells: pd.DataFrame


def run(cells: Sequence[Cell], size: Size, home: Path, workers: int | None = None) -> Records:
    """Run all worlds that are not kept yet, a block of worlds of all societies after the other.

    Args:
        cells: societies, and what happens to them.
        size: of the study.
        home: where results are kept.
        workers: processes; one for each processor by default.

    Returns:
        What was seen, as it is kept.
    """
    folders = {cell.name: home / stamp(cell, size.ticks) / cell.name for cell in cells}
    missing = [
        (cell, seeds)
        for place in range(max(len(cell.blocks) for cell in cells))
        for cell in cells
        for seeds in cell.blocks[place : place + 1]
        if not all(_file(folders[cell.name], table, seeds).is_file() for table in TABLES)
    ]
    calls: list[tuple[Any, ...]] = [
        (cell.conditions, seed, size.ticks, dict(cell.parameters), cell.lesson, cell.attempt)
        for cell, seeds in missing
        for seed in seeds
    ]
    answers = side_by_side(lived, calls, workers)
    for done, (cell, seeds) in enumerate(missing, 1):
        _keep([next(answers) for _ in seeds], folders[cell.name], seeds)
        told = f"{cell.name}, worlds {seeds[0]} to {seeds[-1]} ({done} of {len(missing)})"
        print(told, file=sys.stderr, flush=True)
    return Records(
        *(
            pd.concat(
                [
                    _read(_file(folders[cell.name], table, seeds), cell)
                    for cell in cells
                    for seeds in cell.blocks[: 1 if table == "spells" else None]
                ],
                ignore_index=True,
            )
            for table in TABLES
        )
    )


def stamp(cell: Cell, ticks: int) -> str:
    """Return a hash of what decides what comes of a cell: rules, measures, minds and parameters.

    The engine is known by the program's version alone.
    """
    model, half = model_folder("foraging_roles"), ticks // 2
    known: list[Any] = [socialmind.__version__, ticks, EVERY, SHOWN_EVERY]
    known += [dict(cell.parameters), _weights(cell.lesson, cell.attempt)]
    for name in cell.conditions:
        what = CONDITIONS[name]
        known += [name, what.parameters(half), what.wanted(half).to_dict("records")]
    total = hashlib.sha256(repr(known).encode())
    data = [one for one in sorted(model.rglob("*")) if one.suffix not in (".md", ".py", ".pyc")]
    rules = imported(model / "thresholds.py")
    measures = sorted(Path(socialmind.__file__).parent.glob("experiments/measures/*.py"))
    own = (Path(__file__).with_name("worlds.py"), *measures, *rules)
    for path in (*own, *filter(Path.is_file, data)):
        total.update(f"{path.name}\0".encode() + path.read_bytes())
    return total.hexdigest()[:12]


def imported(first: Path) -> list[Path]:
    """Return a file of a model and all of its folder that it imports; what others do is no matter.

    >>> [one.name for one in imported(model_folder("foraging_roles") / "payoff.py")]
    ['payoff.py', 'roles.py']
    """
    found = [first]
    for path in found:
        for name in re.findall(r"^from \.(\w+) import", path.read_text(encoding="utf-8"), re.M):
            if (other := path.with_name(f"{name}.py")) not in found:
                found.append(other)
    return sorted(found)


def _weights(lesson: str, attempt: int) -> list[Any]:
    own, mind = MINDS.decided_by(lesson, attempt) if lesson else ({}, None)
    skills = [] if mind is None else mind.skills.values()
    genomes = [(one.name, one.genome.tolist()) for one in skills if one.genome is not None]
    return [*own.items(), *genomes]


def _file(folder: Path, table: str, seeds: range) -> Path:
    return folder / f"{table}-{seeds[0]}-{seeds[-1]}.csv"


def _keep(
    answers: Sequence[Mapping[str, list[dict[str, Any]]]], folder: Path, seeds: range
) -> None:
    """Write what came of a block of worlds, each table at once."""
    folder.mkdir(parents=True, exist_ok=True)
    for table in TABLES:
        several = answers[:1] if table == "spells" else answers
        frame = pd.DataFrame([row for one in several for row in one[table]])
        path = _file(folder, table, seeds)
        begun = path.with_suffix(".part")
        frame.to_csv(begun, index=False, float_format="%.9g")
        begun.replace(path)


def _read(path: Path, cell: Cell) -> pd.DataFrame:
    frame = pd.read_csv(path)
    for place, name in enumerate(KEYS):
        frame.insert(place, name, getattr(cell, name))
    return frame
