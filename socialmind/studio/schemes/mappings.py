"""What changed in mappings from names to values, as patches of a YAML text."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from coglogo_py.files.yaml_text import name_text
from socialmind.studio.schemes.patching import Patch


def values_changed(
    before: Mapping[str, Any], after: Mapping[str, Any], text: Any, renamed: Mapping[str, str]
) -> Patch:
    """Return the patch of a mapping of values on one line; None stands for no entry."""
    patch = Patch()
    was, now = _there(before), _there(after)
    for name, value in was.items():
        new = renamed.get(name, name)
        if new not in now:
            patch.removed.add(name)
            continue
        if new != name:
            patch.renamed[name] = new
        if now[new] != value:
            patch.inner[name] = text(now[new])
    stays = {renamed.get(name, name) for name in was}
    patch.added = {name: text(value) for name, value in now.items() if name not in stays}
    return patch


def changed_by_group(
    before: Mapping[str, Mapping[str, Any]],
    after: Mapping[str, Mapping[str, Any]],
    text: Any,
    names: Mapping[str, str],
    inner_names: Mapping[str, Mapping[str, str]] | None = None,
) -> Patch:
    """Return the patch of a mapping from groups to mappings of values; of none there is no entry.

    Args:
        before: by the names of groups.
        after: likewise.
        text: makes a text of a value.
        names: new names of groups by old ones.
        inner_names: new names within a group by old ones, by the group's old name.
    """
    patch = Patch()
    was = {group: there for group, values in before.items() if (there := _there(values))}
    now = {group: there for group, values in after.items() if (there := _there(values))}
    for group, values in was.items():
        new = names.get(group, group)
        if new not in now:
            patch.removed.add(group)
            continue
        if new != group:
            patch.renamed[group] = new
        inner = values_changed(values, now[new], text, (inner_names or {}).get(group, {}))
        if inner:
            patch.inner[group] = inner
    stays = {names.get(group, group) for group in was}
    for group, values in now.items():
        if group not in stays:
            pairs = (f"{name_text(name)}: {text(value)}" for name, value in values.items())
            patch.added[group] = f"{{{', '.join(pairs)}}}"
    return patch


def _there(values: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value is not None}
