"""A document made into a mind, and what is wrong or odd about it, each where it is."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from socialmind.errors import ModelError
from socialmind.mind import lint
from socialmind.mind.description import MindDescription
from socialmind.mind.files.evoagents import ades, botdesc, genome_file, vardesc
from socialmind.mind.files.evoagents.botdesc import ACTUATORS, SENSORS
from socialmind.mind.files.evoagents.folder_reader import GENOME, SKILLS
from socialmind.mind.files.evoagents.text_file import MOST_GENOME, text_of
from socialmind.mind.files.python_file import programs_unrun
from socialmind.mind.modules import Skill
from socialmind.studio.skills.document import (
    Document,
    module_line,
    refuse_file_name,
    refuse_line_breaks,
    skill_text,
)
from socialmind.studio.skills.programs import (
    SUFFIX,
    file_of,
    findings_of_text,
    is_program,
    names_in,
    said,
    with_text,
)

KINDS = {"sensor": "sensors", "actuator": "actuators", "variable": "variables", "skill": "skills"}


@dataclass
class Checked:
    """What came of a document.

    Attributes:
        mind: the mind; None where something is wrong.
        findings: each with ``at`` (the identity of a part, or None), ``wrong``, ``text`` and, of
            what a skill's program says, the ``line``.
        weights: by a skill's identity: ``size``, how many weights its function has, and ``had``,
            how many are in its file, None for none; ``fits``, whether these still do.
        programs: by a skill's identity, the name of the file of its program.
    """

    mind: MindDescription | None = None
    findings: list[dict[str, Any]] = field(default_factory=list)
    weights: dict[str, dict[str, Any]] = field(default_factory=dict)
    programs: dict[str, str] = field(default_factory=dict)

    def say(self, at: str | None, text: str, wrong: bool = False, line: int | None = None) -> None:
        """Add a finding."""
        placed = {} if line is None else {"line": line}
        told = text if line is None else f"line {line}: {text}"
        self.findings.append({"at": at, "wrong": wrong, "text": told, **placed})

    @property
    def wrong(self) -> bool:
        """Whether it is no mind."""
        return any(one["wrong"] for one in self.findings)


def checked(document: Document, home: Path | None, before: Document | None = None) -> Checked:
    """Make a mind of a document, as far as that goes; its programs are not run.

    Args:
        document: of the shape of one.
        home: the mind's folder, beside whose files programs, schemes and weights are looked for;
            None for a mind that has no files yet.
        before: the document as it was opened, to tell what weights will stand for.
    """
    found = Checked()
    try:
        refuse_file_name(document["name"], "the name of the mind")
    except ModelError as error:
        found.say(None, said(error), True)
    with programs_unrun():
        sensors, actuators, variables = _modules(document, home, found)
        skills = [_skill(one, home, found) for one in document["skills"]]
        known = {one["name"]: one for one in (before or {}).get("skills", ())}
        for one, skill in zip(document["skills"], skills, strict=True):
            if skill is not None and home is not None:
                _weigh(one, skill, home, known.get(one["was"]), found)
        whole = [one for one in skills if one is not None]
        try:
            mind = MindDescription(document["name"], sensors, actuators, variables, whole)
        except ModelError as error:
            found.say(
                error.file if error.file in _identities(document) else None, said(error), True
            )
            return found
    if found.wrong:
        return found
    found.mind = mind
    places = _places(document)
    for one in lint.findings(mind):
        at = places.get(one.where)
        if one.kind == "no weights" and found.weights.get(at or "", {}).get("had"):
            continue  # they are in their file
        found.say(at, f"{one.kind}: {one.message}")
    return found


def skill_of(one: dict[str, Any], home: Path | None) -> Skill:
    """Return the skill of a part of a document, without weights.

    Raises:
        ModelError: something about it is wrong.
    """
    refuse_file_name(one["name"], "the name of a skill")
    refuse_line_breaks([*one["inputs"], *one["outputs"], *one["lines"]], "a line of a skill", "#")
    # As what it was called when its files were written: a program may have that name.
    then = {**one, "name": one["was"] or one["name"]}
    with with_text(one, then["name"], skill_folder(one, home or Path("mind"))) as folder:
        text = "\n".join(skill_text(then)) + "\n"
        return ades.parse(text, folder / f"{then['name']}.ades").changed(name=one["name"])


def skill_folder(one: dict[str, Any], home: Path) -> Path:
    """Return the folder in which a skill's files lie, or would."""
    return home / SKILLS / (one["was"] or one["name"])


