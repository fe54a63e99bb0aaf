"""A market for one ware against one staple, at a fixed price, with demands that adapt.

The farmers' village trades tools (the ware) against wheat (the staple); a colony that wants two
kinds of objects in a ratio of 1 : 2 is the same market at price 2. Its equations, with staple S,
ware W and price p:

- perception of demand: π = (S − W · p) / (R · p), R being the stock that counts as plenty;
- signalling, by whoever tried to trade: staple demand −= i · π, ware demand += i · π;
- fading, once a tick: both demands are smoothed towards 0 with weight r, d′ = d + r · (0 − d).

π is positive when the ware is scarcer than the price says, negative when the staple is.
"""

from __future__ import annotations

from typing import Any

from socialmind.agents.agent import Agent
from socialmind.economy.decay import exponential_smoothing


class Market(Agent):
    """A place that trades: its stocks, and the demands that traders have signalled.

    Attributes:
        staple: stock of the staple, in its units.
        ware: stock of the ware, in pieces.
        staple_demand, ware_demand: the demands, any number; 0 is neutral.
        perception: π at the last look.
    """

    staple: float = 0.0
    ware: float = 0.0
    staple_demand: float = 0.0
    ware_demand: float = 0.0
    perception: float = 0.0


def demand_perception(staple: float, ware: float, price: float, plenty: float) -> float:
    """Return how much scarcer the ware is than its price says: π = (S − W · p) / (R · p).

    Args:
        staple: S, the stock of the staple.
        ware: W, the stock of the ware, in pieces.
        price: p, staple a piece, above 0.
        plenty: R, the pieces that count as plenty, above 0.

    Source: reference rules of the farmer-artisan model, `demand perception`.

    >>> demand_perception(8350.0, 50.0, 167.0, 50.0), demand_perception(8350.0, 0.0, 167.0, 50.0)
    (0.0, 1.0)
    """
    return (staple - ware * price) / (plenty * price)


def signal_demand(market: Any, intensity: float) -> None:
    """Let a trader make known what it perceived: staple demand −= i · π, ware demand += i · π.

    Args:
        market: a `Market`.
        intensity: i, the weight of one signal, 0 or more.

    Source: listing 3.3 of the thesis, lines 12–14.
    """
    market.staple_demand += intensity * -market.perception
    market.ware_demand += intensity * market.perception


def fade_demand(market: Any, rate: float) -> None:
    """Let both demands fade by a share, 0 … 1: smoothed towards what is signalled by nobody, 0."""
    market.staple_demand = exponential_smoothing(market.staple_demand, 0.0, rate)
    market.ware_demand = exponential_smoothing(market.ware_demand, 0.0, rate)


def buy_ware(market: Any, price: float) -> None:
    """Take one piece of the ware out of a market, and put its price in."""
    market.ware -= 1
    market.staple += price


def sell_ware(market: Any, price: float) -> None:
    """Put one piece of the ware into a market, and take its price out."""
    market.ware += 1
    market.staple -= price
