"""Minds opened as documents and saved: of their files only what was changed is touched."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from difflib import SequenceMatcher
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from socialmind.errors import SocialmindError
from socialmind.mind.description import MindDescription
from socialmind.mind.files import yaml_writer
from socialmind.mind.files.evoagents.botdesc import ACTUATORS, SENSORS
from socialmind.mind.files.evoagents.folder_reader import (
    ADES,
    BOTDESC,
    GENOME,
    SKILLS,
    TASKS,
    VARDESC,
    agent_file,
    files_in,
    read_folder,
)
from socialmind.mind.files.evoagents.text_file import Line, Lines, inside, text_of
from socialmind.mind.files.folder import load_description
from socialmind.mind.files.layout import LAYOUT, Places, layout_file, lines_of, parse
from socialmind.mind.files.python_file import programs_unrun
from socialmind.studio.skills.checking import Checked, checked, renamed_weights
from socialmind.studio.skills.document import (
    Document,
    assembled,
    module_line,
    module_lines,
    places_of,
    skill_lines,
    skill_text,
)
from socialmind.studio.skills.programs import file_of, is_program, program_text, put_program
from socialmind.work.files import replace_file

YAML = (".yaml", ".yml")
UNWRITTEN = ("id", "was", "position")
"""What of a part its mind's own files do not say."""
Tree = dict[str, bytes]
"""The content of the files of a mind's folder, by their paths in it."""


def is_yaml(path: Path) -> bool:
    """Whether a mind is one YAML file, by its name."""
    return path.suffix.lower() in YAML


@contextmanager
def folder_form(path: Path) -> Iterator[Path]:
    """Give the folder of a mind; of one in a YAML file, a passing one that says the same.

    Args:
        path: the folder, or the YAML file; its programs are not run.

    Raises:
        ModelError: there is no mind, or one of its files is wrong.
    """
    if not is_yaml(path):
        yield path
        return
    with TemporaryDirectory(prefix="socialmind-mind-") as folder:
        with programs_unrun():
            load_description(path, MindDescription).save(folder)
        yield Path(folder)


def opened(path: Path) -> Document:
    """Return the document of a mind's folder or YAML file; its programs are not run.

    Args:
        path: the folder, its `.botdesc` file, or the YAML file.

    Raises:
        ModelError: there is no mind, or one of its files is wrong.
    """
    with programs_unrun():
        mind = load_description(path, MindDescription)  # which says what is wrong
    home = home_of(path)
    with folder_form(home) as folder:
        agent = agent_file(folder)
        modules = module_lines(text_of(agent), agent)
        own = agent.with_suffix(VARDESC)
        variables = Lines(text_of(own), own).rest() if own.is_file() else []
        skills = [
            skill_lines(text_of(file := folder / SKILLS / name / f"{name}{ADES}"), file)
            for name in mind.skills
        ]
        for one in skills:
            one["program"] = program_text(folder / SKILLS / one["name"], one)
    return assembled(
        agent.stem,
        modules[SENSORS],
        modules[ACTUATORS],
        [list(one.fields) for one in variables],
        skills,
        _places(home),
    )


def _places(home: Path) -> Places:
    """Return where the modules of a mind were put."""
    file = layout_file(home)
    if not file.is_file():
        return {}
    return parse(text_of(inside(file.parent, file.name, "the file", file)), file)


def home_of(path: Path) -> Path:
    """Return the folder of a mind that was named by its `.botdesc` file, or by its folder."""
    return path.parent if path.suffix == BOTDESC and path.is_file() else path


def fingerprint(path: Path) -> str:
    """Return a hash of all files of a mind."""
    total = hashlib.sha256()
    for name, content in sorted(tree_of(path).items()):
        total.update(f"{name}\0{len(content)}\0".encode() + content)
    return total.hexdigest()


def tree_of(path: Path) -> Tree:
    """Return the files of a mind; those of its folder that are none of it are left out."""
    if is_yaml(path):
        beside = sorted(path.parent.glob(f"{path.stem}.*/**/*"))
        own = [path, path.with_suffix(LAYOUT)]
        some = [*own, *(one for one in beside if "__pycache__" not in one.parts)]
        return {str(o.relative_to(path.parent)): o.read_bytes() for o in some if o.is_file()}
    some = [one for suffix in (BOTDESC, VARDESC, LAYOUT, ".py") for one in files_in(path, suffix)]
    for inner in (SKILLS, TASKS):
        some += sorted((path / inner).rglob("*"))
    return {
        one.relative_to(path).as_posix(): one.read_bytes()
        for one in some
        if one.is_file() and not one.is_symlink() and "__pycache__" not in one.parts
    }


