"""The file of a model: its classes, rules, plans and declarations, in the order of reading."""

from __future__ import annotations

import colorsys
import re

from socialmind.metaciv.description import Civilisation, Cogniton, Scheme, Terrain, Trigger
from socialmind.metaciv.writing.acts.form import COMPARISONS, as_text, in_name
from socialmind.metaciv.writing.acts.minds import GAIN
from socialmind.metaciv.writing.names import identifier
from socialmind.metaciv.writing.plans import WIDTH, Plans, Rule, sentence
from socialmind.metaciv.writing.scheme_file import at_birth, chosen_plans, compared, is_condition
from socialmind.metaciv.writing.sheet import Built, Sheet, written

SCHEME_FILE, TERRAIN_FILE = "scheme.yaml", "terrain.csv"
PERIOD = 150
"""Ticks after which pheromones grow and roads wear off."""


class ModelFile:
    """The text of a model's file.

    Args:
        sheet: what it is made of.
        before: the same, written before.
    """

    def __init__(self, sheet: Sheet, before: ModelFile | None = None) -> None:
        self.sheet = sheet
        self.people, self.model = sheet.people, sheet.model
        self.plans = Plans(sheet, before.plans if before else None)
        self.every_tick: dict[str, list[Rule]] = {}
        self.births: dict[str, list[Rule]] = {}
        self.crossings: dict[str, Rule] = {}
        for name in chosen_plans(sheet):
            self.plans.add(self.people.plans[name])
        for scheme in self.people.schemes:
            self.every_tick[scheme.name] = self._at_once("self", scheme)
            self.births[scheme.name] = self._at_once("birth", scheme)
            self._noticing(scheme)

    def _at_once(self, kind: str, scheme: Scheme) -> list[Rule]:
        """Return the rules of the plans of every tick, or of birth."""
        found = []
        what = "in every tick" if kind == "self" else "at birth"
        for plan in self.people.plans_of_kind(kind, scheme):
            body = self.plans.lines(plan.actions, plan)
            if body != ["pass"]:
                names = (identifier(plan.name), f"{identifier(plan.name)}_{kind}_plan")
                key = f"{kind} {plan.name}"
                if key not in self.plans.rules:
                    name = self.sheet.function_named(*names)
                    rule = Rule(name, "act", f"{plan.name}: what is done {what}, at once.", body)
                    self.plans.rules[key] = rule
                found.append(self.plans.rules[key])
        return found

    # The text ---------------------------------------------------------------------------------

    def text(self) -> str:
        """Return the file."""
        body = [
            *self._classes(),
            *self._setup(),
            *self._tick(),
            *self._rules(),
            self._model_class(),
        ]
        parts = [self._head(body), *body]
        return re.sub(r"\n{4,}", "\n\n\n", "\n\n\n".join(one.strip("\n") for one in parts)) + "\n"

    def _head(self, body: list[str]) -> str:
        names = _listed([one.name for one in self.people.civilisations])
        doc = sentence(f"{names}: a model of MetaCiv's, {self.model.name}.", "")
        text = "\n".join(body)
        own = {"Agent", "Civilisation", "Grid", "Model", "Population", "each", "once"}
        if "Message)" in text or "Messages(" in text:
            own |= {"Message", "Messages"}
        if "(Patch)" in text:
            own.add("Patch")
        if "parameter(" in text:
            own.add("parameter")
        own |= self.sheet.imports.get("socialmind", set())
        imports = [_import("socialmind", own)]
        economy = self.sheet.imports.get("socialmind.economy", set()) | {
            one for one in ("Facility", "clear_deserted", "clear_ownerless")
            if re.search(rf"\b{one}\b", text)
        }  # fmt: skip
        if economy:
            imports.append(_import("socialmind.economy", economy))
        terrain = {
            one for one in ("Ground", "step_ahead", "step_towards", "tread", "wear_off")
            if re.search(rf"\b{one}\(|\({one}\)", text)
        }  # fmt: skip
        if terrain:
            imports.append(_import("socialmind.terrain", terrain))
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
        lines += self._tables(text)
        return lines

    # Classes ----------------------------------------------------------------------------------

    def _classes(self) -> list[str]:
        return [self._human(), *map(self._facility, self.sheet.used_facilities), self._land(),
                *([_MESSAGE] if "messages" in self.sheet.needs else [])]  # fmt: skip

    def _human(self) -> str:
        lines = ["class Human(Agent):", '    """Somebody: attributes, and what is carried."""', ""]
        sheet = self.sheet
        for name, attribute in self.people.attributes.items():
            lines.append(f"    {sheet.attribute_fields[name]}: float = {_float(attribute.start)}")
        for name in sheet.object_fields:
            if name in sheet.carried:
                lines.append(f"    {sheet.object_fields[name]}: int = 0")
        if "walk" in sheet.needs:
            lines.append("    stride: int = 2  # how far it has come in crossing its patch")
        for built in sheet.used_facilities:
            if built.private:
                lines.append(
                    f"    {built.name}: int = -1  # its own {built.facility.name}: an identity, "
                    "-1 for none"
                )
        lines += [f"    {name}: {declared}" for name, declared in sheet.fields.items()]
        if "deaths" in sheet.needs:
            lines.append("    dying: bool = False  # whether it goes at its next turn")
        if lines[-1] == "":
            lines.pop()
        return "\n".join(lines)

    def _facility(self, built: Built) -> str:
        lines = [f"class {built.title}(Facility):", f'    """{_plain(built.facility.name)}."""', ""]
        lines += [f"    {self.sheet.object_fields[one]}: int = 0" for one in built.stock]
        if built.efficient:
            lines.append("    efficiency: int = -1  # work that it takes to be ready; -1 for none")
            lines.append("    counter: int = 0  # work that is left")
        if lines[-1] == "":
            lines.pop()
        return "\n".join(lines)

    @property
    def terrains(self) -> list[Terrain | None]:
        """The terrains of the map by index; None for one that no file has."""
        known = {one.name: one for one in self.model.terrains}
        return [known.get(name) for name in self.model.environment.terrains]

    @property
    def used_indices(self) -> list[int]:
        """The indices that the map has."""
        return sorted({one for row in self.model.environment.rows for one in row})

    @property
    def mapped(self) -> bool:
        """Whether the map has more than one terrain, or rules ask for them."""
        return len(self.used_indices) > 1 or "terrains" in self.sheet.needs

    def _of_terrains(self, value: object) -> list[object]:
        """Return what is said of each terrain, by index."""
        return [value(one) if one is not None else None for one in self.terrains]  # type: ignore[operator]

    def _only(self, values: list[object]) -> object | None:
        """Return the one value that all terrains of the map have, or None."""
        found = {repr(values[one]) for one in self.used_indices}
        return values[self.used_indices[0]] if len(found) == 1 else None

    def _land(self) -> str:
        sheet = self.sheet
        base = "Ground" if self.grounded else "Patch"
        lines = [f"class Land({base}):", '    """A patch of the map."""', ""]
        if self.mapped:
            lines.append("    terrain: int = 0")
        if self.grounded and not self._varies("passability"):
            (first,) = (self.terrains[self.used_indices[0]],)
            passability = first.passability if first is not None else 20
            lines.append(f"    passability: int = {passability}")
            if "ways" in sheet.needs:
                lines.append(f"    effort: float = {max(passability, 1)}.0")
        for name in sheet.smelt:
            only = self._only(self._of_terrains(_deposit(name, "initial")))
            start = _float(float(only)) if isinstance(only, int | float) else "0.0"
            lines.append(f"    {sheet.pheromone_fields[name]}: float = {start}")
        if lines[-1] == "":
            lines.pop()
        return "\n".join(lines)

    def _varies(self, what: str) -> bool:
        if what == "passability":
            values = self._of_terrains(lambda one: (one.passability, one.impassable))
            only = self._only(values)
            return only is None or bool(only[1])  # type: ignore[index]
        name, column = what.rsplit(" ", 1)
        return self._only(self._of_terrains(_deposit(name, column))) is None

    def _tables(self, text: str) -> list[str]:
        names = ", ".join("–" if one is None else one.name for one in self.terrains)
        lines = []
        if "PASSABILITY" in text:
            numbers = [str(one.passability) if one else "20" for one in self.terrains]
            closed = [str(one.impassable) if one else "False" for one in self.terrains]
            lines.append(f"# Of each terrain of the map: {names}.")
            lines += _table("PASSABILITY", numbers) + _table("IMPASSABLE", closed)
        for name, field in self.sheet.pheromone_fields.items():
            for column, constant in (("initial", f"FIRST_{field.upper()}"),
                                     ("growth", f"{field.upper()}_GROWTH")):  # fmt: skip
                if re.search(rf"\b{constant}\b", text):
                    values = self._of_terrains(_deposit(name, column))
                    if self._only(values) is not None and column == "growth":
                        value = values[self.used_indices[0]]
                        lines.append(f"{constant} = {written(float(value))}")  # type: ignore[arg-type]
                        continue
                    if not lines or not any("Of each terrain" in one for one in lines):
                        lines.append(f"# Of each terrain of the map: {names}.")
                    lines += _table(constant, [written(float(one or 0)) for one in values])  # type: ignore[arg-type]
        return lines

    # Setup ------------------------------------------------------------------------------------

    def _setup(self) -> list[str]:
        parts = [_rule_line("Setup")]
        ground = self._lay_ground()
        if ground:
            parts.append(ground)
        parts += [self._begin(), self._create_founders()]
        if self.scattered:
            parts.append(_PLACE if self.closed else _PLACE_ANYWHERE)
        begins = self._come_into_being()
        if begins:
            parts.append(begins)
        parts += [self._join(name) for name in self.joined]
        if "births" in self.sheet.needs:
            parts.append(self._give_birth())
        return parts

    def _lay_ground(self) -> str:
        lines = []
        if self.grounded and self._varies("passability"):
            lines += [
                "patch.passability = PASSABILITY[patch.terrain]",
                "patch.impassable = IMPASSABLE[patch.terrain]",
            ]
            if "ways" in self.sheet.needs:
                lines.append(
                    "patch.effort = math.inf if patch.impassable else max(patch.passability, 1)"
                )
        for name in self.sheet.smelt:
            if self._varies(f"{name} initial"):
                field = self.sheet.pheromone_fields[name]
                lines.append(f"patch.{field} = FIRST_{field.upper()}[patch.terrain]")
        if not lines:
            return ""
        loop = ["for patch in model.world.patches:", *(f"    {one}" for one in lines)]
        return _function("lay_ground", "Give each patch what its terrain has.", loop)

    @property
    def closed(self) -> bool:
        """Whether the map has ground that nobody can enter."""
        terrains = self.terrains
        return any(one is not None and one.impassable for one in
                   (terrains[index] for index in self.used_indices))  # fmt: skip

    @property
    def grounded(self) -> bool:
        """Whether rules ask how hard the ground is to cross."""
        return "walk" in self.sheet.needs or (self.scattered and self.closed)

    @property
    def scattered(self) -> bool:
        return self.model.parameters.dispersion or any(
            one.scattered > 0 for one in self.people.civilisations
        )

    def _begin(self) -> str:
        height = self.model.environment.height
        by_name = {one.name: one for one in self.people.civilisations}
        founding, first = self._founding()
        taken = [one for one in ("model", "rng") if one in parameters(founding).split(", ")]
        lines = ["if model.tick == 1:"]
        for one in self.people.settlements:
            values = {
                "people": as_text(one.civilisation),
                "count": f"model.{self.sheet.counts[one.civilisation]}",
                "x": str(one.u),
                "y": str((height - one.v) % height),
                "far": str(max(2 * by_name[one.civilisation].scattered, 1)),
            }
            given = [*(values[name] for name in first), *taken]
            lines.append(f"    create_founders({', '.join(given)})")
        if len(lines) == 1:
            lines = ["pass"]
        doc = "Let the founders of each civilisation appear at its places, in tick 2."
        return _function("begin", doc, lines)

    def _create_founders(self) -> str:
        lines, first = self._founding()
        doc = "Create founders of a civilisation at a place"
        if self.model.parameters.dispersion:
            doc += ", scattered around it"
        elif self.scattered:
            doc += ", scattered to its north-east"
        return _function("create_founders", f"{doc}.", lines, *first)

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
        drawn = "model, rng" if self.closed else "rng"
        if self.model.parameters.dispersion:
            lines.insert(0, "far = math.ceil((math.sqrt(count) - 1) / 2)")
            lines.append(f"    place_around(human, x - far, y - far, 2 * far + 1, {drawn})")
        elif self.scattered:
            lines.append(f"    place_around(human, x, y, far, {drawn})")
            first.append("far")
        return lines, first

    @property
    def _begin_life(self) -> str:
        """How rules let somebody begin life."""
        lines = self._beginning()
        if self._is_one_call(lines):
            return lines[0]
        return f"come_into_being({parameters(lines, 'human')})"

    @staticmethod
    def _is_one_call(lines: list[str]) -> bool:
        return len(lines) == 1 and re.fullmatch(r"\w+\(human\b[^()]*\)", lines[0]) is not None

    @property
    def joined(self) -> list[str]:
        return [name for name, group in self.people.groups.items() if group.auto_join]

    def _beginning(self) -> list[str]:
        """Return the lines of what agents are like at birth, beyond what all have."""
        per_scheme: dict[str, list[str]] = {}
        for scheme in self.people.schemes:
            own = [
                f"human.{self.sheet.attribute_fields[name]} = {_float(start)}"
                for name, start in self.people.starts[scheme.name].items()
            ]
            for name in self.people.initial(scheme):
                cogniton = self.people.cognitons[name]
                if not at_birth(self.sheet, name) and not cogniton.triggers:
                    own += _activating(name)
            for group in scheme.groups:
                if group.auto_join:
                    now = self.people.names[scheme.name]["group", group.name]
                    own.append(f"{self._joining(now)}(human, model)")
            own += [one.call for one in self.births[scheme.name]]
            own += self._noticing(scheme)
            per_scheme[scheme.name] = own
        lines = self._by_scheme(per_scheme)
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

    def _by_scheme(self, lines: dict[str, list[str]]) -> list[str]:
        """Return lines that are for the agents of one scheme each."""
        if not self.people.several or len({tuple(one) for one in lines.values()}) == 1:
            return next(iter(lines.values()), [])
        found = []
        for scheme in self.people.schemes:
            own = lines[scheme.name]
            if own:
                word = "elif" if found else "if"
                found.append(f"{word} {_is_of(self.people.of_scheme(scheme))}:")
                found += [f"    {one}" for one in own]
        return found

    def _come_into_being(self) -> str:
        lines = self._beginning()
        doc = "Begin life: what one has and does at birth."
        if not lines or self._is_one_call(lines):
            return ""
        return _function("come_into_being", doc, lines, "human")

    def _joining(self, group: str) -> str:
        return f"join_{identifier(group)}"

    def _join(self, name: str) -> str:
        group = self.people.groups[name]
        field = self.sheet.group_fields[name]
        text, role = as_text(name), as_text(group.auto_join or "")
        several = len(self.people.civilisations) > 1
        number = ""
        lines = []
        if several:
            lines.append("people = 0")
            for place, one in enumerate(self.people.civilisations[1:], 1):
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
        return f"def {self._joining(name)}(human, model):\n{sentence(doc)}\n{_block(lines)}"

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
        return f'def give_birth(human, model, rng):\n    """{doc}"""\n{_block(lines)}'

    # A tick -----------------------------------------------------------------------------------

    def _tick(self) -> list[str]:
        parts = [_rule_line("A tick"), self._live()]
        if "deaths" in self.sheet.needs:
            parts.append(self._pass_away())
        if self.grows:
            parts.append(self._renew())
        grouped = [one for one in self.sheet.used_facilities if one.grouped]
        if grouped:
            parts.append(self._clear(grouped))
        return parts

    def _live(self) -> str:
        sheet = self.sheet
        lines = []
        if "deaths" in sheet.needs:
            lines += ["if human.dying:", f"    pass_away(human{', model' if self._owned else ''})",
                      "    return"]  # fmt: skip
        noticing = {one.name: self._noticing(one) for one in self.people.schemes}
        lines += self._by_scheme(
            {
                name: [*(one.call for one in rules), *noticing[name]]
                for name, rules in self.every_tick.items()
            }
        )
        trees = bool(self.plans.trees)
        if self.model.parameters.decision_maker == "MaxWeightOx2" and trees:
            lines.append("human.reconsider_plan(2.0)")
        elif trees:
            lines += ["if human.plan_ended:", "    human.plan = human.mind.choose_next_plan()"]
        else:
            lines.append("human.plan = human.mind.choose_next_plan()")
        lines.append("human.run_plan(model, rng)")
        lines += self._by_scheme(noticing)
        for name in sorted(one for one in sheet.needs if one.startswith("lent ")):
            cogniton = name.removeprefix("lent ")
            field = f"passing_{identifier(cogniton)}"
            lines += [
                f"human.mind.add_to_cogniton_value({as_text(cogniton)}, -human.{field})",
                f"human.{field} = 0",
            ]
        doc = "Do what is done in every tick, then go on with the plan or choose another."
        if not any(self.every_tick.values()):
            doc = "Go on with the plan, or choose another."
        return f'def live(human, model, rng):\n    """{doc}"""\n{_block(lines)}'

    # Triggers that are no conditions -------------------------------------------------------------

    def _noticed(self, scheme: Scheme) -> list[Cogniton]:
        """Return the cognitons of a scheme that come and go by crossings, not by a condition."""
        names = self.people.names[scheme.name]
        own = [self.people.cognitons[names["cogniton", one.name]] for one in scheme.cognitons]
        return [one for one in own if one.triggers and not is_condition(self.sheet, one)]

    def _noticing(self, scheme: Scheme) -> list[str]:
        """Return the lines that let agents of a scheme notice such crossings."""
        lines = []
        for cogniton in self._noticed(scheme):
            for trigger in cogniton.triggers:
                lines.append(f"{self._crossing(cogniton, trigger).call}")
        return lines

    def _crossing(self, cogniton: Cogniton, trigger: Trigger) -> Rule:
        """Return the rule that brings and takes a cogniton when an attribute crosses a threshold."""
        test = compared(self.sheet, trigger, "human.", "model.")
        key = f"crossing {cogniton.name} {test}"
        if key not in self.crossings:
            _, bound = test.rsplit(" ", 1)
            short = COMPARISONS[trigger.comparison][0]
            state = f"{self.sheet.attribute(trigger.attribute)}_{short}_{in_name(bound)}"
            if self.sheet.fields.get(f"had_{state}") is not None:
                state = f"{state}_for_{identifier(cogniton.name)}"
            field = self.sheet.field(f"had_{state}", "bool = False  # when it was last noticed")
            self.sheet.help("come_to", GAIN)
            name = self.sheet.function_named(f"notice_{state}")
            body = [
                f"now = {test}",
                f"if now and not human.{field}:",
                f"    come_to(human, {as_text(cogniton.name)})",
                f"if human.{field} and not now:",
                f"    human.mind.deactivate_cogniton({as_text(cogniton.name)})",
                f"human.{field} = now",
            ]
            doc = f"Let {cogniton.name} come or go when {trigger.attribute} crosses its threshold."
            self.crossings[key] = Rule(name, "act", doc, body)
        return self.crossings[key]

    @property
    def _owned(self) -> list[Built]:
        return [one for one in self.sheet.used_facilities if one.private]

    def _pass_away(self) -> str:
        lines = []
        for built in self._owned:
            lines += [
                f"if human.{built.name} >= 0:",
                f"    model.{built.population}[human.{built.name}].die()",
            ]
        lines.append("human.die()")
        doc = "Leave the world" + (", with one's own facilities." if self._owned else ".")
        return (
            f"def pass_away(human{', model' if self._owned else ''}):\n"
            f'    """{doc}"""\n{_block(lines)}'
        )

    @property
    def _growing(self) -> list[str]:
        """The pheromones that grow on some terrain of the map."""
        found = []
        for name in self.sheet.smelt:
            values = self._of_terrains(_deposit(name, "growth"))
            if any(values[one] for one in self.used_indices):
                found.append(name)
        return found

    @property
    def grows(self) -> bool:
        return bool(self._growing) or "roads" in self.sheet.needs

    def _renew(self) -> str:
        lines = ["if (model.tick + 1) % PERIOD == 0:"]
        if self._growing:
            lines.append("    for patch in model.world.patches:")
        for name in self._growing:
            field = self.sheet.pheromone_fields[name]
            table = "[patch.terrain]" if self._varies(f"{name} growth") else ""
            lines.append(f"        patch.{field} += {field.upper()}_GROWTH{table}")
        if "roads" in self.sheet.needs:
            lines.append("    wear_off(model, model.road_evaporation)")
        what = [self.sheet.pheromone_fields[one] for one in self._growing]
        doc = f"Let {_listed(what)} grow" if what else "Let roads wear off"
        if what and "roads" in self.sheet.needs:
            doc += " and roads wear off"
        return f"def renew(model):\n{sentence(f'{doc}, every {PERIOD} ticks.')}\n{_block(lines)}"

    def _clear(self, grouped: list[Built]) -> str:
        lines = [
            f"clear_deserted(model.{built.population}, model.humans, {as_text(group)})"
            for built in grouped
            for group in built.grouped
        ]
        doc = "Let the facilities of groups go that have no members any more."
        return f'def clear(model):\n    """{doc}"""\n{_block(lines)}'

    # Rules and plans ----------------------------------------------------------------------------

    def _rules(self) -> list[str]:
        rules = list(self.plans.rules.values())
        every = dict.fromkeys(
            one
            for rules_at_once in (*self.every_tick.values(), *self.births.values())
            for one in rules_at_once
        )
        parts = []
        acts = [one for one in rules if one.kind == "act" and one not in every]
        asks = [one for one in rules if one.kind == "ask"]
        if every:
            born = any(self.births.values())
            parts.append(_rule_line("Every tick, and at birth" if born else "Every tick"))
            parts += [one.text() for one in every]
        if self.crossings:
            parts += [_rule_line("Triggers"), *(one.text() for one in self.crossings.values())]
        if acts:
            parts += [_rule_line("What is done"), *(one.text() for one in acts)]
        if asks:
            parts += [_rule_line("What is asked"), *(one.text() for one in asks)]
        helpers = [one for name, one in self.sheet.helpers.items() if one]
        if "any facility here" in self.sheet.needs:
            helpers.append(self._any_facility())
        if helpers:
            parts += [_rule_line("What rules have in common"), *helpers]
        if self.plans.trees:
            parts += [_rule_line("Plans"),
                      "\n".join("\n".join(one) for one in self.plans.trees.values())]  # fmt: skip
        return parts

    def _any_facility(self) -> str:
        tests = [f"len(model.{one.population}.on(place)) > 0" for one in self.sheet.used_facilities]
        test = " or ".join(tests)
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
        lines = [f"class {sheet.title}(Model):", f'    """{_plain(self.model.name)}, as in MetaCiv."""',
                 "", "    ticks = 1_000", ""]  # fmt: skip
        for one in self.people.civilisations:
            lines += _parameter(sheet.counts[one.name], "int", str(one.agents), "agents",
                                f"founders of {one.name} at each of its places")  # fmt: skip
        for name, constant in self.people.constants.items():
            if name in sheet.used_constants:
                whole = name in sheet.whole
                value = written(int(constant.value)) if whole else _float(constant.value)
                lines += _parameter(sheet.parameters[name], "int" if whole else "float", value,
                                    "", f"MetaCiv's constant {name}", low=None)  # fmt: skip
        parameters = self.model.parameters
        if "ways" in sheet.needs or "free ground" in sheet.needs:
            lines += _parameter("vision_radius", "int", str(max(parameters.vision_radius, 0)),
                                "patches", "how far agents know the ground; 0 for all")  # fmt: skip
        if "roads" in sheet.needs:
            lines += _parameter("road_creation", "int", str(parameters.road_creation), "steps",
                                "after more than these a patch is a road")  # fmt: skip
            lines += _parameter("road_evaporation", "int", str(max(parameters.road_evaporation, 0)),
                                "steps", f"lost by each patch every {PERIOD} ticks")  # fmt: skip
        for name in self.joined:
            count = len(self.people.civilisations)
            declared = (
                f"{sheet.group_fields[name]}: int = -1"
                if count == 1
                else f"{sheet.group_fields[name]}: list[int] = [-1] * {count}"
            )
            whose = "of each civilisation" if count > 1 else "that all join"
            lines += ["", f"    {declared}  # the {name} {whose}: an identity"]
        maps = ', maps={"terrain": "terrain.csv"}' if self.mapped else ""
        lines += ["", *_laid_out(
            "    world = Grid(", [str(environment.width), str(environment.height), "patch=Land",
                                  "low=(0, 0)", *([maps[2:]] if maps else [])], ")")]  # fmt: skip
        lines += self._population()
        for built in sheet.used_facilities:
            lines.append(f"    {built.population} = Population({built.title}, 0)")
        if "messages" in sheet.needs:
            lines.append("    messages = Messages(Request, to=humans)")
        lines.append("")
        if "def lay_ground" in self._lay_ground():
            lines.append("    setup = (once(lay_ground),)")
        phases = ["once(begin)", "each(humans, live)"]
        if self.grows:
            phases.append("once(renew)")
        if any(one.grouped for one in sheet.used_facilities):
            phases.append("once(clear)")
        lines += _laid_out("    schedule = (", phases, ")")
        lines += ["", *self._series()]
        return "\n".join(lines)

    def _population(self) -> list[str]:
        plans = [f"{as_text(name)}: {what}" for name, what in self.plans.carried_out.items()]
        lines = ["    humans = Population(", "        Human,"]
        peoples = [self._civilisation(one) for one in self.people.civilisations]
        lines += _laid_out("        civilisations=(", peoples, "),")
        lines.append(f'        mind="{SCHEME_FILE}",')
        lines += _laid_out("        plans={", plans, "},")
        return [*lines, "    )"]

    def _civilisation(self, one: Civilisation) -> str:
        height = self.model.environment.height
        first = next(s for s in self.people.settlements if s.civilisation == one.name)
        place = f"({first.u}, {(height - first.v) % height})"
        red, green, blue = colorsys.hsv_to_rgb(*one.colour)
        colour = "#" + "".join(f"{round(255 * part):02x}" for part in (red, green, blue))
        return f'Civilisation({as_text(one.name)}, 0, place={place}, colour="{colour}")'

    def _series(self) -> list[str]:
        sheet = self.sheet
        rows = ['"humans": len(humans),']
        if len(self.people.civilisations) > 1:
            rows += [
                f'"{identifier(one.name)}": sum(1 for one in humans if one.civilisation == '
                f"{as_text(one.name)}),"
                for one in self.people.civilisations
            ]
        rows += [
            f'"{sheet.object_fields[name]}": int(humans.{sheet.object_fields[name]}.sum()),'
            for name in sheet.object_fields
            if name in sheet.carried
        ]
        rows += [
            f'"{one}": float(humans.{one}.mean()) if len(humans) else 0.0,'
            for one in sheet.attribute_fields.values()
        ]
        rows += [f'"{one.population}": len(self.{one.population}),' for one in sheet.used_facilities]
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


