"""What an agent would decide if a value were another."""

from __future__ import annotations

from typing import Any

from socialmind.interventions.edit import Edit
from socialmind.model import Model


def supposed(society: Model, edit: Edit) -> dict[str, Any]:
    """Return an agent's next decision as it is, and as it would be after an edit.

    Nothing is changed or drawn.

    Args:
        society: as it is.
        edit: of a value of the agent's.

    Returns:
        ``choice`` and ``before``, plans or None; ``probabilities`` by plan; ``text``, in words.

    Raises:
        SocialmindError: there is no such value, or it cannot be that.
    """
    table = society.tables[edit.population]
    state = society.state()
    try:
        before = _decision(society, edit)
        edit.applied(society)
        after = _decision(society, edit)
    finally:
        society.restore(state)
    said = {"part": edit.part, "value": edit.value, "population": table.shape.name}
    if before is None or after is None:
        return {**said, "choice": None, "before": None, "probabilities": {}, "text": ""}
    choice, chances = after
    was, chances_before = before
    held = chances.get(choice or "", 0.0)
    if choice != was:
        text = f"It would then decide for {choice or 'nothing'} instead of {was or 'nothing'}."
    elif chances == chances_before:
        text = f"That changes nothing in its next decision, {choice or 'nothing'}."
    else:
        then = chances_before.get(choice or "", 0.0)
        text = f"It would still decide for {choice}, with {held:.1%} instead of {then:.1%}."
    return {**said, "choice": choice, "before": was, "probabilities": chances, "text": text}


def _decision(society: Model, edit: Edit) -> tuple[str | None, dict[str, float]] | None:
    """Return the next decision of an agent, and how probable each plan is."""
    table = society.tables[edit.population]
    if table.society is None or table.shape.weighed or not table.contains(edit.agent):
        return None
    receipt = table[edit.agent].mind.explain()
    return receipt.choice, {plan.name: float(plan.probability) for plan in receipt.plans}
