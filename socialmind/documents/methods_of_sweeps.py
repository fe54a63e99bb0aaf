"""The paragraph of methods of a sweep: design, replicates, what came of its runs, the command."""

from __future__ import annotations

import shlex
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from socialmind.documents.methods_said import (
    HASH_DIGITS,
    as_argument,
    as_option,
    interventions_said,
    listed,
    luck,
    minds_used,
    number_of_ticks,
    opening,
    ticks_said,
    valued,
)  # fmt: skip
from socialmind.documents.odd.entities import written
from socialmind.runs.folders import FINISHED

if TYPE_CHECKING:
    import pandas as pd

    from socialmind.model import Model

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


def paragraph_of_sweep(
    content: Mapping[str, Any],
    points: pd.DataFrame | None,
    folder: Path,
    model_class: type[Model] | None = None,
) -> str:
    """Return the paragraph of methods of a sweep.

    Args:
        content: of its manifest.
        points: the design, a row a point, where it is at hand.
        folder: the sweep's, for the commands.
        model_class: its model, whose declaration has units and defaults; None for neither.
    """
    model = content["model"]
    parts = [opening(model, content.get("versions", {}), content.get("platforms", ()), model_class)]
    declared = {} if model_class is None else dict(model_class.parameters)
    units = {name: one.unit for name, one in declared.items()}
    parts.append(_design(content["design"], content["columns"], content["points"], points, units))
    parts.append(_replicates(content["replicates"]))
    parts += _how_it_went(content)
    parts.append(_constant(content, declared))
    parts += minds_used(content.get("schemes", {}), content.get("minds", {}))
    parts.append(interventions_said(content.get("interventions", ())))
    if content.get("measures"):
        told = [f"{one} = {_measure(measure)}" for one, measure in content["measures"].items()]
        parts.append(f"Of each run was measured: {'; '.join(told)}.")
    if content.get("measures") or content.get("keeps_series"):
        parts.append(f"Its series was recorded every {ticks_said(content['every'])}.")
    parts.append(luck())
    place = shlex.quote(str(folder))
    parts.append(
        f"The design, the seeds and every result are in {folder}; any run of it is repeated by "
        f"`socialmind run --from-sweep {place} --number N`"
    )
    again = _sweep_command(content, points)
    parts[-1] += f", all of them by `{again}`." if again else "."
    return " ".join(part for part in parts if part)


def _how_it_went(content: Mapping[str, Any]) -> list[str]:
    """Return the sentences of how many runs finished, and what became of the others."""
    counts = content.get("counts", {})
    done = counts.get("finished", 0)
    others = [
        f"{number:,} {status.replace('_', ' ')}"
        for status, number in counts.items()
        if status not in ("finished", "pending") and number
    ]
    were = "run of {} was" if done == 1 else "runs of {} were"
    lacking = f" ({listed(others)})" if others else ""
    parts = [f"{done:,} {were.format(number_of_ticks(content['ticks']))} finished{lacking}."]
    if content.get("status", FINISHED) != FINISHED:
        parts.append(f"The sweep is {content['status']}: further runs may come.")
    if content.get("timeout"):
        parts.append(f"Each had {content['timeout']:g} s at most.")
    return parts


def _constant(content: Mapping[str, Any], declared: Mapping[str, Any]) -> str:
    """Return the sentence of what did not vary: what was set, and defaults where they are known."""
    fixed = content.get("fixed", {})
    told = [
        valued(one, value, declared[one].unit if one in declared else "")
        for one, value in fixed.items()
    ]
    usual = [
        valued(name, one.default, one.unit)
        for name, one in declared.items()
        if name not in content["columns"] and name not in fixed
    ]
    if declared and not usual:
        return f"In all of them {listed(told)}." if told else ""
    which_are = f": {listed(usual)}" if usual else ""
    if told:
        return f"In all of them {listed(told)}; all other parameters had their defaults{which_are}."
    which = "All other" if content["columns"] else "All"
    return f"{which} parameters had their defaults{which_are}."


def _sweep_command(content: Mapping[str, Any], points: pd.DataFrame | None) -> str:
    """Return the command that makes a sweep again; empty where options cannot say it all."""
    replicates, measures = content["replicates"], content.get("measures", {})
    plain = not content.get("interventions") and content.get("agents_every") is None
    plain = plain and all("expression" in one for one in measures.values())
    design = _design_options(content, points)
    if not plain or design is None:
        return ""
    command = ["socialmind", "sweep", as_argument(content["model"])]
    command += design
    for name, value in content.get("fixed", {}).items():
        command += ["--set", f"{name}={as_option(value)}"]
    seeds = list(replicates["seeds"])
    whole = seeds == list(range(seeds[0], seeds[0] + len(seeds)))
    said = f"{seeds[0]}:{seeds[-1] + 1}" if whole else ",".join(map(str, seeds))
    command += ["--seeds", said, *(["--common"] if replicates.get("common") else [])]
    if replicates.get("until"):
        command += ["--until", replicates["until"], "--at-most", str(replicates["most"])]
    every = content["every"] if content.get("keeps_series", True) else 0
    command += ["--ticks", str(content["ticks"]), "--every", str(every)]
    if content.get("timeout"):
        command += ["--timeout", f"{content['timeout']:g}"]
    for name, one in measures.items():
        command += ["--measure", f"{name}={one['expression']}"]
    return shlex.join(command)


def _design_options(content: Mapping[str, Any], points: pd.DataFrame | None) -> list[str] | None:
    """Return a design as options of `socialmind sweep`; None where these cannot say it."""
    made, columns = content["design"], content["columns"]
    name = made.get("name")
    if name == "none":
        return []
    options = []
    if name == "grid" and points is not None and set(columns) <= set(points):
        for one in columns:
            values = dict.fromkeys(points[one].tolist())
            options += ["--grid", f"{one}={','.join(map(as_option, values))}"]
        return options
    if "ranges" in made and made.get("seed") == 0:
        options = ["--sample", f"{name}:{made['size']}"]
        for one, (low, high) in made["ranges"].items():
            options += ["--ranges", f"{one}={as_option(low)}:{as_option(high)}"]
        return options
    return None


def _design(
    made: Mapping[str, Any],
    columns: Sequence[str],
    count: int,
    points: pd.DataFrame | None,
    units: Mapping[str, str],
) -> str:
    """Return the sentence of what varied, and by which design."""
    if not columns:
        return "Nothing was varied."
    name = str(made.get("name", "table"))
    varied = listed([_varied(one, points, units.get(one, "")) for one in columns])
    said = [f"{one} {made[one]}" for one in ("size", "seed") if one in made]
    number = f"{count:,} point{'s' if count != 1 else ''}"
    return (
        f"What was varied is {varied}, by {DESIGNS.get(name, f'the design {name}')} of {number}"
        f"{f' ({listed(said)})' if said else ''}."
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


def _varied(name: str, points: pd.DataFrame | None, unit: str = "") -> str:
    """Return the name of what varies, with its values or its range, and its unit."""
    if points is None or name not in points:
        return name
    values = list(dict.fromkeys(points[name].tolist()))
    if len(values) <= FEW:
        told = ", ".join(written(one) for one in values)
    else:
        told = f"{written(min(values))} … {written(max(values))}"
    return f"{name} ({told}{f' {unit}' if unit else ''})"


def _seeds(seeds: Sequence[int]) -> str:
    whole = list(range(seeds[0], seeds[0] + len(seeds))) if seeds else []
    if len(seeds) > 2 and list(seeds) == whole:
        return f"{seeds[0]} … {seeds[-1]}"
    return ", ".join(map(str, seeds))
