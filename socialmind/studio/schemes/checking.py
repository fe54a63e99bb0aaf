"""What is wrong or odd about a document, each thing at the part where it is to be seen."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from coglogo_py import CognitiveScheme, DecisionMaker, Role
from coglogo_py.decision import BUILT_IN
from coglogo_py.lint import Finding
from socialmind.agents.heeding import check_conditions
from socialmind.errors import ModelError, SocialmindError
from socialmind.model import Model
from socialmind.society.connection import names_of_minds
from socialmind.society.population import Population
from socialmind.studio.schemes.document import WEIGHTS, Document, Wrong, made_of, scheme_of

UNKNOWN_PLAN = "link to unknown plan"


@dataclass(frozen=True)
class Bearers:
    """The population whose agents are to have a scheme.

    Attributes:
        model: the class that declares it.
        name: the population's.
    """

    model: type[Model]
    name: str

    @classmethod
    def of(cls, model: type[Model], name: str) -> Bearers:
        """Return a population, which must have minds.

        Raises:
            SocialmindError: it has none, or there is no such population.
        """
        minded = [each for each, one in model.populations.items() if one.mind is not None]
        if name not in minded:
            known = ", ".join(minded) or "none"
            raise SocialmindError(
                f"population {name!r} of {model.name}; populations with schemes: {known}"
            )
        return cls(model, name)

    @property
    def population(self) -> Population:
        """Its declaration."""
        return self.model.populations[self.name]

    @property
    def plans(self) -> tuple[str, ...] | None:
        """The plans that it has rules for; None where plans are none of the model's business."""
        return tuple(self.population.plans) or None

    @property
    def makers(self) -> tuple[type[DecisionMaker], ...]:
        """Decision makers of the modeller's own."""
        return tuple(self.population.decision_makers)


@dataclass(frozen=True)
class Checked:
    """What came of looking through a document.

    Attributes:
        scheme: that it describes; None where something is wrong.
        wrong: what keeps it from being a scheme.
        odd: what is allowed, and yet hardly meant; or what keeps the model from running it.
        unruled: identities of plans that the model has no rule for.
        makers: the decision makers that may be named.
    """

    scheme: CognitiveScheme | None
    wrong: list[Wrong]
    odd: list[Wrong]
    unruled: list[str]
    makers: list[str]

    def to_json(self) -> dict[str, Any]:
        """Return all but the scheme as data."""
        said = [
            {"at": one.at, "wrong": wrong, "text": one.text}
            for found, wrong in ((self.wrong, True), (self.odd, False))
            for one in found
        ]
        return {"findings": said, "unruled": self.unruled, "makers": self.makers}


def checked(document: Document, bearers: Bearers | None = None) -> Checked:
    """Look through a document.

    Args:
        document: as `socialmind.studio.schemes.document` describes.
        bearers: whose scheme it is to be, if that is known.
    """
    makers = () if bearers is None else bearers.makers
    scheme, wrong = made_of(document, makers)
    known = list(dict.fromkeys(one.name for one in (*BUILT_IN, *makers)))
    if scheme is None:
        return Checked(None, wrong, [], [], known)
    plans = None if bearers is None else bearers.plans
    written = None
    if bearers is not None:
        written = bearers.model.typed(compiled=True).cognitons_set(bearers.name)
    places = _places(document)
    unruled = [one["id"] for one in document["plans"] if plans and one["name"] not in plans]
    odd = [
        Wrong(_place(one, places, document), f"{one.where}: {one.message}")
        for one in scheme.check(plans, written)
        if not (one.kind == UNKNOWN_PLAN and plans)
    ]
    if bearers is not None:
        for one in document["plans"]:
            if one["id"] in unruled:
                said = f"plan {one['name']!r}: {bearers.model.name} has no rule of this name"
                odd.append(Wrong(one["id"], f"{said}, so its agents will not choose it"))
        odd += _of_model(document, scheme, bearers)
    return Checked(scheme, [], odd, unruled, known)


def runnable(scheme: CognitiveScheme, bearers: Bearers) -> CognitiveScheme:
    """Return a scheme without the plans that a model has no rule for: nobody can choose them.

    Where it has a rule for each, that is the scheme itself.
    """
    plans = bearers.plans
    if plans is None or set(scheme.plans) <= set(plans):
        return scheme

    def of(one: Any) -> Any:
        links: dict[str, Any] = {
            field: {plan: w for plan, w in getattr(one, field).items() if plan in plans}
            for field in WEIGHTS
        }
        return replace(one, **links, conditional=tuple(p for p in one.conditional if p in plans))

    order = tuple(plan for plan in scheme.plans if plan in plans)
    return replace(_with_holders(scheme, of), plan_order=order)


def runnable_of(document: Document, bearers: Bearers) -> CognitiveScheme:
    """Return the scheme of a document as a population's agents can have it.

    Raises:
        SchemeError: it is none.
    """
    return runnable(scheme_of(document, bearers.makers), bearers)


