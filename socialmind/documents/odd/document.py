"""The ODD document of a model (Grimm et al. 2020): seven elements and eleven design concepts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py.border.errors import shown
from socialmind.documents.markdown import html_page, tables_in
from socialmind.documents.odd import entities, minds, process
from socialmind.documents.odd.pictures import Picture
from socialmind.documents.odd.words import (
    CONCEPTS,
    ELEVEN,
    ENTITIES,
    INITIALISATION,
    INPUT,
    PROCESS,
    PURPOSE,
    SUBMODELS,
    Section,
    Words,
    plain,
    words_of,
)
from socialmind.errors import SocialmindError
from socialmind.work.files import replace_file

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from coglogo_py import CognitiveScheme
    from socialmind.mind.evaluation.arrays import Assembly
    from socialmind.model import Model

ODD_FILE = "ODD.md"
ABOUT = (
    "This description follows the ODD protocol for individual-based and other simulation models "
    "(Grimm et al. 2020). Its tables of entities, parameters, steps and rules, and its drawings of "
    "minds, are made from the declarations and docstrings of the code that runs; the rest are the "
    "author's words."
)
GRIMM = (
    "Grimm, V., Railsback, S. F., Vincenot, C. E., et al. (2020). The ODD protocol for describing "
    "agent-based and other simulation models: a second update to improve clarity, replication, and "
    "structural realism. *Journal of Artificial Societies and Social Simulation* 23(2): 7. "
    "doi:10.18564/jasss.4259"
)
UNSAID = "*Not described yet.*"


@dataclass
class Document:
    """An ODD document.

    Attributes:
        title: of the document.
        text: Markdown.
        pictures: that it shows.
        gaps: what is missing in it, in words.
        words: the author's.
    """

    title: str
    text: str
    pictures: tuple[Picture, ...]
    gaps: tuple[str, ...]
    words: Words

    def write(self, path: Path) -> list[Path]:
        """Write it, as HTML where the file is called so, else as Markdown with its pictures.

        Args:
            path: the file; pictures go into a folder beside it, or into the HTML.

        Returns:
            The files written.

        Raises:
            SocialmindError: the file is called neither .md nor .html.
        """
        if path.suffix == ".md":
            replace_file(path, self.text.encode())
            return [path, *(one.write(path.parent) for one in self.pictures)]
        if path.suffix not in (".html", ".htm"):
            found = path.suffix or "no suffix"
            raise SocialmindError(f"{path}: found {found}; expected .md or .html")
        from tempfile import TemporaryDirectory

        with TemporaryDirectory() as folder:
            for one in self.pictures:
                one.write(Path(folder))
            page = html_page(self.text, self.title, Path(folder))
        replace_file(path, page.encode())
        return [path]

    def stale(self, path: Path) -> list[str]:
        """Return in what a written document differs from this one; nothing where it does not."""
        if not path.is_file():
            return [f"{path}: no such file"]
        found = []
        kept, new = path.read_text("utf-8").splitlines(), self.text.splitlines()
        if kept != new:
            both = zip(kept, new, strict=False)
            line = next((n for n, (a, b) in enumerate(both, 1) if a != b), None)
            line = line or min(len(kept), len(new)) + 1
            there, made = (some[line - 1] if line <= len(some) else "" for some in (kept, new))
            found.append(f"{path}:{line}: found {shown(there)}; expected {shown(made)}")
        found += [
            f"{path.parent / one.place}: shows another mind than the model's, or is missing"
            for one in self.pictures
            if one.is_stale(path.parent)
        ]
        return found


@dataclass
class _Parts:
    """What is gathered on the way."""

    gaps: list[str] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)


def odd(model: type[Model]) -> Document:
    """Return the ODD document of a model.

    Args:
        model: the model's class; `odd_words.md` beside it holds its author's words.

    Raises:
        ModelError: the words stand under headings that ODD does not have; or a rule, a scheme or a
            mind of the model is wrong.
    """
    words = words_of(model.folder(), model.name)
    parts = _Parts()
    program = model.typed(compiled=False)
    gap = parts.gaps.append
    bodies = {
        PURPOSE: lambda: _said(words.elements[PURPOSE]),
        ENTITIES: lambda: _entities(model, words, parts),
        PROCESS: lambda: [process.schedule(model, program), *_said(words.elements[PROCESS])],
        CONCEPTS: lambda: _concepts(words, parts),
        INITIALISATION: lambda: [process.setup(model), *_said(words.elements[INITIALISATION])],
        INPUT: lambda: _said(words.elements[INPUT]),
        SUBMODELS: lambda: [
            *_said(words.elements[SUBMODELS]),
            "### The rules one by one",
            process.rules(model, program, gap),
        ],
    }
    lines = [
        f"<!-- Made by `socialmind odd {model.folder().name}` from the model's declarations, "
        f"docstrings and {words.file.name}: change those, and make it again. -->",
        f"# {words.title}",
        words.introduction,
        ABOUT,
    ]
    for number, (element, body) in enumerate(bodies.items(), 1):
        lines += [f"## {number}. {element}", *body()]
        if element != CONCEPTS and not words.elements[element].speaks:
            gap(f"the author's words on {element!r}")
            lines.append(UNSAID)
    cited = words.references.split("\n\n") if words.references else []
    lines += ["## References", *sorted([*cited, GRIMM], key=str.lower)]
    text = "\n\n".join(line for line in lines if line) + "\n"
    return Document(words.title, text, tuple(parts.pictures), tuple(parts.gaps), words)


def _said(section: Section) -> Iterator[str]:
    """Yield an author's section as it stands."""
    yield section.text
    for heading, text in section.others(set()):
        yield f"### {heading}\n\n{text}"


