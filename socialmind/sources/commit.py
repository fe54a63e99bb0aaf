"""Which commit of its repository the program is, where it runs from a clone."""

from __future__ import annotations

import subprocess
from pathlib import Path

PACKAGES = ("socialmind", "coglogo_py")


def own_commit(repository: Path | None = None) -> str:
    """Return the commit that the program is, abbreviated; an empty text where none is.

    None is it where the program was installed from a wheel, or where its files were edited since.

    Args:
        repository: a clone's folder; that of the program by default.
    """
    root = repository or Path(__file__).parents[2]
    if not (root / ".git").exists():  # or that of a project which the program is installed in
        return ""
    try:
        edited = _git(root, "status", "--porcelain", "--", *PACKAGES)
        return "" if edited else _git(root, "rev-parse", "--short=10", "HEAD")
    except (OSError, subprocess.SubprocessError):
        return ""


def _git(root: Path, *words: str) -> str:
    done = subprocess.run(
        ["git", "-C", str(root), *words], capture_output=True, text=True, check=True, timeout=10
    )
    return done.stdout.strip()
