"""The linter of cognitive schemes: what is allowed and yet hardly meant.

What it reports, by kind:

- *plan never available*: no conditional link leads to the plan.
- *cogniton without effect*, *culturon without effect*: no conditional link leads from it, and no
  influence link other than 0 to a plan that can be available. It may still remember something.
- *plan always loses*: under MaximumWeight only, for a stochastic maker gives every plan a chance.
  Proven for each cogniton or culturon that makes the plan available, from the plans that it makes
  available too: one has the same influence links and comes before it in the order of plans, or two
  pull in opposite directions so that one of them always weighs as much. This holds for all values.
- *plan loses at values above 0*: the same, but beaten by a plan whose influence links are nowhere
  weaker and which comes before it, or has a stronger link from what makes them available. It holds
  while no value and no participation is below 0, and what makes the plan available above 0.
- *link to unknown plan*: of the plans that are written out (those of the model, the scheme's order
  of plans, or else its plan positions), none is the link's.
- *condition without effect*: it could make active what is active at birth, and no other condition
  makes inactive.
- *not as its type*: a percept or a trait that feed-back changes, or a percept that no rule of the
  model and no condition sets.
- *duplicate name*: written twice in the file, or shared by a cogniton and a culturon with other
  links (with the same ones they are one idea, an agent's own and lent by a role, as in MetaCiv).
- *names alike*: names that differ in capitals or blanks only.
- *odd name*: empty, or with blanks at its ends or control characters.

That a plan is not reported proves nothing: it may still lose for the values that a model uses.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import combinations

from coglogo_py.border.errors import nearest
from coglogo_py.decision import MaximumWeight
from coglogo_py.parts import Cogniton, Culturon, Scheme


@dataclass(frozen=True)
class Finding:
    """One thing that the linter finds odd.

    Args:
        kind: which of the oddities in this file's list.
        where: what it is about, such as "plan 'eat'".
        message: what is odd about it, and what to do.

    >>> print(Finding("odd name", "plan ' eat'", "blanks count as part of a name"))
    odd name: plan ' eat': blanks count as part of a name
    """

    kind: str
    where: str
    message: str

    def __str__(self) -> str:
        return f"{self.kind}: {self.where}: {self.message}"


def findings(
    scheme: Scheme, plans: Iterable[str] | None = None, written: Iterable[str] | None = None
) -> list[Finding]:
    r"""Return what is odd in a scheme, kind by kind, each in the scheme's order.

    Args:
        scheme: the scheme to look through.
        plans: the plans that the model carries out, if they are known.
        written: the cognitons that the model's rules set, if they are known.

    >>> from coglogo_py import CognitiveScheme
    >>> cow = CognitiveScheme("cow", (Cogniton("Hunger", influence={"eat": 1}),))
    >>> print(*findings(cow, plans=["eat", "rest"]), sep="\n")
    plan never available: plan 'eat': no conditional link leads to it; add one
    plan never available: plan 'rest': no link leads to it; add one or drop the plan
    cogniton without effect: cogniton 'Hunger': it sways no plan that can be available
    """
    model_plans = None if plans is None else tuple(plans)
    holders = _holders(scheme)
    available = {plan for holder in holders.values() for plan in holder.conditional}
    found = _never_available(scheme, available, model_plans or ())
    found += _without_effect(holders, available)
    if isinstance(scheme.decision_maker, MaximumWeight):
        pairs = sum(len(holder.conditional) ** 2 for holder in holders.values())
        if len(holders) * (pairs + len(scheme.plans)) <= MOST_COMPARISONS:
            found += _losers(scheme, holders)
        else:
            what = "too many to look for plans that always lose"
            found.append(Finding("not looked at", f"{len(scheme.plans):,} plans", what))
    found += _unknown_plans(scheme, holders, model_plans)
    found += _conditions(scheme) + _types(scheme, written)
    return found + _names(scheme, holders)


MOST_COMPARISONS = 20_000_000
"""Of plans with each other, cogniton by cogniton; beyond this a check would take minutes."""
Holders = Mapping[str, Cogniton | Culturon]
"""What links lead from, by its description: cognitons, then each culturon of each group once."""


def _holders(scheme: Scheme) -> Holders:
    holders: dict[str, Cogniton | Culturon] = {
        f"cogniton {cogniton.name!r}": cogniton for cogniton in scheme.cognitons
    }
    for group in scheme.groups:
        for role in group.roles:
            for culturon in role.culturons:
                holders[f"culturon {culturon.name!r} of group {group.name!r}"] = culturon
    return holders


def _never_available(
    scheme: Scheme, available: set[str], model_plans: tuple[str, ...]
) -> list[Finding]:
    found = []
    linked_plans = set(scheme.linked_plans)
    for plan in dict.fromkeys((*scheme.plans, *model_plans)):
        if plan not in available:
            linked = plan in linked_plans
            message = (
                "no conditional link leads to it; add one"
                if linked
                else "no link leads to it; add one or drop the plan"
            )
            found.append(Finding("plan never available", f"plan {plan!r}", message))
    return found


def _without_effect(holders: Holders, available: set[str]) -> list[Finding]:
    found = []
    for where, holder in holders.items():
        sways = any(weight and plan in available for plan, weight in holder.influence.items())
        if not sways and not holder.conditional:
            kind = f"{where.split()[0]} without effect"
            found.append(Finding(kind, where, "it sways no plan that can be available"))
    return found


Pull = tuple[float, ...]
"""The weights of the influence links to one plan, from every holder in order; 0 without a link."""


def _losers(scheme: Scheme, holders: Holders) -> list[Finding]:
    pulls: dict[str, Pull] = {
        plan: tuple(holder.influence.get(plan, 0.0) for holder in holders.values())
        for plan in scheme.plans
    }
    rank = {plan: position for position, plan in enumerate(scheme.plans)}
    found = []
    for plan in scheme.plans:
        openers = [
            (row, [other for other in holder.conditional if other != plan])
            for row, holder in enumerate(holders.values())
            if plan in holder.conditional
        ]
        if not openers:
            continue
        always = [_always_beaten(plan, others, pulls, rank) for _, others in openers]
        mostly = [
            beaten or _beaten_above_0(plan, others, pulls, rank, row)
            for beaten, (row, others) in zip(always, openers, strict=True)
        ]
        if all(always):
            kind, message = "plan always loses", "weighs as much or more at all values"
        elif all(mostly):
            kind, message = "plan loses at values above 0", "is drawn as strongly or more"
        else:
            continue
        winners = _listed(always if all(always) else mostly)
        message = f"{winners} {message}; change the influence links"
        found.append(Finding(kind, f"plan {plan!r}", message))
    return found


def _listed(groups_of_plans: Iterable[tuple[str, ...]]) -> str:
    plans = dict.fromkeys(plan for group in groups_of_plans for plan in group)
    return " or ".join(repr(plan) for plan in plans)


def _always_beaten(
    plan: str, others: list[str], pulls: Mapping[str, Pull], rank: Mapping[str, int]
) -> tuple[str, ...]:
    """Return the plans of which one wins against `plan` at all values; none if not proven."""
    earlier = {other for other in others if rank[other] < rank[plan]}
    for other in others:
        if other in earlier and pulls[other] == pulls[plan]:
            return (other,)
    for one, two in combinations(others, 2):
        # Where a·x ≥ 0 and −c·a·x ≥ 0 with c > 0, both are 0: a tie, which an earlier plan wins.
        if earlier & {one, two} and _opposite(pulls[plan], pulls[one], pulls[two]):
            return one, two
    return ()


def _opposite(middle: Pull, one: Pull, two: Pull) -> bool:
    """Whether the differences of two plans' pulls to a middle one are opposite in direction."""
    first = [a - b for a, b in zip(one, middle, strict=True)]
    second = [a - b for a, b in zip(two, middle, strict=True)]
    longest = max(range(len(first)), key=lambda row: abs(first[row]))
    # Cross products rather than a quotient: equal for opposite vectors of short decimal weights,
    # and where rounding parts them the linter says nothing.
    return first[longest] * second[longest] < 0 and all(
        a * second[longest] == b * first[longest] for a, b in zip(first, second, strict=True)
    )


