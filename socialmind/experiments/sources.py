"""What a run was made from: the files of its model, and its copy of the cognitive scheme."""

from __future__ import annotations

import hashlib
import inspect
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from socialmind.catalogue import MODEL_FILE, catalogue, load_model, source_hash
from socialmind.errors import SocialmindError

if TYPE_CHECKING:
    from coglogo_py.scheme import CognitiveScheme
    from socialmind.experiments.capsule import Capsule
    from socialmind.model import Model


def model_source(model_class: type[Model]) -> dict[str, str | None]:
    """Where a model stands and the hash of its source, as the manifest records it.

    A class defined in a ``model.py`` stands for its folder; one of another file for that file;
    one typed into an interpreter has neither path nor hash.
    """
    try:
        path: Path | None = Path(inspect.getfile(model_class)).resolve()
    except (OSError, TypeError):
        path = None
    if path is None or not path.is_file():
        return {"name": model_class.__name__, "path": None, "source_sha256": None}
    if path.name == MODEL_FILE:
        path = path.parent
    return {
        "name": path.name if path.is_dir() else model_class.__name__,
        "path": str(path),
        "source_sha256": source_hash(path),
    }


def recorded_folder(capsule: Capsule) -> Path | None:
    """The folder of a run's model: where it stood, or the one of that name that ships."""
    name, path = capsule.manifest.model["name"], capsule.manifest.model["path"]
    if path is not None and (Path(path) / MODEL_FILE).is_file():
        return Path(path)
    return catalogue().get(name or "")


def recorded_class(capsule: Capsule) -> type[Model]:
    """The model class of a run, loaded from the folder that its manifest names.

    Raises:
        SocialmindError: no such folder is here.
    """
    folder = recorded_folder(capsule)
    if folder is None:
        record = capsule.manifest.model
        raise SocialmindError(
            f"{capsule.folder}: its model {record['name']} is not at {record['path']}; "
            "put its folder there, or give the class as model_class in Python"
        )
    return load_model(folder)


def changes_since(capsule: Capsule, model_class: type[Model]) -> str | None:
    """What differs between the run's model or scheme and the files as they are; None if nothing."""
    found = model_source(model_class)
    if found["source_sha256"] != capsule.manifest.model["source_sha256"]:
        return f"{found['path']}: the model's source is not the one the run was made with"
    record = capsule.manifest.scheme
    if record is not None and capsule.scheme is not None:
        if not capsule.scheme.is_file():
            return f"{capsule.scheme}: the run's copy of its scheme is missing"
        if hashlib.sha256(capsule.scheme.read_bytes()).hexdigest() != record["sha256"]:
            return f"{capsule.scheme}: the run's copy of its scheme was changed"
    return None


def model_of(
    capsule: Capsule,
    model_class: type[Model] | None = None,
    compiled: bool | None = None,
    strict: bool = True,
) -> Model:
    """A run's model at tick 0.

    Args:
        capsule: the run.
        model_class: its class; loaded from where the manifest says by default.
        compiled: speed; the run's by default.
        strict: refuse a model whose source or scheme was changed since.

    Raises:
        SocialmindError: the model is missing, or was changed.
    """
    manifest = capsule.manifest
    cls = recorded_class(capsule) if model_class is None else model_class
    changed = changes_since(capsule, cls) if strict else None
    if changed:
        raise SocialmindError(f"{changed}; put the old file back, or start another run")
    return cls(
        seed=manifest.seed,
        compiled=manifest.compiled if compiled is None else compiled,
        scheme=capsule.scheme,
        **manifest.parameters,
    )


def scheme_copy(
    model: Model, given: CognitiveScheme | str | Path | None
) -> tuple[dict[str, str] | None, bytes | None]:
    """The manifest's record of a model's scheme, and the content of the copy a run keeps.

    Args:
        model: the run's model.
        given: what the user gave; a file is kept byte for byte, anything else as YAML.
    """
    scheme: CognitiveScheme | None = model.scheme
    if scheme is None:
        return None, None
    if isinstance(given, str | Path):
        path = Path(given).expanduser()
        suffix, content = path.suffix, path.read_bytes()
    else:
        suffix = ".yaml"
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"scheme{suffix}"
            scheme.save(path)
            content = path.read_bytes()
    record = {
        "name": scheme.name,
        "file": f"scheme{suffix}",
        "sha256": hashlib.sha256(content).hexdigest(),
    }
    return record, content
