"""The trainings of ForageRole: the one that the model has, and others that fall short of it.

python -m analysis.foraging_roles.trainings             # all of them, an attempt after the other
python -m analysis.foraging_roles.trainings counts

They lie in `trainings/`; what was learned is kept in `results/genomes.csv`.
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from socialmind.catalogue import load_file, model_folder
from socialmind.errors import SocialmindError
from socialmind.learning import Curriculum, Training, learn, resume
from socialmind.mind import InternalFunction, MindDescription, Perceptron

MODEL = model_folder("foraging_roles")
LESSONS = load_file(MODEL / "lessons.py")
ECONOMY = load_file(MODEL / "economy.py")
NOTHING, UNDECIDED = ECONOMY.NOTHING, ECONOMY.UNDECIDED

HOME = Path(__file__).parent / "trainings"
GENOMES = Path(__file__).parent / "results" / "genomes.csv"
SEED = 8
ATTEMPTS = 3
PERCEPTRON = Perceptron(layers=2)
"""The internal function of the thesis's skills."""
COUNTS_ALONE = {"off": 0.0, "off_late": 0.0, "out_late": 0.0, "change": 0.0, "counts": 1.0}
ONE_SOCIETY = {
    "numbers": (9,), "ratios": (2 / 3,), "starts": (UNDECIDED,), "events": (NOTHING,)
}  # fmt: skip


@dataclass(frozen=True)
class Plan:
    """A training.

    Attributes:
        about: what is special about it.
        function: the internal function of ForageRole.
        terms: of the economy, where they are not the lesson's.
    """

    about: str
    function: InternalFunction = LESSONS.SETTLING
    terms: Mapping[str, Any] = field(default_factory=dict)


PLANS: Mapping[str, Plan] = {
    "learned": Plan("the lesson of the model"),
    "counts": Plan(
        "a perceptron; nine undecided robots, one ratio, no shock; judged by the counts alone",
        PERCEPTRON,
        {**ONE_SOCIETY, **COUNTS_ALONE},
    ),
    "counts-changes": Plan(
        "the same, and changes of roles cost", PERCEPTRON,
        {**ONE_SOCIETY, **COUNTS_ALONE, "change": 0.1},
    ),
    "perceptron": Plan("the lesson of the model with a perceptron", PERCEPTRON),
    "changes-free": Plan("changes of roles cost nothing", terms={"change": 0.0}),
    "one-society": Plan(
        "nine undecided robots, one ratio, no shock; else as learned", terms=ONE_SOCIETY
    ),
}  # fmt: skip
"""By name. What differs from `learned` is the matter of each."""


def plan_of(name: str) -> Plan:
    """Return the plan of a name.

    Raises:
        SocialmindError: there is none.
    """
    if name not in PLANS:
        raise SocialmindError(f"no training called {name!r}; expected one of {', '.join(PLANS)}")
    return PLANS[name]


def mind_of(name: str, genome: NDArray[np.float64] | None = None) -> MindDescription:
    """Return the mind of a plan, with what was learned, or without.

    Args:
        name: of the plan.
        genome: of ForageRole.
    """
    known = MindDescription.load(model_folder("collect_retrained") / "mind")
    mind = LESSONS.foraging(known, plan_of(name).function)
    if genome is None:
        return mind
    return mind.with_modules(skills=[mind.skill(LESSONS.ROLE).changed(genome=genome)])


def train(
    name: str, folder: Path, generations: int | None = None, attempts: int = ATTEMPTS
) -> Path:
    """Make a training, or go on with it.

    Args:
        name: of the plan.
        folder: of the training.
        generations: in place of the lesson's own.
        attempts: how many.

    Returns:
        The training's folder.
    """
    lesson = LESSONS.lesson.changed(parameters=dict(plan_of(name).terms))
    if generations is not None:
        lesson = lesson.changed(generations=generations)
    lessons = Curriculum((lesson,), mind=mind_of(name))
    if (folder / "manifest.json").is_file():
        return resume(folder, attempts=attempts, lessons=lessons)
    return learn(None, lessons=lessons, attempts=attempts, seed=SEED, out=folder)


def genomes_of(folder: Path) -> list[NDArray[np.float64]]:
    """Return what the attempts of a training learned, one after the other."""
    training = Training(folder)
    attempts = range(1, training.manifest.finished + 1)
    found = [training.mind(attempt).skill(LESSONS.ROLE).genome for attempt in attempts]
    return [genome for genome in found if genome is not None]


def keep(learned: Mapping[str, Iterable[NDArray[np.float64]]], path: Path = GENOMES) -> None:
    """Write genomes by plan into a file, in place of those of these plans that it holds."""
    rows = {**kept(path), **{name: list(several) for name, several in learned.items()}}
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["plan", "attempt", "weights"])
        for name, several in rows.items():
            for attempt, genome in enumerate(several, 1):
                writer.writerow([name, attempt, " ".join(map(repr, genome.tolist()))])


def kept(path: Path = GENOMES) -> dict[str, list[NDArray[np.float64]]]:
    """Return the genomes that are kept, by plan; none where there is no file."""
    found: dict[str, list[NDArray[np.float64]]] = {}
    if path.is_file():
        with path.open(newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                weights = np.array([float(one) for one in row["weights"].split()])
                found.setdefault(row["plan"], []).append(weights)
    return found


def main(names: list[str]) -> None:
    """Make trainings by name, all of them by default, and keep what they learned.

    Raises:
        SystemExit: with a line on what is wrong: a name that no plan has.
    """
    if {"-h", "--help"} & set(names):
        print((__doc__ or "").strip())
        return
    try:
        for name in names:
            plan_of(name)
    except SocialmindError as error:
        raise SystemExit(f"error: {error}") from error
    for name in names or PLANS:
        print(f"{name}: {plan_of(name).about}", file=sys.stderr, flush=True)
        keep({name: genomes_of(train(name, HOME / name))})


if __name__ == "__main__":
    main(sys.argv[1:])
