"""What a run was made from: the files of its model, and its copies of schemes and minds."""

from __future__ import annotations

import hashlib
import inspect
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import socialmind
from socialmind.catalogue import MODEL_FILE, catalogue, load_model, source_hash
from socialmind.errors import SocialmindError
from socialmind.trust import programs_in, remember, require

if TYPE_CHECKING:
    from coglogo_py.scheme import CognitiveScheme
    from socialmind.experiments.capsule import Capsule
    from socialmind.mind.description import MindDescription
    from socialmind.model import Model

    SchemeArgument = str | Path | CognitiveScheme | Mapping[str, Any] | None
    HierarchyArgument = str | Path | MindDescription | Mapping[str, Any] | None


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


def recorded_class(capsule: Capsule, trust: bool = False) -> type[Model]:
    """The model class of a run, loaded from the folder that its manifest names.

    Args:
        capsule: the run.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: no such folder is here, or it holds unknown programs.
    """
    folder = recorded_folder(capsule)
    if folder is None:
        record = capsule.manifest.model
        raise SocialmindError(
            f"{capsule.folder}: its model {record['name']} is not at {record['path']}; "
            "put its folder there, or give the class as model_class in Python"
        )
    require(programs_in(folder), trust, f"{capsule.folder}: its model at {folder}")
    cls = load_model(folder)
    for population in cls.populations.values():
        # A mind may lie beside the model's folder.
        if isinstance(population.hierarchy, str | Path):
            mind = cls.folder() / population.hierarchy
            require(programs_in(mind), trust, f"{capsule.folder}: the mind at {mind}")
    return cls


def require_minds(capsule: Capsule, trust: bool) -> None:
    """Refuse unknown programs in a run's copies of its minds, unless they are trusted.

    Raises:
        SocialmindError: there are some; lists them.
    """
    for path in capsule.minds.values():
        require(programs_in(path), trust, f"{capsule.folder}: its copy of a mind")


def changes_since(capsule: Capsule, model_class: type[Model]) -> str | None:
    """What differs between the run's model or schemes and the files as they are, or None."""
    found = model_source(model_class)
    if found["source_sha256"] != capsule.manifest.model["source_sha256"]:
        return _changed(found["path"])
    for population, path in capsule.schemes.items():
        if not path.is_file():
            return f"{path}: the run's copy of its scheme is missing"
        if _sha256(path.read_bytes()) != capsule.manifest.schemes[population]["sha256"]:
            return f"{path}: the run's copy of its scheme was changed"
    for population, path in capsule.minds.items():
        if not path.is_dir():
            return f"{path}: the run's copy of its mind is missing"
        if _hash_of(_files_in(path)) != capsule.manifest.minds[population]["sha256"]:
            return f"{path}: the run's copy of its mind was changed"
    return None


def _changed(path: str | Path | None) -> str:
    return f"{path}: the model's source is not the one the run was made with"


def model_of(
    capsule: Capsule,
    model_class: type[Model] | None = None,
    compiled: bool | None = None,
    trust: bool = False,
) -> Model:
    """A run's model at tick 0.

    Args:
        capsule: the run.
        model_class: its class; loaded from where the manifest says by default.
        compiled: speed; the run's by default.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: the model is missing, or it, its scheme or socialmind was changed since;
            or model or minds hold unknown programs.
    """
    manifest = capsule.manifest
    require_minds(capsule, trust)
    folder = None if model_class is not None else recorded_folder(capsule)
    if folder is not None and source_hash(folder) != manifest.model["source_sha256"]:
        # Said before anything is run, or asked about.
        raise SocialmindError(f"{_changed(folder)}; put the old file back, or start another run")
    cls = recorded_class(capsule, trust) if model_class is None else model_class
    changed = changes_since(capsule, cls)
    if changed:
        raise SocialmindError(f"{changed}; put the old file back, or start another run")
    then, today = manifest.versions.get("socialmind"), socialmind.__version__
    if then != today:
        raise SocialmindError(
            f"{capsule.folder}: made by socialmind {then}, this is {today}, whose runs may differ; "
            f"install {then}, or start another run"
        )
    return cls(
        seed=manifest.seed,
        compiled=manifest.compiled if compiled is None else compiled,
        scheme=capsule.schemes or None,
        hierarchy=capsule.minds or None,
        **physics_of(manifest.engine),
        **manifest.parameters,
    )


def physics_of(engine: str) -> dict[str, Any]:
    """What a model is made with for an engine; only a model on a plane can take another one."""
    return {} if engine == "compiled" else {"physics": engine}


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
                source = model.folder() / source
        if isinstance(source, str | Path):
            suffix, content = Path(source).suffix, Path(source).expanduser().read_bytes()
        else:
            suffix, content = ".yaml", _as_yaml(scheme)
        alone = len(model.schemes) == 1
        file = f"scheme{suffix}" if alone else f"scheme-{population}{suffix}"
        records[population] = {"name": scheme.name, "file": file, "sha256": _sha256(content)}
        files[file] = content
    return records, files


def mind_copies(model: Model) -> tuple[dict[str, dict[str, str]], dict[str, bytes]]:
    """The hierarchies of skills of a model as its run keeps them: each a mind's folder.

    Args:
        model: the run's model.

    Returns:
        For each population with hierarchies, the manifest's record of its mind; and the content
        of each file.
    """
    records: dict[str, dict[str, str]] = {}
    files: dict[str, bytes] = {}
    for population, assembly in model.assemblies.items():
        with tempfile.TemporaryDirectory() as place:
            assembly.description.save(Path(place) / "mind")
            found = _files_in(Path(place) / "mind")
        folder = f"minds/{population}"
        name, sha256 = assembly.description.name, _hash_of(found)
        remember({path: content for path, content in found.items() if path.endswith(".py")})
        records[population] = {"name": name, "folder": folder, "sha256": sha256}
        files |= {f"{folder}/{path}": content for path, content in found.items()}
    return records, files


def _files_in(folder: Path) -> dict[str, bytes]:
    """The files of a folder but what Python leaves there, by their paths in it."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file())
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in paths
        if "__pycache__" not in path.parts
    }


def _hash_of(files: Mapping[str, bytes]) -> str:
    whole = "".join(f"{name} {_sha256(content)}\n" for name, content in sorted(files.items()))
    return _sha256(whole.encode())


def _as_yaml(scheme: CognitiveScheme) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scheme.yaml"
        scheme.save(path)
        return path.read_bytes()


def _sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