def saved(document: Document, target: Path, home: Path | None) -> list[str]:
    """Save a document; files whose content does not change are not written.

    Args:
        document: of the shape of one.
        target: the folder or YAML file to save in.
        home: where the document was opened from; None for a mind that has no files yet.

    Returns:
        What is to be known about it, in sentences.

    Raises:
        SocialmindError: the document is no mind; or it cannot be written.
    """
    if is_yaml(target):
        _places(target)  # a file that is called so, and is none of ours, is refused, not lost
    before = None if home is None else opened(home)
    layout = _layout(document, before, home)
    notes: list[str] = []
    if before is None or not (is_yaml(target) and target == home and _same(document, before)):
        with nullcontext() if home is None else folder_form(home) as folder:
            notes = _save(document, target, folder, before, layout)
    if is_yaml(target):
        file = target.with_suffix(LAYOUT)
        there = {file.name: file.read_bytes()} if file.is_file() else {}
        _write(_named(layout, target.stem), target.parent, there)
    return notes


def _layout(document: Document, before: Document | None, home: Path | None) -> bytes:
    """Return the content of the file that says where parts were put; nothing where none was."""
    file = None if home is None else layout_file(home)
    old = file.read_bytes() if file is not None and file.is_file() else b""
    places = places_of(document)
    if before is not None and places == places_of(before):
        return old
    return patched(old, lines_of(places))


def _named(layout: bytes, stem: str) -> Tree:
    return {f"{stem}{LAYOUT}": layout} if layout.strip() else {}


def _save(
    document: Document, target: Path, home: Path | None, before: Document | None, layout: bytes
) -> list[str]:
    """Save into a folder; or by way of one into a YAML file, which is written anew."""
    found = checked(document, home, before)
    refuse_wrong(found)
    old = {} if home is None else tree_of(home)
    new, notes = _tree(document, before, old, found)
    if not is_yaml(target):
        new |= _named(layout, document["name"])
        _write(new, target, tree_of(target) if target.is_dir() else {})
        return notes
    if target.is_file() and "#" in text_of(target).removeprefix(yaml_writer.HEADER):
        notes.append("comments of a YAML file are not kept where it is changed")
    with TemporaryDirectory(prefix="socialmind-mind-") as folder:
        _write(new, Path(folder), {})
        with programs_unrun():
            mind = read_folder(Path(folder), MindDescription)
            names = [one["name"] for one in document["skills"]]
            made = MindDescription(
                mind.name,
                mind.sensors.values(),
                mind.actuators.values(),
                mind.variables.values(),
                [mind.skills[name] for name in names],
            )
            for one in target.parent.glob(f"{target.stem}.genomes/*.genome"):
                if one.stem not in names or mind.skills[one.stem].genome is None:
                    one.unlink()
            made.save(target)
    return notes


def _write(new: Tree, target: Path, there: Tree) -> None:
    """Write the files of a folder that are others than those that are there."""
    try:
        target.mkdir(parents=True, exist_ok=True)
        for name, content in new.items():
            if there.get(name) != content:
                (target / name).parent.mkdir(parents=True, exist_ok=True)
                replace_file(target / name, content)
        for name in [one for one in there if one not in new]:
            (target / name).unlink()
            _remove_empty((target / name).parent, target)
    except OSError as error:
        raise SocialmindError(f"{target}: cannot be written ({error.strerror})") from None


def programs_changed(document: Document, home: Path | None) -> bool:
    """Return whether saving a document would write a program that is not there already.

    Args:
        document: of the shape of one.
        home: where it was opened from; None for a mind that has no files yet.
    """
    before = [] if home is None else opened(home)["skills"]
    there = {one["name"]: one["program"] for one in before}
    return any(
        is_program(one) and one["program"] != there.get(one["was"]) for one in document["skills"]
    )


def refuse_wrong(found: Checked) -> None:
    """Refuse to save what is no mind.

    Raises:
        SocialmindError: it is none, with the first thing that is wrong.
    """
    if found.wrong:
        first = next(one["text"] for one in found.findings if one["wrong"])
        raise SocialmindError(f"not saved: {first}")


def _same(document: Document, before: Document) -> bool:
    return _without_identities(document) == _without_identities(before)


def _without_identities(document: Document) -> dict[str, Any]:
    return {
        what: some
        if isinstance(some, str)
        else [{name: one[name] for name in one if name not in UNWRITTEN} for one in some]
        for what, some in document.items()
    }


