"""Plans: lines `Action : …` as trees of actions."""

from __future__ import annotations

from typing import Literal

from coglogo_py.border.errors import shown
from socialmind.metaciv.actions import ACTIONS, DIRECTIONS, OLD_NAMES, Kind, kind_called
from socialmind.metaciv.description import Action, Place, Plan
from socialmind.metaciv.reading.arguments import Arguments, Written, written_arguments
from socialmind.metaciv.reading.files import Line
from socialmind.metaciv.reading.names import SchemeNames, WorldNames
from socialmind.metaciv.reading.record import Record

DEEPEST = 50
"""Actions within actions."""
MOST_ACTIONS = 5_000
"""Actions of a plan."""
BIRTH = "A_BirthGroupAndRole"


def read_plan(
    record: Record,
    kind: Literal["plan", "birth", "self"],
    scheme: SchemeNames,
    world: WorldNames,
) -> Plan:
    """Return the plan that a file says."""
    plan = Plan(record.name, kind, _Actions(record, scheme, world).tree(), record.place)
    births = [one for action in plan.actions for one in action.all() if one.name == BIRTH]
    for one in births if kind == "birth" else []:
        found, remedy = f"{BIRTH} in the plan of birth", "each child would have a child at once"
        record.findings.error(one.place, found, "no birth at birth", remedy)
    return plan


class _Actions:
    """Reads the actions of one plan."""

    def __init__(self, record: Record, scheme: SchemeNames, world: WorldNames) -> None:
        self.record, self.older = record, world.older
        self.own_actions = world.own_actions
        self.arguments = Arguments(record.findings, scheme, world)
        self.findings = record.findings

    def tree(self) -> tuple[Action, ...]:
        """Return the actions at the top, each with its children."""
        nodes: list[tuple[int, Line]] = []
        deepest = 0
        for line in self.record.document.lines:
            if line.key != "Action":
                if line.key.strip() == "Action":
                    place = self.record.document.place(line)
                    found, expected = "blanks before `Action`", "a tab for each step inwards"
                    self.findings.error(place, found, expected)
                continue
            if line.tabs > min(deepest, DEEPEST):
                expected = f"at most {min(deepest, DEEPEST)}"
                self.findings.error(
                    self.record.document.place(line), f"{line.tabs} tabs before `Action`", expected
                )
                continue
            if len(nodes) == MOST_ACTIONS:
                found = f"more than {MOST_ACTIONS} actions"
                self.findings.error(self.record.document.place(line), found, "a smaller plan")
                break
            nodes.append((line.tabs, line))
            deepest = line.tabs + 1
        return self._siblings(nodes, 0, len(nodes))

    def _siblings(self, nodes: list[tuple[int, Line]], begin: int, end: int) -> tuple[Action, ...]:
        """Return the actions of a stretch of lines that begins with one of the outermost."""
        found = []
        while begin < end:
            after = begin + 1
            while after < end and nodes[after][0] > nodes[begin][0]:
                after += 1
            children = self._siblings(nodes, begin + 1, after)
            action = self._action(nodes[begin][1], children)
            found += [] if action is None else [action]
            begin = after
        return tuple(found)

    def _action(self, line: Line, children: tuple[Action, ...]) -> Action | None:
        place = self.record.document.place(line)
        name, _, rest = line.rest.partition(",")
        name = name.strip()
        kind = kind_called(name)
        written = written_arguments(rest)
        if kind is None and name not in self.own_actions:
            self.findings.unknown(place, name, [*ACTIONS, *OLD_NAMES], "an action")
            return None
        if written is None:
            self.findings.error(place, shown(rest), "arguments `label(Type value)`")
            return None
        if kind is None:
            found, remedy = f"{name}, an action of the model's own", "its Java class is not read"
            self.findings.unsupported(place, found, remedy)
            return Action(name, (), children, place, None, name)
        arguments = self.arguments.read(kind, written, place)
        if arguments is None:
            return None
        direction = self._direction(kind, written, place)
        heeded = self._heeded(kind, children, place)
        return Action(kind.name, arguments, heeded, place, direction, name)

    def _heeded(self, kind: Kind, children: tuple[Action, ...], place: Place) -> tuple[Action, ...]:
        """Return the children that count."""
        most = kind.most_children
        if self.older and kind.name == "L_Repeat":
            most = 1
        if most is not None and len(children) > most:
            several = "s" * (len(children) > 1)
            found = f"{len(children)} action{several} within {kind.name}"
            self.findings.warn(place, found, f"at most {most}", "the others were left out")
        return children[:most]

    def _direction(self, kind: Kind, written: list[Written], place: Place) -> str | None:
        if not kind.has_direction:
            return None
        said = written[0].label.strip() if written else ""
        if said not in DIRECTIONS:
            self.findings.error(place, shown(said), f"a direction: {', '.join(DIRECTIONS)}")
            return None
        return said
