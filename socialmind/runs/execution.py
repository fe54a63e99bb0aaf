"""Running a model into a capsule, and going on with a capsule."""

from __future__ import annotations

import shutil
import time
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py.border.numbers import whole_number
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.interventions.following import Intervention, begun_for, in_order
from socialmind.runs import continuing, folders, sources
from socialmind.runs.branching.kept import copies_of, interventions_of
from socialmind.runs.capsule import Capsule, Manifest
from socialmind.runs.loop import Execution, Interrupted, Progress, tables_of
from socialmind.runs.record import LONGEST
from socialmind.runs.schemes import scheme_copies
from socialmind.sources.provenance import sources_of
from socialmind.sources.trust import remember
from socialmind.work.progress import progress_bar

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.runs.schemes import SchemeArgument
    from socialmind.runs.sources import HierarchyArgument

__all__ = ["Interrupted", "Progress", "resume", "run"]

RECORDED = 500
"""Rows of the series, by default, in a run of its whole length."""
AGENTS_EVERY = 10
"""Rows of the series for one recording of the agents, by default."""


def run(
    model_class: type[Model] | str | Path,
    ticks: int | None = None,
    seed: int = 0,
    parameters: Mapping[str, Any] | None = None,
    scheme: SchemeArgument = None,
    hierarchy: HierarchyArgument = None,
    every: int | None = None,
    agents_every: int | None = None,
    out: str | Path | None = None,
    compiled: bool = True,
    on_progress: Progress | None = None,
    checkpoint_every: float = 5.0,
    engine: str = "compiled",
    links: bool | None = None,
    events: bool | None = None,
    interventions: Iterable[Intervention] = (),
    progress: bool | None = None,
) -> Path:
    """Run a model into a folder of its own.

    Args:
        model_class: the model: its class, name or folder, or the file that defines it.
        ticks: length of the run, at least 0; the model's own by default.
        seed: of every random draw; 0 … 2**64 − 1.
        parameters: values by name; the model's defaults for the rest.
        scheme: a cognitive scheme or its file in place of the model's own; for a model with
            several populations that have minds, a mapping from their names.
        hierarchy: a mind's folder or YAML file, or a `MindDescription`, in place of the model's
            own hierarchy of skills; for a model with several, a mapping from their populations.
        every: ticks between two rows of the series, at least 1; by default such that about 500
            are recorded. The last tick is always recorded.
        agents_every: ticks between two recordings of the agents; by default ten times `every`.
        out: folder to make, or an empty one; by default the next number under ``runs/``. It may
            hold the model itself, in ``model/``.
        compiled: False runs the rules in plain Python, with the same result.
        on_progress: called with the ticks done and the length, about ten times a second.
        checkpoint_every: seconds between two checkpoints.
        engine: on a plane, what moves the bodies: "compiled", or "pymunk", the reference.
        links: whether the links of networks are recorded; by default as the model says
            (`record_links`).
        events: whether births and deaths are recorded, where agents are born or die; likewise
            (`record_events`).
        interventions: what is done to the society on its way: `Shock` and `Change` values.
        progress: whether a bar is drawn; by default in notebooks and on terminals, unless
            `on_progress` is given.

    Returns:
        The run's folder.

    Raises:
        SocialmindError: an unknown parameter, a value out of range, a folder in use.
        Interrupted: Ctrl-C; what was done is safe, `resume` goes on.
    """
    started = time.perf_counter()
    model_class = load_model(model_class)
    length = whole("ticks", model_class.ticks if ticks is None else ticks, 0)
    step = whole("every", max(1, -(-length // RECORDED)) if every is None else every, 1)
    agents_step = min(step * AGENTS_EVERY, LONGEST) if agents_every is None else agents_every
    agents_step = whole("agents_every", agents_step, 1)
    seed = whole("seed", seed, 0, 2**64 - 1)
    target = None if out is None else Path(out)
    holding: tuple[str, ...] = ()
    if target is not None:
        holding = (folders.OWN_MODEL,) if sources.is_own(target, model_class) else ()
        folders.refuse_unless_free(target.expanduser(), holding)

    given = dict(parameters or {})
    for name in given:
        if name in getattr(model_class, "populations", {}):
            raise SocialmindError(
                f"a table for {name!r}, which a run could not repeat; declare it beside the model: "
                f"{name} = Population(…, table='{name}.csv')"
            )
    with progress_bar(progress, "ticks", f"run {model_class.name}", on_progress) as tell:
        model = model_class(
            seed=seed,
            compiled=compiled,
            scheme=scheme,
            hierarchy=hierarchy,
            **sources.physics_of(engine),
            **given,
        )
        schemes, scheme_files = scheme_copies(model, scheme)
        minds, mind_files = sources.mind_copies(model)
        to_come = in_order(interventions)
        records, intervention_files = copies_of(to_come, model_class)
        manifest = Manifest(
            model=sources.model_source(model_class),
            parameters=dict(model.parameter_values()),
            seed=seed,
            compiled=compiled,
            engine=engine,
            schemes=schemes,
            minds=minds,
            ticks=length,
            every=step,
            agents_every=agents_step,
            recorded=tables_of(model, links, events, to_come),
            interventions=records,
            timings={"created": datetime.now(UTC).isoformat(timespec="seconds")},
            versions=folders.versions(),
            platforms=[folders.fingerprint()],
        )
        copies = sources_of(model_class).copies()
        remember({path: content for path, content in copies.items() if path.endswith(".py")})
        files = {**scheme_files, **mind_files, **copies, **intervention_files}
        capsule = Capsule.create(target, manifest, files, holding)
        with capsule.locked():
            Execution(capsule, model, None, started, to_come).go(length, tell, checkpoint_every)
    return capsule.folder


def resume(
    folder: str | Path,
    ticks: int | None = None,
    compiled: bool | None = None,
    model_class: type[Model] | None = None,
    on_progress: Progress | None = None,
    checkpoint_every: float = 5.0,
    kept: bool = False,
    trust: bool = False,
    progress: bool | None = None,
) -> Path:
    """Go on with a run that was stopped, or make a finished one longer.

    The tables become those of one run that was never stopped.

    Args:
        folder: the run's.
        ticks: length of the whole run, not less than the ticks done; as it was by default.
        compiled: speed from here on; as it was by default.
        model_class: the model; loaded from where the run says it stands by default.
        on_progress: as for `run`.
        checkpoint_every: as for `run`.
        kept: whether to take the copies of the model's source that the run keeps.
        trust: run programs that this user has neither named nor run before.
        progress: as for `run`.

    Returns:
        The run's folder.

    Raises:
        SocialmindError: no run's folder, in use, its model or scheme was changed since, or it
            holds unknown programs.
        Interrupted: Ctrl-C; what was done is safe.
    """
    started = time.perf_counter()
    capsule = Capsule(folder)
    with capsule.locked(), progress_bar(progress, "ticks", "run", on_progress) as tell:
        checkpoint = continuing.checked_checkpoint(capsule)
        # Killed between its last tick and its last file: only the files are missing.
        if (
            checkpoint is not None
            and capsule.manifest.status != folders.FINISHED
            and checkpoint.tick == capsule.manifest.ticks
            and all(tick == checkpoint.tick for tick in checkpoint.recorded.values())
        ):
            continuing.finish(capsule, checkpoint)
        done = continuing.ticks_done(capsule.manifest, checkpoint)
        length = capsule.manifest.ticks if ticks is None else whole("ticks", ticks, 0)
        if length < done:
            raise SocialmindError(
                f"{capsule.folder}: {done} ticks are done, {length} asked for; "
                "a run can be made longer, not shorter"
            )
        if capsule.manifest.status == folders.FINISHED:
            shutil.rmtree(capsule.parts, ignore_errors=True)
            if length == done:
                return capsule.folder
        model = sources.model_of(capsule, model_class, compiled, kept, trust)
        interventions = interventions_of(capsule, trust)
        if checkpoint is not None:
            model = begun_for(model, interventions, checkpoint.tick)
            continuing.restore(model, checkpoint, capsule.checkpoint)
        if capsule.manifest.status == folders.FINISHED:
            checkpoint = continuing.reopen(capsule, checkpoint, length)
        capsule.update(
            status=folders.RUNNING,
            ticks=length,
            error=None,
            compiled=capsule.manifest.compiled if compiled is None else compiled,
            platforms=folders.with_this_machine(capsule.manifest.platforms),
        )
        execution = Execution(capsule, model, checkpoint, started, interventions)
        execution.go(length, tell, checkpoint_every)
    return capsule.folder


def whole(name: str, value: Any, low: int, high: int = LONGEST) -> int:
    """Return a whole number as Python's, which a manifest can hold."""
    return whole_number(value, name, low, high, SocialmindError)
