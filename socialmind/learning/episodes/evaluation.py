"""Where individuals are judged: an environment, a mind, and the skills whose genomes they are."""

from __future__ import annotations

import hashlib
import inspect
import pickle
import tempfile
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from socialmind.errors import ModelError
from socialmind.mind.description import MindDescription
from socialmind.mind.modules import Skill
from socialmind.work.importable import found, referred

COMPILED, PYMUNK = "compiled", "pymunk"
"""The engines of physical worlds."""

Genomes = NDArray[np.float64]


class Judged(NamedTuple):
    """What came of episodes: individuals by worlds.

    Attributes:
        score: shape (k, r).
        ticks: how long they went on, shape (k, r).
    """

    score: NDArray[np.float64]
    ticks: NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Ground:
    """Where individuals are judged.

    Attributes:
        environment: a model, or a class with the interface of `Episodes` but for the model.
        mind: the mind; the genomes of the skills that learn are exchanged.
        master: the skill that steers.
        skills: the skills that learn.
        ticks: the length of an episode; None for the environment's own.
        parameters: of the environment.
        drive: the drive module of the hierarchy.
        engine: `compiled` or `pymunk`.
    """

    environment: type[Any]
    mind: MindDescription
    master: str
    skills: tuple[str, ...]
    ticks: int | None = None
    parameters: Mapping[str, Any] = field(default_factory=dict)
    drive: Callable[..., None] | None = None
    engine: str = COMPILED

    def with_skill(self, skill: Skill) -> Ground:
        """Return the ground with another skill in the place of the one of its name."""
        return replace(self, mind=self.mind.with_modules(skills=[skill]))

    def episodes(self) -> Any:
        """Return the `Episodes` that run there."""
        arguments: dict[str, Any] = {
            "parameters": dict(self.parameters),
            "hierarchy": self.mind,
            "master": self.master,
            "skill": self.skills if len(self.skills) > 1 else self.skills[0],
            "drive": self.drive,
            "ticks": self.ticks,
            "physics": self.engine,
        }
        from socialmind.model import Model

        if not issubclass(self.environment, Model):
            return self.environment(**arguments)
        if not self.environment.shape.world.has_episodes:
            from socialmind.learning.episodes.society_episodes import SocietyEpisodes

            return SocietyEpisodes(self.environment, **arguments)
        from socialmind.learning.episodes.plane_episodes import Episodes

        return Episodes(self.environment, **arguments)

    def packed(self) -> PackedGround:
        """Return the ground as it goes to another process.

        Raises:
            ModelError: environment or drive are not found by another process.
        """
        files = files_of(self.mind)
        rest = (
            referred(self.environment), self.master, self.skills, self.ticks,
            dict(self.parameters), referred(self.drive), self.engine,
        )  # fmt: skip
        try:
            content = pickle.dumps((files, rest))
        except (pickle.PicklingError, AttributeError, TypeError) as error:
            raise ModelError(
                f"an environment or drive that other processes cannot load ({error})",
                "a class and a function of a file",
                "write them into the model's lessons.py",
            ) from None
        return PackedGround(hashlib.sha256(content).hexdigest(), content)


@dataclass(frozen=True)
class PackedGround:
    """A ground as bytes.

    Args:
        key: the hash of the content.
        content: the mind's files and the rest, pickled.
    """

    key: str
    content: bytes = field(repr=False)

    def unpacked(self, folder: Path) -> Ground:
        """Return the ground; its mind's files are put into a folder, which is to stay."""
        files, rest = pickle.loads(self.content)
        environment, master, skills, ticks, parameters, drive, engine = rest
        for name, content in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)
        mind = MindDescription.load(folder)
        return Ground(
            found(environment), mind, master, skills, ticks, parameters, found(drive), engine
        )


def files_of(mind: MindDescription) -> dict[str, bytes]:
    """Return the files of a mind's folder, by their paths in it."""
    with tempfile.TemporaryDirectory() as folder:
        mind.save(folder)
        paths = sorted(path for path in Path(folder).rglob("*") if path.is_file())
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


