"""What is said of a model: its README, and the words of its ODD document."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator, Sequence

from socialmind.metaciv.writing.map_text import PERIOD
from socialmind.metaciv.writing.mending import mended
from socialmind.metaciv.writing.model_file import ModelFile
from socialmind.metaciv.writing.scheme_file import chosen_plans, culturons, own_cognitons
from socialmind.metaciv.writing.sheet import Sheet, Unsupported, written

WIDTH = 120
"""Of lines of text."""


def readme(file: ModelFile, unsupported: list[Unsupported]) -> str:
    """Return the README of a model, in the order of ODD (Grimm et al. 2020)."""
    model = file.model
    parts = [
        f"# {model.name}",
        f"{_peoples(file)} A model of MetaCiv's, imported: the rules are in "
        "[`model.py`](model.py), the minds in [`scheme.yaml`](scheme.yaml)"
        + (", the map in [`terrain.csv`](terrain.csv)." if file.map.mapped else "."),
        "    socialmind run .\n    socialmind odd .          # the full ODD document",
        "## Purpose",
        _PURPOSE,
        "## Entities",
        *_entities(file),
        "## Process",
        *_process(file),
        "## Initialisation",
        _initialisation(file),
        "## Plans",
        _plans_table(file),
    ]
    renamed = list(_renamed(file.sheet))
    if renamed:
        parts += ["## Names", "What is called otherwise here, since Python has names of its own:"]
        parts.append(_table(("MetaCiv", "here", "what"), renamed))
    parts += ["## What is mended", "MetaCiv's program does otherwise, which is taken for a fault:"]
    parts.append("\n".join(f"- {one}" for one in mended(file)))
    parts.append("## What is not supported")
    if unsupported:
        parts.append("\n".join(f"- `{one.place.file}:{one.place.line}`: {one.what}"
                               for one in unsupported))  # fmt: skip
    else:
        parts.append("Nothing: all that the files say is in the model.")
    return wrapped(parts)


def odd_words(file: ModelFile) -> str:
    """Return the author's words for the ODD document, as far as the files say them."""
    sheet = file.sheet
    parts = [
        f"# {file.model.name}",
        f"{_peoples(file)} Imported from a model of MetaCiv's; the code is "
        "[`model.py`](model.py), the minds are [`scheme.yaml`](scheme.yaml).",
        "## Purpose and patterns",
        f"{_PURPOSE} By which patterns it is to be judged, the files do not say.",
        "## Entities, state variables and scales",
        "### Humans",
        _table(("variable", "unit", "start", "meaning"), _human_rows(file)),
    ]
    cognitons = _cogniton_rows(sheet)
    if cognitons:
        parts += ["### Mind of humans", _table(("cogniton", "stands for"), cognitons)]
    for built in sheet.used_facilities:
        rows = [("`owner`", "identity", "-1", "whose it is; -1 for nobody's"),
                ("`group`", "identity", "-1", "of which group it is; -1 for none")]  # fmt: skip
        rows += [(f"`{sheet.object_fields[one]}`", "things", "0", f"{one} in stock")
                 for one in built.stock]  # fmt: skip
        if built.efficient:
            rows += [("`efficiency`", "work", "0 … 99", "what it takes to be ready"),
                     ("`counter`", "work", "`efficiency`", "what is left")]  # fmt: skip
        title = built.population.replace("_", " ").capitalize()
        parts += [f"### {title}", _table(("variable", "unit", "start", "meaning"), rows)]
    if "messages" in sheet.needs:
        parts += ["### Messages", _table(("variable", "unit", "start", "meaning"), [
            ("`sender`", "identity", "–", "who sent it"),
            ("`recipient`", "identity", "–", "to whom"),
            ("`kind`", "–", "–", "1 an attack, 2 a wish to trade, 3 an offer of work"),
        ])]  # fmt: skip
    patches = _patch_rows(file)
    if patches:
        parts += ["### Patches", _table(("variable", "unit", "start", "meaning"), patches)]
    joined = [(f"`{sheet.group_fields[name]}`", "identity", "-1", f"the {name} that all join")
              for name in file.beginning.joined]  # fmt: skip
    if joined:
        parts += ["### The model", _table(("variable", "unit", "start", "meaning"), joined)]
    parts += ["### Scales", _scales(file)]
    parts += ["## Process overview and scheduling", *_process(file)]
    parts += ["## Design concepts", *_concepts(file)]
    parts += ["## Initialisation", _initialisation(file)]
    parts += ["## Input data", "None that varies in time. The scheme is read from `scheme.yaml`"
              + (", the map from `terrain.csv`." if file.map.mapped else ".")]  # fmt: skip
    parts += ["## Submodels", "### Plans", _plans_table(file)]
    if "walk" in sheet.needs:
        parts += ["### Walking", _WALKING]
    return wrapped(parts)


