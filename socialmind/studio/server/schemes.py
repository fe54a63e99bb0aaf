"""What the room of schemes asks for: files and models to open, checking as one types, saving."""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Iterator
from pathlib import Path
from threading import Lock
from typing import Any

from starlette.routing import Route

from coglogo_py import CognitiveScheme
from coglogo_py.files.reading import text_in
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.sources.folders import digest
from socialmind.studio.schemes.checking import Bearers, checked
from socialmind.studio.schemes.document import EMPTY, document_of, matched
from socialmind.studio.schemes.files import SUFFIXES, YAML, opened, written
from socialmind.studio.server.answering import Asked, OtherFileError, answering
from socialmind.studio.server.folders import Folders
from socialmind.work.files import replace_file

MOST_FILES = 300
MOST_LOOKED_AT = 20_000
"""Files and folders below the studio's own that are looked at for a list of schemes."""
HEAD = 20_000
"""Bytes of a YAML file that say whether it holds a scheme."""


def routes(folders: Folders, models: Callable[[], Collection[str]]) -> list[Route]:
    """Return the routes of the room.

    Args:
        folders: where pages may read and write.
        models: gives the names of the models that pages may load.
    """
    schemes = _Schemes(folders, models)
    return [
        Route("/api/schemes/files", answering(schemes.files)),
        Route("/api/schemes/populations", answering(schemes.populations), methods=["POST"]),
        Route("/api/schemes/open", answering(schemes.open), methods=["POST"]),
        Route("/api/schemes/check", answering(schemes.check), methods=["POST"]),
        Route("/api/schemes/save", answering(schemes.save), methods=["POST"]),
    ]


class _Schemes:
    """Answers; one at a time, since loading models is not made for several threads."""

    def __init__(self, folders: Folders, models: Callable[[], Collection[str]]) -> None:
        self._folders, self._models = folders, models
        self._lock = Lock()

    def files(self, asked: Asked) -> Asked:
        """List files of schemes below the studio's folder."""
        found = [self._folders.shown(one) for one in _scheme_files(self._folders.home)]
        return {"files": sorted(found)[:MOST_FILES]}

    def populations(self, asked: Asked) -> Asked:
        """Tell which populations of a model have schemes."""
        with self._lock:
            kind = self._model(asked)
        named = [name for name, one in kind.populations.items() if one.mind is not None]
        return {"populations": named}

    def open(self, asked: Asked) -> Asked:
        """Open a file, the scheme of a model's population, or an empty one."""
        with self._lock:
            bearers = self._bearers(asked)
            makers = () if bearers is None else bearers.makers
            path, text = None, ""
            if asked.get("file"):
                path = self._folders.to_read(asked["file"])
                text, document = opened(path, makers)
            elif bearers is not None:
                source = bearers.population.mind
                if isinstance(source, CognitiveScheme):
                    document = document_of(source)
                else:
                    path = bearers.model.folder() / str(source)
                    text, document = opened(path, makers)
            else:
                document = EMPTY
            if asked.get("running") is not None:
                document = matched(asked["running"], document)
            return {"document": document, **self._place(path, text)}

    def check(self, asked: Asked) -> Asked:
        """Tell what is wrong or odd about a document."""
        with self._lock:
            return checked(asked.get("document") or {}, self._bearers(asked)).to_json()

    def save(self, asked: Asked) -> Asked:
        """Save a document, unless a file stands there that is not the one that was opened."""
        with self._lock:
            bearers = self._bearers(asked)
        path = self._folders.to_write(asked.get("file"))
        if path.suffix.lower() not in SUFFIXES:
            raise SocialmindError(f"{path.name}: a scheme's file ends in {', '.join(SUFFIXES)}")
        base = asked.get("base") or {}
        makers = () if bearers is None else bearers.makers
        file = written(
            asked.get("document") or {},
            path.suffix,
            str(base.get("text") or ""),
            str(base.get("suffix") or ""),
            makers,
        )
        shown = self._folders.shown(path)
        there = path.read_bytes() if path.is_file() else None
        own = there is not None and digest(there) == base.get("sha256")
        if there is not None and not own and not asked.get("replace"):
            changed = "was changed by another program since it was opened"
            raise OtherFileError(f"{shown} {changed if base.get('file') == shown else 'is there'}")
        if there is None or text_in(path, latin_1=True) != file.text:
            try:
                path.parent.mkdir(parents=True, exist_ok=True)
                replace_file(path, file.text.encode())
            except OSError as error:
                raise SocialmindError(f"{shown}: cannot be written ({error.strerror})") from None
        text, suffix = str(base.get("text") or ""), base.get("suffix")
        # What it was opened from stays what is changed: parts have the identities of that text.
        return {"notes": list(file.notes), **self._place(path, text, suffix)}

    def _place(self, path: Path | None, text: str, suffix: str | None = None) -> Asked:
        """Say where a scheme came from, as it is to be said again when it is saved."""
        if path is None:
            return {"base": None, "writable": False}
        shown = self._folders.shown(path)
        try:
            self._folders.to_write(shown)
            writable = os.access(path, os.W_OK)
        except SocialmindError:
            writable = False
        base = {
            "file": shown,
            "text": text,
            "suffix": suffix or path.suffix,
            "sha256": digest(path.read_bytes()),
        }
        return {"base": base, "writable": writable}

    def _model(self, asked: Asked) -> Any:
        name = asked.get("model")
        if not isinstance(name, str) or name not in self._models():
            raise SocialmindError(f"no model {name!r}; start the studio with its folder")
        return load_model(name)

    def _bearers(self, asked: Asked) -> Bearers | None:
        """Return whose scheme it is to be, if that was said."""
        if not asked.get("model"):
            return None
        return Bearers.of(self._model(asked), str(asked.get("population")))


def _scheme_files(home: Path) -> Iterator[Path]:
    """Yield the files below a folder that hold schemes; hidden folders and runs are left out."""
    left = MOST_LOOKED_AT
    for folder, inner, names in os.walk(home):
        inner[:] = sorted(
            name
            for name in inner
            if not name.startswith((".", "__")) and name not in ("node_modules", "runs", "venv")
        )
        left -= len(names) + len(inner)
        if left < 0:
            return
        for name in sorted(names):
            path = Path(folder, name)
            suffix = path.suffix.lower()
            if suffix == ".cogscheme" or (suffix in YAML and _holds_scheme(path)):
                yield path


def _holds_scheme(path: Path) -> bool:
    try:
        with path.open("rb") as file:
            head = file.read(HEAD)
    except OSError:
        return False
    lines = head.splitlines()
    named = any(line.startswith(b"name:") for line in lines)
    return named and any(line.startswith((b"cognitons:", b"decision_maker:")) for line in lines)
