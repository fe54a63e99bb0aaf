"""What a run was made from: the files of its model, and its copies of schemes and minds."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from socialmind.catalogue import load_model, load_script
from socialmind.errors import SocialmindError
from socialmind.runs import folders
from socialmind.sources.cells import FILE
from socialmind.sources.folders import MODEL_FILE, catalogue, digest, file_of_class, source_hash
from socialmind.sources.loading import modules_from
from socialmind.sources.provenance import CELLS, KEPT, difference, difference_of_copies, sources_of
from socialmind.sources.trust import programs_in, remember, require

if TYPE_CHECKING:
    from socialmind.mind.description import MindDescription
    from socialmind.model import Model
    from socialmind.runs.capsule import Capsule

    HierarchyArgument = str | Path | MindDescription | Mapping[str, Any] | None


class Made(Protocol):
    """A folder of what was made with a model: a run's, or a sweep's."""

    @property
    def folder(self) -> Path:
        """Where it lies."""

    @property
    def manifest(self) -> Any:
        """Its ``model``, ``schemes``, ``minds``, ``interventions`` and ``versions``."""

    @property
    def schemes(self) -> dict[str, Path]:
        """Its copies of schemes, by their names in the manifest."""

    @property
    def minds(self) -> dict[str, Path]:
        """Its copies of minds likewise."""


def model_source(model_class: type[Model]) -> dict[str, Any]:
    """Where a model stands and what it is made from, as the manifest records it.

    A class defined in a ``model.py`` stands for its folder; one of another file for that file;
    one typed into a notebook or interpreter has no path.

    Raises:
        SocialmindError: a file was edited since it was loaded.
    """
    file = file_of_class(model_class)
    path = None if file is None else file.resolve()
    if path is not None and path.name == MODEL_FILE:
        path = path.parent
    there = path is not None and path.exists()
    named = path is not None and path.is_dir() and path.name != folders.OWN_MODEL
    return {
        "name": path.name if path is not None and named else model_class.__name__,
        "path": str(path) if there else None,
        "source_sha256": source_hash(path) if path is not None and there else None,
        "sources": sources_of(model_class).record(),
    }


def is_own(folder: Path, model_class: type[Model]) -> bool:
    """Return whether a run's folder holds the model itself, written for this run."""
    file = file_of_class(model_class)
    return file is not None and file.resolve().parent == folder.resolve() / folders.OWN_MODEL


def with_late_reads(record: dict[str, Any], model_class: type[Model]) -> dict[str, Any]:
    """A manifest's record of a model, with the files that the model has read since it was made."""
    sources = record.get("sources")
    if sources is None:
        return record
    found = sources_of(model_class).late(sources["files"])
    return {**record, "sources": {**sources, "files": {**sources["files"], **found}}}


def recorded_folder(capsule: Made) -> Path | None:
    """The folder of a run's model: its own, where it stood, or the one of that name that ships."""
    if (capsule.folder / folders.OWN_MODEL / MODEL_FILE).is_file():
        return capsule.folder / folders.OWN_MODEL
    name, path = capsule.manifest.model["name"], capsule.manifest.model["path"]
    if path is not None and (Path(path) / MODEL_FILE).is_file():
        return Path(path)
    return catalogue().get(name or "")


def _script(capsule: Made) -> Path | None:
    """The script that defines a run's model, where it stood."""
    path = capsule.manifest.model["path"]
    return Path(path) if path is not None and Path(path).is_file() else None


def recorded_class(capsule: Made, kept: bool = False, trust: bool = False) -> type[Model]:
    """The model class of a run, loaded from where its manifest says, or from the run's copies.

    Args:
        capsule: the run.
        kept: from the copies that the run keeps.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: the model is not there, or it holds unknown programs.
    """
    record = capsule.manifest.model
    path = None if record["path"] is None else Path(record["path"])
    typed_in = path is None and (capsule.folder / KEPT / CELLS).is_file()
    if kept or typed_in:
        return _kept_class(capsule, path, trust)
    folder = recorded_folder(capsule)
    if folder is not None:
        require(programs_in(folder), trust, f"{capsule.folder}: its model at {folder}")
        return _with_minds(capsule, load_model(folder), trust, folder)
    if path is not None and path.is_file():
        require(programs_in(path), trust, f"{capsule.folder}: its model at {path}")
        return _with_minds(capsule, load_script(path, record["name"]), trust)
    where = f"is not at {path}"
    if path is None:
        where = "was typed into a notebook or interpreter, and could not be kept as a file"
    remedy = "give the class as model_class in Python"
    if (capsule.folder / KEPT).is_dir():
        remedy += ", or take the run's own copy: --source kept"
    raise SocialmindError(f"{capsule.folder}: its model {record['name']} {where}; {remedy}")


