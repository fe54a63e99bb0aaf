"""The shared economy: a market, decay, bags and facilities for programmed and learned minds.

They are rules in the sense of docs/rules.md: plain functions that a model's rules call, and that
run at both speeds.
"""

from socialmind.economy.decay import exponential_smoothing, proportional_decay, towards_neutral
from socialmind.economy.facility import (
    Facility,
    build_for_group,
    build_private,
    clear_deserted,
    clear_ownerless,
    facility_here,
    may_use,
    nearest_usable,
    stand_at,
)
from socialmind.economy.inventory import craft, holds, swap, take, transfer
from socialmind.economy.market import (
    Market,
    buy_ware,
    demand_perception,
    fade_demand,
    sell_ware,
    signal_demand,
)

__all__ = [
    "Facility",
    "Market",
    "build_for_group",
    "build_private",
    "buy_ware",
    "clear_deserted",
    "clear_ownerless",
    "craft",
    "demand_perception",
    "exponential_smoothing",
    "facility_here",
    "fade_demand",
    "holds",
    "may_use",
    "nearest_usable",
    "proportional_decay",
    "sell_ware",
    "signal_demand",
    "stand_at",
    "swap",
    "take",
    "towards_neutral",
    "transfer",
]
