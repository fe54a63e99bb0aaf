"""All kinds of actions, and what each becomes."""

from __future__ import annotations

from socialmind.metaciv.writing.acts import (
    facilities,
    ground,
    groups,
    minds,
    others,
    things,
    trading,
)
from socialmind.metaciv.writing.acts.form import Writer

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