def _with_minds(
    capsule: Made, cls: type[Model], trust: bool, checked: Path | None = None
) -> type[Model]:
    """The class, whose minds may lie beside its folder, of which all programs are checked."""
    for population in cls.populations.values():
        if isinstance(population.hierarchy, str | Path):
            mind = cls.folder() / population.hierarchy
            if checked is not None and mind.resolve().is_relative_to(checked.resolve()):
                continue
            require(programs_in(mind), trust, f"{capsule.folder}: the mind at {mind}")
    return cls


def _kept_class(capsule: Made, path: Path | None, trust: bool) -> type[Model]:
    home = capsule.folder / KEPT
    name = FILE if path is None else path.name
    if not (home / "model" / name).is_file() and not (home / "model" / MODEL_FILE).is_file():
        raise SocialmindError(
            f"{capsule.folder}: keeps no copy of its model's source; give the class as model_class"
        )
    changed = difference_of_copies(capsule.manifest.model["sources"], capsule.folder)
    if changed:
        raise SocialmindError(changed)
    require(programs_in(home), trust, f"{capsule.folder}: its copy of the model's source")
    with modules_from(home / "modules"):
        if (home / "model" / MODEL_FILE).is_file():
            return load_model(home / "model")
        return load_script(home / "model" / name, capsule.manifest.model["name"])


def require_minds(capsule: Made, trust: bool) -> None:
    """Refuse unknown programs in a run's copies of its minds, unless they are trusted.

    Raises:
        SocialmindError: there are some; lists them.
    """
    for path in capsule.minds.values():
        require(programs_in(path), trust, f"{capsule.folder}: its copy of a mind")


def changes_since(capsule: Made, model_class: type[Model]) -> str | None:
    """What differs between the run's model or schemes and the files as they are, or None."""
    record = capsule.manifest.model
    if _is_kept(capsule, model_class):
        changed = difference_of_copies(record["sources"], capsule.folder)
    elif "sources" in record:
        changed = difference(record["sources"], sources_of(model_class))
    else:  # a run from before modules and data elsewhere were looked at
        found = model_source(model_class)
        same = found["source_sha256"] == record["source_sha256"]
        changed = None if same else f"{found['path']}: is not the source the run was made with"
    if changed:
        return changed
    for population, path in capsule.schemes.items():
        if not path.is_file():
            return f"{path}: the run's copy of its scheme is missing"
        if digest(path.read_bytes()) != capsule.manifest.schemes[population]["sha256"]:
            return f"{path}: the run's copy of its scheme was changed"
    for population, path in capsule.minds.items():
        if not path.is_dir():
            return f"{path}: the run's copy of its mind is missing"
        if hash_of(mind_files_in(path)) != capsule.manifest.minds[population]["sha256"]:
            return f"{path}: the run's copy of its mind was changed"
    return None


def what_was_edited(record: Mapping[str, Any], place: Path) -> str | None:
    """What differs between a record and the files of a model, found without running any of them.

    Args:
        record: what a manifest says of the model.
        place: the model's folder, or the script that defines it.
    """
    folder = place.parent if place.is_file() else place
    for label, hashed in (record.get("sources") or {"files": {}})["files"].items():
        kind, _, name = label.partition("/")
        if kind == "model" and name.endswith(".py"):
            file = folder / name
            if not file.is_file() or digest(file.read_bytes()) != hashed:
                return f"{file}: is not the file that the run was made with"
    if record.get("sources") is None and source_hash(place) != record["source_sha256"]:
        return f"{place}: is not the source the run was made with"
    return None


