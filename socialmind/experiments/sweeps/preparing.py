"""What a sweep needs before its first run: all that was asked for, checked, and its folder."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py import CognitiveScheme
from coglogo_py.border.errors import nearest as resembling
from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number
from coglogo_py.changing.words import words_of
from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.sweeps.capsule import SweepCapsule, SweepManifest
from socialmind.experiments.sweeps.columns import Names
from socialmind.experiments.sweeps.measures.expressions import Expression
from socialmind.experiments.sweeps.measures.of_runs import (
    AMeasure,
    Recorded,
    measure_called,
    of_records,
    record_of,
)
from socialmind.experiments.sweeps.one_run import Common, in_one_line
from socialmind.experiments.sweeps.points.settings import Key, Settings
from socialmind.experiments.sweeps.points.table import (
    Points,
    points_in,
    points_of,
    points_of_parquet,
    refuse_twice,
)
from socialmind.experiments.sweeps.points.varied import MIND, SCHEME, WORD, Nameable, Varied
from socialmind.experiments.sweeps.replicates import Replicates
from socialmind.interventions.shock import Shock
from socialmind.mind.description import MindDescription
from socialmind.mind.files.packing import files_of
from socialmind.runs import folders
from socialmind.runs.branching.kept import copies_of, interventions_of
from socialmind.runs.execution import whole
from socialmind.runs.schemes import as_kept
from socialmind.runs.sources import checked_class, hash_of, model_source
from socialmind.society.founding.making import schemes_of
from socialmind.sources.folders import digest
from socialmind.sources.provenance import sources_of
from socialmind.sources.trust import programs_in, remember

if TYPE_CHECKING:
    from socialmind.model import Model

ROWS = 100
"""Rows of a run's series, by default."""
TRIES = 5
"""Points of which one must be such that a society can begin."""
AGENTS = ("none", "last")
SCHEMES, MINDS = "schemes", "minds"
"""The folders of a sweep's copies."""


@dataclass(frozen=True)
class Prepared:
    """A sweep that can begin, or go on.

    Attributes:
        common: what its runs have in common.
        points: of the design.
        replicates: at each.
        names: of the columns.
        series: the columns of the series, as the first society has them.
    """

    common: Common
    points: Points
    replicates: Replicates
    names: Names
    series: tuple[str, ...]

    def job_of(self, run: int) -> tuple[int, int, tuple[Any, ...]]:
        """Return a run as workers take it."""
        point, _ = self.replicates.place_of(run)
        return run, self.replicates.seed_of(run), self.points.values[point]


def nameable(model_class: type[Model]) -> Nameable:
    """Return what designs of a model can name, by its own schemes and minds."""
    schemes, _ = schemes_of(
        model_class.populations,
        model_class.folder,
        None,
        model_class.name,
        model_class._blueprint.schemes,
    )
    return Nameable(model_class, schemes, tuple(model_class.steerings()))


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
    schemes, minds = _whole(there, points, settled)
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
    records, files = _copies(there, settings)
    shocked, shock_files = copies_of(shocks, model_class)
    table = points.parquet(names)
    copies = sources_of(model_class).copies()
    remember({path: content for path, content in copies.items() if path.endswith(".py")})
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
    files = {**files, **copies, **shock_files, "design.parquet": table}
    capsule = SweepCapsule.create(target, manifest, files)
    notes = there.clashes([*manifest.columns, *manifest.fixed])
    return capsule, [*notes, *_sizes(common, points, replicates, series)]


def taken_up(
    capsule: SweepCapsule,
    model_class: type[Model] | None = None,
    measures: Mapping[str, Any] | None = None,
    trust: bool = False,
    functions: bool = True,
    shocks: Sequence[Shock] | None = None,
) -> Prepared:
    """Return the sweep that a folder keeps.

    Args:
        capsule: the folder.
        model_class: the model; loaded from where the manifest says by default.
        measures: functions in place of those that stand in no file.
        trust: run programs that this user has neither named nor run before.
        functions: whether measures are wanted at all.
        shocks: those of the sweep, where they are at hand; from its copies by default.

    Raises:
        SocialmindError: its model, schemes, shocks or socialmind were changed since.
    """
    manifest = capsule.manifest
    cls = checked_class(capsule, model_class, trust=trust, what="sweep")
    makers = {name: one.decision_makers for name, one in cls.populations.items()}
    schemes: dict[Key, CognitiveScheme] = {}
    for key, path in capsule.schemes.items():
        record = manifest.schemes[key]
        owner = record["population"]
        schemes[owner, record["given"]] = CognitiveScheme.load(path, makers[owner])
    minds: dict[Key, MindDescription] = {}
    for key, path in capsule.minds.items():
        record = manifest.minds[key]
        minds[record["population"], record["given"]] = MindDescription.load(path)
    own = {owner: scheme for (owner, given), scheme in schemes.items() if not given}
    there = Nameable(cls, own, tuple(owner for owner, given in minds if not given))
    columns = tuple(there.called(name) for name in manifest.columns)
    fixed = tuple((there.called(name), value) for name, value in manifest.fixed.items())
    found: dict[str, AMeasure] = {}
    if functions:
        found = of_records(manifest.measures, measures or {}, str(capsule.folder), trust)
    names = Names(tuple(manifest.columns), tuple(manifest.measures))
    common = Common(
        cls,
        Settings(columns, fixed, schemes, minds, makers),
        manifest.ticks,
        manifest.every,
        manifest.keeps_series,
        manifest.agents_every,
        found,
        manifest.timeout,
        manifest.compiled,
        checked_shocks(interventions_of(capsule, trust) if shocks is None else shocks),
    )
    table = capsule.table("design")
    content = table.read_bytes() if table.is_file() else b""
    if digest(content) != manifest.design.get("sha256"):
        raise SocialmindError(
            f"{table}: is not the design that the sweep was begun with; take it from a copy of the "
            "folder, or start another sweep"
        )
    points = points_of_parquet(content, columns, names)
    replicates = Replicates.of_record(manifest.replicates)
    return Prepared(common, points, replicates, names, tuple(manifest.series_columns))


