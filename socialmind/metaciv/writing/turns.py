"""An agent's turn in a model's file: what is done in every tick, the plan, triggers, the end."""

from __future__ import annotations

from socialmind.metaciv.description import Civilisation, Cogniton, Scheme, Trigger
from socialmind.metaciv.writing.acts.form import COMPARISONS, as_text, in_name
from socialmind.metaciv.writing.acts.minds import GAIN
from socialmind.metaciv.writing.layout import block, function
from socialmind.metaciv.writing.names import identifier
from socialmind.metaciv.writing.plans import Plans, Rule
from socialmind.metaciv.writing.scheme_file import chosen_plans, compared, is_condition
from socialmind.metaciv.writing.sheet import Built, Sheet


class Turns:
    """What agents do in a turn.

    Args:
        sheet: the model file.
        before: the same, written before.

    Attributes:
        plans: the plans that agents choose, and all rules that plans call.
        every_tick, births: of each scheme the rules of the plans of every tick, and of birth.
        crossings: the rules by which agents notice that an attribute crosses a threshold.
    """

    def __init__(self, sheet: Sheet, before: Turns | None = None) -> None:
        self.sheet, self.people, self.model = sheet, sheet.people, sheet.model
        self.plans: Plans = Plans(sheet, before.plans if before else None)
        self.every_tick: dict[str, list[Rule]] = {}
        self.births: dict[str, list[Rule]] = {}
        self.crossings: dict[str, Rule] = {}
        for name in chosen_plans(sheet):
            self.plans.add(self.people.plans[name])
        for scheme in self.people.schemes:
            self.every_tick[scheme.name] = self._at_once("self", scheme)
            self.births[scheme.name] = self._at_once("birth", scheme)
            self.noticing(scheme)

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

    def by_scheme(self, lines: dict[str, list[str]]) -> list[str]:
        """Return lines that are for the agents of one scheme each."""
        if not self.people.several or len({tuple(one) for one in lines.values()}) == 1:
            return next(iter(lines.values()), [])
        found: list[str] = []
        for scheme in self.people.schemes:
            own = lines[scheme.name]
            if own:
                word = "elif" if found else "if"
                found.append(f"{word} {_is_of(self.people.of_scheme(scheme))}:")
                found += [f"    {one}" for one in own]
        return found

    def live(self) -> str:
        """Return the rule of a turn."""
        sheet = self.sheet
        lines = []
        if "deaths" in sheet.needs:
            lines += ["if human.dying:", f"    pass_away(human{', model' if self._owned else ''})",
                      "    return"]  # fmt: skip
        noticing = {one.name: self.noticing(one) for one in self.people.schemes}
        lines += self.by_scheme(
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
        elif self.plans.carried_out:
            lines.append("human.plan = human.mind.choose_next_plan()")
        if self.plans.carried_out:
            lines.append("human.run_plan(model, rng)")
        lines += self.by_scheme(noticing)
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
        if not self.plans.carried_out:
            doc = "Do what is done in every tick: there are no plans to choose."
        return function("live", doc, lines, "human").removesuffix("\n")

    # Triggers that are no conditions -------------------------------------------------------------

    def _noticed(self, scheme: Scheme) -> list[Cogniton]:
        """Return the cognitons of a scheme that come and go by crossings, not by a condition."""
        names = self.people.names[scheme.name]
        own = [self.people.cognitons[names["cogniton", one.name]] for one in scheme.cognitons]
        return [one for one in own if one.triggers and not is_condition(self.sheet, one)]

    def noticing(self, scheme: Scheme) -> list[str]:
        """Return the lines that let agents of a scheme notice such crossings."""
        return [
            self._crossing(cogniton, trigger).call
            for cogniton in self._noticed(scheme)
            for trigger in cogniton.triggers
        ]

    def _crossing(self, cogniton: Cogniton, trigger: Trigger) -> Rule:
        """Return the rule that brings or takes a cogniton when an attribute crosses a threshold."""
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

    def pass_away(self) -> str:
        """Return the rule by which somebody leaves the world."""
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
            f'    """{doc}"""\n{block(lines)}'
        )

    def clear(self, grouped: list[Built]) -> str:
        """Return the rule by which facilities of deserted groups go."""
        lines = [
            f"clear_deserted(model.{built.population}, model.humans, {as_text(group)})"
            for built in grouped
            for group in built.grouped
        ]
        doc = "Let the facilities of groups go that have no members any more."
        return f'def clear(model):\n    """{doc}"""\n{block(lines)}'


def _is_of(civilisations: list[Civilisation]) -> str:
    return " or ".join(f"human.civilisation == {as_text(one.name)}" for one in civilisations)