def _tree(
    document: Document, before: Document | None, old: Tree, found: Checked
) -> tuple[Tree, list[str]]:
    """Return the files of a document's folder, and what is to be known about them."""
    name, was = document["name"], document["name"] if before is None else before["name"]
    outer = [path for path in old if "/" not in path and not path.endswith(LAYOUT)]
    new = {_renamed(path, was, name): old[path] for path in outer}
    new |= {path: content for path, content in old.items() if path.startswith(f"{TASKS}/")}
    modules = [SENSORS, *map(module_line, document["sensors"]), ACTUATORS]
    modules += map(module_line, document["actuators"])
    new[f"{name}{BOTDESC}"] = patched(new.get(f"{name}{BOTDESC}", b""), modules)
    if document["variables"] or f"{name}{VARDESC}" in new:
        lines = list(map(module_line, document["variables"]))
        new[f"{name}{VARDESC}"] = patched(new.get(f"{name}{VARDESC}", b""), lines)
    notes = []
    for one in document["skills"]:
        begin = f"{SKILLS}/{one['was'] or one['name']}/"
        own = {path.removeprefix(begin): old[path] for path in old if path.startswith(begin)}
        if one["was"] and one["was"] != one["name"]:
            own = {_renamed(path, one["was"], one["name"]): text for path, text in own.items()}
        file, weights = f"{one['name']}{ADES}", f"{one['name']}{GENOME}"
        own[file] = patched(own.get(file, b""), skill_text(one))
        if weights in own and not found.weights[one["id"]]["fits"]:
            del own[weights]
            notes.append(f"the weights of {one['name']} did not fit any more and are gone")
        elif weights in own and one["was"] != one["name"]:
            own[weights] = renamed_weights(own[weights].decode(), one["name"]).encode()
        if is_program(one):
            put_program(own, one, _program_file(one, before, own))
        new |= {f"{SKILLS}/{one['name']}/{path}": content for path, content in own.items()}
    return new, notes


def _program_file(one: dict[str, Any], before: Document | None, own: Tree) -> str | None:
    """Return the name of the file of the program that a skill had, if it had one."""
    had = next((o for o in (before or {}).get("skills", ()) if o["name"] == one["was"]), None)
    return None if had is None or not is_program(had) else file_of(had, one["name"], own)


def _renamed(path: str, was: str, name: str) -> str:
    """Return the path of a file that is called as a mind or a skill, whose name is another now."""
    folder, slash, file = path.rpartition("/")
    stem, dot, suffix = file.rpartition(".")
    return f"{folder}{slash}{name}{dot}{suffix}" if stem == was and dot else path


def patched(old: bytes, lines: Sequence[str]) -> bytes:
    r"""Return a file that says these lines, with what is left of the old one as it was written.

    Comments, blank lines and the spelling of lines that stay are kept.

    Args:
        old: the file's content.
        lines: what it is to say, a line each.

    >>> patched(b"# eyes\nS1 : proxSensor  # left\nS2:proxSensor\n", ["S1:proxSensor", "S3:x"])
    b'# eyes\nS1 : proxSensor  # left\nS3:x\n'
    """
    text = old.decode("utf-8")
    ending = "\r\n" if "\r\n" in text else "\n"
    raw = text.split(ending)
    tail = raw.pop() if raw and raw[-1] == "" else None
    places = [(n, said) for n, line in enumerate(raw) if (said := _said(line, n)) is not None]
    wanted = [_fields(line) for line in lines]
    matcher = SequenceMatcher(None, [said for _, said in places], wanted, autojunk=False)
    result: list[str] = []
    at = 0
    for tag, begin, end, first, last in matcher.get_opcodes():
        if tag == "equal":
            stop = places[end - 1][0] + 1
            result += raw[at:stop]
            at = stop
            continue
        new = list(lines[first:last])
        if begin < end:
            # What stands above the lines that go stays; the new ones come in their place.
            result += raw[at : places[begin][0]]
            inner = raw[places[begin][0] : places[end - 1][0] + 1]
            result += new + [line for line in inner if _said(line, 0) is None and line.strip()]
            at = places[end - 1][0] + 1
        else:
            result += new
    result += raw[at:]
    if tail is not None or not text:
        result.append("")
    return ending.join(result).encode("utf-8")


def _fields(line: str) -> tuple[str, ...]:
    return Line(line, 1).fields


def _said(line: str, number: int) -> tuple[str, ...] | None:
    """Return the fields of a line, None for one that says nothing."""
    said = line.removeprefix("\ufeff").partition("#")[0].strip()
    return Line(said, number).fields if said else None


def _remove_empty(folder: Path, home: Path) -> None:
    """Remove folders that hold nothing any more."""
    while folder != home and folder.is_dir() and not any(_kept(folder.iterdir())):
        for one in list(folder.rglob("*")):
            if one.is_file():
                one.unlink()
        for one in sorted((o for o in folder.rglob("*") if o.is_dir()), reverse=True):
            one.rmdir()
        folder.rmdir()
        folder = folder.parent


def _kept(some: Iterable[Path]) -> Iterable[Path]:
    return (one for one in some if one.name != "__pycache__")