def _is_of(civilisations: list[Civilisation]) -> str:
    return " or ".join(f"human.civilisation == {as_text(one.name)}" for one in civilisations)


def _deposit(name: str, column: str) -> object:
    """Return what says how much of a pheromone a terrain has, or gets."""

    def found(terrain: Terrain) -> float:
        return next((getattr(one, column) for one in terrain.deposits if one.pheromone == name), 0.0)

    return found


def _import(module: str, names: set[str]) -> str:
    ordered = sorted(names, key=lambda one: (not one.isupper(), not one[:1].isupper(), one))
    flat = f"from {module} import {', '.join(ordered)}"
    if len(flat) <= WIDTH:
        return flat
    return "\n".join([f"from {module} import (", *(f"    {one}," for one in ordered), ")"])


def _laid_out(before: str, parts: list[str], after: str) -> list[str]:
    """Return parts between brackets, on one line if they fit."""
    single = "," if len(parts) == 1 and after[0] == ")" and before.endswith("=(") else ""
    single = "," if len(parts) == 1 and before.endswith("= (") else single
    flat = f"{before}{', '.join(parts)}{single}{after}"
    if len(flat) <= WIDTH:
        return [flat]
    indent = re.match(" *", before).group()  # type: ignore[union-attr]
    return [before, *(f"{indent}    {one}," for one in parts), f"{indent}{after}"]


