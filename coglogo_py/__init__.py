"""The cogniton engine: schemes, minds, groups and culturons, decision makers.

A name is imported when it is first used, so that what needs none of them starts fast.
"""

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from coglogo_py.decision import (
        BiasedWeightedStochastic,
        DecisionMaker,
        MaximumWeight,
        WeightedStochastic,
    )
    from coglogo_py.errors import CogLogoError, MindError, SchemeError
    from coglogo_py.lint import Finding
    from coglogo_py.mind import Mind
    from coglogo_py.receipts.receipt import Receipt
    from coglogo_py.scheme import CognitiveScheme, Cogniton, Culturon, Group, Role
    from coglogo_py.society import Society

_MODULES = {
    "decision": (
        "BiasedWeightedStochastic",
        "DecisionMaker",
        "MaximumWeight",
        "WeightedStochastic",
    ),
    "errors": ("CogLogoError", "MindError", "SchemeError"),
    "lint": ("Finding",),
    "mind": ("Mind",),
    "receipt": ("Receipt",),
    "scheme": ("CognitiveScheme", "Cogniton", "Culturon", "Group", "Role"),
    "society": ("Society",),
}
_HOMES = {name: f"coglogo_py.{module}" for module, names in _MODULES.items() for name in names}

__all__ = [
    "BiasedWeightedStochastic",
    "CogLogoError",
    "CognitiveScheme",
    "Cogniton",
    "Culturon",
    "DecisionMaker",
    "Finding",
    "Group",
    "MaximumWeight",
    "Mind",
    "MindError",
    "Receipt",
    "Role",
    "SchemeError",
    "Society",
    "WeightedStochastic",
]

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Import a name from where it is defined, once."""
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        globals()[name] = getattr(import_module(_HOMES[name]), name)
        return globals()[name]

    def __dir__() -> list[str]:
        return sorted({*globals(), *_HOMES})
