"""The folders that pages may read and write in: where the studio began, and what it was given."""

from __future__ import annotations

from pathlib import Path

from socialmind.errors import SocialmindError


class Folders:
    """Where pages may read and write.

    Args:
        home: the folder in which the studio was started; pages read and write below it.
        given: files and folders that were named on the command line; likewise.
        readable: folders that may be read alone, as those of the models that come with the package.
    """

    def __init__(
        self, home: Path, given: tuple[Path, ...] = (), readable: tuple[Path, ...] = ()
    ) -> None:
        self.home = home.resolve()
        self._given = tuple(one.resolve() for one in given)
        self._readable = tuple(one.resolve() for one in readable)

    def to_read(self, said: object) -> Path:
        """Return the path that a page named, which it may read.

        Args:
            said: as the page says it, from `home` if relative.

        Raises:
            SocialmindError: it lies elsewhere, also by a link.
        """
        return self._within(said, (self.home, *self._given, *self._readable))

    def to_write(self, said: object) -> Path:
        """Return the path that a page named, which it may write.

        Args:
            said: as the page says it, from `home` if relative.

        Raises:
            SocialmindError: it lies elsewhere, also by a link.
        """
        return self._within(said, (self.home, *self._given))

    def shown(self, path: Path) -> str:
        """Return a path as pages are told it: from `home` where it is below."""
        path = path.resolve()
        return str(path.relative_to(self.home) if path.is_relative_to(self.home) else path)

    def _within(self, said: object, allowed: tuple[Path, ...]) -> Path:
        if not isinstance(said, str) or not said.strip() or "\0" in said:
            raise SocialmindError(f"{said!r} is no path")
        path = (self.home / said).resolve()
        if not any(path == one or path.is_relative_to(one) for one in allowed):
            raise SocialmindError(f"{said} is not below {self.home}, where the studio was started")
        return path