@dataclass(frozen=True, eq=False)
class Piece:
    """Individuals and worlds that are judged in one go.

    Attributes:
        individuals: the places of the individuals in the generation.
        worlds: the places of the worlds.
        genomes: shape (k, genome size); or one skill for each individual, where their functions
            differ.
        seeds: of the worlds.
    """

    individuals: slice
    worlds: slice
    genomes: Genomes | tuple[Skill, ...]
    seeds: tuple[int, ...]


def pieces_of(genomes: Genomes | Sequence[Skill], seeds: Sequence[int], count: int) -> list[Piece]:
    """Cut individuals by worlds into about so many pieces; individuals first.

    >>> cut = pieces_of(np.zeros((3, 1)), [7, 8], 4)
    >>> [(one.individuals, one.seeds) for one in cut][:2]
    [(slice(0, 1, None), (7,)), (slice(0, 1, None), (8,))]
    """
    individuals = _slices(len(genomes), count)
    worlds = _slices(len(seeds), -(-count // len(individuals)))
    return [
        Piece(one, other, _some(genomes, one), tuple(seeds[other]))
        for one in individuals
        for other in worlds
    ]


def _some(genomes: Genomes | Sequence[Skill], which: slice) -> Genomes | tuple[Skill, ...]:
    return genomes[which] if isinstance(genomes, np.ndarray) else tuple(genomes[which])


def _slices(length: int, count: int) -> list[slice]:
    """Return at most so many slices of nearly the same length."""
    bounds = np.linspace(0, length, min(max(count, 1), length) + 1).round().astype(int)
    return [slice(int(a), int(b)) for a, b in pairwise(bounds)]


def judged(ground: Ground, piece: Piece, episodes: Any = None) -> Judged:
    """Run the episodes of a piece.

    Args:
        ground: where.
        piece: whom, and on which worlds.
        episodes: the ground's `Episodes`, where they stand already.

    Raises:
        ModelError: scores that are no finite numbers, or of a wrong shape.
    """
    if isinstance(piece.genomes, tuple):
        outcomes = [
            ground.with_skill(skill).episodes().run(None, piece.seeds) for skill in piece.genomes
        ]
    else:
        standing = ground.episodes() if episodes is None else episodes
        outcomes = [standing.run(piece.genomes, piece.seeds)]
    found = Judged(
        np.concatenate([np.asarray(one.score, np.float64) for one in outcomes]),
        np.concatenate([np.asarray(one.ticks, np.int64) for one in outcomes]),
    )
    shape = (len(piece.genomes), len(piece.seeds))
    if found.score.shape != shape or not np.isfinite(found.score).all():
        wrong = (
            f"scores of shape {found.score.shape}"
            if found.score.shape != shape
            else "scores that are no finite numbers"
        )
        raise ModelError(
            f"{wrong} from the environment {ground.environment.__name__}",
            f"finite scores of shape {shape}",
            "look at its rewards",
            _file_of(ground.environment),
        )
    return found


def _file_of(environment: type[Any]) -> str | None:
    try:
        return inspect.getfile(environment)
    except (OSError, TypeError):
        return None


_standing = threading.local()
"""What a worker in another process keeps from one piece to the next: making it takes longer than
running it."""


def judged_elsewhere(packed: PackedGround, piece: Piece) -> Judged:
    """Run the episodes of a piece in a worker's process; as `judged`."""
    if getattr(_standing, "key", None) != packed.key:
        _standing.key = None
        _standing.folder = tempfile.TemporaryDirectory()
        _standing.ground = packed.unpacked(Path(_standing.folder.name))
        _standing.episodes = None
        _standing.key = packed.key
    if _standing.episodes is None and not isinstance(piece.genomes, tuple):
        _standing.episodes = _standing.ground.episodes()
    return judged(_standing.ground, piece, _standing.episodes)
