"""Cognitive schemes as a run keeps them: files, byte for byte."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py import CognitiveScheme
from socialmind.sources.folders import digest

if TYPE_CHECKING:
    from socialmind.model import Model

    SchemeArgument = str | Path | CognitiveScheme | Mapping[str, Any] | None


def scheme_copies(
    model: Model, given: SchemeArgument
) -> tuple[dict[str, dict[str, str]], dict[str, bytes]]:
    """The schemes of a model as its run keeps them.

    A file is kept byte for byte, comments and all; a scheme made in Python as YAML.

    Args:
        model: the run's model.
        given: what the user gave in place of the model's own.

    Returns:
        For each population with minds, the manifest's record of its scheme; and the content of
        each file.
    """
    records, files = {}, {}
    for population, scheme in model.schemes.items():
        source = given.get(population) if isinstance(given, Mapping) else given
        if source is None:
            source = model.populations[population].mind
            if isinstance(source, str | Path):
                source = type(model).folder() / source
        suffix, content = as_kept(scheme if source is None else source)
        alone = len(model.schemes) == 1
        file = f"scheme{suffix}" if alone else f"scheme-{population}{suffix}"
        records[population] = {"name": scheme.name, "file": file, "sha256": digest(content)}
        files[file] = content
    return records, files


def as_kept(source: str | Path | CognitiveScheme) -> tuple[str, bytes]:
    """Return the suffix and the content of a scheme's file.

    Args:
        source: the file; or a scheme made in Python, which is written as YAML.
    """
    if not isinstance(source, CognitiveScheme):
        return Path(source).suffix, Path(source).expanduser().read_bytes()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scheme.yaml"
        source.save(path)
        return ".yaml", path.read_bytes()
