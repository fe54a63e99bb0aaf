"""The author's words of an ODD document: `odd_words.md`, Markdown under the headings of ODD.

Declarations say what a model is made of, and docstrings what its rules do. Why, and what it is
for, only its author can say. Under "Entities, state variables and scales" a heading that is the
name of a population speaks of it, and a table there whose first column is `variable` says what its
fields mean: their units, their values at the start where rules set them.

A line `{{collect}}` stands for what the words of the model `collect` say in the same place: under
a heading, or, right under an element, all of that element but what has a heading here too. So a
variant of a model says what is other, and its document still tells all. A heading with nothing
under it leaves the other model's words out.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from coglogo_py.border.errors import nearest
from coglogo_py.files.reading import text_in
from socialmind.documents.markdown import tables_in
from socialmind.errors import ModelError
from socialmind.sources.folders import model_folder

WORDS_FILE = "odd_words.md"

PURPOSE = "Purpose and patterns"
ENTITIES = "Entities, state variables and scales"
PROCESS = "Process overview and scheduling"
CONCEPTS = "Design concepts"
INITIALISATION = "Initialisation"
INPUT = "Input data"
SUBMODELS = "Submodels"
REFERENCES = "References"
QUESTIONS: Mapping[str, str] = {
    PURPOSE: "What is the model for? By which patterns, seen in the real system or expected, is it "
    "judged to be good enough for that?",
    ENTITIES: "What kinds of entities are there, and why these? What do space and time stand for? "
    "One heading for each population, with a table `| variable | unit | start | meaning |`.",
    PROCESS: "Who does what, in what order, and why in this order?",
    CONCEPTS: "One heading for each of the eleven concepts; where one plays no part, say so.",
    INITIALISATION: "What is the state at the start? Is it always the same, and where do the "
    "values come from?",
    INPUT: "Does the model read data that stand for processes that change over time?",
    SUBMODELS: "What, in detail, are the rules: equations, parameters, and why they are as they "
    "are?",
}
"""The seven elements of ODD (Grimm et al. 2020), and what their readers ask."""
ELEVEN: Mapping[str, str] = {
    "Basic principles": "Which theories, hypotheses or approaches stand behind the design?",
    "Emergence": "What comes out of what agents do, and is not written into their rules?",
    "Adaptation": "How do agents answer to changes of themselves and their environment?",
    "Objectives": "What do agents seek, and how is it measured?",
    "Learning": "Do agents change how they decide, by what they have lived through?",
    "Prediction": "How do agents foresee what their decisions lead to?",
    "Sensing": "What do agents know, of themselves and others, and with what error?",
    "Interaction": "How do agents act on each other, directly or through what they share?",
    "Stochasticity": "What is drawn at random, and why?",
    "Collectives": "Which groups do agents belong to, formed by them or given?",
    "Observation": "What is recorded of a run, and how is it looked at?",
}
"""The eleven design concepts of ODD, and what their readers ask."""

Facts = dict[str, dict[str, str]]
"""By variable, then by column: `unit`, `start`, `meaning`."""

_HEADING = re.compile(r"^(#{1,3}) +(.+?) *$")
_AS_IN = re.compile(r"^\{\{(\w+)\}\}$", re.MULTILINE)


@dataclass
class Section:
    """What stands under a heading: text, and what stands under the headings below.

    Attributes:
        text: before the first heading below.
        parts: by heading, in order.
        lines: the line of each of these headings.
    """

    text: str = ""
    parts: dict[str, str] = field(default_factory=dict)
    lines: dict[str, int] = field(default_factory=dict)

    @property
    def speaks(self) -> bool:
        """Whether anything is said in it, beside what variables mean."""
        return any(facts_in(text)[0] for text in (self.text, *self.parts.values()))

    def part(self, heading: str) -> str:
        """Return what stands under a heading below, however it is spelled; empty for nothing."""
        return next((text for name, text in self.parts.items() if plain(name) == heading), "")

    def others(self, headings: set[str]) -> Iterator[tuple[str, str]]:
        """Yield what stands under all other headings below."""
        for name, text in self.parts.items():
            if plain(name) not in headings and text:
                yield name, text


@dataclass
class Words:
    """What an author says of a model.

    Attributes:
        file: where it stands.
        title: the document's.
        introduction: what comes before the seven elements.
        elements: by name; all seven, said or not.
        references: the works cited.
    """

    file: Path
    title: str
    introduction: str = ""
    elements: dict[str, Section] = field(
        default_factory=lambda: {name: Section() for name in QUESTIONS}
    )
    references: str = ""


def plain(heading: str) -> str:
    """Return a heading as names are compared: `Drop zones`, `drop_zones` → `drop zones`."""
    return heading.replace("_", " ").replace("`", "").strip().lower()


def words_of(folder: Path, name: str) -> Words:
    """Return the author's words in a model's folder; none where there is no such file.

    Args:
        folder: the model's.
        name: the model's, the title unless the file has one.

    Raises:
        ModelError: a heading that ODD does not have, or has twice; words of models that stand for
            each other.
        SchemeError: the file cannot be read as UTF-8.
    """
    return _words_of(folder, name, ())


def _words_of(folder: Path, name: str, readers: tuple[Path, ...]) -> Words:
    """Return the words in a model's folder, which stand for some in those of `readers`."""
    file = folder / WORDS_FILE
    found = Words(file, name.replace("_", " ").capitalize())
    if not file.is_file():
        return found
    # Questions that were not answered are comments, as `skeleton` writes them.
    text = re.sub(r"<!--.*?-->", _lines_alone, text_in(file), flags=re.DOTALL)
    section, place = None, ""
    collected: dict[tuple[str, str], list[str]] = {("", ""): []}
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        fenced ^= line.startswith("```")
        match = None if fenced else _HEADING.match(line)
        if match is None:
            collected[section or "", place].append(line)
        elif match[1] == "#":
            found.title = match[2]
        elif match[1] == "##":
            section, place = _element(match[2], file, number), ""
            if (section, "") in collected:
                raise ModelError(f"a second {section!r}", None, "put it together", file, number)
            collected[section, ""] = []
        else:
            if section is None or section == REFERENCES:
                raise ModelError(f"{match[2]!r} under no element of ODD", None, None, file, number)
            place = match[2]
            if section == CONCEPTS and plain(place) not in map(plain, ELEVEN):
                expected = f"one of {', '.join(ELEVEN)}"
                raise ModelError(f"the design concept {place!r}", expected, None, file, number)
            if (section, place) in collected:
                raise ModelError(f"a second {place!r}", None, "put it together", file, number)
            collected[section, place] = []
            found.elements[section].lines[place] = number
    for (section, place), lines in collected.items():
        said = "\n".join(lines).strip()
        if not section:
            found.introduction = said
        elif section == REFERENCES:
            found.references = said
        elif place:
            found.elements[section].parts[place] = said
        else:
            found.elements[section].text = said
    for element, said_there in found.elements.items():
        _take_in(said_there, element, file, (*readers, folder))
    return found


