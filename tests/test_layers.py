"""No room imports one above it: at import time, deferred, or for annotations."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
LAYERS = (
    "coglogo_py",
    "version errors",
    "fields",
    "looks",
    "values",
    "columns",
    "streams names",
    "text_table",
    "language",
    "compiling",
    "sources",
    "work",
    "mind",
    "agents",
    "economy",
    "worlds",
    "terrain",
    "society",
    "networks",
    "engine",
    "observation",
    "mesa",
    "model",
    "drawing",
    "catalogue",
    "interventions",
    "runs",
    "learning",
    "experiments",
    "documents",
    "metaciv",
    "envs",
    "studio",
    "commands",
    "cli",
)
"""The rooms of the library from the ground up; those of one line do not know each other."""
RANK = {room: number for number, line in enumerate(LAYERS) for room in line.split()}


CIRCLES = {
    "socialmind.__main__": "`python -m` may be told to start either",
    "coglogo_py.mind": "a receipt tells of a mind in a society, and a mind gives its receipt",
    "socialmind.experiments.trainings.plans": "plans are kept and rechecked as plans",
    "socialmind.language.typing.loops": "a loop's body is statements, of which loops are a kind",
    "socialmind.learning.episodes.batch": "a batch runs episodes, which make their batch",
    "socialmind.mind.evaluation.running_skill": "a skill of a hierarchy sets its genome",
    "socialmind.mind.functions.contract": "a module has a function, which says what it fits",
    "socialmind.worlds.plane.arena": "what moves bodies is handed the arena",
}
"""Circles of two or three modules, none at import, by their first module, and why they are one."""


def modules() -> dict[str, Path]:
    found = {}
    for package in ("coglogo_py", "socialmind"):
        for path in sorted((ROOT / package).rglob("*.py")):
            if "template" not in path.parts:
                name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
                found[name.removesuffix(".__init__")] = path
    return found


MODULES = modules()


def imports(name: str) -> Iterator[tuple[str, int, bool]]:
    """Yield the modules that one names, the line, and whether it imports them as it is imported."""
    tree = ast.parse(MODULES[name].read_text("utf-8"))
    at_once = {id(node) for node in tree.body}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for one in node.names:
                if one.name in MODULES:
                    yield one.name, node.lineno, id(node) in at_once
        elif isinstance(node, ast.ImportFrom) and node.module:
            for one in node.names:
                for module in (f"{node.module}.{one.name}", node.module):
                    if module in MODULES:
                        yield module, node.lineno, id(node) in at_once
                        break


def named_in_text(name: str) -> Iterator[tuple[str, int]]:
    """Yield the modules that a module's texts import: text that becomes compiled code."""
    for node in ast.walk(ast.parse(MODULES[name].read_text("utf-8"))):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            for module, part in re.findall(
                r"^from ([\w.]+) import (\w+)", node.value, re.MULTILINE
            ):
                for one in (f"{module}.{part}", module):
                    if one in MODULES:
                        yield one, node.lineno
                        break


def room(module: str) -> str:
    if module == "socialmind.__main__":
        return "cli"
    parts = module.split(".")
    return parts[0] if parts[0] == "coglogo_py" or len(parts) == 1 else parts[1]


def test_no_arrow_points_up():
    up = []
    for name in MODULES:
        if name == "socialmind":
            continue  # the front door, which names what modellers need
        seen = {(module, line) for module, line, _ in imports(name)}
        for module, line in sorted(seen | set(named_in_text(name))):
            above = module == "socialmind" or RANK[room(module)] >= RANK[room(name)]
            if above and room(module) != room(name):
                up.append(f"{name}:{line} -> {module}")
    assert up == []


def test_every_room_has_its_layer():
    rooms = {room(name) for name in MODULES} - {"socialmind"}
    assert rooms == set(RANK)


def circles(known: dict[str, set[str]]) -> list[list[str]]:
    """Return the circles of a graph: modules that reach each other."""

    def reached(start: str) -> set[str]:
        seen, waiting = set(), [start]
        while waiting:
            for other in known.get(waiting.pop(), set()) - seen:
                seen.add(other)
                waiting.append(other)
        return seen

    reach = {name: reached(name) for name in known}
    found: dict[frozenset[str], None] = {}
    for name in known:
        if name in reach[name]:
            circle = frozenset(other for other in reach[name] if name in reach.get(other, set()))
            found[circle] = None
    return [sorted(one) for one in found]


@pytest.mark.parametrize("deferred", [False, True], ids=["at import", "deferred and typing too"])
def test_circles_are_small_and_for_types_alone(deferred):
    known = {
        name: {module for module, _, at_once in imports(name) if at_once or deferred} - {name}
        for name in MODULES
        if name != "socialmind"
    }
    found = circles(known)
    if not deferred:
        assert found == []
    assert [one for one in found if len(one) > 3 or one[0] not in CIRCLES] == []


def test_no_folder_is_crowded():
    counts: dict[str, int] = {}
    for name, path in MODULES.items():
        if path.name != "__init__.py":
            counts[name.rpartition(".")[0]] = counts.get(name.rpartition(".")[0], 0) + 1
    assert {folder: count for folder, count in counts.items() if count > 14} == {}


def test_the_architecture_page_shows_the_same_layers():
    page = (ROOT / "ARCHITECTURE.md").read_text("utf-8")
    shown = re.search(r"```layers\n(.*?)```", page, re.DOTALL)
    assert shown is not None
    lines = [line.split("  ")[0].strip() for line in shown[1].strip().splitlines()]
    assert lines == list(reversed(LAYERS))