def wrapped(parts: list[str]) -> str:
    """Return parts of a document under each other, their lines wrapped but for tables and code."""
    lines: list[str] = []
    for part in parts:
        for line in part.split("\n"):
            if len(line) <= WIDTH or line.startswith(("|", "#", "    ")):
                lines.append(line)
            else:
                inner = "  " if line.startswith("- ") else "   " if line[:1].isdigit() else ""
                lines += textwrap.wrap(
                    line, WIDTH, subsequent_indent=inner,
                    break_long_words=False, break_on_hyphens=False,
                )  # fmt: skip
        lines.append("")
    return "\n".join(lines)


_PURPOSE = "MetaCiv's files do not say what the model is for; say it here."

_WALKING = (
    "Agents stand in the middle of patches. To leave a patch of passability p takes "
    "max(p div 10 − 2, 1) ticks, and below 20 two patches are crossed in one, if the place they go "
    "to is not passed by that. Before what cannot be entered they turn any way that is open. Ways "
    "are the cheapest ones, by the effort of the patches in sight (A*)."
)


def _peoples(file: ModelFile) -> str:
    parts = [f"{one.name} ({one.agents})" for one in file.people.civilisations]
    word = "Civilisations" if len(parts) > 1 else "One civilisation"
    return f"{word}, with their founders: {', '.join(parts)}." if len(parts) > 1 else (
        f"{word}, with its founders: {parts[0] if parts else 'none'}.")  # fmt: skip


def _entities(file: ModelFile) -> Iterator[str]:
    sheet = file.sheet
    attributes = [f"`{field}`" for field in sheet.attribute_fields.values()]
    carried = [
        f"`{sheet.object_fields[one]}`" for one in sheet.object_fields if one in sheet.carried
    ]
    said = "Humans stand on patches and have minds"
    if attributes:
        said += f" and the attribute{'s' * (len(attributes) > 1)} {', '.join(attributes)}"
    if carried:
        said += f"; they carry {', '.join(carried)}"
    yield f"{said}."
    if sheet.used_facilities:
        built = [f"{one.facility.name} (`{one.population}`)" for one in sheet.used_facilities]
        yield f"They build {', '.join(built)}."
    described = [
        f"- **{one.name}**: {' '.join(one.description.split())}"
        for one in file.people.cognitons.values()
        if one.description.strip("- ")
    ]
    described += [
        f"- **{one.name}**: {' '.join(one.description.split())}"
        for one in file.model.objects
        if one.description.strip("- ") and one.name in sheet.carried
    ]
    if described:
        yield "\n".join(described)
    yield _scales(file)


def _scales(file: ModelFile) -> str:
    environment = file.model.environment
    return (
        f"The map, {environment.name}, is a torus of {environment.width} × {environment.height} "
        "patches, with (0, 0) at the south-west. A tick is one action of an agent."
    )


