"""Branches: a run gone back to, changed, and gone on with as a run of its own."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py import CognitiveScheme
from socialmind.errors import SocialmindError
from socialmind.interventions.change import Change
from socialmind.interventions.following import Intervention, in_order
from socialmind.interventions.shock import Shock
from socialmind.runs import continuing, folders
from socialmind.runs.branching.kept import FOLDER, copies_of, interventions_of
from socialmind.runs.branching.past import rows_before, with_society
from socialmind.runs.branching.repeating import society_at
from socialmind.runs.capsule import Capsule, Manifest
from socialmind.runs.execution import Progress, whole
from socialmind.runs.loop import Execution
from socialmind.runs.sources import files_in, model_of
from socialmind.society.settings import sorted_out
from socialmind.sources.provenance import KEPT

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.runs.checkpoint import Checkpoint
    from socialmind.runs.schemes import SchemeArgument


def branch(
    folder: str | Path,
    at: int,
    settings: Mapping[str, Any] | Iterable[tuple[str, Any]] = (),
    scheme: SchemeArgument = None,
    do: Sequence[Any] = (),
    ticks: int | None = None,
    out: str | Path | None = None,
    compiled: bool | None = None,
    model_class: type[Model] | None = None,
    on_progress: Progress | None = None,
    checkpoint_every: float = 5.0,
    kept: bool = False,
    trust: bool = False,
) -> Path:
    """Go back to a moment of a run, change something, and go on as a run of its own.

    Both futures draw the same numbers. Without a change the branch equals the run, to the last bit.

    Args:
        folder: the run's, which stays as it is.
        at: the tick to go back to, 0 … the ticks done. What is recorded of it is as in the run.
        settings: parameters, or words of schemes such as ``influence.WheatNeed.GrowWheat``, with
            their values, by name.
        scheme: a scheme, or its file, in place of the one in force then; for a model with several
            populations that have minds, a mapping from their names.
        do: functions that change the society, as of `Shock`.
        ticks: length of the whole branch, those before included; as the run's by default.
        out: folder to make, or an empty one; by default the next number under ``runs/``.
        compiled: speed from here on; the run's by default.
        model_class: the model; loaded from where the run says it stands by default.
        on_progress: as for `run`.
        checkpoint_every: as for `run`.
        kept: whether to take the copies of the model's source that the run keeps.
        trust: run programs that this user has neither named nor run before.

    Returns:
        The branch's folder.

    Raises:
        SocialmindError: no such tick, a change that does not fit, a folder in use, or the model was
            changed since.
        Interrupted: Ctrl-C; what was done is safe, `resume` goes on.
    """
    started = time.perf_counter()
    target = None if out is None else Path(out)
    if target is not None:
        folders.refuse_unless_free(target.expanduser())
    origin = Capsule(folder)
    checkpoint = continuing.checked_checkpoint(origin)
    at = _moment(origin, at, continuing.ticks_done(origin.manifest, checkpoint))
    length = origin.manifest.ticks if ticks is None else whole("ticks", ticks, 0)
    if length < at:
        raise SocialmindError(f"ticks: {length} in all, and the branch begins at tick {at}")
    model = model_of(origin, model_class, compiled, kept, trust)
    known = interventions_of(origin, trust)
    changes = sorted_out(type(model), settings)
    society = society_at(model, known, at, checkpoint, origin, on_progress)
    if society.tick < at:
        raise SocialmindError(f"{origin.folder}: repeated, the run stops at tick {society.tick}")
    schemes = _schemes_then(society, known)
    other = _whole_schemes(type(model), scheme)
    told = _in_words(changes.parameters, changes.words, other, do)
    other |= changes.changed({**schemes, **_read(type(model), other)}, type(model).populations)
    own: list[Intervention] = []
    if changes.parameters or other:
        own.append(Change(at, changes.parameters, other))
        own[0].applied(society)  # what does not fit is said before a folder is made
    own += [Shock(at, one) for one in do]
    manifest, files = _as_branch(origin, checkpoint, own, at, length, told, type(model))
    if compiled is not None:
        manifest = replace(manifest, compiled=compiled)
    capsule = Capsule.create(target, manifest, files)
    with capsule.locked():
        past = rows_before(origin, checkpoint, at, capsule.parts)
        begin = None
        if past is not None:
            begin = with_society(past, society, manifest.identity())
            begin.save(capsule.checkpoint)
            capsule.update(ticks_done=at)
        execution = Execution(capsule, society, begin, started, in_order((*known, *own)))
        execution.go(length, on_progress, checkpoint_every)
    return capsule.folder


def _moment(origin: Capsule, at: Any, done: int) -> int:
    tick = whole("at", at, 0)
    if tick > done:
        raise SocialmindError(
            f"{origin.folder}: tick {tick}; expected 0 … {done}, the ticks that the run has done"
        )
    return tick


def _schemes_then(society: Model, known: Iterable[Intervention]) -> dict[str, CognitiveScheme]:
    """Return the schemes with which a society leaves its tick."""
    found = dict(society.schemes)
    for one in known:
        if isinstance(one, Change) and one.tick == society.tick:
            found |= _read(type(society), one.schemes)
    return found


def _read(
    kind: type[Model], schemes: Mapping[str, CognitiveScheme | Path]
) -> dict[str, CognitiveScheme]:
    found = {}
    for name, one in schemes.items():
        if not isinstance(one, CognitiveScheme):
            one = CognitiveScheme.load(one, kind.populations[name].decision_makers)
        found[name] = one
    return found


def _whole_schemes(kind: type[Model], scheme: SchemeArgument) -> dict[str, CognitiveScheme | Path]:
    """Return the schemes that were given, by population."""
    minded = [name for name, one in kind.populations.items() if one.mind is not None]
    if scheme is None:
        return {}
    if not isinstance(scheme, Mapping):
        if len(minded) != 1:
            raise SocialmindError(
                f"a scheme for {kind.name}, which has {len(minded)} populations with minds; "
                f"give a mapping from {', '.join(minded) or 'their names'}"
            )
        scheme = {minded[0]: scheme}
    for name in scheme:
        if name not in minded:
            known = ", ".join(minded) or "none"
            raise SocialmindError(
                f"a scheme of {name!r} in {kind.name}; populations with schemes: {known}"
            )
    return {
        name: one if isinstance(one, CognitiveScheme) else Path(one).expanduser()
        for name, one in scheme.items()
    }


def _in_words(
    parameters: Mapping[str, Any],
    words: Mapping[str, Iterable[tuple[str, Any]]],
    schemes: Mapping[str, CognitiveScheme | Path],
    do: Iterable[Any],
) -> list[str]:
    """Return what changes, a text each."""
    told = [f"{name}={value}" for name, value in parameters.items()]
    for name, one in schemes.items():
        told.append(f"scheme of {name}: {one.name}")
    told += [f"{name}.{word}={value}" for name, own in words.items() for word, value in own]
    return [*told, *(f"do {getattr(one, '__name__', one)}" for one in do)]


def _as_branch(
    origin: Capsule,
    checkpoint: Checkpoint | None,
    own: list[Intervention],
    at: int,
    length: int,
    told: list[str],
    kind: type[Model],
) -> tuple[Manifest, dict[str, bytes]]:
    """Return the manifest of a branch and the files that it begins with."""
    manifest = origin.manifest
    records, files = copies_of(own, kind, first=len(manifest.interventions))
    merged = sorted([*manifest.interventions, *records], key=lambda one: int(one["tick"]))
    recorded = manifest.recorded or list(checkpoint.parts if checkpoint else manifest.tables)
    made = replace(
        manifest,
        ticks=length,
        status=folders.RUNNING,
        ticks_done=0,
        error=None,
        tables={},
        idle={},
        timings={"created": datetime.now(UTC).isoformat(timespec="seconds")},
        versions=folders.versions(),
        platforms=folders.with_this_machine(manifest.platforms),
        recorded=recorded or None,
        interventions=merged,
        branch={
            "run": str(origin.folder),
            "identity": manifest.identity(),
            "tick": at,
            "change": told,
        },
    )
    for path in [*origin.schemes.values(), *origin.minds.values()]:
        files |= _copied(origin.folder, path)
    for name in (KEPT, FOLDER):
        files |= _copied(origin.folder, origin.folder / name)
    return made, files


def _copied(folder: Path, path: Path) -> dict[str, bytes]:
    """Return the contents of a file or a folder of a run, by their places in it."""
    place = path.relative_to(folder).as_posix()
    if path.is_file():
        return {place: path.read_bytes()}
    return {f"{place}/{name}": content for name, content in files_in(path).items()}
