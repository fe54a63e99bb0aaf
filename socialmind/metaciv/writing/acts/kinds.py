"""All kinds of actions, and what each becomes."""

from __future__ import annotations

from socialmind.metaciv.description import Action
from socialmind.metaciv.writing.acts import (
    facilities,
    ground,
    groups,
    minds,
    others,
    things,
    trading,
)
from socialmind.metaciv.writing.acts.form import Act, Ask, Writer
from socialmind.metaciv.writing.names import identifier
from socialmind.metaciv.writing.sheet import Sheet

WRITERS: dict[str, Writer] = {
    **facilities.WRITERS,
    **ground.WRITERS,
    **groups.WRITERS,
    **minds.WRITERS,
    **others.WRITERS,
    **things.WRITERS,
    **trading.WRITERS,
}
"""How each kind is written but for those that only order others: `L_Instant`, `L_Repeat` …"""


def written(sheet: Sheet, action: Action) -> Act | Ask:
    """Return what an action becomes; of the model's own ones a rule that does nothing."""
    return WRITERS.get(action.name, _of_the_models_own)(sheet, action)


def _of_the_models_own(sheet: Sheet, action: Action) -> Act | Ask:
    """An action whose Java class is the model's own."""
    said = f"{action.name}, an action of the model's own, is not supported"
    sheet.not_supported(action.place, said)
    name = identifier(action.name.partition("_")[2] or action.name)
    if action.name.startswith("L_"):
        return Ask((f"{name}_holds",), f"whether nothing: {said}", "False", (f"# {said}",))
    return Act((name,), f"Do nothing: {said}.", [f"pass  # {said}"])
