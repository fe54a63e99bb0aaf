"""`socialmind new`."""

from __future__ import annotations

import shutil
from pathlib import Path

from socialmind.errors import SocialmindError

TEMPLATE = Path(__file__).parent.parent / "template"
FILES = ("model.py", "scheme.yaml", "README.md")


def write_model(folder: Path) -> None:
    """Copy the small model to start from.

    Args:
        folder: to make; it may be there when it is empty.

    Raises:
        SocialmindError: the folder holds something, or is a file.
    """
    if folder.is_dir():
        if any(folder.iterdir()):
            raise SocialmindError(f"{folder}: is not empty; give a fresh folder")
    elif folder.exists():
        raise SocialmindError(f"{folder}: is a file; give a folder")
    folder.mkdir(parents=True, exist_ok=True)
    for name in FILES:
        shutil.copyfile(TEMPLATE / name, folder / name)