def _process(file: ModelFile) -> Iterator[str]:
    steps = ["in tick 2 alone, the founders appear at the places of their civilisations;"]
    turn = "each agent, in a fresh random order, "
    if any(file.turns.every_tick.values()):
        names = ", ".join(
            dict.fromkeys(one.name for o in file.turns.every_tick.values() for one in o)
        )
        turn += f"does what is done in every tick (`{names}`), then "
    turn += "goes on with its plan by one action, or chooses one and begins it;"
    steps.append(turn)
    if file.map.grows:
        steps.append(f"every {PERIOD} ticks the ground changes by itself (`renew`);")
    if any(one.grouped for one in file.sheet.used_facilities):
        steps.append("facilities of groups without members go.")
    steps[-1] = steps[-1].rstrip(";.") + "."
    yield "A tick:"
    yield "\n".join(f"{number}. {one}" for number, one in enumerate(steps, 1))
    yield "Agents first act in tick 3; whoever is born acts from the next tick on."


def _initialisation(file: ModelFile) -> str:
    height = file.model.environment.height
    places = [f"{one.civilisation} at ({one.u}, {(height - one.v) % height})"
              for one in file.people.settlements]  # fmt: skip
    said = f"Founders appear in tick 2: {', '.join(places) or 'nobody'}"
    if file.model.parameters.dispersion:
        said += ", scattered over the least square that has a patch for each"
    elif file.map.scattered:
        said += ", scattered to its north-east"
    return f"{said}. Attributes and cognitons begin as `model.py` and `scheme.yaml` say."


def _plans_table(file: ModelFile) -> str:
    rows = [
        (name, f"`{file.turns.plans.carried_out[name]}`", _permitted(file.sheet, name))
        for name in chosen_plans(file.sheet)
    ]
    for kind, rules in (("in every tick", file.turns.every_tick), ("at birth", file.turns.births)):
        once = dict.fromkeys(one for own in rules.values() for one in own)
        rows += [(one.doc.partition(":")[0], f"`{one.name}`", kind) for one in once]
    return _table(("plan", "in `model.py`", "while there is"), rows) if rows else "None."


def _permitted(sheet: Sheet, plan: str) -> str:
    names = [one.name for one in sheet.people.cognitons.values()
             if any(permit.plan == plan for permit in one.permits)]  # fmt: skip
    return " or ".join(names) or "nothing: it is never available"


def _cogniton_rows(sheet: Sheet) -> list[tuple[str, ...]]:
    own = {one.name: one for one in own_cognitons(sheet)}
    everything = {**own, **culturons(sheet)}
    return [
        (name, " ".join(one.description.split()).strip("- ") or "what the files do not say")
        for name, one in everything.items()
        if name in own
    ]


def _human_rows(file: ModelFile) -> list[tuple[str, ...]]:
    sheet = file.sheet
    rows: list[tuple[str, ...]] = [
        ("`x`, `y`", "patches", "at the place of the civilisation", "the patch"),
        ("`heading`", "degrees", "0", "0 is north, clockwise"),
    ]
    for name, attribute in file.people.attributes.items():
        field = sheet.attribute_fields[name]
        rows.append((f"`{field}`", "–", written(attribute.start), f"MetaCiv's attribute {name}"))
    for name, field in sheet.object_fields.items():
        if name in sheet.carried:
            rows.append((f"`{field}`", "things", "0", f"{name} that it carries"))
    if "walk" in sheet.needs:
        rows.append(("`stride`", "ticks", "2", "how far it has come in crossing its patch"))
    for built in sheet.used_facilities:
        if built.private:
            what = f"its own {built.facility.name}; -1 for none"
            rows.append((f"`{built.name}`", "identity", "-1", what))
    for name, declared in sheet.fields.items():
        match = re.match(r"\w+ = (\S+)(?:\s+# (.*))?", declared)
        start, meaning = match.groups() if match else ("–", None)
        rows.append((f"`{name}`", "–", start, meaning or name.replace("_", " ")))
    if "deaths" in sheet.needs:
        rows.append(("`dying`", "–", "False", "whether it goes at its next turn"))
    rows += [
        ("`civilisation`", "–", "its founders'", "to which it belongs"),
        ("`plan`", "–", "none", "which it carries out"),
    ]
    return rows