def _beaten_above_0(
    plan: str, others: list[str], pulls: Mapping[str, Pull], rank: Mapping[str, int], opener: int
) -> tuple[str, ...]:
    """Return a plan that wins against `plan` while no value is below 0 and the opener's above."""
    for other in others:
        no_weaker = all(a >= b for a, b in zip(pulls[other], pulls[plan], strict=True))
        wins_ties = rank[other] < rank[plan]
        if no_weaker and (wins_ties or pulls[other][opener] > pulls[plan][opener]):
            return (other,)
    return ()


def _unknown_plans(
    scheme: Scheme, holders: Holders, model_plans: tuple[str, ...] | None
) -> list[Finding]:
    if model_plans is not None:
        known, source = model_plans, "the model"
    elif scheme.plan_order is not None:
        known, source = scheme.plan_order, "the scheme's order of plans"
    elif scheme.plan_positions:
        known, source = tuple(scheme.plan_positions), "the scheme's plan positions"
    else:
        return []
    found = []
    listed = set(known)
    for where, holder in holders.items():
        for field in ("influence", "conditional", "reinforcement"):
            for plan in getattr(holder, field):
                if plan not in listed:
                    advice = nearest(plan, known) or f"the plans are {', '.join(known) or 'none'}"
                    found.append(
                        Finding(
                            "link to unknown plan",
                            where,
                            f"its {field} link leads to {plan!r}, which {source} does not have; "
                            f"{advice}",
                        )
                    )
    return found


