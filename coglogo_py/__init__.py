"""The cogniton engine: schemes, minds, groups and culturons, decision makers.

A name is imported when it is first used, so that what needs none of them starts fast.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from coglogo_py.border.errors import CogLogoError as CogLogoError
    from coglogo_py.border.errors import MindError as MindError
    from coglogo_py.border.errors import SchemeError as SchemeError
    from coglogo_py.culture import Culture as Culture
    from coglogo_py.decision import BiasedWeightedStochastic as BiasedWeightedStochastic
    from coglogo_py.decision import DecisionMaker as DecisionMaker
    from coglogo_py.decision import MaximumWeight as MaximumWeight
    from coglogo_py.decision import PositiveStochastic as PositiveStochastic
    from coglogo_py.decision import WeightedStochastic as WeightedStochastic
    from coglogo_py.lint import Finding as Finding
    from coglogo_py.mind import Mind as Mind
    from coglogo_py.parts import Cogniton as Cogniton
    from coglogo_py.parts import Culturon as Culturon
    from coglogo_py.parts import Group as Group
    from coglogo_py.parts import Role as Role
    from coglogo_py.receipts.receipt import Receipt as Receipt
    from coglogo_py.scheme import CognitiveScheme as CognitiveScheme
    from coglogo_py.society import Society as Society
else:
    from coglogo_py.on_demand import on_demand

    __getattr__, __dir__, __all__ = on_demand(
        __name__,
        {
            "coglogo_py.culture": "Culture",
            "coglogo_py.decision": "BiasedWeightedStochastic DecisionMaker"
            " MaximumWeight PositiveStochastic WeightedStochastic",
            "coglogo_py.border.errors": "CogLogoError MindError SchemeError",
            "coglogo_py.lint": "Finding",
            "coglogo_py.mind": "Mind",
            "coglogo_py.receipts.receipt": "Receipt",
            "coglogo_py.parts": "Cogniton Culturon Group Role",
            "coglogo_py.scheme": "CognitiveScheme",
            "coglogo_py.society": "Society",
        },
    )
