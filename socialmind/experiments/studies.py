"""Finding studies: what re-makes a figure or a table of the thesis, by its name.

A study belongs to a topic, a folder with a ``studies.py`` that names it. In a checkout or an
editable install the topics stand in ``analysis/`` beside the package, in a wheel they are data of
the package. Like models they are documents, loaded by path.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from socialmind.errors import ModelError, SocialmindError, nearest
from socialmind.sources.folders import PACKAGE, STUDIES_FILE, shipped
from socialmind.sources.loading import failure_in_model, load_file

if TYPE_CHECKING:
    from matplotlib.figure import Figure


Make = Callable[[Path], Sequence[Path]]
"""Makes a study in a folder, which it makes where it is missing, and returns the files written."""

One = TypeVar("One")


class Way(StrEnum):
    """How a study that stands on trainings comes by them; its value is the command's option."""

    FULL = ""
    """It makes them, or goes on with them."""
    QUICK = " --quick"
    """It makes small ones."""
    KEPT = " --kept"
    """It takes those that are kept beside it."""

    def said(self, name: str, topic: str) -> str:
        """Return what its results say of how they were made.

        Args:
            name: of the study.
            topic: the name of its topic.
        """
        command = f"by `socialmind reproduce {name}{self}`"
        return {
            Way.FULL: f"From training to result, {command}.",
            Way.QUICK: f"A small version, {command}. It shows that all works, and says nothing "
            "about how well anything learns.",
            Way.KEPT: f"From the trainings kept in `analysis/{topic}/results`, scored anew, "
            f"{command}.",
        }[self]


@dataclass(frozen=True)
class Study:
    """What re-makes one figure or table.

    Attributes:
        name: as `socialmind reproduce` takes it: ``figure-4.6``.
        about: what it shows, in a line.
        make: makes it.
        quick: makes a smaller one, in place of one that takes long; None where none does.
        kept: makes it from results that stand beside the study, in place of one that takes long;
            None where none does.
    """

    name: str
    about: str
    make: Make
    quick: Make | None = None
    kept: Make | None = None

    @classmethod
    def of_trainings(
        cls, name: str, about: str, make: Callable[[Way, Path], Sequence[Path]]
    ) -> Study:
        """Return a study that can be made in each way.

        Args:
            name: as `socialmind reproduce` takes it.
            about: what it shows, in a line.
            make: makes it in one of these ways, in a folder.
        """
        whole, quick, kept = (partial(make, way) for way in (Way.FULL, Way.QUICK, Way.KEPT))
        return cls(name, about, whole, quick, kept)


def topics() -> dict[str, Path]:
    """The topics whose studies can be made.

    Returns:
        The folder of each topic by its name, in alphabetical order.

    Raises:
        SocialmindError: this installation holds no studies.
    """
    found = shipped("analysis", STUDIES_FILE)
    if found:
        return found
    raise SocialmindError(
        f"the studies are not installed in {PACKAGE.parent}; "
        "run `socialmind reproduce` from a checkout of the repository (`pip install -e .`)"
    )


def studies_in(folder: Path) -> tuple[Study, ...]:
    """The studies of a topic.

    Args:
        folder: the topic's; its ``studies.py`` holds them as ``studies = (Study(…), …)``.

    Raises:
        ModelError: the file cannot be loaded, or does not hold studies.
    """
    return declared_in(folder / STUDIES_FILE, "studies", Study, "the studies of the topic")


def declared_in(path: Path, name: str, kind: type[One], what: str) -> tuple[One, ...]:
    """Return what a topic's file declares, a tuple of one kind of things.

    Args:
        path: the file.
        name: of the tuple in it.
        kind: of its members.
        what: they are, in words.

    Raises:
        ModelError: the file cannot be loaded, or does not hold them.
    """
    found: Any = getattr(load_file(path), name, None)
    if not isinstance(found, tuple) or not all(isinstance(one, kind) for one in found):
        raise ModelError(
            f"{type(found).__name__} as `{name}`" if found is not None else f"no `{name}`",
            what,
            f"write `{name} = ({kind.__name__}(…), …)`",
            path,
        )
    return found


