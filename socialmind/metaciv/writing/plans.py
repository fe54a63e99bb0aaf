"""Plans as trees of rules, and as lines of a rule where all happens at once."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field

from socialmind.metaciv.description import Action, Plan
from socialmind.metaciv.writing.acts.facilities import efficient_here
from socialmind.metaciv.writing.acts.form import Act, Ask
from socialmind.metaciv.writing.acts.kinds import WRITERS, written
from socialmind.metaciv.writing.acts.minds import do_nothing
from socialmind.metaciv.writing.acts.trading import made_bargain, met_nobody
from socialmind.metaciv.writing.layout import WIDTH, sentence
from socialmind.metaciv.writing.names import identifier
from socialmind.metaciv.writing.sheet import Sheet

LONGEST_NAME = 36
"""Of a rule that is named after several."""


@dataclass
class Call:
    """A node of a tree as text: what is called, with what."""

    name: str
    arguments: list[Call | str] = field(default_factory=list)

    def lines(self, before: str = "", after: str = "") -> list[str]:
        """Return the call, on one line if it fits."""
        flat = f"{before}{self}{after}"
        if len(flat) <= WIDTH:
            return [flat]
        indent = re.match(" *", before).group()  # type: ignore[union-attr]
        found = [f"{before}{self.name}("]
        for one in self.arguments:
            if isinstance(one, Call):
                word, _, rest = one.name.rpartition("=")
                named = Call(rest, one.arguments)
                lead = f"{indent}    {word}=" if word else f"{indent}    "
                found += named.lines(lead, ",")
            else:
                found.append(f"{indent}    {one},")
        return [*found, f"{indent}){after}"]

    def __str__(self) -> str:
        return f"{self.name}({', '.join(map(str, self.arguments))})"


@dataclass(eq=False)
class Rule:
    """A rule of the model file.

    Attributes:
        name: its name.
        kind: "act" or "ask".
        doc: what it does, or asks.
        body: its lines.
    """

    name: str
    kind: str
    doc: str
    body: list[str]

    @property
    def parameters(self) -> str:
        """What it is called with."""
        text = "\n".join(self.body)
        more = [one for one in ("model", "rng") if re.search(rf"\b{one}\b", text)]
        return ", ".join(["human", *more])

    @property
    def call(self) -> str:
        """How another rule calls it."""
        return f"{self.name}({self.parameters})"

    def text(self) -> str:
        """Return it as the file has it."""
        body = "\n    ".join(self.body)
        doc = sentence(self.doc)
        if self.body == ["pass"]:
            return f"def {self.name}({self.parameters}):\n{doc}\n"
        return f"def {self.name}({self.parameters}):\n{doc}\n    {body}\n"


class Plans:
    """The plans of a model, written.

    Args:
        sheet: the model file.
        before: the same, written before: it says which rules are called several times.

    Attributes:
        rules: the rules that trees and other rules call, in the order of their first use.
        trees: constants of the file that are trees, with their text.
        carried_out: what carries out each plan: a rule or a tree.
    """

    def __init__(self, sheet: Sheet, before: Plans | None = None) -> None:
        self.sheet = sheet
        self.rules: dict[str, Rule] = {}
        self.trees: dict[str, list[str]] = {}
        self.carried_out: dict[str, str] = {}
        self.uses: Counter[str] = Counter()
        self.wanted: dict[str, tuple[str, ...]] = {}
        self._uses_before = before.uses if before else Counter()
        claims = Counter(names[0] for names in (before.wanted if before else {}).values())
        self._claimed = {name for name, count in claims.items() if count > 1}
        self._counters = 0
        self._staying: set[str] = set()

    # Trees ------------------------------------------------------------------------------------

    def add(self, plan: Plan) -> None:
        """Write a plan that agents choose."""
        name = identifier(plan.name)
        if not plan.actions:
            self.carried_out[plan.name] = self._rule(do_nothing(self.sheet)).name
            return
        if len(plan.actions) == 1:
            (action,) = plan.actions
            if action.name in WRITERS and not action.children:
                made = WRITERS[action.name](self.sheet, action)
                if isinstance(made, Act) and not made.stays and self._uses_before[_key(made)] < 2:
                    made.names = (name, *made.names)
                    made.doc = f"{plan.name}: {made.doc[:1].lower()}{made.doc[1:]}"
                    self.carried_out[plan.name] = self._rule(made, made.names).name
                    return
            if action.name == "L_Instant":
                rule = self._at_once(action, (name,), f"{plan.name}, all of it at once.")
                self.carried_out[plan.name] = rule.name
                return
        parts = [part for one in plan.actions for part in self._parts(one, plan)]
        (first, *more) = parts
        if isinstance(first, str) and not more and first not in self._staying:
            self.carried_out[plan.name] = first
            return
        constant = self.sheet.function_named(name.upper(), f"{name.upper()}_PLAN")
        tree = first if isinstance(first, Call) and not more else Call("sequence", parts)
        self.trees[constant] = tree.lines(f"{constant} = ")
        self.carried_out[plan.name] = constant
        for word in re.findall(r"\b(sequence|repeat|when)\(", str(tree)):
            self.sheet.use("socialmind", word)

    def _parts(self, action: Action, plan: Plan) -> list[Call | str]:
        """Return an action as parts of a sequence."""
        if action.name == "L_MultipleActions":
            return [part for one in action.children[:2] for part in self._parts(one, plan)] or [
                self._idle()
            ]
        if action.name == "L_Repeat":
            times = int(float(action.argument("Integer").value))
            inner = [part for one in action.children for part in self._parts(one, plan)]
            if not inner or times < 1:
                return [self._idle()]
            return inner if times == 1 else [Call("repeat", [str(times), *inner])]
        if action.name == "L_Instant":
            return [self._instant(action, plan).name]
        if action.name == "L_EveryXTick":
            asked = self._ask(self._every(action, plan))
            return [self._when(asked, action.children[:1], plan)]
        made = written(self.sheet, action)
        if isinstance(made, Act):
            done = self._rule(made).name
            if action.name in ("A_Trade", "A_TravelTrade") and action.children:
                return [done, *self._after_trade(action, plan)]
            return [done]
        asked = self._ask(made)
        choice = self._when(asked, action.children[:2], plan)
        if action.name == "L_IsCounterAtZero":
            there = self._ask(efficient_here(self.sheet, action))
            return [Call("when", [there, choice, f"otherwise={self._idle()}"])]
        return [choice]

    def _when(self, asked: str, children: tuple[Action, ...], plan: Plan) -> Call:
        """Return a condition with its branches; one that is missing takes a tick."""
        branches: list[Call | str] = []
        for number in range(2):
            parts = self._parts(children[number], plan) if number < len(children) else []
            if len(parts) > 1:
                branches.append(Call("sequence", parts))
            else:
                branches.append(parts[0] if parts else self._idle())
        then, otherwise = branches
        if isinstance(otherwise, Call):
            return Call(
                "when", [asked, then, Call(f"otherwise={otherwise.name}", otherwise.arguments)]
            )
        return Call("when", [asked, then, f"otherwise={otherwise}"])

    def _after_trade(self, action: Action, plan: Plan) -> list[Call | str]:
        """Return what follows a trade: the first child, the second if nobody came, or neither."""
        parts: list[Call | str] = []
        for asking, child in zip((made_bargain, met_nobody), action.children[:2], strict=False):
            asked = self._ask(asking(self.sheet, action))
            inner = self._parts(child, plan)
            parts.append(
                Call("when", [asked, Call("sequence", inner) if len(inner) > 1 else inner[0]])
            )
        return parts

    def _idle(self) -> str:
        return self._rule(do_nothing(self.sheet)).name

    def _every(self, action: Action, plan: Plan) -> Ask:
        """Return the question whether it is time again, of a counter of its own."""
        ticks = int(float(action.argument("Integer").value))
        self._counters += 1
        name = identifier(plan.name)
        field_name = f"visits_in_{name}"
        if field_name in self.sheet.fields:
            field_name = f"{field_name}_{self._counters}"
        self.sheet.field(field_name, f"int = 0  # to what {plan.name} does now and then")
        before = (
            f"human.{field_name} += 1",
            f"if human.{field_name} <= {ticks}:",
            "    return False",
            f"human.{field_name} = 0",
        )
        doc = f"whether it is time: once in {ticks + 1} times that it is asked"
        return Ask((f"is_time_in_{name}",), doc, "True", before)

    def _instant(self, action: Action, plan: Plan) -> Rule:
        """Return what does several things at once, named after them or after its plan."""
        done = [one for one in action.children if one.name != "A_DoNothing"]
        if not done:
            return self._rule(do_nothing(self.sheet))
        acts = []
        for one in done:
            if one.name in WRITERS and not one.children:
                made = WRITERS[one.name](self.sheet, one)
                if isinstance(made, Act):
                    acts.append(made)
        if len(acts) == len(done) == 1 and not acts[0].stays:
            return self._rule(acts[0])
        named = [self._name_of(one) for one in acts]
        names = [f"{identifier(plan.name)}_at_once"]
        joined = "_and_".join(named)
        if len(named) == len(done) <= 2 and len(joined) <= LONGEST_NAME:
            names.insert(0, joined)
        elif named:
            names.append(f"{names[0]}_with_{named[0]}")
        return self._at_once(action, tuple(names), f"Do several things of {plan.name} at once.")

    def _name_of(self, made: Act) -> str:
        return made.names[-1] if made.names[0] in self._claimed else made.names[0]

    def _at_once(self, action: Action, names: tuple[str, ...], doc: str) -> Rule:
        return self._rule(Act(names, doc, self.lines(action.children)))

    # Rules ------------------------------------------------------------------------------------

    def _rule(self, made: Act | Ask, names: tuple[str, ...] = ()) -> Rule:
        """Return the rule of what was made: the same for the same lines."""
        key = _key(made)
        self.uses[key] += 1
        self.wanted[key] = made.names
        if key not in self.rules:
            wanted = names or made.names
            if not names and wanted[0] in self._claimed and len(wanted) > 1:
                wanted = wanted[1:]
            name = self.sheet.function_named(*wanted)
            if isinstance(made, Act):
                self.rules[key] = Rule(name, "act", made.doc, made.body)
                if made.stays:
                    self._staying.add(name)
            else:
                body = [*made.before, *_returned(made.test)]
                self.rules[key] = Rule(name, "ask", f"Return {made.doc}.", body)
        return self.rules[key]

    def _ask(self, made: Ask | Act) -> str:
        return self._rule(made).name

    # Lines ------------------------------------------------------------------------------------

    def lines(self, actions: tuple[Action, ...], plan: Plan | None = None) -> list[str]:
        """Return the lines of actions that all happen at once."""
        return [line for one in actions for line in self._statement(one, plan)] or ["pass"]

    def _statement(self, action: Action, plan: Plan | None) -> list[str]:
        if action.name == "L_Instant":
            return self.lines(action.children, plan) if action.children else []
        if action.name == "L_MultipleActions":
            return self.lines(action.children[:2], plan) if action.children else []
        if action.name == "L_Repeat":
            times = int(float(action.argument("Integer").value))
            inner = self.lines(action.children, plan)
            if times <= 1:
                return inner if times == 1 and action.children else []
            return [f"for _ in range({times}):", *_indented(inner)]
        if action.name == "L_EveryXTick":
            rule = self._rule(self._every(action, plan or _NAMELESS))
            return self._branches(rule.call, action.children[:1], plan)
        if action.name == "A_DoNothing":
            return []
        made = written(self.sheet, action)
        if isinstance(made, Act):
            if len(made.body) == 1 and not made.stays:
                self.uses[_key(made)] += 0
                return list(made.body)
            done = [self._rule(made).call]
            if action.name in ("A_Trade", "A_TravelTrade"):
                for asking, child in zip(
                    (made_bargain, met_nobody), action.children[:2], strict=False
                ):
                    test = asking(self.sheet, action).test
                    done += [f"if {test}:", *_indented(self.lines((child,), plan))]
            return done
        test = self._rule(made).call if made.before else made.test
        lines = self._branches(test, action.children[:2], plan)
        if action.name == "L_IsCounterAtZero":
            there = efficient_here(self.sheet, action).test
            return [f"if {there}:", *_indented(lines)] if lines else []
        return lines

    def _branches(self, test: str, children: tuple[Action, ...], plan: Plan | None) -> list[str]:
        then = [line for one in children[:1] for line in self._statement(one, plan)]
        otherwise = [line for one in children[1:] for line in self._statement(one, plan)]
        if not then and not otherwise:
            return []
        if not then:
            return [f"if not ({test}):", *_indented(otherwise)]
        nested = then[0].removeprefix("if ").removesuffix(":") if then[0].startswith("if ") else ""
        whole = all(line.startswith("    ") for line in then[1:])
        if nested and whole and not otherwise and " or " not in f"{test} {nested}":
            both = f"if {test} and {nested}:"
            if len(both) + 4 <= WIDTH and " if " not in both[3:]:
                return [both, *then[1:]]
        found = [f"if {test}:", *_indented(then)]
        return [*found, "else:", *_indented(otherwise)] if otherwise else found


_NAMELESS = Plan("tick", "self", (), None)  # type: ignore[arg-type]


def _indented(lines: list[str]) -> list[str]:
    return [f"    {line}" for line in lines]


def _key(made: Act | Ask) -> str:
    return "\n".join(made.body if isinstance(made, Act) else [*made.before, f"? {made.test}"])


def _returned(test: str) -> list[str]:
    """Return the line that returns what a test says, laid out where it is long."""
    if len(test) + 11 <= WIDTH:
        return [f"return {test}"]
    if len(test) + 8 <= WIDTH:
        return ["return (", f"    {test}", ")"]
    first, *more = re.split(r" (?=and |is not |>|<|==)", test)
    return ["return (", f"    {first}", *(f"    {one}" for one in more), ")"]