def _is_kept(capsule: Made, model_class: type[Model]) -> bool:
    """Return whether a class was loaded from a run's own copies."""
    file = file_of_class(model_class)
    return file is not None and file.is_relative_to(capsule.folder / KEPT)


def model_of(
    capsule: Capsule,
    model_class: type[Model] | None = None,
    compiled: bool | None = None,
    kept: bool = False,
    trust: bool = False,
) -> Model:
    """A run's model at tick 0.

    Args:
        capsule: the run.
        model_class: its class; loaded from where the manifest says by default.
        compiled: speed; the run's by default.
        kept: load the class from the copies that the run keeps.
        trust: run programs that this user has neither named nor run before.

    Raises:
        SocialmindError: as `checked_class`.
    """
    manifest = capsule.manifest
    return checked_class(capsule, model_class, kept, trust)(
        seed=manifest.seed,
        compiled=manifest.compiled if compiled is None else compiled,
        scheme=capsule.schemes or None,
        hierarchy=capsule.minds or None,
        **physics_of(manifest.engine),
        **manifest.parameters,
    )


def checked_class(
    capsule: Made,
    model_class: type[Model] | None = None,
    kept: bool = False,
    trust: bool = False,
    what: str = "run",
) -> type[Model]:
    """The class of a run's or a sweep's model, which is what it was made with.

    Args:
        capsule: the run or sweep.
        model_class: its class; loaded from where the manifest says by default.
        kept: load the class from the copies that the run keeps.
        trust: run programs that this user has neither named nor run before.
        what: "run" or "sweep".

    Raises:
        SocialmindError: the model is missing, or it, its scheme or socialmind was changed since;
            or model or minds hold unknown programs.
    """
    manifest = capsule.manifest
    require_minds(capsule, trust)
    cls = model_class
    # Said before anything is run, or asked about.
    place = recorded_folder(capsule) or _script(capsule)
    changed = (
        None if kept or cls is not None or place is None else what_was_edited(manifest.model, place)
    )
    if cls is None and not changed:
        cls = recorded_class(capsule, kept, trust)
    changed = changed or (None if cls is None else changes_since(capsule, cls))
    if changed or cls is None:
        remedies = ["put the old file back", f"start another {what}"]
        if (capsule.folder / KEPT).is_dir():
            remedies.insert(1, f"take the {what}'s own copies (--source kept)")
        remedy = f"{', '.join(remedies[:-1])}, or {remedies[-1]}"
        raise SocialmindError(f"{changed}; {remedy}")
    folders.refuse_other_version(capsule.folder, what, manifest.versions)
    return cls


def physics_of(engine: str) -> dict[str, Any]:
    """What a model is made with for an engine; only a model on a plane can take another one."""
    return {} if engine == "compiled" else {"physics": engine}


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
        from socialmind.mind.files.packing import files_of  # where there are minds it is loaded

        found = files_of(assembly.description)
        folder = f"minds/{population}"
        name, sha256 = assembly.description.name, hash_of(found)
        remember({path: content for path, content in found.items() if path.endswith(".py")})
        records[population] = {"name": name, "folder": folder, "sha256": sha256}
        files |= {f"{folder}/{path}": content for path, content in found.items()}
    return records, files


def files_in(folder: Path) -> dict[str, bytes]:
    """The files of a folder but what Python leaves there, by their paths in it."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file())
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in paths
        if "__pycache__" not in path.parts
    }


def mind_files_in(folder: Path) -> dict[str, bytes]:
    """The files of a kept mind, by their paths in it; where an editor draws it is none of it."""
    from socialmind.mind.files.layout import LAYOUT  # where there are minds it is loaded

    found = files_in(folder).items()
    return {name: content for name, content in found if "/" in name or not name.endswith(LAYOUT)}


def hash_of(files: Mapping[str, bytes]) -> str:
    """Return a hash of files, by their names and contents."""
    whole = "".join(f"{name} {digest(content)}\n" for name, content in sorted(files.items()))
    return digest(whole.encode())