def _table(name: str, values: list[str]) -> list[str]:
    return _laid_out(f"{name} = (", values, ")")


def _parameter(
    name: str, kind: str, value: str, unit: str, doc: str, low: int | None = 0
) -> list[str]:
    parts = [value]
    if unit:
        parts.append(f'unit="{unit}"')
    if low is not None:
        parts.append(f"low={low}")
    parts.append(f"doc={as_text(doc)}")
    flat = f"    {name}: {kind} = parameter({', '.join(parts)})"
    if len(flat) <= WIDTH:
        return [flat]
    return [f"    {name}: {kind} = parameter(", f"        {', '.join(parts)}", "    )"]


def _rule_line(title: str) -> str:
    return f"# {title} ".ljust(WIDTH - 1, "-")


def parameters(lines: list[str], *first: str) -> str:
    """Return what a function takes: what always, and what its lines use of the rest."""
    text = "\n".join(lines)
    more = [one for one in ("model", "rng") if re.search(rf"\b{one}\b", text)]
    return ", ".join([*first, *more])


def _function(name: str, doc: str, lines: list[str], *first: str) -> str:
    return f"def {name}({parameters(lines, *first)}):\n{sentence(doc)}\n{_block(lines)}"


def _block(lines: list[str]) -> str:
    return "\n".join(f"    {one}" for one in lines)


def _float(value: float) -> str:
    text = written(value)
    return text if "." in text or "e" in text else f"{text}.0"


def _plain(text: str) -> str:
    return text.replace("\\", "/").replace('"""', "'''").strip('"') or "Unnamed"


def _listed(names: list[str]) -> str:
    if len(names) <= 1:
        return "".join(names)
    return f"{', '.join(names[:-1])} and {names[-1]}"