def checked_shocks(shocks: Sequence[Any]) -> tuple[Shock, ...]:
    """Return shocks in the order of their ticks.

    Raises:
        SocialmindError: there is something else.
    """
    for one in shocks:
        if not isinstance(one, Shock):
            raise SocialmindError(f"shocks: found {shown(one)}; expected Shock(TICK, FUNCTION)")
    return tuple(sorted(shocks, key=lambda one: one.tick))


def _agents(agents: str | int) -> int | None:
    """Return the ticks between two records of the agents; 0 for the end alone, None for none."""
    if agents in AGENTS:
        return None if agents == "none" else 0
    if isinstance(agents, str) and not agents.strip().isdecimal():
        raise SocialmindError(f"agents: found {agents!r}; expected none, last or a number of ticks")
    return whole("agents", int(agents) if isinstance(agents, str) else agents, 1)


def _whole(
    there: Nameable, points: Points, fixed: Sequence[tuple[Varied, Any]]
) -> tuple[dict[Key, CognitiveScheme], dict[Key, MindDescription]]:
    """Return all schemes and minds: those that the model has, and those that points name.

    Raises:
        SchemeError: a scheme that cannot be read, likewise a mind.
    """
    cls = there.model_class
    schemes: dict[Key, CognitiveScheme] = {(n, ""): one for n, one in there.schemes.items()}
    minds: dict[Key, MindDescription] = {
        (name, ""): one.assembly.description for name, one in cls.steerings().items()
    }
    for one, value in _named(points, fixed):
        path = Path(value).expanduser()
        if one.kind == SCHEME:
            makers = cls.populations[one.population].decision_makers
            schemes[one.population, value] = CognitiveScheme.load(path, makers)
        elif one.kind == MIND:
            remember(programs_in(path))
            minds[one.population, value] = MindDescription.load(path)
    return schemes, minds


def _named(points: Points, fixed: Sequence[tuple[Varied, Any]]) -> list[tuple[Varied, Any]]:
    """Return what names schemes and minds, and each of the names once."""
    found = [(one, value) for one, value in fixed if one.kind in (SCHEME, MIND)]
    for place, one in enumerate(points.columns):
        if one.kind in (SCHEME, MIND):
            values = dict.fromkeys(row[place] for row in points.values)
            found += [(one, value) for value in values]
    return found


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


def _copies(
    there: Nameable, settings: Settings
) -> tuple[dict[str, dict[str, dict[str, str]]], dict[str, bytes]]:
    """Return what the manifest says of schemes and minds, and the content of their copies."""
    records: dict[str, dict[str, dict[str, str]]] = {SCHEMES: {}, MINDS: {}}
    files: dict[str, bytes] = {}
    for (owner, given), scheme in settings.schemes.items():
        key = _key(owner, records[SCHEMES])
        source = given or there.model_class.populations[owner].mind
        if isinstance(source, str | Path) and not given:
            source = there.model_class.folder() / source
        suffix, content = as_kept(scheme if source is None else source)
        file = f"{SCHEMES}/{key}{suffix}"
        files[file] = content
        records[SCHEMES][key] = {
            "population": owner, "given": given, "name": scheme.name, "file": file,
            "sha256": digest(content),
        }  # fmt: skip
    for (owner, given), mind in settings.minds.items():
        key = _key(owner, records[MINDS])
        found = files_of(mind)
        remember({path: content for path, content in found.items() if path.endswith(".py")})
        folder = f"{MINDS}/{key}"
        files |= {f"{folder}/{path}": content for path, content in found.items()}
        records[MINDS][key] = {
            "population": owner, "given": given, "name": mind.name, "folder": folder,
            "sha256": hash_of(found),
        }  # fmt: skip
    return records, files


def _key(owner: str, taken: Mapping[str, Any]) -> str:
    """Return a name for a copy: that of its population, with a number from the second on."""
    count = sum(one["population"] == owner for one in taken.values())
    return f"{owner}-{count}" if count else owner


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
