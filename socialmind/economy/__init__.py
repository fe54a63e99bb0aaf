"""The shared economy: one market and one set of decay models for programmed and learned minds.

They are rules in the sense of docs/rules.md: plain functions that a model's rules call, and that
run at both speeds.
"""

from socialmind.economy.decay import exponential_smoothing, proportional_decay, towards_neutral
from socialmind.economy.market import (
    Market,
    buy_ware,
    demand_perception,
    fade_demand,
    sell_ware,
    signal_demand,
)

__all__ = [
    "Market",
    "buy_ware",
    "demand_perception",
    "exponential_smoothing",
    "fade_demand",
    "proportional_decay",
    "sell_ware",
    "signal_demand",
    "towards_neutral",
]