def _patch_rows(file: ModelFile) -> list[tuple[str, ...]]:
    sheet = file.sheet
    rows: list[tuple[str, ...]] = []
    if file.map.grounded:
        rows += [
            ("`passability`", "–", "of its terrain", "what it takes to cross it"),
            ("`impassable`", "–", "of its terrain", "whether nobody can enter it"),
            ("`effort`", "–", "of its terrain", "what a way over it costs"),
            ("`passage`", "steps", "0", "how often it was trodden, less what wore off"),
            ("`road`", "–", "False", "whether that left a road, whose ways cost half"),
        ]
    if file.map.mapped:
        names = ", ".join(
            f"{number} {one.name}"
            for number, one in enumerate(file.map.terrains)
            if one is not None
        )
        rows.append(("`terrain`", "–", "of the map", names))
    rows += [
        (f"`{sheet.pheromone_fields[name]}`", "–", "of its terrain", f"MetaCiv's pheromone {name}")
        for name in sheet.smelt
    ]
    return rows


def _concepts(file: ModelFile) -> Iterator[str]:
    maker = {
        "MaxWeight": "the heaviest available plan is chosen",
        "MaxWeightOx2": "the heaviest available plan is chosen, and takes over from one that goes "
        "on if it weighs more than twice as much",
        "WeightedStochastic": "an available plan is drawn, in proportion to its weight",
    }[file.model.parameters.decision_maker]
    triggers = any(one.triggers for one in file.people.cognitons.values())
    groups = ", ".join(file.people.groups) or None
    said = {
        "Basic principles": "MetaCiv's cognitive schemes (Suro 2020, chapter 3): what an agent "
        "believes and is weighs its plans.",
        "Emergence": "The files do not say what is to emerge.",
        "Adaptation": f"By choice among plans: {maker}.",
        "Objectives": "None is maximised.",
        "Learning": "By cognitons that actions strengthen and weaken."
        if "strengthen" in file.sheet.helpers else "None.",
        "Prediction": "None.",
        "Sensing": "What the conditions of plans ask"
        + (", and attributes that bring cognitons by their triggers." if triggers else "."),
        "Interaction": "As the actions of plans say; what one does the next one sees.",
        "Stochasticity": "Orders, and what plans and choices draw, all keyed by the seed.",
        "Collectives": f"Groups: {groups}." if groups else "None.",
        "Observation": "`series.parquet` holds one row a recorded tick: how many there are, what "
        "all carry together and the means of attributes; `agents.parquet` one row an agent.",
    }  # fmt: skip
    for concept, words in said.items():
        yield f"### {concept}"
        yield words


# Names ------------------------------------------------------------------------------------------


def _renamed(sheet: Sheet) -> Iterator[tuple[str, ...]]:
    for what, names in (
        ("attribute", sheet.attribute_fields),
        ("object", {one: sheet.object_fields[one] for one in sheet.object_fields
                    if one in sheet.carried}),
        ("pheromone", {one: sheet.pheromone_fields[one] for one in sheet.smelt}),
        ("constant", {one: sheet.parameters[one] for one in sheet.used_constants}),
        ("facility", {one.facility.name: one.population for one in sheet.used_facilities}),
        ("civilisation", sheet.counts),
    ):  # fmt: skip
        for name, here in names.items():
            if name.casefold() != here:
                yield name, f"`{here}`", what


def _table(head: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    lines = [f"| {' | '.join(head)} |", "|" + "---|" * len(head)]
    for row in rows:
        cells = [one.replace("|", "\\|").replace("<", "&lt;") for one in row]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines)
