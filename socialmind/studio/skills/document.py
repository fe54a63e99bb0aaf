"""A mind of skills as a document: what its files say, part by part, in the words of those files.

A document is JSON: ``name``, ``sensors``, ``actuators``, ``variables`` (each with ``id``, ``name``,
``kind`` and the ``fields`` that follow in its line) and ``skills`` (``id``, ``name``, ``was``: the
name under which its files lie, ``inputs``, ``outputs``, ``function``: its keyword, ``lines``, and
``program``: the text of its own program, or None). Identities are a page's own; an opened document
has those of its order. Each part has a ``position`` too: x and y where somebody put it, or None.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from socialmind.errors import ModelError, SocialmindError
from socialmind.mind.files.evoagents.botdesc import ACTUATORS, SENSORS
from socialmind.mind.files.evoagents.text_file import Lines, one_line
from socialmind.mind.files.layout import LARGEST, SECTIONS, Places
from socialmind.studio.skills.programs import checked_text

Document = dict[str, Any]
EMPTY: Document = {
    "name": "mind", "sensors": [], "actuators": [], "variables": [], "skills": []
}  # fmt: skip
LETTERS = {"sensors": "s", "actuators": "a", "variables": "v", "skills": "k"}
MOST = 5000
"""Parts of a kind, and links and lines of a skill, that a document may have."""


def module_lines(text: str, file: Path) -> dict[str, list[list[str]]]:
    """Return the fields of the lines of a `.botdesc` file, of its sensors and of its actuators."""
    found: dict[str, list[list[str]]] = {SENSORS: [], ACTUATORS: []}
    section = SENSORS
    for line in Lines(text, file).rest():
        if line.text in found:
            section = line.text
        else:
            found[section].append(list(line.fields))
    return found


def skill_lines(text: str, file: Path) -> dict[str, Any]:
    """Return what an `.ades` file that can be read says, line by line."""
    lines = Lines(text, file)
    name = lines.take("a skill").text
    links = {}
    for one in ("inputs", "outputs"):
        count = int(lines.take(one).fields[1])
        links[one] = [":".join(lines.take(one).fields) for _ in range(count)]
    keyword = lines.take("a function").text
    return {
        "name": name,
        **links,
        "function": keyword,
        "lines": [_plain(line) for line in lines.rest()],
    }


def _plain(line: Any) -> str:
    # Lines of graphs are words between blanks.
    return ":".join(line.fields) if ":" in line.text else str(line.text)


def assembled(
    name: str,
    sensors: Iterable[list[str]],
    actuators: Iterable[list[str]],
    variables: Iterable[list[str]],
    skills: Iterable[Mapping[str, Any]],
    places: Places,
) -> Document:
    """Return the document of lines that were read.

    Args:
        name: of the mind.
        sensors: the fields of their lines.
        actuators: likewise.
        variables: likewise.
        skills: as `skill_lines` gives them.
        places: where parts were put.
    """

    def position(what: str, name: str) -> list[int] | None:
        place = places.get(what, {}).get(name)
        return None if place is None else list(place)

    lines = {"sensors": sensors, "actuators": actuators, "variables": variables}
    modules = {
        what: [
            {
                "id": f"{LETTERS[what]}{place}",
                "name": one[0],
                "kind": one[1] if len(one) > 1 else "",
                "fields": one[2:],
                "position": position(what, one[0]),
            }
            for place, one in enumerate(some)
        ]
        for what, some in lines.items()
    }
    own = [
        {
            "id": f"k{place}",
            "was": one["name"],
            **one,
            "position": position("skills", one["name"]),
        }
        for place, one in enumerate(skills)
    ]
    return {"name": name, **modules, "skills": own}


def places_of(document: Document) -> Places:
    """Return where the parts of a document were put."""
    return {
        what: {
            one["name"]: (one["position"][0], one["position"][1])
            for one in document[what]
            if one["position"] is not None
        }
        for what in SECTIONS
    }


def module_line(one: Mapping[str, Any]) -> str:
    """Return the line of a sensor, an actuator or a variable."""
    fields = [one["name"], one["kind"], *one["fields"]]
    while len(fields) > 2 and fields[-1] == "":
        fields.pop()
    return ":".join(fields)


def skill_text(one: Mapping[str, Any]) -> list[str]:
    """Return the lines of a skill's file."""
    lines = [one["name"]]
    for keyword, links in (("input", one["inputs"]), ("output", one["outputs"])):
        lines += [f"{keyword}:{len(links)}", *links]
    return [*lines, one["function"], *one["lines"]]


def checked_shape(document: Any) -> Document:
    """Return a document that a page sent, if it has the shape of one.

    Raises:
        SocialmindError: it has not; nothing that a user could do with the page.
    """
    if not isinstance(document, dict) or not isinstance(document.get("name"), str):
        raise SocialmindError("expected a document of a mind")
    found: Document = {"name": document["name"]}
    for what in ("sensors", "actuators", "variables"):
        found[what] = [
            {**_position(one), **_texts(one, "id", "name", "kind"), **_lists(one, "fields")}
            for one in _parts(document, what)
        ]
    found["skills"] = [
        {
            **_position(one),
            **_texts(one, "id", "name", "function"),
            **_lists(one, "inputs", "outputs", "lines"),
            "was": _folder_name(one.get("was")),
            "program": checked_text(one.get("program")),
        }
        for one in _parts(document, "skills")
    ]
    return found


def _parts(document: Mapping[str, Any], what: str) -> list[dict[str, Any]]:
    parts = document.get(what)
    if not isinstance(parts, list) or len(parts) > MOST:
        raise SocialmindError(f"expected a list of {what}, {MOST} at most")
    if not all(isinstance(one, dict) for one in parts):
        raise SocialmindError(f"expected {what} as objects")
    return parts


def _folder_name(was: Any) -> str | None:
    if was is not None:
        what = "the name of a skill's folder"
        if not isinstance(was, str):
            raise SocialmindError(f"expected {what}, or nothing")
        refuse_file_name(was, what)
    return was


def _texts(one: Mapping[str, Any], *names: str) -> dict[str, str]:
    if not all(isinstance(one.get(name), str) for name in names):
        raise SocialmindError(f"expected texts: {', '.join(names)}")
    return {name: one[name] for name in names}


def _position(one: Mapping[str, Any]) -> dict[str, list[int] | None]:
    place = one.get("position")
    if place is not None and not (
        isinstance(place, list)
        and len(place) == 2
        and all(type(x) is int and -LARGEST <= x < LARGEST for x in place)
    ):
        raise SocialmindError("expected two whole numbers of 32 bits as a position")
    return {"position": place}


def _lists(one: Mapping[str, Any], *names: str) -> dict[str, list[str]]:
    for name in names:
        some = one.get(name)
        if not isinstance(some, list) or len(some) > MOST:
            raise SocialmindError(f"expected a list of {name}, {MOST} at most")
        if not all(isinstance(text, str) for text in some):
            raise SocialmindError(f"expected texts as {name}")
    return {name: one[name] for name in names}


def refuse_file_name(name: str, what: str) -> None:
    """Refuse a name that files and folders cannot have: one with / leads elsewhere.

    Raises:
        ModelError: it is such a name.
    """
    one_line(name, what, ":#/\\")
    if not name or name.startswith("."):
        raise ModelError(f"{name!r} as {what}", "a name that does not begin with '.'", "change it")


def refuse_line_breaks(texts: Iterable[str], what: str, barred: str) -> None:
    """Refuse texts that would not stay on their lines of a file.

    Raises:
        ModelError: one would not.
    """
    for text in texts:
        one_line(text, what, barred)
