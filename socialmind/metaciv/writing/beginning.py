"""The beginning of agents in a model's file: founders, births, and what all are like at birth."""

from __future__ import annotations

import re

from socialmind.metaciv.writing.acts.form import as_text
from socialmind.metaciv.writing.layout import block, fractional, function, sentence, taken
from socialmind.metaciv.writing.map_text import MapText
from socialmind.metaciv.writing.scheme_file import at_birth
from socialmind.metaciv.writing.sheet import Sheet
from socialmind.metaciv.writing.turns import Turns


class Beginning:
    """The rules by which agents come into being.

    Args:
        sheet: the model file.
        map_text: its map.
        turns: what its agents do in every tick and at birth.
    """

    def __init__(self, sheet: Sheet, map_text: MapText, turns: Turns) -> None:
        self.sheet, self.people, self.model = sheet, sheet.people, sheet.model
        self.map, self.turns = map_text, turns

    def rules(self) -> list[str]:
        """Return the rules, in the order of reading."""
        parts = [self._begin(), self._create_founders()]
        if self.map.scattered:
            parts.append(_PLACE if self.map.closed else _PLACE_ANYWHERE)
        begins = self._come_into_being()
        if begins:
            parts.append(begins)
        parts += [self._join(name) for name in self.joined]
        if "births" in self.sheet.needs:
            parts.append(self._give_birth())
        return parts

    def _begin(self) -> str:
        height = self.model.environment.height
        by_name = {one.name: one for one in self.people.civilisations}
        founding, first = self._founding()
        rest = [one for one in ("model", "rng") if one in taken(founding).split(", ")]
        lines = ["if model.tick == 1:"]
        for one in self.people.settlements:
            values = {
                "people": as_text(one.civilisation),
                "count": f"model.{self.sheet.counts[one.civilisation]}",
                "x": str(one.u),
                "y": str((height - one.v) % height),
                "far": str(max(2 * by_name[one.civilisation].scattered, 1)),
            }
            given = [*(values[name] for name in first), *rest]
            lines.append(f"    create_founders({', '.join(given)})")
        if len(lines) == 1:
            lines = ["pass"]
        doc = "Let the founders of each civilisation appear at its places, in tick 2."
        return function("begin", doc, lines)

    def _create_founders(self) -> str:
        lines, first = self._founding()
        doc = "Create founders of a civilisation at a place"
        if self.model.parameters.dispersion:
            doc += ", scattered around it"
        elif self.map.scattered:
            doc += ", scattered to its north-east"
        return function("create_founders", f"{doc}.", lines, *first)

    def _founding(self) -> tuple[list[str], list[str]]:
        """Return the lines that create founders, and what they take besides model and stream."""
        lines = ["for _ in range(count):", "    human = model.humans.create()"]
        first = ["count", "x", "y"]
        if len(self.people.civilisations) > 1:
            lines.append("    human.civilisation = people")
            first.insert(0, "people")
        lines += ["    human.x = x", "    human.y = y"]
        if "home" in self.sheet.needs:
            lines += ["    human.home_x = x", "    human.home_y = y"]
        if self._beginning():
            lines.append(f"    {self._begin_life}")
        drawn = "model, rng" if self.map.closed else "rng"
        if self.model.parameters.dispersion:
            lines.insert(0, "far = math.ceil((math.sqrt(count) - 1) / 2)")
            lines.append(f"    place_around(human, x - far, y - far, 2 * far + 1, {drawn})")
        elif self.map.scattered:
            lines.append(f"    place_around(human, x, y, far, {drawn})")
            first.append("far")
        return lines, first

    @property
    def _begin_life(self) -> str:
        """How rules let somebody begin life."""
        lines = self._beginning()
        if self._is_one_call(lines):
            return lines[0]
        return f"come_into_being({taken(lines, 'human')})"

    @staticmethod
    def _is_one_call(lines: list[str]) -> bool:
        return len(lines) == 1 and re.fullmatch(r"\w+\(human\b[^()]*\)", lines[0]) is not None

    @property
    def joined(self) -> list[str]:
        """The groups that all of a civilisation join at birth."""
        return [name for name, group in self.people.groups.items() if group.auto_join]

    def _beginning(self) -> list[str]:
        """Return the lines of what agents are like at birth, beyond what all have."""
        per_scheme: dict[str, list[str]] = {}
        for scheme in self.people.schemes:
            own = [
                f"human.{self.sheet.attribute_fields[name]} = {fractional(start)}"
                for name, start in self.people.starts[scheme.name].items()
            ]
            for name in self.people.initial(scheme):
                if not at_birth(self.sheet, name):
                    own += _activating(name)
            for group in scheme.groups:
                if group.auto_join:
                    now = self.people.names[scheme.name]["group", group.name]
                    own.append(f"{self.sheet.joins[now]}(human, model)")
            own += [one.call for one in self.turns.births[scheme.name]]
            own += self.turns.noticing(scheme)
            per_scheme[scheme.name] = own
        lines = self.turns.by_scheme(per_scheme)
        for civilisation in self.people.civilisations:
            further = [
                line
                for name in civilisation.cognitons
                if name in self.people.cognitons
                for line in _activating(name)
            ]
            if further:
                lines += [f"if human.civilisation == {as_text(civilisation.name)}:",
                          *(f"    {one}" for one in further)]  # fmt: skip
        return lines

    def _come_into_being(self) -> str:
        lines = self._beginning()
        doc = "Begin life: what one has and does at birth."
        if not lines or self._is_one_call(lines):
            return ""
        return function("come_into_being", doc, lines, "human")

    def _join(self, name: str) -> str:
        group = self.people.groups[name]
        field = self.sheet.group_fields[name]
        text, role = as_text(name), as_text(group.auto_join or "")
        peoples = self.people.joining(name)
        number = ""
        lines = []
        if len(peoples) > 1:
            lines.append("people = 0")
            for place, one in enumerate(peoples[1:], 1):
                lines += [f"if human.civilisation == {as_text(one.name)}:", f"    people = {place}"]
            number = "[people]"
        lines += [
            f"if len(model.humans.members_of({text}, model.{field}{number})) > 0:",
            f"    human.mind.join_group({text}, {role}, model.{field}{number})",
            "else:",
            f"    human.mind.create_and_join_group({text}, {role})",
            f"    model.{field}{number} = human.mind.get_group_id({text})",
        ]
        doc = f"Join the {name} of the own civilisation; the first one founds it."
        return f"def {self.sheet.joins[name]}(human, model):\n{sentence(doc)}\n{block(lines)}"

    def _give_birth(self) -> str:
        lines = ["child = model.humans.create()"]
        if len(self.people.civilisations) > 1:
            lines.append("child.civilisation = human.civilisation")
        lines += ["child.x = human.x", "child.y = human.y"]
        if "home" in self.sheet.needs:
            lines += ["child.home_x = human.home_x", "child.home_y = human.home_y"]
        if self._beginning():
            lines.append(self._begin_life.replace("human", "child", 1))
        lines.append("return child")
        doc = "Return a new child here, of the same civilisation."
        return f'def give_birth(human, model, rng):\n    """{doc}"""\n{block(lines)}'


_PLACE = '''def place_around(human, x, y, size, model, rng):
    """Put an agent on a patch of a square that can be entered; (x, y) is its south-west."""
    human.x = x + rng.integers(size)
    human.y = y + rng.integers(size)
    while model.world.patch(human.x, human.y).impassable:
        human.x = x + rng.integers(size)
        human.y = y + rng.integers(size)'''


_PLACE_ANYWHERE = '''def place_around(human, x, y, size, rng):
    """Put an agent on a patch of a square; (x, y) is its south-west."""
    human.x = x + rng.integers(size)
    human.y = y + rng.integers(size)'''


def _activating(name: str) -> list[str]:
    return [
        f"human.mind.activate_cogniton({as_text(name)})",
        f"human.mind.set_cogniton_value({as_text(name)}, 1)",
    ]