def _take_in(section: Section, element: str, file: Path, readers: tuple[Path, ...]) -> None:
    """Put the words of other models where lines `{{name}}` stand for them.

    Raises:
        SocialmindError: there is no such model.
    """

    def elsewhere(name: str) -> Section:
        folder = model_folder(name)
        if folder == file.parent:
            raise ModelError(f"{{{{{name}}}}}, the model itself", "another model", None, file)
        if folder in readers:
            expected = f"words that are not made of those of {file.parent.name}"
            raise ModelError(f"{{{{{name}}}}}, which goes round in a circle", expected, None, file)
        return _words_of(folder, name, readers).elements[element]

    for heading, text in section.parts.items():
        section.parts[heading] = _AS_IN.sub(
            lambda match: elsewhere(match[1]).part(plain(heading)),  # noqa: B023
            text,
        ).strip()
    own = {plain(heading) for heading in section.parts}
    for name in _AS_IN.findall(section.text):
        other = elsewhere(name)
        section.text = section.text.replace(f"{{{{{name}}}}}", other.text).strip()
        others = {head: text for head, text in other.parts.items() if plain(head) not in own}
        section.parts = {**others, **section.parts}


def _lines_alone(match: re.Match[str]) -> str:
    return "\n" * match[0].count("\n")


def _element(heading: str, file: Path, line: int) -> str:
    known = {plain(name): name for name in (*QUESTIONS, REFERENCES)}
    name = plain(re.sub(r"^\d+\. *", "", heading))
    if name not in known:
        raise ModelError(
            f"the heading {heading!r}", "an element of ODD", nearest(heading, known.values()),
            file, line,
        )  # fmt: skip
    return known[name]


def facts_in(text: str) -> tuple[str, Facts]:
    r"""Take the table of variables out of a text.

    Returns:
        The text without it, and what it says of each variable.

    >>> text, facts = facts_in("They move.\n\n| variable | unit |\n|---|---|\n| `x`, `y` | m |")
    >>> text, facts
    ('They move.', {'x': {'unit': 'm'}, 'y': {'unit': 'm'}})
    """
    lines = text.splitlines()
    facts: Facts = {}
    tables = [one for one in tables_in(text) if plain(one[2][0][0]) == "variable"]
    for begin, end, _ in reversed(tables):
        del lines[begin:end]
    for _, _, (header, *rows) in tables:
        for row in rows:
            said = dict(zip(map(plain, header[1:]), row[1:], strict=False))
            for name in re.findall(r"`([^`]+)`", row[0]) or [row[0]]:
                facts[name] = said
    return re.sub(r"\n{3,}", "\n\n", "\n".join(lines)).strip(), facts


def skeleton(title: str, populations: Mapping[str, list[str]]) -> str:
    """Return an `odd_words.md` to begin with: ODD's headings, and what is to be answered there.

    Args:
        title: the document's.
        populations: the fields to be explained, by population.
    """
    lines = [f"# {title}", ""]
    for element, question in QUESTIONS.items():
        lines += [f"## {element}", "", f"<!-- {question} -->", ""]
        if element == ENTITIES:
            for name, fields in populations.items():
                lines += [f"### {name.replace('_', ' ').capitalize()}", ""]
                lines += ["| variable | unit | start | meaning |", "|---|---|---|---|"]
                lines += [*(f"| `{one}` | | | |" for one in fields), ""]
        if element == CONCEPTS:
            for concept, asked in ELEVEN.items():
                lines += [f"### {concept}", "", f"<!-- {asked} -->", ""]
    return "\n".join(lines)
