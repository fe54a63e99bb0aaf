"""Minds in files for the tests of this folder."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture
def write_files(tmp_path):
    """Write files from a table of path and text; gives the folder."""

    def write(files, folder="mind"):
        home = tmp_path / folder
        for path, text in files.items():
            (home / path).parent.mkdir(parents=True, exist_ok=True)
            if isinstance(text, bytes):
                (home / path).write_bytes(text)
            else:
                (home / path).write_text(text, encoding="utf-8", newline="")
        return home

    return write
