"""A sweep that begins: all that was asked for, checked, and its folder."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py.border.errors import nearest as resembling
from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from coglogo_py.changing.words import words_of
from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.sweeps.capsule import SweepCapsule, SweepManifest
from socialmind.experiments.sweeps.columns import Names
from socialmind.experiments.sweeps.copies import MINDS, SCHEMES, copies, schemes_and_minds
from socialmind.experiments.sweeps.measures.expressions import Expression
from socialmind.experiments.sweeps.measures.of_runs import (
    Recorded,
    measure_called,
    record_of,
)
from socialmind.experiments.sweeps.one_run import Common, in_one_line
from socialmind.experiments.sweeps.points.settings import Settings
from socialmind.experiments.sweeps.points.table import (
    Points,
    points_in,
    points_of,
    refuse_twice,
)
from socialmind.experiments.sweeps.points.varied import SCHEME, WORD
from socialmind.experiments.sweeps.preparing import nameable
from socialmind.experiments.sweeps.replicates import Replicates
from socialmind.interventions.shock import Shock
from socialmind.runs import folders
from socialmind.runs.branching.kept import copies_of
from socialmind.runs.execution import whole
from socialmind.runs.sources import model_source
from socialmind.sources.folders import digest
from socialmind.sources.provenance import sources_of
from socialmind.sources.trust import remember

if TYPE_CHECKING:
    from socialmind.model import Model

ROWS = 100
"""Rows of a run's series, by default."""
TRIES = 5
"""Points of which one must be such that a society can begin."""
AGENTS = ("none", "last")


