"""Cognitive schemes: what the minds of a breed have in common, as immutable descriptions.

A scheme names cognitons, groups with their roles and culturons, and a decision maker. Plans have no
description of their own: they are the names that links lead to (thesis, section 3.2).

- influence link: value × weight is added to the plan's weight;
- conditional link: an active cogniton, or a culturon of one's role, makes the plan available;
- reinforcement link: feed-back from the plan changes the value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from coglogo_py.border.errors import SchemeError
from coglogo_py.border.html_table import as_html
from coglogo_py.decision import DecisionMaker, MaximumWeight
from coglogo_py.files import checks
from coglogo_py.files.reading import text_in
from coglogo_py.parts import (
    Cogniton,
    Culturon,
    Group,
    check_nesting,
    described_once,
    links_of,
    plain_fields,
    settle,
)

if TYPE_CHECKING:
    from coglogo_py.lint import Finding


@dataclass(frozen=True, eq=False)
class CognitiveScheme:
    """What the minds of one or more breeds have in common.

    Two schemes are equal if their descriptions are and their plans come in the same order, since
    the order decides between plans of equal weight.

    Args:
        name: of the scheme; CogLogo knows it by the breed's name.
        cognitons: each named once.
        groups: each named once.
        decision_maker: how a mind picks a plan.
        breeds: the further breeds linked with the scheme, as the modeller spells them.
        plan_positions: plan → x and y in the drawing of the scheme.
        plan_order: the plans in the order that decides between equals; None: the order in which
            they first appear in the links.
        repeated: what the file, which the scheme was read from, wrote more than once and the reader
            put together; reported by `check`, no part of the description.

    Raises:
        SchemeError: a name stands twice, or a field holds something else.

    >>> hunger = Cogniton("Hunger", influence={"eat": 2.0}, conditional=("eat",))
    >>> CognitiveScheme("cows", (hunger,)).plans
    ('eat',)
    """

    name: str
    cognitons: tuple[Cogniton, ...] = ()
    groups: tuple[Group, ...] = ()
    decision_maker: DecisionMaker = field(default_factory=MaximumWeight)
    breeds: tuple[str, ...] = ()
    plan_positions: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    plan_order: tuple[str, ...] | None = None
    repeated: tuple[str, ...] = field(default=(), repr=False)

    def __post_init__(self) -> None:
        checks.checked_name(self.name, "a scheme")
        where = f"scheme {self.name!r}"
        settle(self, "cognitons", described_once(self.cognitons, Cogniton, "cogniton", where))
        settle(self, "groups", described_once(self.groups, Group, "group", where))
        check_nesting({one.name: ([r.name for r in one.roles], one.within) for one in self.groups})
        if not isinstance(self.decision_maker, DecisionMaker):
            raise SchemeError(
                f"decision maker {self.decision_maker!r} of {where}",
                "a decision maker such as MaximumWeight()",
            )
        settle(self, "breeds", checks.checked_names(self.breeds, f"breeds of {where}"))
        settle(self, "repeated", checks.checked_names(self.repeated, f"repeated names of {where}"))
        if not isinstance(self.plan_positions, Mapping):
            raise SchemeError(f"{self.plan_positions!r} as plan positions", "plan → (x, y)")
        positions = {
            checks.checked_name(plan, "a plan"): checks.checked_position(xy, f"plan {plan!r}")
            for plan, xy in self.plan_positions.items()
        }
        settle(self, "plan_positions", MappingProxyType(positions))
        if self.plan_order is not None:
            order = checks.checked_names(self.plan_order, f"plan_order of {where}")
            if len(set(order)) < len(order):
                raise SchemeError(f"plan_order {list(order)} of {where}", "each plan once")
            settle(self, "plan_order", order)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, CognitiveScheme):
            return NotImplemented
        described = (
            "name", "cognitons", "groups", "decision_maker", "breeds", "plan_positions", "plans",
        )  # fmt: skip
        return all(getattr(self, each) == getattr(other, each) for each in described)

    def __hash__(self) -> int:
        return hash((self.name, self.plans))

    def __reduce__(self) -> tuple[type[CognitiveScheme], tuple[object, ...]]:
        return type(self), plain_fields(self)

    @cached_property
    def linked_plans(self) -> tuple[str, ...]:
        """The plans that links lead to, in the order of first appearance.

        Cognitons come first, then culturons group by group and role by role; within each its
        influence, its conditional and its reinforcement links.
        """
        return tuple(dict.fromkeys(plan for holder in self._holders() for plan in links_of(holder)))

    @cached_property
    def plans(self) -> tuple[str, ...]:
        """All plans, in the order that decides between equals.

        That is `plan_order`, then the linked plans it does not name.
        """
        return tuple(dict.fromkeys((*(self.plan_order or ()), *self.linked_plans)))

    @cached_property
    def has_conditions(self) -> bool:
        """Whether some cogniton has conditions."""
        return any(one.conditions for one in self.cognitons)

    @classmethod
    def load(
        cls, path: str | Path, decision_makers: Iterable[type[DecisionMaker]] = ()
    ) -> CognitiveScheme:
        """Read a scheme from a file.

        Args:
            path: a .yaml or .yml file in the form of docs/schemes.md; any other is read as a
                CogLogo file.
            decision_makers: decision makers of the modeller's own that the file may name.

        Raises:
            SchemeError: the file cannot be read as a scheme; says where and why.
        """
        return cls.parsed(text_in(Path(path), latin_1=True), path, decision_makers)

    @classmethod
    def parsed(
        cls, text: str, path: str | Path, decision_makers: Iterable[type[DecisionMaker]] = ()
    ) -> CognitiveScheme:
        """Return the scheme of a text that was read from a file; arguments as of `load`."""
        # Here, since most schemes come from no file: yaml takes its time.
        from coglogo_py.files import cogscheme_file, yaml_file

        reader = yaml_file if Path(path).suffix.lower() in (".yaml", ".yml") else cogscheme_file
        return reader.parse(text, path, cls, decision_makers)

    def save(self, path: str | Path) -> None:
        """Write the scheme to a file, in the form that the suffix names; replaces what was there.

        Args:
            path: ends in .cogscheme, .yaml or .yml.

        Raises:
            SchemeError: another suffix, the form cannot hold the scheme, or the file cannot be
                written.
        """
        from coglogo_py.files import cogscheme_file, yaml_file

        suffix = Path(path).suffix.lower()
        if suffix in (".yaml", ".yml"):
            text = yaml_file.written(self)
        elif suffix == ".cogscheme":
            try:
                text = cogscheme_file.written(self)
            except SchemeError as error:
                raise error.at(path) from None
        else:
            raise SchemeError(
                f"the suffix {suffix!r}", ".cogscheme, .yaml or .yml", "change the name", path
            )
        try:
            Path(path).write_text(text, encoding="utf-8", newline="\n")
        except OSError as error:
            found = f"the file cannot be written ({error.strerror or type(error).__name__})"
            raise SchemeError(found, remedy="check the path", file=path) from None

    def check(
        self, plans: Iterable[str] | None = None, written: Iterable[str] | None = None
    ) -> list[Finding]:
        """Return what the linter finds odd in the scheme; see `coglogo_py.lint`.

        Args:
            plans: the plans that the model carries out; None: those of `plan_order`, if written.
            written: the cognitons that the model's rules set; None: that is not known.

        >>> CognitiveScheme("cows", (Cogniton("Mood"),)).check()[0].kind
        'cogniton without effect'
        """
        from coglogo_py.lint import findings

        return findings(self, plans, written)

    def _repr_html_(self) -> str:
        plans = self.plans
        rows: list[tuple[object, ...]] = [(self.name, "start", *plans)]
        for one in self._holders():
            links = (f"{one.influence[p]:+g}" if p in one.influence else "" for p in plans)
            opens = ("○" if p in one.conditional else "" for p in plans)
            both = (" ".join(filter(None, pair)) for pair in zip(links, opens, strict=True))
            rows.append((one.name, f"{one.start_value:g}", *both))
        return as_html(rows) + "<p>influence; ○ makes the plan available</p>"

    def _holders(self) -> Iterator[Cogniton | Culturon]:
        yield from self.cognitons
        for group in self.groups:
            for role in group.roles:
                yield from role.culturons
