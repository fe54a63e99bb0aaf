"""Who is linked with whom: lists of links over the rows of a network, for both speeds.

A link has two halves, one for each of its ends: of the link in slot s, half 2s is its source's and
half 2s + 1 its target's. Each agent has a list of its halves, in the order of the links' birth; in
networks whose sources are told from their targets it has two. Taking a half out keeps the order of
the others, so the lists are a function of the network's rows, and `built` makes them anew.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

FIRST, LAST, DEGREE = 0, 1, 2
"""What the head of an agent's list holds: its first and last half, −1 in none; how many."""
NEXT, PREVIOUS, AGENT, LINK = 0, 1, 2, 3
"""What a half holds: the next and the previous one of its list, −1 for none; its agent's slot; the
link's identity. Both halves of a link are a cache line."""


@register_jitable
def tie(heads: Any, halves: Any, half: int, agent: int, link: int) -> None:
    """Append a half of a link, by its identity, to the list of the agent in a slot."""
    last = heads[agent, LAST]
    halves[half, NEXT] = -1
    halves[half, PREVIOUS] = last
    halves[half, AGENT] = agent
    halves[half, LINK] = link
    if last < 0:
        heads[agent, FIRST] = half
    else:
        halves[last, NEXT] = half
    heads[agent, LAST] = half
    heads[agent, DEGREE] += 1


@register_jitable
def untie(heads: Any, halves: Any, half: int) -> None:
    """Take a half out of its list.

    It still knows the next one: who is there in a walk through the list goes on from it.
    """
    agent = halves[half, AGENT]
    after, before = halves[half, NEXT], halves[half, PREVIOUS]
    if before < 0:
        heads[agent, FIRST] = after
    else:
        halves[before, NEXT] = after
    if after < 0:
        heads[agent, LAST] = before
    else:
        halves[after, PREVIOUS] = before
    heads[agent, DEGREE] -= 1


@register_jitable
def link_between(heads_out: Any, heads_in: Any, halves: Any, one: int, other: int) -> int:
    """Return the slot of the link between two agents, by their slots, or −1; the short list tells.

    Args:
        heads_out: the lists of sources.
        heads_in: the lists of targets; the same where they are not told apart.
        halves: the halves.
        one: the slot of the source.
        other: the slot of the target.
    """
    if heads_out[one, DEGREE] <= heads_in[other, DEGREE]:
        half, sought = heads_out[one, FIRST], other
    else:
        half, sought = heads_in[other, FIRST], one
    while half >= 0:
        if halves[half ^ 1, AGENT] == sought:
            return half >> 1
        half = halves[half, NEXT]
    return -1


@register_jitable
def nth(heads: Any, halves: Any, agent: int, place: int) -> int:
    """Return the half at a place in the list of the agent in a slot; −1 behind its end."""
    half = heads[agent, FIRST]
    while place > 0 and half >= 0:
        half = halves[half, NEXT]
        place -= 1
    return half


def no_lists(agents: int) -> NDArray[np.int64]:
    """Return the heads of so many empty lists."""
    return np.tile(np.array([-1, -1, 0], np.int64), (agents, 1))


def built(
    heads: NDArray[np.int64],
    halves: NDArray[np.int64],
    which: NDArray[np.int64],
    agents: NDArray[np.int64],
    links: NDArray[np.int64],
) -> None:
    """Fill empty lists with halves.

    Args:
        heads: the heads of the lists, all empty.
        halves: the halves; those of other lists stay.
        which: the numbers of those that go in, in order.
        agents: the slot of each one's agent.
        links: the identity of each one's link.

    >>> heads, halves = no_lists(3), np.zeros((4, 4), np.int64)
    >>> built(heads, halves, np.arange(4), np.array([0, 1, 0, 2]), np.array([0, 0, 1, 1]))
    >>> heads.tolist(), halves[:, NEXT].tolist()
    ([[0, 2, 2], [1, 1, 1], [3, 3, 1]], [2, -1, -1, -1])
    """
    if not len(which):
        return
    sorting = np.argsort(agents, kind="stable")
    half, agent = which[sorting], agents[sorting]
    starts = np.flatnonzero(np.concatenate([[True], agent[1:] != agent[:-1]]))
    ends = np.append(starts[1:], len(agent)) - 1
    after, before = np.append(half[1:], -1), np.append(-1, half[:-1])
    after[ends] = -1
    before[starts] = -1
    halves[half, NEXT], halves[half, PREVIOUS], halves[half, AGENT] = after, before, agent
    halves[half, LINK] = links[sorting]
    heads[agent[starts]] = np.column_stack([half[starts], half[ends], ends - starts + 1])
