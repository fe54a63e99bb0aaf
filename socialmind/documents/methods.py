"""The paragraph of methods that a paper says of a run or a sweep, from the folder's manifest."""

from __future__ import annotations

import json
import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.documents.odd.entities import written
from socialmind.errors import SocialmindError
from socialmind.runs.folders import FINISHED, MANIFEST

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.model import Model

HASH_DIGITS = 12
"""Of a SHA-256 hash, as many as tell versions apart on a page."""
FEW = 8
"""Values of a parameter that are listed; of more the range is said."""
DESIGNS = {
    "grid": "a full factorial design",
    "lhs": "a Latin hypercube sample",
    "sobol": "a Sobol sequence",
    "halton": "a Halton sequence",
    "saltelli": "Saltelli's design for Sobol indices",
    "morris": "Morris's elementary effects design",
    "fast": "a FAST design",
    "table": "a design given as a table",
}
"""What designs of sweeps are called in print."""
PACKAGES = {"python": "Python", "numpy": "NumPy", "numba": "Numba"}


def methods(folder: Path, trust: bool = False) -> str:
    """Return the paragraph of methods of a run or a sweep.

    Args:
        folder: the run's, or the sweep's.
        trust: load the run's model, whose declaration has units and defaults, also if this user has
            neither named nor run it before.

    Raises:
        SocialmindError: the folder holds neither.
    """
    path = folder / MANIFEST
    if not path.is_file():
        found = "holds no manifest.json" if folder.is_dir() else "no such folder"
        raise SocialmindError(f"{folder}: {found}; expected the folder of a run or a sweep")
    try:
        kind = json.loads(path.read_text("utf-8")).get("kind")
    except (ValueError, AttributeError):
        kind = None  # reading it as a run's says what is wrong
    return _of_sweep(folder) if kind == "sweep" else _of_run(folder, trust)


def _of_run(folder: Path, trust: bool) -> str:
    from socialmind.runs.capsule import Capsule
    from socialmind.runs.sources import changes_since, recorded_class

    capsule = Capsule(folder)
    manifest = capsule.manifest
    try:
        model_class: type[Model] | None = recorded_class(capsule, trust=trust)
    except SocialmindError:
        model_class = None  # the paragraph then says all values, without units
    name = manifest.model["name"]
    parts = [_opening(manifest.model, manifest.versions, manifest.platforms, model_class)]
    length = f"{manifest.ticks:,} ticks"
    parts.append(f"One run of {length} was made with the seed {manifest.seed}.")
    if manifest.status != FINISHED:
        parts.append(f"It is {manifest.status}, after {manifest.ticks_done:,} ticks.")
    parts.append(settings(manifest.parameters, model_class))
    parts += _minds_used(manifest.schemes, manifest.minds)
    if manifest.branch is not None:
        parts.append(f"It left {manifest.branch['run']} at tick {manifest.branch['tick']:,}.")
    parts.append(_interventions(manifest.interventions))
    if manifest.engine != "compiled":
        parts.append(f"Bodies were moved by {manifest.engine}.")
    parts.append(
        f"The society was recorded every {_ticks(manifest.every)}, its agents every "
        f"{_ticks(manifest.agents_every)}."
    )
    changed = changed_from_defaults(manifest.parameters, model_class)
    command = ["socialmind", "run", name, "--ticks", str(manifest.ticks), "--seed",
               str(manifest.seed), "--every", str(manifest.every), "--agents-every",
               str(manifest.agents_every)]  # fmt: skip
    for one, value in changed.items():
        command += ["--set", f"{one}={_plain(value)}"]
    for option, copies in (("--scheme", capsule.schemes), ("--mind", capsule.minds)):
        for population, copy in copies.items():
            if not _is_own_scheme(copy, population, model_class):
                command += [option, f"{population}={copy}"]
    if manifest.engine != "compiled":
        command += ["--engine", manifest.engine]
    shocks = _as_options(manifest.interventions, capsule.folder)
    parts.append(_luck())
    place = shlex.quote(str(folder))
    replay = f"`socialmind replay {place}`"
    if model_class is None or changes_since(capsule, model_class) is not None:
        parts.append("The model's files are not at hand as they ran; the run keeps copies of them:")
        replay = f"`socialmind replay {place} --source kept`"
    elif manifest.model["path"] is None:
        parts.append("The model was typed into a notebook; the run keeps it as a file:")
    elif shocks is not None:
        parts.append(f"The run is repeated by `{shlex.join(command + shocks)}`;")
    parts.append(f"{replay} repeats it from its folder and compares every number.")
    return " ".join(part for part in parts if part)


def _of_sweep(folder: Path) -> str:
    import pandas as pd

    content = json.loads((folder / MANIFEST).read_text("utf-8"))
    design = folder / "design.parquet"
    points = pd.read_parquet(design) if design.is_file() else None
    return paragraph_of_sweep(content, points, folder)


