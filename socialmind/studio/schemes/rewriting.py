"""What changed in a scheme, as a patch of the YAML text that it was read from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import yaml

from coglogo_py.files.yaml_file import COGNITON_FIELDS, TOP_FIELDS
from coglogo_py.files.yaml_nodes import composed
from coglogo_py.files.yaml_text import name_text, number_text, position_text
from socialmind.studio.schemes.document import CONDITIONS, SHARES, WEIGHTS, Document
from socialmind.studio.schemes.mappings import changed_by_group, values_changed
from socialmind.studio.schemes.patching import Items, Patch, Value, entries, patched

Part = Mapping[str, Any]
UNSAID = {
    "starting": True,
    "start": 0.0,
    "colour": "#808080",
    "type": None,
    **dict.fromkeys(SHARES, 1.0),
}
"""What a field is where it is left out."""
IN_FILE = {"starting": "at_birth"}
"""What fields are called there, where that is another name."""
HELD = ("start", "colour", "position")
"""Fields of cognitons and culturons alike, but for links."""


def rewritten(text: str, before: Document, after: Document, order: list[str] | None) -> str:
    """Return the text of a scheme's file with what changed in it.

    Args:
        text: YAML, its lines ending in LF.
        before: what it describes.
        after: what it is to describe; parts keep their identities.
        order: the order of plans, if it is to be written out.

    Raises:
        SocialmindError: the text repeats parts of itself.
    """
    return patched(text, _Difference(text, before, after).patch(order))


class _Difference:
    """Finds what is other in a document than in the one that a text describes."""

    def __init__(self, text: str, before: Document, after: Document) -> None:
        self.root = entries(composed(text, "text"))
        self.before, self.after = before, after
        self.was = {one["id"]: one["name"] for one in before["plans"]}
        self.now = {one["id"]: one["name"] for one in after["plans"]}
        self.renamed = _renamed(before["plans"], after["plans"])

    def patch(self, order: list[str] | None) -> Patch:
        before, after = self.before, self.after
        patch = Patch(order=TOP_FIELDS)
        if before["name"] != after["name"]:
            patch.inner["name"] = name_text(after["name"])
        self._maker(patch)
        if before["breeds"] != after["breeds"]:
            self._put(patch, "breeds", after["breeds"])
        if order is not None:
            stands = self.root.get("plans")
            known = (
                [one.value for one in stands.value]
                if isinstance(stands, yaml.SequenceNode)
                else None
            )
            if [self.renamed.get(name, name) for name in known or []] != order or self.renamed:
                self._put(patch, "plans", order)
        positions: dict[str, Any] = {
            "before": {self.was[one["id"]]: one["position"] for one in before["plans"]},
            "after": {self.now[one["id"]]: one["position"] for one in after["plans"]},
        }
        places = values_changed(**positions, text=position_text, renamed=self.renamed)
        self._within(patch, "plan_positions", places)
        self._within(patch, "cognitons", self._cognitons())
        self._within(patch, "groups", self._groups())
        self._of_groups(patch)
        return patch

    def _of_groups(self, patch: Patch) -> None:
        """Patch what is said of groups beside their roles and culturons."""
        before, after = self.before["groups"], self.after["groups"]
        names = _renamed(before, after)
        roles = {
            was["name"]: _renamed(was["roles"], now["roles"])
            for was in before
            for now in after
            if was["id"] == now["id"]
        }

        def said(of: Any) -> dict[str, Any]:
            return {
                word: {one["name"]: of(one) for one in each}
                for word, each in (("before", before), ("after", after))
            }

        numbers = changed_by_group(
            **said(lambda one: dict(one["attributes"])), text=_number, names=names
        )
        self._within(patch, "group_attributes", numbers)
        around: dict[str, Any] = {"before": _nesting(self.before), "after": _nesting(self.after)}
        self._within(patch, "nested_groups", values_changed(**around, text=str, renamed=names))
        places = values_changed(
            **said(lambda one: one["position"]), text=position_text, renamed=names
        )
        self._within(patch, "group_positions", places)
        inner = said(lambda one: {role["name"]: role["position"] for role in one["roles"]})
        places = changed_by_group(**inner, text=position_text, names=names, inner_names=roles)
        self._within(patch, "role_positions", places)

    def _within(self, patch: Patch, name: str, inner: Patch) -> None:
        """Take a patch of a field of the whole, which may not stand there yet, or go empty."""
        if not inner:
            return
        if name in self.root and inner.removed == {*entries(self.root[name])} and not inner.added:
            patch.removed.add(name)
        elif name in self.root:
            patch.inner[name] = inner
        else:
            patch.added[name] = inner.added

    def _put(self, patch: Patch, name: str, names: list[str]) -> None:
        if name in self.root:
            patch.inner[name] = Items(names, self.renamed if name == "plans" else {})
        elif names:
            patch.added[name] = f"[{', '.join(map(name_text, names))}]"

    def _maker(self, patch: Patch) -> None:
        was, now = self.before["decision_maker"], self.after["decision_maker"]
        if was == now:
            return
        name, bias = name_text(now["name"]), number_text(float(now["bias"]))
        whole = name if now["bias"] == 1 else f"{{name: {name}, bias: {bias}}}"
        stands = self.root.get("decision_maker")
        if stands is None:
            patch.added["decision_maker"] = whole
        elif not isinstance(stands, yaml.MappingNode):
            patch.inner["decision_maker"] = whole
        else:
            inner = Patch()
            if was["name"] != now["name"]:
                inner.inner["name"] = name
            if was["bias"] != now["bias"]:
                (inner.inner if "bias" in entries(stands) else inner.added)["bias"] = bias
            patch.inner["decision_maker"] = inner

    def _cognitons(self) -> Patch:
        stands = entries(self.root.get("cognitons"))
        was = {one["id"]: one for one in self.before["cognitons"]}
        patch = Patch(renamed=_renamed(self.before["cognitons"], self.after["cognitons"]))
        now = {one["id"] for one in self.after["cognitons"]}
        patch.removed = {one["name"] for one in was.values() if one["id"] not in now}
        for one in self.after["cognitons"]:
            if one["id"] in was:
                before = was[one["id"]]
                fields = self._fields(entries(stands[before["name"]]), before, one)
                if fields:
                    patch.inner[before["name"]] = fields
            else:
                patch.added[one["name"]] = self._whole(one)
        return patch

    def _fields(self, stands: Mapping[str, yaml.Node], before: Part, after: Part) -> Patch:
        """Return the patch of the fields of a cogniton or culturon."""
        patch = Patch(order=COGNITON_FIELDS)
        texts = self._texts(after)
        for name in (*UNSAID, "position", *CONDITIONS):
            called = IN_FILE.get(name, name)
            if name not in after or before[name] == after[name]:
                continue
            if called not in texts:
                if called in stands:
                    patch.removed.add(called)
            elif called in stands:
                patch.inner[called] = str(texts[called])
            else:
                patch.added[called] = texts[called]
        for name in WEIGHTS:
            links: dict[str, Any] = {
                "before": {self.was[plan]: weight for plan, weight in before[name]},
                "after": {self.now[plan]: weight for plan, weight in after[name]},
            }
            inner = values_changed(**links, text=_number, renamed=self.renamed)
            if not inner:
                continue
            if name not in stands:
                patch.added[name] = texts[name]
            elif not after[name]:
                patch.removed.add(name)
            else:
                patch.inner[name] = inner
        was = [self.was[plan] for plan in before["conditional"]]
        now = [self.now[plan] for plan in after["conditional"]]
        if was != now:
            if "conditional" not in stands:
                patch.added["conditional"] = texts["conditional"]
            elif now:
                patch.inner["conditional"] = Items(now, self.renamed)
            else:
                patch.removed.add("conditional")
        return patch

    def _texts(self, one: Part) -> dict[str, Value]:
        """Return the fields of a cogniton or culturon that are said, as texts of their values."""
        found: dict[str, Value] = {}
        if "starting" in one:
            found["at_birth"] = "true" if one["starting"] else "false"
        found["start"] = _number(one["start"])
        found["colour"] = f"'{one['colour']}'"
        if one["position"] is not None:
            found["position"] = position_text(one["position"])
        for name in WEIGHTS:
            if one[name]:
                pairs = (f"{name_text(self.now[plan])}: {_number(w)}" for plan, w in one[name])
                found[name] = f"{{{', '.join(pairs)}}}"
        if one["conditional"]:
            names = (name_text(self.now[plan]) for plan in one["conditional"])
            found["conditional"] = f"[{', '.join(names)}]"
        for name in CONDITIONS:
            if one.get(name):
                texts = [name_text(each) for each in one[name]]
                found[name] = texts[0] if len(texts) == 1 else f"[{', '.join(texts)}]"
        if one.get("type") is not None:
            found["type"] = one["type"]
        found |= {name: _number(one[name]) for name in SHARES if name in one}
        return found

    def _whole(self, one: Part) -> dict[str, Value]:
        """Return what is said of a new cogniton or culturon, in the order of the file."""
        texts = self._texts(one)
        for name, unsaid in UNSAID.items():
            if name in one and one[name] == unsaid and name not in ("starting", "start"):
                texts.pop(IN_FILE.get(name, name), None)
        return {name: texts[name] for name in COGNITON_FIELDS if name in texts}

    def _groups(self) -> Patch:
        was = {one["id"]: one for one in self.before["groups"]}
        patch = Patch(renamed=_renamed(self.before["groups"], self.after["groups"]))
        now = {one["id"] for one in self.after["groups"]}
        patch.removed = {one["name"] for one in was.values() if one["id"] not in now}
        for one in self.after["groups"]:
            if one["id"] in was:
                inner = self._roles(was[one["id"]], one)
                if inner:
                    patch.inner[was[one["id"]]["name"]] = inner
            else:
                shown: set[str] = set()
                patch.added[one["name"]] = {
                    role["name"]: self._new_culturons(one, role, shown) for role in one["roles"]
                }
        return patch

    def _roles(self, before: Part, after: Part) -> Patch:
        """Return the patch of a group: its roles, and the culturons that they name."""
        stands = entries(entries(self.root.get("groups"))[before["name"]])
        was = {one["id"]: one for one in before["roles"]}
        now = {one["id"]: one for one in after["roles"]}
        held = {one["id"]: one for one in before["culturons"]}
        new = {one["id"]: one for one in after["culturons"]}
        staying = {
            role: _staying(one["culturons"], now[role]["culturons"]) if role in now else []
            for role, one in was.items()
        }
        anew = set()
        """Those to be described once more: what a mention says, that goes, would be lost."""
        for identity, one in held.items():
            stays = [
                identity in staying[role] for role in was if identity in was[role]["culturons"]
            ]
            if identity not in new or stays == [True]:
                continue
            if not all(stays) or _described(one) != _described(new[identity]):
                anew.add(identity)
        shown = {identity for identity in held if identity in new and identity not in anew}
        patch = Patch(renamed=_renamed(before["roles"], after["roles"]))
        patch.removed = {one["name"] for one in was.values() if one["id"] not in now}
        for role in after["roles"]:
            if role["id"] not in was:
                patch.added[role["name"]] = self._new_culturons(after, role, shown)
                continue
            old = was[role["id"]]
            there = entries(stands[old["name"]])
            inner = Patch()
            stays_here = staying[role["id"]]
            inner.removed = {held[c]["name"] for c in old["culturons"] if c not in stays_here}
            for identity in role["culturons"]:
                one = new[identity]
                if identity not in stays_here:
                    inner.added[one["name"]] = "" if identity in shown else self._whole(one)
                    shown.add(identity)
                    continue
                name = held[identity]["name"]
                if name != one["name"]:
                    inner.renamed[name] = one["name"]
                fields = entries(there[name])
                if identity not in anew:
                    change = self._fields(fields, held[identity], one)
                else:
                    change = Patch(removed=set(fields))
                    if identity not in shown:
                        change.added = self._whole(one)
                        shown.add(identity)
                if change:
                    inner.inner[name] = change
            if inner:
                patch.inner[old["name"]] = inner
        return patch

    def _new_culturons(self, group: Part, role: Part, shown: set[str]) -> dict[str, Value] | str:
        held = {one["id"]: one for one in group["culturons"]}
        found: dict[str, Value] = {}
        for identity in role["culturons"]:
            found[held[identity]["name"]] = "" if identity in shown else self._whole(held[identity])
            shown.add(identity)
        return found or ""


def _renamed(before: list[Any], after: list[Any]) -> dict[str, str]:
    """Return the new names of parts that are called otherwise now, by the old ones."""
    was = {one["id"]: one["name"] for one in before}
    return {
        was[one["id"]]: one["name"]
        for one in after
        if one["id"] in was and was[one["id"]] != one["name"]
    }


def _staying(before: list[str], after: list[str]) -> list[str]:
    """Return what can stay where it is: the first that come in the order of before."""
    found: list[str] = []
    for one in after:
        if one not in before or (found and before.index(one) < before.index(found[-1])):
            break
        found.append(one)
    return found


def _described(one: Part) -> dict[str, Any]:
    return {name: value for name, value in one.items() if name != "name"}


def _nesting(document: Document) -> dict[str, str]:
    groups = {one["id"]: one["name"] for one in document["groups"]}
    roles = {role["id"]: role["name"] for one in document["groups"] for role in one["roles"]}
    return {
        one[
            "name"
        ]: f"{{{name_text(groups[one['within'][0]])}: {name_text(roles[one['within'][1]])}}}"
        for one in document["groups"]
        if one["within"] is not None
    }


def _number(value: Any) -> str:
    return number_text(float(value))
