"""Making a run of a sweep again, as an ordinary capsule."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.capsule import SweepCapsule
from socialmind.experiments.sweeps.points.varied import SCHEME, WORD
from socialmind.experiments.sweeps.preparing import taken_up
from socialmind.runs import execution

if TYPE_CHECKING:
    from socialmind.model import Model
    from socialmind.runs.execution import Progress


def remake_run(
    folder: str | Path,
    number: int,
    out: str | Path | None = None,
    compiled: bool | None = None,
    model_class: type[Model] | None = None,
    on_progress: Progress | None = None,
    trust: bool = False,
) -> Path:
    """Make a run of a sweep again, as a folder of its own, equal to the last bit.

    Args:
        folder: the sweep's.
        number: of the run, as the column `run` has it.
        out: folder to make, or an empty one; by default the next number under ``runs/``.
        compiled: speed; the sweep's by default.
        model_class: the model; loaded from where the sweep says it stands by default.
        on_progress: called with the ticks done and the length.
        trust: run programs that this user has neither named nor run before.

    Returns:
        The run's folder.

    Raises:
        SocialmindError: no sweep's folder, no such run, or its model was changed since.
        Interrupted: Ctrl-C; what was done is safe.
    """
    capsule = SweepCapsule(folder)
    prepared = taken_up(capsule, model_class, trust=trust, functions=False)
    most = prepared.replicates.most
    runs = len(prepared.points.values) * most
    if not 0 <= number < runs:
        raise SocialmindError(f"{capsule.folder}: no run {number}; its runs are 0 … {runs - 1}")
    common, (_, seed, values) = prepared.common, prepared.job_of(number)
    settings = common.settings
    arguments: dict[str, Any] = settings.arguments(values)
    schemes, minds = arguments.pop("scheme"), arguments.pop("hierarchy")
    varied = {
        one.population
        for one in (*settings.columns, *(one for one, _ in settings.fixed))
        if one.kind in (SCHEME, WORD)
    }
    for key, path in capsule.schemes.items():
        record = capsule.manifest.schemes[key]
        if not record["given"] and record["population"] not in varied:
            schemes[record["population"]] = path  # with its comments
    return execution.run(
        common.model_class,
        common.ticks,
        seed,
        arguments,
        schemes,
        minds,
        common.every,
        common.agents_every or None,
        out,
        common.compiled if compiled is None else compiled,
        on_progress,
        interventions=common.shocks,
    )
