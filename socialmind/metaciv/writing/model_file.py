"""The file of a model: its classes, rules, plans and declarations, in the order of reading."""

from __future__ import annotations

import re

from socialmind.metaciv.description import Civilisation
from socialmind.metaciv.writing.acts.form import as_text
from socialmind.metaciv.writing.beginning import Beginning
from socialmind.metaciv.writing.layout import (
    WIDTH,
    fractional,
    heading,
    imported,
    laid_out,
    listed,
    parameter,
    plain,
    sentence,
)
from socialmind.metaciv.writing.map_text import PERIOD, MapText
from socialmind.metaciv.writing.names import Names, identifier
from socialmind.metaciv.writing.pictures import colours_of_terrains, looks, rgb
from socialmind.metaciv.writing.sheet import Built, Sheet, written
from socialmind.metaciv.writing.turns import Turns

SCHEME_FILE, TERRAIN_FILE = "scheme.yaml", "terrain.csv"


class ModelFile:
    """The text of a model's file.

    Args:
        sheet: what it is made of.
        before: the same, written before.

    Attributes:
        turns, map, beginning: its parts.
    """

    def __init__(self, sheet: Sheet, before: ModelFile | None = None) -> None:
        self.sheet, self.people, self.model = sheet, sheet.people, sheet.model
        self.turns: Turns = Turns(sheet, before.turns if before else None)
        self.map = MapText(sheet)
        self.beginning = Beginning(sheet, self.map, self.turns)

    def text(self) -> str:
        """Return the file."""
        sheet = self.sheet
        ground = self.map.lay_ground()
        body = [
            *self._classes(),
            heading("Setup"),
            *([ground] if ground else []),
            *self.beginning.rules(),
            heading("A tick"),
            self.turns.live(),
            *([self.turns.pass_away()] if "deaths" in sheet.needs else []),
            *([self.map.renew()] if self.map.grows else []),
            *([self.turns.clear(self._grouped)] if self._grouped else []),
            *self._rules(),
            self._model_class(),
        ]
        parts = [self._head(body), *body]
        return re.sub(r"\n{4,}", "\n\n\n", "\n\n\n".join(one.strip("\n") for one in parts)) + "\n"

    @property
    def _grouped(self) -> list[Built]:
        """The facilities that groups build."""
        return [one for one in self.sheet.used_facilities if one.grouped]

    def _head(self, body: list[str]) -> str:
        names = listed([one.name for one in self.people.civilisations])
        doc = sentence(f"{names}: a model of MetaCiv's, {self.model.name}.", "")
        text = "\n".join(body)
        own = {"Agent", "Civilisation", "Grid", "Looks", "Model", "Population", "each", "once"}
        if "Message)" in text or "Messages(" in text:
            own |= {"Message", "Messages"}
        if "(Patch)" in text:
            own.add("Patch")
        if "parameter(" in text:
            own.add("parameter")
        own |= self.sheet.imports.get("socialmind", set())
        imports = [imported("socialmind", own)]
        economy = self.sheet.imports.get("socialmind.economy", set()) | {
            one for one in ("Facility", "clear_deserted", "clear_ownerless")
            if re.search(rf"\b{one}\b", text)
        }  # fmt: skip
        if economy:
            imports.append(imported("socialmind.economy", economy))
        terrain = {
            one for one in ("Ground", "step_ahead", "step_towards", "wear_off")
            if re.search(rf"\b{one}\(|\({one}\)", text)
        }  # fmt: skip
        if terrain:
            imports.append(imported("socialmind.terrain", terrain))
        head = [doc, ""]
        if "math." in text:
            head += ["import math", ""]
        head += imports
        constants = self._constants(text)
        if constants:
            head += ["", *constants]
        return "\n".join(head)

    def _constants(self, text: str) -> list[str]:
        found = {name: value for name, value in self.sheet.constants.items()
                 if re.search(rf"\b{name}\b", text)}  # fmt: skip
        lines = [f"{name} = {value}" for name, value in found.items()]
        if "PERIOD" in text:
            lines.append(f"PERIOD = {PERIOD}  # ticks after which the ground changes by itself")
        if self.map.mapped:
            lines += colours_of_terrains(self.map)
        return lines + self.map.tables(text)

    # Classes ----------------------------------------------------------------------------------

    def _classes(self) -> list[str]:
        return [self._human(), *map(self._facility, self.sheet.used_facilities), self.map.land(),
                *([_MESSAGE] if "messages" in self.sheet.needs else [])]  # fmt: skip

    def _human(self) -> str:
        lines = ["class Human(Agent):", '    """Somebody: attributes, and what is carried."""', ""]
        sheet = self.sheet
        for name, attribute in self.people.attributes.items():
            lines.append(
                f"    {sheet.attribute_fields[name]}: float = {fractional(attribute.start)}"
            )
        lines += [
            f"    {field}: int = 0"
            for name, field in sheet.object_fields.items()
            if name in sheet.carried
        ]
        if "walk" in sheet.needs:
            lines.append("    stride: int = 2  # how far it has come in crossing its patch")
        lines += [
            f"    {one.name}: int = -1  # its own {one.facility.name}: an identity, -1 for none"
            for one in sheet.used_facilities
            if one.private
        ]
        lines += [f"    {name}: {declared}" for name, declared in sheet.fields.items()]
        if "deaths" in sheet.needs:
            lines.append("    dying: bool = False  # whether it goes at its next turn")
        if lines[-1] == "":
            lines.pop()
        return "\n".join(lines)

    def _facility(self, built: Built) -> str:
        lines = [f"class {built.title}(Facility):", f'    """{plain(built.facility.name)}."""', ""]
        lines += [f"    {self.sheet.object_fields[one]}: int = 0" for one in built.stock]
        if built.efficient:
            lines.append("    efficiency: int = -1  # work that it takes to be ready; -1 for none")
            lines.append("    counter: int = 0  # work that is left")
        if lines[-1] == "":
            lines.pop()
        return "\n".join(lines)

    # Rules and plans ----------------------------------------------------------------------------

    def _rules(self) -> list[str]:
        rules = list(self.turns.plans.rules.values())
        every = dict.fromkeys(
            one
            for rules_at_once in (*self.turns.every_tick.values(), *self.turns.births.values())
            for one in rules_at_once
        )
        parts = []
        acts = [one for one in rules if one.kind == "act" and one not in every]
        asks = [one for one in rules if one.kind == "ask"]
        if every:
            born = any(self.turns.births.values())
            parts.append(heading("Every tick, and at birth" if born else "Every tick"))
            parts += [one.text() for one in every]
        if self.turns.crossings:
            parts += [heading("Triggers"), *(one.text() for one in self.turns.crossings.values())]
        if acts:
            parts += [heading("What is done"), *(one.text() for one in acts)]
        if asks:
            parts += [heading("What is asked"), *(one.text() for one in asks)]
        helpers = [one for name, one in self.sheet.helpers.items() if one]
        if "any facility here" in self.sheet.needs:
            helpers.append(self._any_facility())
        if helpers:
            parts += [heading("What rules have in common"), *helpers]
        if self.turns.plans.trees:
            trees = self.turns.plans.trees.values()
            parts += [heading("Plans"), "\n".join(line for one in trees for line in one)]
        return parts

    def _any_facility(self) -> str:
        tests = [f"len(model.{one.population}.on(place)) > 0" for one in self.sheet.used_facilities]
        test = " or ".join(tests) or "False"
        line = f"return {test}"
        if len(line) + 4 > WIDTH:
            line = "return (\n        " + "\n        or ".join(tests) + "\n    )"
        return (
            "def any_facility_here(place, model):\n"
            f'    """Return whether a facility is on the patch of somebody, or on a patch."""\n'
            f"    {line}\n"
        )

    # The model ----------------------------------------------------------------------------------

    def _model_class(self) -> str:
        sheet, environment = self.sheet, self.model.environment
        lines = [
            f"class {sheet.title}(Model):",
            f'    """{plain(self.model.name)}, as in MetaCiv."""',
            "",
            "    ticks = 1_000",
            "",
        ]
        for one in self.people.civilisations:
            lines += parameter(sheet.counts[one.name], "int", str(one.agents), "agents",
                                f"founders of {one.name} at each of its places")  # fmt: skip
        for name, constant in self.people.constants.items():
            if name in sheet.used_constants:
                whole = name in sheet.whole
                value = written(int(constant.value)) if whole else fractional(constant.value)
                lines += parameter(sheet.parameters[name], "int" if whole else "float", value,
                                    "", f"MetaCiv's constant {name}", low=None)  # fmt: skip
        parameters = self.model.parameters
        if "ways" in sheet.needs or "free ground" in sheet.needs:
            lines += parameter("vision_radius", "int", str(max(parameters.vision_radius, 0)),
                                "patches", "how far agents know the ground; 0 for all")  # fmt: skip
        if "roads" in sheet.needs:
            lines += parameter("road_creation", "int", str(parameters.road_creation), "steps",
                                "after more than these a patch is a road")  # fmt: skip
            lines += parameter("road_evaporation", "int", str(max(parameters.road_evaporation, 0)),
                                "steps", f"lost by each patch every {PERIOD} ticks")  # fmt: skip
        for name in self.beginning.joined:
            count = len(self.people.joining(name))
            declared = (
                f"{sheet.group_fields[name]}: int = -1"
                if count == 1
                else f"{sheet.group_fields[name]}: list[int] = [-1] * {count}"
            )
            whose = "of each civilisation" if count > 1 else "that all join"
            lines += ["", f"    {declared}  # the {name} {whose}: an identity"]
        maps = ', maps={"terrain": "terrain.csv"}' if self.map.mapped else ""
        lines += ["", *laid_out(
            "    world = Grid(", [str(environment.width), str(environment.height), "patch=Land",
                                  "low=(0, 0)", *([maps[2:]] if maps else [])], ")")]  # fmt: skip
        lines += self._population()
        for built in sheet.used_facilities:
            lines.append(f"    {built.population} = Population({built.title}, 0)")
        if "messages" in sheet.needs:
            lines.append("    messages = Messages(Request, to=humans)")
        lines.append("")
        if "def lay_ground" in self.map.lay_ground():
            lines.append("    setup = (once(lay_ground),)")
        phases = ["once(begin)", "each(humans, live)"]
        if self.map.grows:
            phases.append("once(renew)")
        if any(one.grouped for one in sheet.used_facilities):
            phases.append("once(clear)")
        lines += laid_out("    schedule = (", phases, ")")
        lines += ["", *self._series(), "", *looks(sheet, self.map)]
        return "\n".join(lines)

    def _population(self) -> list[str]:
        plans = [f"{as_text(name)}: {what}" for name, what in self.turns.plans.carried_out.items()]
        lines = ["    humans = Population(", "        Human,"]
        peoples = [self._civilisation(one) for one in self.people.civilisations]
        lines += laid_out("        civilisations=(", peoples, "),")
        lines.append(f'        mind="{SCHEME_FILE}",')
        if plans:
            lines += laid_out("        plans={", plans, "},")
        return [*lines, "    )"]

    def _civilisation(self, one: Civilisation) -> str:
        height = self.model.environment.height
        first = next(s for s in self.people.settlements if s.civilisation == one.name)
        place = f"({first.u}, {(height - first.v) % height})"
        return f'Civilisation({as_text(one.name)}, 0, place={place}, colour="{rgb(one.colour)}")'

    def _series(self) -> list[str]:
        sheet = self.sheet
        keys = Names(("humans", "tick"))
        rows = ['"humans": len(humans),']
        if len(self.people.civilisations) > 1:
            rows += [
                f'"{keys.own(identifier(one.name))}": '
                f"int((humans.civilisation == {as_text(one.name)}).sum()),"
                for one in self.people.civilisations
            ]
        for group in self.people.groups.values():
            for role in group.roles:
                name = identifier(role.name)
                key = keys.own(name, f"{identifier(group.name)}_{name}")
                played = f"humans.plays({as_text(group.name)}, {as_text(role.name)})"
                rows.append(f'"{key}": int({played}.sum()),')
        rows += [
            f'"{keys.own(field, f"{field}_carried")}": int(humans.{field}.sum()),'
            for name, field in sheet.object_fields.items()
            if name in sheet.carried
        ]
        rows += [
            f'"{keys.own(one, f"mean_{one}")}": float(humans.{one}.mean()) if len(humans) else 0.0,'
            for one in sheet.attribute_fields.values()
        ]
        rows += [
            f'"{keys.own(one.population, f"{one.population}_built")}": len(self.{one.population}),'
            for one in sheet.used_facilities
        ]
        doc = "Return how many there are, what all carry, and what they are like in the mean."
        return [
            "    def series(self):",
            f"{sentence(doc, '        ')}",
            "        humans = self.humans",
            "        return {",
            *(f"            {one}" for one in rows),
            "        }",
        ]


_MESSAGE = '''class Request(Message):
    """What an agent tells another: one of ATTACK, TRADE and HIRING."""

    kind: int = 0'''
