"""The cogniton engine: schemes, minds, groups and culturons, decision makers."""

from coglogo_py.decision import (
    BiasedWeightedStochastic,
    DecisionMaker,
    MaximumWeight,
    WeightedStochastic,
)
from coglogo_py.errors import CogLogoError, MindError, SchemeError
from coglogo_py.lint import Finding
from coglogo_py.mind import Mind
from coglogo_py.receipt import Receipt
from coglogo_py.scheme import CognitiveScheme, Cogniton, Culturon, Group, Role
from coglogo_py.society import Society

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