def renamed_weights(text: str, name: str) -> str:
    """Return a file of weights as that of a skill of another name."""
    lines = text.splitlines(keepends=True)
    place = next(n for n, line in enumerate(lines) if line.partition("#")[0].startswith("skill:"))
    ending = lines[place][len(lines[place].rstrip("\r\n")) :]
    lines[place] = f"skill:{name}{ending}"
    return "".join(lines)


def _modules(document: Document, home: Path | None, found: Checked) -> list[list[Any]]:
    """Return sensors, actuators and variables, each read from the line that it would be."""
    agent = (home or Path("mind")) / document["name"]
    made: dict[str, list[Any]] = {}
    for what in ("sensors", "actuators", "variables"):
        made[what] = []
        for one in document[what]:
            try:
                refuse_line_breaks([one["name"], one["kind"], *one["fields"]], "a field", ":#")
                line = module_line(one)
                if what == "variables":
                    made[what] += vardesc.parse(line, agent.with_name(f"{agent.name}.vardesc"))
                    continue
                both = [line, ACTUATORS] if what == "sensors" else [ACTUATORS, line]
                text = "\n".join([SENSORS, *both])
                made[what] += botdesc.parse(text, f"{agent}.botdesc")[what == "actuators"]
            except ModelError as error:
                found.say(one["id"], said(error), True)
        _refuse_twice(document[what], what.removesuffix("s"), found)
    _refuse_twice(document["skills"], "skill", found)
    return [_once(made[what]) for what in ("sensors", "actuators", "variables")]


def _refuse_twice(parts: list[dict[str, Any]], what: str, found: Checked) -> None:
    seen: set[str] = set()
    for one in parts:
        if one["name"] in seen:
            found.say(one["id"], f"a second {what} called {one['name']!r}; each name once", True)
        seen.add(one["name"])


def _once(some: list[Any]) -> list[Any]:
    return list({one.name: one for one in reversed(some)}.values())[::-1]


def _skill(one: dict[str, Any], home: Path | None, found: Checked) -> Skill | None:
    if is_program(one):
        there = skill_folder(one, home or Path("mind"))
        found.programs[one["id"]] = file_of(one, one["was"] or one["name"], names_in(there))
    try:
        skill = skill_of(one, home)
    except ModelError as error:
        in_program = is_program(one) and str(error.file).endswith(SUFFIX)
        found.say(one["id"], said(error), True, error.line if in_program else None)
        return None
    if is_program(one):
        for odd in findings_of_text(one["program"], skill):
            found.say(one["id"], odd.text, line=odd.line)
    found.weights[one["id"]] = {"size": skill.genome_size, "had": None, "fits": True}
    # What is wrong about it between others is to be found by its identity.
    return skill.changed(file=one["id"], line=None)


def _weigh(
    one: dict[str, Any], skill: Skill, home: Path, before: dict[str, Any] | None, found: Checked
) -> None:
    """Tell what becomes of the weights that a skill has learned."""
    if not one["was"]:
        return
    file = skill_folder(one, home) / f"{one['was']}{GENOME}"
    if not file.is_file():
        return
    had = before and skill_of(before, home).genome_size
    try:
        text = renamed_weights(text_of(file, MOST_GENOME), one["name"])
        fitting = genome_file.parse(text, file, skill.changed(file=None))
    except (ModelError, StopIteration):
        found.weights[one["id"]] |= {"had": had, "fits": False}
        found.say(
            one["id"],
            f"its {had or ''} learned weights do not fit any more: its function has "
            f"{skill.genome_size} now, for {len(skill.inputs)} inputs and {len(skill.outputs)} "
            "outputs; it is saved without them, to be trained anew",
        )
        return
    found.weights[one["id"]] |= {"had": len(fitting.genome if fitting.genome is not None else ())}
    found.weights[one["id"]]["size"] = fitting.genome_size
    for links in ("inputs", "outputs"):
        for place, (then, now) in enumerate(zip((before or one)[links], one[links], strict=False)):
            if then != now:
                found.say(
                    one["id"],
                    f"its learned weights go by place: {links[:-1]} {place + 1} was {then} when "
                    f"they were learned, and is {now}",
                )


def _identities(document: Document) -> set[str]:
    return {one["id"] for what in KINDS.values() for one in document[what]}


def _places(document: Document) -> dict[str, str]:
    """Return the identities of parts by what the linter calls them."""
    return {
        f"{kind} {one['name']!r}": one["id"]
        for kind, what in KINDS.items()
        for one in document[what]
    }