def paragraph_of_sweep(
    content: Mapping[str, Any], points: pd.DataFrame | None, folder: Path
) -> str:
    """Return the paragraph of methods of a sweep.

    Args:
        content: of its manifest.
        points: the design, a row a point, where it is at hand.
        folder: the sweep's, for the commands.
    """
    model, replicates = content["model"], content["replicates"]
    parts = [_opening(model, content.get("versions", {}), content.get("platforms", ()), None)]
    parts.append(_design(content["design"], content["columns"], content["points"], points))
    parts.append(_replicates(replicates))
    counts = content.get("counts", {})
    done = counts.get("finished", 0)
    others = [f"{number:,} {status.replace('_', ' ')}" for status, number in counts.items()
              if status not in ("finished", "pending") and number]  # fmt: skip
    lacking = f" ({_listed(others)})" if others else ""
    were = "run of {} was" if done == 1 else "runs of {} were"
    parts.append(f"{done:,} {were.format(_number(content['ticks']))} finished{lacking}.")
    if content.get("status", FINISHED) != FINISHED:
        parts.append(f"The sweep is {content['status']}: further runs may come.")
    if content.get("timeout"):
        parts.append(f"Each had {content['timeout']:g} s at most.")
    if content.get("fixed"):
        fixed = [f"{one} = {written(value)}" for one, value in content["fixed"].items()]
        parts.append(f"In all of them {_listed(fixed)}; all other parameters had their defaults.")
    else:
        which = "All other" if content["columns"] else "All"
        parts.append(f"{which} parameters had their defaults.")
    parts += _minds_used(content.get("schemes", {}), content.get("minds", {}))
    parts.append(_interventions(content.get("interventions", ())))
    if content.get("measures"):
        told = [f"{one} = {_measure(measure)}" for one, measure in content["measures"].items()]
        parts.append(f"Of each run was measured: {'; '.join(told)}.")
    if content.get("measures") or content.get("keeps_series"):
        parts.append(f"Its series was recorded every {_ticks(content['every'])}.")
    parts.append(_luck())
    parts.append(
        f"The design, the seeds and every result are in {folder}; any run of it is repeated by "
        f"`socialmind run --from-sweep {shlex.quote(str(folder))} --number N`."
    )
    return " ".join(part for part in parts if part)


def _design(
    made: Mapping[str, Any], columns: Sequence[str], count: int, points: pd.DataFrame | None
) -> str:
    """Return the sentence of what varied, and by which design."""
    if not columns:
        return "Nothing was varied."
    name = str(made.get("name", "table"))
    varied = _listed([_varied(one, points) for one in columns])
    said = [f"{one} {made[one]}" for one in ("size", "seed") if one in made]
    number = f"{count:,} point{'s' if count != 1 else ''}"
    return (
        f"What was varied is {varied}, by {DESIGNS.get(name, f'the design {name}')} of {number}"
        f"{f' ({_listed(said)})' if said else ''}."
    )


def _replicates(record: Mapping[str, Any]) -> str:
    """Return the sentences of the replicates and their seeds."""
    seeds = record["seeds"]
    each = len(seeds)
    how = (
        f"with the seed{'s' if each != 1 else ''} {_seeds(seeds)} at all points (common random "
        "numbers)"
        if record.get("common")
        else f"each with a seed of its own that follows from {_seeds(seeds)} and the point"
    )
    told = f"At each point {each:,} replicate{'s were' if each != 1 else ' was'} run, {how}."
    if not record.get("until"):
        return told
    width, _, measure = record["until"].partition(":")
    return (
        f"{told} There runs with further seeds were added until the 95 % interval of {measure} was "
        f"within {width}, at most {record['most']:,}."
    )


def _measure(record: Mapping[str, str]) -> str:
    """Return a measure as its author wrote it."""
    if "file" not in record:
        return record.get("expression") or f"the function {record['function']}"
    file, _, function = record["file"].rpartition(":")
    return f"{function} ({Path(file).name}, SHA-256 {record['sha256'][:HASH_DIGITS]}…)"


def _interventions(records: Sequence[Mapping[str, Any]]) -> str:
    """Return the sentence of what was done to societies on their way, if anything was."""
    told = []
    for one in records:
        if "function" in one:
            digest = one["sources"]["sha256"][:HASH_DIGITS]
            what = [f"{one['function']} ({Path(one['file']).name}, SHA-256 {digest}…)"]
        elif "agent" in one:
            whose = f"{one['part']} of agent {one['agent']} of {one['population']}"
            what = [_valued(whose, one["value"])]
        else:
            what = [_valued(*each) for each in one["parameters"].items()]
            what += [
                f"the cognitive scheme {scheme['name']} of {owner} (SHA-256 "
                f"{scheme['sha256'][:HASH_DIGITS]}…)"
                for owner, scheme in one["schemes"].items()
            ]
        told.append(f"at tick {one['tick']:,} {_listed(what)}")
    return f"Societies were changed on their way: {'; '.join(told)}." if told else ""


def _as_options(records: Sequence[Mapping[str, Any]], folder: Path) -> list[str] | None:
    """Return interventions as options of `socialmind run`; None where these cannot say them."""
    options: list[str] = []
    for one in records:
        # A copy that imports others of the user's finds them in a replay alone.
        if "function" not in one or len(one["sources"]["files"]) > 1:
            return None
        options += ["--shock", f"{one['tick']}:{folder / one['file']}:{one['function']}"]
    return options