def begun(
    model_class: type[Model],
    design: Any,
    ticks: int | None,
    replicates: Replicates,
    fixed: Mapping[str, Any],
    every: int | None,
    agents: str | int,
    measures: Mapping[str, Any],
    timeout: float | None,
    compiled: bool,
    shocks: Sequence[Shock],
    out: str | Path | None,
) -> tuple[SweepCapsule, list[str]]:
    """Check all that was asked for, and make the folder of a sweep.

    Args:
        model_class: the model.
        design: as of `sweep`, and so are the others.
        ticks: length of a run.
        replicates: at each point.
        fixed: what is set in all runs alike.
        every: ticks between two rows of the series.
        agents: which records of agents are kept.
        measures: by name.
        timeout: seconds that a run may take.
        compiled: whether rules run compiled.
        shocks: of every run.
        out: the folder.

    Returns:
        The folder, and what is to be said of it before it starts.

    Raises:
        SocialmindError: what was asked for cannot be.
    """
    target = None if out is None else Path(out).expanduser()
    if target is not None:
        folders.refuse_unless_free(target)
    length = whole("ticks", model_class.ticks if ticks is None else ticks, 0)
    step = max(1, -(-length // ROWS)) if not every else whole("every", every, 1)
    if timeout is not None and not (is_number(timeout) and timeout > 0):
        raise SocialmindError(f"timeout: found {shown(timeout)}; expected seconds above 0")
    there = nameable(model_class)
    points = (
        points_in(Path(design), there)
        if isinstance(design, str | Path)
        else points_of(design, there)
    )
    settled = [(one, one.checked(v)) for n, v in fixed.items() for one in [there.called(n)]]
    refuse_twice([*points.columns, *(one for one, _ in settled)])
    schemes, minds = schemes_and_minds(there, points, settled)
    makers = {name: one.decision_makers for name, one in model_class.populations.items()}
    settings = Settings(points.columns, tuple(settled), schemes, minds, makers)
    _check_words(settings, points)
    found = {name: measure_called(name, one) for name, one in measures.items()}
    names = Names(tuple(one.name for one in points.columns), tuple(found))
    common = Common(
        model_class, settings, length, step, every != 0, _agents(agents), found, timeout, compiled,
        shocks,
    )  # fmt: skip
    series = _first_society(common, points, replicates, names)
    if replicates.until is not None:
        wanted, known = replicates.until.measure, [*found, *series]
        if wanted not in known:
            raise SocialmindError(
                f"--until: no measure called {wanted!r}; {nearest(wanted, known)}"
            )
    records, files = copies(there, settings)
    shocked, shock_files = copies_of(shocks, model_class)
    table = points.parquet(names)
    sources = sources_of(model_class).copies()
    remember({path: content for path, content in sources.items() if path.endswith(".py")})
    manifest = SweepManifest(
        model=model_source(model_class),
        design={**points.made, "sha256": digest(table)},
        points=len(points.values),
        columns=[one.name for one in points.columns],
        fixed={one.name: value for one, value in settled},
        replicates=replicates.record(),
        ticks=length,
        every=step,
        keeps_series=common.keeps_series,
        agents_every=common.agents_every,
        measures={name: record_of(one) for name, one in found.items()},
        series_columns=list(series),
        timeout=None if timeout is None else float(timeout),
        compiled=compiled,
        schemes=records[SCHEMES],
        minds=records[MINDS],
        timings={"created": datetime.now(UTC).isoformat(timespec="seconds"), "seconds": 0.0},
        versions=folders.versions(),
        platforms=[folders.fingerprint()],
        interventions=shocked,
    )
    files = {**files, **sources, **shock_files, "design.parquet": table}
    capsule = SweepCapsule.create(target, manifest, files)
    notes = there.clashes([*manifest.columns, *manifest.fixed])
    return capsule, [*notes, *_sizes(common, points, replicates, series)]


def _agents(agents: str | int) -> int | None:
    """Return the ticks between two records of the agents; 0 for the end alone, None for none."""
    if agents in AGENTS:
        return None if agents == "none" else 0
    if isinstance(agents, str) and not agents.strip().isdecimal():
        raise SocialmindError(f"agents: found {agents!r}; expected none, last or a number of ticks")
    return whole("agents", int(agents) if isinstance(agents, str) else agents, 1)


def _check_words(settings: Settings, points: Points) -> None:
    """Refuse words that a scheme of the design has not, and values that they cannot have."""
    words = [one for one in (*settings.columns, *(o for o, _ in settings.fixed)) if one.word]
    if not words:
        return
    for (owner, given), scheme in settings.schemes.items():
        known = words_of(scheme)
        for one in words:
            if one.word is not None and one.population == owner and one.word.text not in known:
                hint = resembling(one.word.text, known) or "leave one of the two out"
                raise SocialmindError(
                    f"{given or owner}: this scheme has no {one.word.text}, which varies; {hint}"
                )
    places = [n for n, one in enumerate(settings.columns) if one.kind in (WORD, SCHEME)]
    seen: set[tuple[Any, ...]] = set()
    for number, row in enumerate(points.values):
        values = tuple(row[place] for place in places)
        if values not in seen:
            seen.add(values)
            try:
                settings.arguments(row)
            except (SocialmindError, ValueError) as error:
                raise SocialmindError(f"point {number} of the design: {error}") from None


def _first_society(
    common: Common, points: Points, replicates: Replicates, names: Names
) -> tuple[str, ...]:
    """Make the first society that can be made, and return what columns its series has.

    Raises:
        SocialmindError: none of the first can be, measures name what there is not, or are called as
            something else.
    """
    failures = []
    for point, values in enumerate(points.values[:TRIES]):
        model = None
        try:
            model = common.begin(replicates.seed_of(replicates.run_of(point, 0)), values)
            row = model.series()
            break
        except Exception as error:
            failures.append(in_one_line(error, common.model_class, model))
    else:
        raise SocialmindError(failures[0])
    names.check(row)
    source = Recorded(model, [0], [row])
    for one in common.measures.values():
        if isinstance(one, Expression):
            one.check_names(source)
    return tuple(name for name in row if name != "tick")


def _sizes(
    common: Common, points: Points, replicates: Replicates, series: Sequence[str]
) -> list[str]:
    """Return what is said before a sweep starts: how many runs, how large their series."""
    seeds = len(replicates.seeds)
    runs = len(points.values) * seeds
    name = points.made.get("name", "table")
    size = f" {points.made['size']:,}" if "size" in points.made else ""
    design = {"none": "nothing varies", "table": "a table"}.get(name, f"{name}{size}")
    at_most = ""
    if replicates.until is not None:
        at_most = f" at first, {len(points.values) * replicates.most:,} at most"
    lines = [
        f"{len(points.values):,} point{'s' * (len(points.values) != 1)} ({design}) × "
        f"{seeds:,} seed{'s' * (seeds != 1)} = {runs:,} runs of {common.ticks:,} ticks{at_most}"
    ]
    if common.keeps_series:
        rows = math.ceil(common.ticks / common.every) + 1
        gigabytes = runs * rows * (len(series) + 2) * 8 / 1e9
        if gigabytes > 1.0:
            lines.append(
                f"the series have {runs * rows:,} rows, {gigabytes:,.1f} GB in memory when read "
                "whole, half of it on disk or less; --every 0 leaves them out"
            )
    return lines
