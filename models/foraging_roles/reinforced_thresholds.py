"""Reinforced response thresholds: that of the task at hand falls, the other rises.

They are those of Theraulaz et al. (1998), equal at the start. Its numbers are those that do best in
worlds for choosing (`analysis/foraging_roles`).

    socialmind run models/foraging_roles/reinforced_thresholds.py
"""

from dataclasses import replace

from .thresholds import ForagingByThresholds

KNOWN = ForagingByThresholds.parameters


class ReinforcedThresholds(ForagingByThresholds):
    """Foraging with roles that reinforced response thresholds decide about."""

    lowest_threshold: float = replace(KNOWN["lowest_threshold"], default=0.02)
    highest_threshold: float = replace(KNOWN["highest_threshold"], default=0.5)
    variety: float = replace(KNOWN["variety"], default=0.0)
    learning: float = replace(KNOWN["learning"], default=0.01)
    forgetting: float = replace(KNOWN["forgetting"], default=0.03)