def catalogue_of_studies() -> dict[str, tuple[Study, Path]]:
    """All studies by name, each with the folder of its topic.

    Raises:
        SocialmindError: there are none, one cannot be loaded, or two go by one name.
    """
    known: dict[str, tuple[Study, Path]] = {}
    for folder in topics().values():
        for study in studies_in(folder):
            if study.name in known:
                raise ModelError(
                    f"a second study called {study.name!r}, after that of {known[study.name][1]}",
                    "each name once",
                    file=folder / STUDIES_FILE,
                )
            known[study.name] = study, folder
    return known


def find(name: str) -> list[tuple[Study, Path]]:
    """The study of a name, or all those of a topic, each with the folder of its topic.

    Args:
        name: of the study (``figure-4.6``) or of the topic (``mind_variables``).

    Raises:
        SocialmindError: there is none of this name.
    """
    known = catalogue_of_studies()
    if name in known:
        return [known[name]]
    folder = topics().get(name.replace("-", "_"))
    found = [one for one in known.values() if one[1] == folder]
    if not found:
        raise SocialmindError(f"no study called {name}; {nearest(name, [*known, *topics()])}")
    return found


def reproduce(
    names: Iterable[str], out: str | Path, quick: bool = False, kept: bool = False
) -> Iterator[Path]:
    """Make studies one after another.

    Args:
        names: of studies or topics; all are looked up before the first is made.
        out: the folder for what is made.
        quick: whether a smaller version will do where the full one takes long.
        kept: whether it is to be made from results that stand beside the study, where the full one
            makes its own and takes long; one that has none is made as a whole, which is said.

    Yields:
        The files as they are written.

    Raises:
        SocialmindError: there is no study of a name, or one stopped with an error.
    """
    if quick and kept:
        raise SocialmindError("a smaller version, or one from kept results? expected one of both")
    chosen = {study.name: (study, folder) for name in names for study, folder in find(name)}
    for study, folder in chosen.values():
        make = (study.quick if quick else study.kept if kept else None) or study.make
        if kept and study.quick and not study.kept:
            warnings.warn(
                f"{study.name}: no results are kept that it could be made from; it is made as a "
                "whole, which takes long",
                stacklevel=2,
            )
        try:
            written = make(Path(out))
        except (SocialmindError, OSError):
            raise
        except Exception as error:
            raise failure_in_model(error, folder / STUDIES_FILE, study.name) from error
        yield from written


def write_figure(
    name: str, figure: Figure, table: Sequence[dict[str, Any]], out: Path
) -> list[Path]:
    """Write a study's figure as PDF and PNG, and the numbers that it shows as CSV.

    Args:
        name: of the study, and of its files.
        figure: what is shown.
        table: the numbers, a dictionary a row, all with the same keys.
        out: the folder, made where it is missing.

    Returns:
        The files written.
    """
    import csv

    from socialmind.drawing import style as paper

    written = paper.save({name: figure}, out)
    path = out / f"{name}.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(table[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(table)
    return [*written, path]


def write_page(name: str, title: str, told: Sequence[str], lines: Sequence[str], out: Path) -> Path:
    """Write what a study found as a page of Markdown.

    Args:
        name: of the file.
        title: its heading.
        told: how it was made, and then where each of its trainings comes from.
        lines: what was found.
        out: the folder, made where it is missing.

    Returns:
        The file.
    """
    out.mkdir(parents=True, exist_ok=True)
    made, *sources = told
    text = [f"# {title}", "", made, "", *(f"- {line}" for line in sources), "", *lines]
    path = out / f"{name}.md"
    path.write_text("\n".join(text) + "\n", "utf-8")
    return path
