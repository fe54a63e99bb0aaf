"""A scheme as an editor has it: plain data in which every part has an identity of its own.

Links name plans by identity, so a plan that is renamed is renamed everywhere, and a name that is
not finished yet is no error in fifty places. `document_of` gives identities by places (``c0`` the
first cogniton, ``p2`` the third plan, ``g0r1`` a role, ``g0k0`` a culturon), so that a scheme has
the same ones each time; what an editor adds has others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from coglogo_py import CognitiveScheme, Cogniton, Culturon, DecisionMaker, Group, Role, SchemeError
from coglogo_py.decision import decision_maker_called
from coglogo_py.parts import check_nesting

Document = dict[str, Any]
WEIGHTS = ("influence", "reinforcement")
CONDITIONS = ("active_while", "activated_when", "deactivated_when")
SHARES = ("chance", "inherited")
EMPTY: Document = {
    "name": "scheme",
    "decision_maker": {"name": "MaximumWeight", "bias": 1.0},
    "breeds": [],
    "ordered": True,
    "plans": [],
    "cognitons": [],
    "groups": [],
}
"""What an editor begins with."""


@dataclass(frozen=True)
class Wrong:
    """What keeps a document from being a scheme.

    Attributes:
        at: the identity of the part where it stands; None for the whole.
        text: a sentence.
    """

    at: str | None
    text: str


class DocumentError(SchemeError):
    """A document is no scheme; its message is of the first thing that is wrong."""


def document_of(scheme: CognitiveScheme) -> Document:
    """Return a scheme as a document.

    >>> hunger = Cogniton("Hunger", influence={"eat": 2.0}, conditional=("eat",))
    >>> found = document_of(CognitiveScheme("cows", (hunger,)))
    >>> found["plans"][0]["name"], found["cognitons"][0]["influence"]
    ('eat', [['p0', 2.0]])
    """
    names = dict.fromkeys((*scheme.plans, *scheme.plan_positions))
    plans = {name: f"p{place}" for place, name in enumerate(names)}
    groups = {one.name: place for place, one in enumerate(scheme.groups)}
    return {
        "name": scheme.name,
        "decision_maker": {"name": scheme.decision_maker.name, "bias": scheme.decision_maker.bias},
        "breeds": list(scheme.breeds),
        "ordered": scheme.plan_order is not None,
        "plans": [
            {
                "id": plans[name],
                "name": name,
                "position": _place(scheme.plan_positions.get(name)),
                "listed": scheme.plan_order is None or name in scheme.plan_order,
            }
            for name in names
        ],
        "cognitons": [
            {
                "id": f"c{place}",
                **_holder(one, plans),
                "starting": one.starting,
                **{field: [str(each) for each in getattr(one, field)] for field in CONDITIONS},
                "type": one.type,
                **{field: getattr(one, field) for field in SHARES},
            }
            for place, one in enumerate(scheme.cognitons)
        ],
        "groups": [
            _group(one, f"g{groups[one.name]}", plans, groups, scheme) for one in scheme.groups
        ],
    }


def _holder(one: Cogniton | Culturon, plans: Mapping[str, str]) -> Document:
    return {
        "name": one.name,
        "start": one.start_value,
        "colour": "#{:02x}{:02x}{:02x}".format(*one.colour),
        "position": _place(one.position),
        **{
            field: [[plans[plan], weight] for plan, weight in getattr(one, field).items()]
            for field in WEIGHTS
        },
        "conditional": [plans[plan] for plan in one.conditional],
    }


def _group(
    group: Group, identity: str, plans: Mapping[str, str], groups: Mapping[str, int], scheme: Any
) -> Document:
    held = {one.name: one for role in group.roles for one in role.culturons}
    culturons = {name: f"{identity}k{place}" for place, name in enumerate(held)}
    within = None
    if group.within is not None:
        around = groups[group.within[0]]
        roles = [one.name for one in scheme.groups[around].roles]
        within = [f"g{around}", f"g{around}r{roles.index(group.within[1])}"]
    return {
        "id": identity,
        "name": group.name,
        "attributes": [[name, value] for name, value in group.attributes],
        "within": within,
        "position": _place(group.position),
        "roles": [
            {
                "id": f"{identity}r{place}",
                "name": one.name,
                "position": _place(one.position),
                "culturons": [culturons[culturon.name] for culturon in one.culturons],
            }
            for place, one in enumerate(group.roles)
        ],
        "culturons": [{"id": culturons[name], **_holder(one, plans)} for name, one in held.items()],
    }


def _place(position: tuple[int, int] | None) -> list[int] | None:
    return None if position is None else list(position)


def scheme_of(document: Document, makers: Iterable[type[DecisionMaker]] = ()) -> CognitiveScheme:
    """Return the scheme that a document describes.

    Args:
        document: as `document_of` gives it.
        makers: decision makers of the modeller's own.

    Raises:
        DocumentError: it is none; says the first reason.

    >>> document = document_of(CognitiveScheme("cows", (Cogniton("Mood"),)))
    >>> scheme_of(document) == CognitiveScheme("cows", (Cogniton("Mood"),))
    True
    """
    scheme, wrong = made_of(document, makers)
    if scheme is None:
        raise DocumentError(wrong[0].text)
    return scheme


def made_of(
    document: Document, makers: Iterable[type[DecisionMaker]] = ()
) -> tuple[CognitiveScheme | None, list[Wrong]]:
    """Return the scheme that a document describes, or all that keeps it from being one.

    Arguments as of `scheme_of`.
    """
    wrong: list[Wrong] = []
    try:
        scheme = _made(document, tuple(makers), wrong)
    except SchemeError as error:
        wrong.append(Wrong(None, str(error)))
    except (KeyError, TypeError, ValueError, AttributeError, IndexError) as error:
        wrong.append(Wrong(None, f"this is no document of a scheme ({type(error).__name__})"))
    return (None if wrong else scheme), wrong


def _made(
    document: Document, makers: tuple[type[DecisionMaker], ...], wrong: list[Wrong]
) -> CognitiveScheme | None:
    """Return the scheme, or None and what is wrong."""
    plans = {one["id"]: one["name"] for one in document["plans"]}
    wrong += _names(document)
    cognitons, groups = [], []
    for one in document["cognitons"]:
        with _Placed(one["id"], wrong):
            cognitons.append(_cogniton(one, plans))
    group_names = {one["id"]: one["name"] for one in document["groups"]}
    role_names = {r["id"]: r["name"] for one in document["groups"] for r in one["roles"]}
    for one in document["groups"]:
        with _Placed(one["id"], wrong):
            groups.append(_group_of(one, plans, group_names, role_names, wrong))
    maker = None
    said = document["decision_maker"]
    with _Placed(None, wrong):
        maker = decision_maker_called(said["name"], said["bias"], makers)
    if wrong or maker is None:
        return None
    nesting = {one.name: ([role.name for role in one.roles], one.within) for one in groups}
    try:
        check_nesting(nesting)
    except SchemeError as error:
        nested = [one for one in document["groups"] if one["within"] is not None]
        named = [one for one in nested if f"group {one['name']!r} " in error.found]
        wrong.append(Wrong((named or nested)[0]["id"], str(error)))
        return None
    return _ordered(document, tuple(cognitons), tuple(groups), maker)


def _ordered(
    document: Document,
    cognitons: tuple[Cogniton, ...],
    groups: tuple[Group, ...],
    maker: DecisionMaker,
) -> CognitiveScheme:
    """Return the scheme, with its order of plans written out where links do not give it."""
    plans = document["plans"]
    positions = {one["name"]: tuple(one["position"]) for one in plans if one["position"]}
    listed = tuple(one["name"] for one in plans if one["listed"])
    scheme = CognitiveScheme(
        document["name"],
        cognitons,
        groups,
        maker,
        tuple(document["breeds"]),
        positions,
        listed if document["ordered"] else None,
    )
    known = {*scheme.plans, *(one["name"] for one in plans if not one["position"])}
    wanted = tuple(one["name"] for one in plans if one["name"] in known)
    return scheme if wanted == scheme.plans else replace(scheme, plan_order=wanted)


def _cogniton(one: Mapping[str, Any], plans: Mapping[str, str]) -> Cogniton:
    becoming: dict[str, Any] = {field: tuple(one[field]) for field in CONDITIONS}
    becoming |= {field: one[field] for field in ("type", *SHARES)}
    return Cogniton(one["name"], one["starting"], **_held(one, plans), **becoming)


def _held(one: Mapping[str, Any], plans: Mapping[str, str]) -> dict[str, Any]:
    colour = one["colour"]
    if not isinstance(colour, str) or len(colour) != 7 or not colour.startswith("#"):
        raise SchemeError(f"{colour!r} as the colour of {one['name']!r}", "a colour as '#ff8800'")
    rgb = int(colour[1:], 16)
    return {
        "start_value": one["start"],
        "colour": (rgb >> 16, rgb >> 8 & 255, rgb & 255),
        "position": one["position"],
        **{field: {plans[plan]: weight for plan, weight in one[field]} for field in WEIGHTS},
        "conditional": tuple(plans[plan] for plan in one["conditional"]),
    }


def _group_of(
    one: Mapping[str, Any],
    plans: Mapping[str, str],
    groups: Mapping[str, str],
    roles: Mapping[str, str],
    wrong: list[Wrong],
) -> Group:
    culturons = {}
    for held in one["culturons"]:
        with _Placed(held["id"], wrong):
            culturons[held["id"]] = Culturon(held["name"], **_held(held, plans))
            if not any(held["id"] in role["culturons"] for role in one["roles"]):
                raise SchemeError(f"the culturon {held['name']!r} is in no role; put it into one")
    within = one["within"]
    return Group(
        one["name"],
        tuple(
            Role(
                role["name"],
                tuple(culturons[c] for c in role["culturons"] if c in culturons),
                role["position"],
            )
            for role in one["roles"]
        ),
        tuple((name, value) for name, value in one["attributes"]),
        None if within is None else (groups[within[0]], roles[within[1]]),
        one["position"],
    )


def matched(document: Document, known: Document) -> Document:
    """Return a document whose parts have the identities of another's of the same names.

    So an editor's document fits the file that it is to be saved in.

    Args:
        document: whose parts are taken.
        known: whose identities are taken, where it has a part of the name.
    """
    new: dict[str, str] = {}

    def pair(parts: list[Any], others: list[Any]) -> None:
        by_name = {one["name"]: one["id"] for one in others}
        new.update((one["id"], by_name.get(one["name"], f"m{one['id']}")) for one in parts)

    for name in ("plans", "cognitons", "groups"):
        pair(document[name], known[name])
    groups = {one["name"]: one for one in known["groups"]}
    for one in document["groups"]:
        other = groups.get(one["name"], {"roles": [], "culturons": []})
        for name in ("roles", "culturons"):
            pair(one[name], other[name])

    def renewed(value: Any, key: str = "") -> Any:
        if isinstance(value, dict):
            return {name: renewed(one, name) for name, one in value.items()}
        if isinstance(value, list) and key not in ("breeds", "attributes", *CONDITIONS):
            return [renewed(one, "id" if isinstance(one, str) else key) for one in value]
        return new.get(value, value) if key == "id" and isinstance(value, str) else value

    found: Document = renewed(document)
    return found


def _names(document: Document) -> Iterator[Wrong]:
    """Tell names that are missing or stand twice, where they stand."""
    if not document["name"]:
        yield Wrong(None, "the scheme has no name; give it one")
    several: list[tuple[str, list[Any]]] = [
        ("plan", document["plans"]),
        ("cogniton", document["cognitons"]),
        ("group", document["groups"]),
    ]
    for group in document["groups"]:
        several.append((f"role of {group['name']!r}", group["roles"]))
        several.append((f"culturon of {group['name']!r}", group["culturons"]))
    for noun, parts in several:
        seen = set()
        for one in parts:
            if one["name"] in seen:
                yield Wrong(one["id"], f"another {noun} is called {one['name']!r}; rename one")
            seen.add(one["name"])


def _identity(parts: Iterable[Mapping[str, Any]], name: str) -> str | None:
    return next((one["id"] for one in parts if one["name"] == name), None)


class _Placed:
    """Notes an error of what is done within it, where it is to be seen."""

    def __init__(self, at: str | None, wrong: list[Wrong]) -> None:
        self._at, self._wrong = at, wrong

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        if not isinstance(error, SchemeError):
            return False
        self._wrong.append(Wrong(self._at, str(error)))
        return True
