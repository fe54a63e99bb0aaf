"""Fixed response thresholds: they differ between robots and stay (Bonabeau et al. 1998).

Its numbers are those that do best in worlds for choosing (`analysis/foraging_roles`).

    socialmind run models/foraging_roles/fixed_thresholds.py
"""

from dataclasses import replace

from .thresholds import ForagingByThresholds

KNOWN = ForagingByThresholds.parameters


class FixedThresholds(ForagingByThresholds):
    """Foraging with roles that fixed response thresholds decide about."""

    lowest_threshold: float = replace(KNOWN["lowest_threshold"], default=0.2)
    highest_threshold: float = replace(KNOWN["highest_threshold"], default=1.0)
