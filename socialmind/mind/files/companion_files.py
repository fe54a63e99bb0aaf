"""Files that go with a mind's: Python files of functions, schemes; all written at the end."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from coglogo_py import CognitiveScheme
from socialmind.errors import ModelError, of_model_file
from socialmind.mind.files.evoagents.text_file import field, write_text
from socialmind.mind.files.python_file import Function, function_text, source_file
from socialmind.mind.functions.cogniton_scheme import CognitonScheme

Texts = dict[Path, str]
"""The files to be written. All are drawn up before the first one is written."""


def file_name(name: str, suffix: str) -> str:
    """Return the name of a module as that of a file or folder.

    Raises:
        ModelError: it cannot be one.
    """
    field(name, "the name of a file")
    if not name or name.startswith(".") or "/" in name or "\\" in name:
        raise ModelError(
            f"{name!r} as the name of a file",
            "a name without '/' that does not begin with '.'",
            "rename it, or save the mind as one .yaml file",
        )
    return name + suffix


def add_function(
    function: Function, folder: Path, texts: Texts, names: tuple[str, ...] = ()
) -> str:
    """Note a function's Python file among the files to be written; one that is there stays.

    Args:
        function: the function.
        folder: the folder that is to hold the file.
        texts: the files to be written.
        names: what the file may be called, without `.py`, the first one best; nothing: as the file
            it comes from.

    Returns:
        The file's name.

    Raises:
        ModelError: its source cannot be had, or another file of that name is to be written.
    """
    source = source_file(function)
    there = source is not None and source.resolve().parent == folder.resolve()
    if source is not None and there and (not names or source.stem in names):
        return source.name
    name = f"{(names or (function.__name__,))[0]}.py"
    text = function_text(function, names[0] if names else "")
    if texts.setdefault(folder / name, text) != text:
        raise ModelError(
            f"two functions called {function.__name__!r}",
            f"one in {folder / name}",
            "rename one of them",
        )
    return name


def write(texts: Mapping[Path, str], schemes: Mapping[Path, CognitonScheme]) -> None:
    """Write files, and schemes where the file does not hold them already.

    Raises:
        ModelError: one cannot be written.
    """
    for file, text in texts.items():
        write_text(file, text)
    for file, function in schemes.items():
        with of_model_file(file):
            if file.is_file() and CognitiveScheme.load(file) == function.scheme:
                continue
            file.parent.mkdir(parents=True, exist_ok=True)
            function.scheme.save(file)