def _concepts(words: Words, parts: _Parts) -> Iterator[str]:
    said = words.elements[CONCEPTS]
    yield said.text
    for concept in ELEVEN:
        text = said.part(plain(concept))
        if not text:
            parts.gaps.append(f"the author's words on the design concept {concept!r}")
        yield f"### {concept}\n\n{text or UNSAID}"


def _entities(model: type[Model], words: Words, parts: _Parts) -> Iterator[str]:
    said = words.elements[ENTITIES]
    yield said.text
    yield entities.overview(model)
    shown_minds = {
        name: "\n\n".join(_minds_of(model, name, words, parts))
        for name, one in model.populations.items()
        if one.mind is not None or one.hierarchy is not None
    }
    yield from entities.entity_sections(model, words, shown_minds, parts.gaps.append)
    yield entities.parameters(model, words, parts.gaps.append)


def _minds_of(model: type[Model], name: str, words: Words, parts: _Parts) -> Iterator[str]:
    """Yield what is to be said of the minds of a population."""
    population = model.populations[name]
    said = words.elements[ENTITIES]
    if population.mind is not None:
        scheme = _scheme(model, name)
        text, meanings = _cognitons_in(said.part(plain(f"mind of {name}")))
        for one in meanings:
            if one not in {cogniton.name for cogniton in scheme.cognitons}:
                parts.gaps.append(f"the cogniton {one} of {name}, which the scheme does not have")
        tables = minds.scheme_tables(scheme, meanings)
        yield f"### Mind of {name.replace('_', ' ')}"
        yield text
        yield tables
        caption = f"The cognitive scheme of {name.replace('_', ' ')}"
        yield _picture(parts, f"{name}_scheme", caption, tables, partial(_draw_scheme, scheme))
    if population.hierarchy is not None:
        assembly = model.steerings()[name].assembly
        tables = minds.hierarchy_tables(assembly)
        yield f"### Skills of {name.replace('_', ' ')}"
        yield said.part(plain(f"skills of {name}"))
        yield tables
        caption = (
            f"The hierarchy of skills of {name.replace('_', ' ')}: skills grey, sensors blue, "
            "actuators red, variables yellow"
        )
        yield _picture(parts, f"{name}_skills", caption, tables, partial(_draw_skills, assembly))


def _scheme(model: type[Model], name: str) -> CognitiveScheme:
    from coglogo_py import CognitiveScheme

    population = model.populations[name]
    if isinstance(population.mind, CognitiveScheme):
        return population.mind
    return CognitiveScheme.load(model.folder() / str(population.mind), population.decision_makers)


def _cognitons_in(text: str) -> tuple[str, dict[str, str]]:
    """Take what an author says that cognitons stand for out of a text: `| cogniton | … |`."""
    meanings: dict[str, str] = {}
    lines = text.splitlines()
    for begin, end, (header, *rows) in reversed(tables_in(text)):
        if [plain(one) for one in header] == ["cogniton", "stands for"]:
            del lines[begin:end]
            meanings |= {plain_name.strip("`"): meaning for plain_name, meaning in rows}
    return "\n".join(lines).strip(), meanings


def _picture(parts: _Parts, name: str, caption: str, shows: str, draw: partial[Figure]) -> str:
    picture = Picture(name, caption, shows, draw)
    parts.pictures.append(picture)
    number = len(parts.pictures)
    return f"![{caption}]({picture.place})\n\n**Figure {number}.** {caption}."


def _draw_scheme(scheme: CognitiveScheme) -> Figure:
    from socialmind.drawing.scheme import scheme_figure

    return scheme_figure(scheme)


def _draw_skills(assembly: Assembly) -> Figure:
    from socialmind.mind.hierarchy import Hierarchy
    from socialmind.mind.views.drawing import draw_hierarchy

    figure: Any = draw_hierarchy(Hierarchy(assembly.description, assembly.master)).figure
    return figure


def begin_words(model: type[Model], words: Words) -> None:
    """Write an `odd_words.md` to fill in, where a model has none."""
    from socialmind.documents.odd.words import skeleton

    fields = {
        name: [
            key
            for key in entities.shape_fields(model, name)
            if key not in entities.known_meanings(model)
        ]
        for name in model.shape.populations
    }
    replace_file(words.file, skeleton(words.title, fields).encode())