def continued(scheme: CognitiveScheme, before: CognitiveScheme) -> CognitiveScheme:
    """Return a scheme that the minds of another can go on with.

    A plan, group or role that it lacks stays, with no link or culturon: so who carries the plan out
    does so until it decides anew, and nobody chooses it again; who is in the group is in one
    without effect; and rules that name them know what they name.

    >>> from coglogo_py import Cogniton
    >>> before = CognitiveScheme("a", (Cogniton("Hunger", conditional=("eat",)),))
    >>> continued(CognitiveScheme("a"), before).plans
    ('eat',)
    """
    groups = {one.name: one for one in scheme.groups}
    for one in before.groups:
        now = groups.get(one.name, replace(one, roles=()))
        known = [role.name for role in now.roles]
        lost = tuple(Role(role.name) for role in one.roles if role.name not in known)
        groups[one.name] = replace(now, roles=(*now.roles, *lost))
    plans = dict.fromkeys((*scheme.plans, *before.plans))
    return replace(scheme, groups=tuple(groups.values()), plan_order=tuple(plans))


def same_minds(one: CognitiveScheme, other: CognitiveScheme) -> bool:
    """Whether two schemes differ in their drawing at most.

    >>> from coglogo_py import Cogniton
    >>> red, grey = Cogniton("Mood", colour=(255, 0, 0)), Cogniton("Mood", position=(1, 2))
    >>> same_minds(CognitiveScheme("a", (red,)), CognitiveScheme("a", (grey,)))
    True
    """
    return _undrawn(one) == _undrawn(other)


def _undrawn(scheme: CognitiveScheme) -> CognitiveScheme:
    def of(one: Any) -> Any:
        return replace(one, colour=(0, 0, 0), position=None)

    bare = _with_holders(scheme, of)
    groups = tuple(one.without_positions() for one in bare.groups)
    return replace(bare, groups=groups, plan_positions={}, plan_order=scheme.plans)


def _with_holders(scheme: CognitiveScheme, of: Callable[[Any], Any]) -> CognitiveScheme:
    """Return a scheme with each cogniton and culturon as a function returns it."""

    def role(one: Role) -> Role:
        return replace(one, culturons=tuple(map(of, one.culturons)))

    groups = tuple(replace(one, roles=tuple(map(role, one.roles))) for one in scheme.groups)
    return replace(scheme, cognitons=tuple(map(of, scheme.cognitons)), groups=groups)


def _of_model(document: Document, scheme: CognitiveScheme, bearers: Bearers) -> list[Wrong]:
    """Return what keeps a model from running a scheme, but for plans without a rule."""
    found = []
    shape, name = bearers.model.shape, bearers.name
    for said, cogniton in zip(document["cognitons"], scheme.cognitons, strict=True):
        alone = CognitiveScheme(scheme.name, (cogniton,))
        try:
            check_conditions(
                alone, name, shape.populations[name].fields, shape.parameters, (None, None)
            )
        except ModelError as error:
            found.append(Wrong(said["id"], str(error)))
    if bearers.population.hierarchy is None and bearers.population.culture is None:
        program = bearers.model.typed(compiled=True)
        try:
            names_of_minds(program, name, runnable(scheme, bearers))
        except ModelError as error:
            found.append(Wrong(None, str(error)))
    return found


def _places(document: Document) -> dict[str, str]:
    """Return the identities of parts by what the linter calls them."""
    found: dict[str, str] = {}
    for one in document["plans"]:
        found[f"plan {one['name']!r}"] = one["id"]
    for group in document["groups"]:
        found[f"group {group['name']!r}"] = group["id"]
        for name, _ in group["attributes"]:
            found.setdefault(f"attribute {name!r}", group["id"])
        for one in group["roles"]:
            found.setdefault(f"role {one['name']!r}", one["id"])
        for one in group["culturons"]:
            found[f"culturon {one['name']!r} of group {group['name']!r}"] = one["id"]
            found.setdefault(f"culturon {one['name']!r}", one["id"])
    for one in document["cognitons"]:
        for noun in ("cogniton", "activated_when of cogniton", one["type"]):
            found[f"{noun} {one['name']!r}"] = one["id"]
    return found


def _place(finding: Finding, places: dict[str, str], document: Document) -> str | None:
    """Return where a finding is to be seen: at a link, as ``influence c0 p1``, or at a part."""
    at = places.get(finding.where)
    if at is None or finding.kind != UNKNOWN_PLAN:
        return at
    field = finding.message.split()[1]
    holders = [*document["cognitons"], *(c for g in document["groups"] for c in g["culturons"])]
    links = next(one for one in holders if one["id"] == at)[field]
    names = {one["id"]: one["name"] for one in document["plans"]}
    for plan in (link if field == "conditional" else link[0] for link in links):
        if finding.message.startswith(f"its {field} link leads to {names[plan]!r}, "):
            return f"{field} {at} {plan}"
    return at
