"""What the room of skills asks for: minds to open, checking as one types, saving."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

from starlette.routing import Route

from socialmind.catalogue import catalogue
from socialmind.errors import SocialmindError
from socialmind.mind.files.evoagents.folder_reader import BOTDESC
from socialmind.studio.server.answering import Asked, OtherFileError, answering
from socialmind.studio.server.folders import Folders
from socialmind.studio.skills.checking import checked
from socialmind.studio.skills.document import EMPTY, Document, checked_shape
from socialmind.studio.skills.files import (
    YAML,
    fingerprint,
    folder_form,
    home_of,
    is_yaml,
    opened,
    programs_changed,
    saved,
)

WITH_PROGRAMS = "/api/skills/save-with-programs"
"""Where documents are saved whose programs were changed."""
MOST_FILES = 300
MOST_LOOKED_AT = 20_000
"""Files and folders below the studio's own that are looked at for a list of minds."""
HEAD = 20_000
"""Bytes of a YAML file that say whether it holds a mind."""


def routes(folders: Folders) -> list[Route]:
    """Return the routes of the room.

    Args:
        folders: where pages may read and write.
    """
    room = _Skills(folders)
    return [
        Route("/api/skills/files", answering(room.files)),
        Route("/api/skills/open", answering(room.open), methods=["POST"]),
        Route("/api/skills/check", answering(room.check), methods=["POST"]),
        Route("/api/skills/save", answering(room.save), methods=["POST"]),
        Route(WITH_PROGRAMS, answering(room.save_with_programs), methods=["POST"]),
    ]


class _Skills:
    """Answers.

    Args:
        folders: where pages may read and write.
    """

    def __init__(self, folders: Folders) -> None:
        self._folders = folders

    def files(self, asked: Asked) -> Asked:
        """List the minds below the studio's folder, and those of models."""
        found = {self._folders.shown(one): None for one in _minds_below(self._folders.home)}
        models = {
            f"{name}: {one.name}": str(one)
            for name, folder in catalogue().items()
            for one in sorted(folder.glob("mind*"))
            if one.is_dir() and any(one.glob(f"*{BOTDESC}"))
        }
        return {"files": list(found)[:MOST_FILES], "models": models}

    def open(self, asked: Asked) -> Asked:
        """Open a mind's folder or YAML file, or an empty document."""
        if not asked.get("file"):
            return {"document": EMPTY, "base": None, "writable": False}
        path = home_of(self._folders.to_read(asked["file"]))
        return {"document": opened(path), **self._place(path)}

    def check(self, asked: Asked) -> Asked:
        """Tell what is wrong or odd about a document, and what becomes of learned weights."""
        document = checked_shape(asked.get("document"))
        home = self._home(asked)
        if home is None:
            found = checked(document, None)
        else:
            with folder_form(home) as folder:
                found = checked(document, folder, opened(home))
        masters = () if found.mind is None else found.mind.masters
        return {
            "findings": found.findings,
            "weights": found.weights,
            "programs": found.programs,
            "masters": list(masters),
        }

    def save(self, asked: Asked) -> Asked:
        """Save a document, unless a mind stands there that is not the one that was opened.

        One that has other programs than the files from which it was opened is not saved so: what
        is a program now may be run later by somebody who trusts the folder.
        """
        document = checked_shape(asked.get("document"))
        if programs_changed(document, self._home(asked)):
            raise SocialmindError("programs were changed; they are saved with the studio's token")
        return self._saved(document, asked)

    def save_with_programs(self, asked: Asked) -> Asked:
        """Save a document, its programs too: for pages that have shown the token."""
        return self._saved(checked_shape(asked.get("document")), asked)

    def _saved(self, document: Document, asked: Asked) -> Asked:
        target, home = self._folders.to_write(asked.get("file")), self._home(asked)
        if target == self._folders.home:
            raise SocialmindError("name a folder below the studio's, or a .yaml file")
        shown, base = self._folders.shown(target), asked.get("base") or {}
        there = target.exists() and not (target.is_dir() and not any(target.iterdir()))
        if there and not asked.get("replace"):
            if target != home:
                raise OtherFileError(f"{shown} is there")
            if fingerprint(target) != base.get("sha256"):
                raise OtherFileError(f"{shown} was changed by another program since it was opened")
        if there and not is_yaml(target) and not any(target.glob(f"*{BOTDESC}")):
            raise SocialmindError(f"{shown} holds something else than a mind; give another folder")
        target.parent.mkdir(parents=True, exist_ok=True)
        notes = saved(document, target, home)
        return {"notes": notes, **self._place(target)}

    def _home(self, asked: Asked) -> Path | None:
        base = asked.get("base")
        return None if not base else home_of(self._folders.to_read(base.get("file")))

    def _place(self, path: Path) -> Asked:
        """Say where a mind came from, as it is to be said again when it is saved."""
        shown = self._folders.shown(path)
        try:
            self._folders.to_write(shown)
            writable = os.access(path, os.W_OK)
        except SocialmindError:
            writable = False
        return {"base": {"file": shown, "sha256": fingerprint(path)}, "writable": writable}


def _minds_below(home: Path) -> Iterator[Path]:
    """Yield the minds below a folder; those that runs and trainings keep are left out."""
    left = MOST_LOOKED_AT
    for place, inner, names in os.walk(home):
        folder = Path(place)
        left -= len(names) + len(inner)
        if left < 0:
            return
        if any(name.endswith(BOTDESC) for name in names):
            inner.clear()
            yield folder
            continue
        inner[:] = sorted(
            name
            for name in inner
            if not name.startswith((".", "__")) and name not in ("node_modules", "venv")
        )
        if "manifest.json" in names:  # what a run or training keeps; what it has learned is shown
            inner[:] = [name for name in inner if name.startswith("mind-attempt-")]
        for name in sorted(names):
            if name.lower().endswith(YAML) and _holds_mind(folder / name):
                yield folder / name


def _holds_mind(path: Path) -> bool:
    try:
        with path.open("rb") as file:
            lines = file.read(HEAD).splitlines()
    except OSError:
        return False
    return any(one.startswith((b"skills:", b"sensors:", b"actuators:")) for one in lines)