def _conditions(scheme: Scheme) -> list[Finding]:
    message = "active at birth and made inactive by no condition; write at_birth: false"
    return [
        Finding("condition without effect", f"activated_when of cogniton {one.name!r}", message)
        for one in scheme.cognitons
        if one.activated_when and not one.deactivated_when and one.starting and one.chance == 1.0
    ]


def _types(scheme: Scheme, written: Iterable[str] | None) -> list[Finding]:
    found = []
    set_by_rules = None if written is None else set(written)
    for one in scheme.cognitons:
        where = f"{one.type} {one.name!r}"
        changing = [plan for plan, weight in one.reinforcement.items() if weight]
        if one.type in ("percept", "trait") and changing:
            kept = "what is perceived" if one.type == "percept" else "what stays for life"
            message = f"feed-back from {_listed([tuple(changing)])} changes {kept}"
            found.append(Finding("not as its type", where, f"{message}; drop the link or the type"))
        unset = set_by_rules is not None and one.name not in set_by_rules and not one.conditions
        if one.type == "percept" and unset:
            message = "no rule and no condition sets it; perceive something, or drop the type"
            found.append(Finding("not as its type", where, message))
    return found


def _names(scheme: Scheme, holders: Holders) -> list[Finding]:
    found = [
        Finding("duplicate name", what, "the name stands twice in the file; taken as one")
        for what in scheme.repeated
    ]
    cognitons = [cogniton.name for cogniton in scheme.cognitons]
    known = {cogniton.name: cogniton for cogniton in scheme.cognitons}
    culturons = {where: c for where, c in holders.items() if isinstance(c, Culturon)}
    for where, culturon in culturons.items():
        own = known.get(culturon.name)
        if own is not None and _links(own) != _links(culturon):
            message = "a cogniton of this name has other links; rename one of them"
            found.append(Finding("duplicate name", where, message))
    places = {
        "cogniton": cognitons,
        "culturon": [culturon.name for culturon in culturons.values()],
        "group": [group.name for group in scheme.groups],
        "role": [role.name for group in scheme.groups for role in group.roles],
        "attribute": [name for group in scheme.groups for name, _ in group.attributes],
        "plan": list(scheme.plans),
        "breed": list(scheme.breeds),
    }
    for noun, names in places.items():
        found += _alike(noun, names)
    for noun, names in {"scheme": [scheme.name], **places}.items():
        for name in dict.fromkeys(names):
            if name != name.strip() or not name.isprintable() or not name:
                found.append(
                    Finding(
                        "odd name",
                        f"{noun} {name!r}",
                        "blanks and control characters count as part of a name"
                        if name
                        else "the name is empty; a blank line in the file, perhaps",
                    )
                )
    return found


def _links(holder: Cogniton | Culturon) -> tuple[object, ...]:
    """Return the links of a cogniton or culturon, whatever their order."""
    influence, reinforcement = (
        {plan: weight for plan, weight in links.items() if weight}
        for links in (holder.influence, holder.reinforcement)
    )
    return influence, set(holder.conditional), reinforcement


def _alike(noun: str, names: list[str]) -> list[Finding]:
    first: dict[str, str] = {}
    found = []
    for name in dict.fromkeys(names):
        earlier = first.setdefault("".join(name.split()).casefold(), name)
        if earlier != name:
            found.append(
                Finding(
                    "names alike",
                    f"{noun} {name!r}",
                    f"it differs from {earlier!r} in capitals or blanks only",
                )
            )
    return found