def _is_own_scheme(copy: Path, population: str, model_class: type[Model] | None) -> bool:
    """Whether a run's copy of a scheme is the file that its model has."""
    if model_class is None or not copy.is_file():
        return False
    scheme = model_class.folder() / str(model_class.populations[population].mind)
    return scheme.is_file() and scheme.read_bytes() == copy.read_bytes()


def _opening(
    model: Mapping[str, Any],
    versions: Mapping[str, str],
    platforms: Sequence[Mapping[str, str]],
    model_class: type[Model] | None,
) -> str:
    """Return the sentence of the model, its version and the software."""
    sources = model.get("sources") or {}
    digest = sources.get("sha256") or model.get("source_sha256")
    hashed = f", whose source has the SHA-256 {digest[:HASH_DIGITS]}…," if digest else ""
    software = [f"{PACKAGES[one]} {versions[one]}" for one in PACKAGES if one in versions]
    software += [f"{one} {version}" for one, version in (sources.get("packages") or {}).items()]
    system = next((f"{one['system']}, {one['machine']}" for one in platforms), "")
    tools = "; ".join(filter(None, [", ".join(software), system]))
    described = ""
    if model_class is not None and (model_class.folder() / "ODD.md").is_file():
        described = " Its description after the ODD protocol (Grimm et al. 2020) is ODD.md."
    return (
        f"The model {model['name']}{hashed} was run with socialmind "
        f"{versions.get('socialmind', 'of an unknown version')} ({tools}).{described}"
    )


def settings(parameters: Mapping[str, Any], model_class: type[Model] | None) -> str:
    """Return the sentence of the parameters: what differs from the defaults, then those.

    Args:
        parameters: the value of each.
        model_class: what declares them; None where it is not at hand.
    """
    if not parameters:
        return ""
    if model_class is None:
        return f"Its parameters were {_listed([_valued(*one) for one in parameters.items()])}."
    declared = model_class.parameters
    changed = changed_from_defaults(parameters, model_class)
    told = [
        f"{_valued(name, value, declared[name].unit)} (default {written(declared[name].default)})"
        for name, value in changed.items()
    ]
    usual = [
        _valued(name, value, declared[name].unit)
        for name, value in parameters.items()
        if name not in changed and name in declared
    ]
    sentences = []
    if told:
        sentences.append(f"{_listed(told)} differed from the defaults.")
    if usual:
        lead = "All other parameters had" if told else "All parameters had"
        sentences.append(f"{lead} their defaults: {_listed(usual)}.")
    return " ".join(sentences)


def changed_from_defaults(
    parameters: Mapping[str, Any], model_class: type[Model] | None
) -> dict[str, Any]:
    """Return the parameters that have other values than the defaults; all without a model."""
    if model_class is None:
        return dict(parameters)
    declared = model_class.parameters
    return {
        name: value
        for name, value in parameters.items()
        if name in declared and value != declared[name].default
    }


def _valued(name: str, value: Any, unit: str = "") -> str:
    return f"{name} = {written(value)}{f' {unit}' if unit else ''}"


def _plain(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _minds_used(
    schemes: Mapping[str, Mapping[str, str]], minds: Mapping[str, Mapping[str, str]]
) -> list[str]:
    told = []
    for what, copies in (("cognitive scheme", schemes), ("hierarchy of skills", minds)):
        found: dict[str, list[str]] = {}
        for key, one in copies.items():  # a sweep may have several of a population
            name = f"{one['name']} (SHA-256 {one['sha256'][:HASH_DIGITS]}…)"
            found.setdefault(one.get("population", key), []).append(name)
        told += [f"The {what} of {owner} was {' or '.join(n)}." for owner, n in found.items()]
    return told


def _varied(name: str, points: pd.DataFrame | None) -> str:
    """Return the name of what varies, with its values or its range."""
    if points is None or name not in points:
        return name
    values = list(dict.fromkeys(points[name].tolist()))
    if len(values) <= FEW:
        return f"{name} ({', '.join(written(one) for one in values)})"
    return f"{name} ({written(min(values))} … {written(max(values))})"


def _seeds(seeds: Sequence[int]) -> str:
    whole = list(range(seeds[0], seeds[0] + len(seeds))) if seeds else []
    if len(seeds) > 2 and list(seeds) == whole:
        return f"{seeds[0]} … {seeds[-1]}"
    return ", ".join(map(str, seeds))


def _ticks(number: int) -> str:
    return "tick" if number == 1 else _number(number)


def _number(ticks: int) -> str:
    return f"{ticks:,} tick{'s' if ticks != 1 else ''}"


def _listed(words: Sequence[str]) -> str:
    """Return words as a sentence lists them.

    >>> _listed(["a", "b", "c"])
    'a, b and c'
    """
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def _luck() -> str:
    return (
        "Random numbers come from Philox4x32-10 (Salmon et al. 2011), keyed by the seed, the "
        "agent, the tick and the rule."
    )
