"""Who is linked with whom: lists of links over the rows of a network, for both speeds.

Each agent has a list of its links, in the order of their birth, which is that of their identities;
in networks whose sources are told from their targets it has two. A list lies in one piece in an
array that all share, so that walking through it waits for no memory, and moves to where there is
more room when it is full. The lists are a function of the network's rows; `built` makes them anew.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

BEGIN, DEGREE, ROOM = 0, 1, 2
"""What the head of an agent's list holds: where it begins, how many there are, how many may be."""
LINK, SLOT, AGENT = 0, 1, 2
"""What a list holds of a link: its identity, its slot, and the slot of the agent at its other end.
The first row of all says where the free room begins, and how many links the lists hold."""
LEAST = 4
"""Room for so many links when an agent gets its first."""
AT_FIRST = 4096
"""Room for so many links at most, 16 an agent, before there are any: rules may make all at once."""


@register_jitable
def tie(heads: Any, ties: Any, agent: int, link: int, slot: int, other: int) -> bool:
    """Append a link to an agent's list; say whether there was room.

    Args:
        heads: the heads of the lists.
        ties: the array that they lie in.
        agent: the slot of the agent.
        link: the link's identity, beyond those in the list.
        slot: the link's.
        other: that of the agent at the other end.
    """
    degree = heads[agent, DEGREE]
    if degree == heads[agent, ROOM]:
        room = max(LEAST, 2 * degree)
        top = ties[0, 0]
        if top + room > len(ties):
            return False
        before = heads[agent, BEGIN]
        for place in range(degree):
            for part in range(3):
                ties[top + place, part] = ties[before + place, part]
        heads[agent, BEGIN] = top
        heads[agent, ROOM] = room
        ties[0, 0] = top + room
    place = heads[agent, BEGIN] + degree
    ties[place, LINK] = link
    ties[place, SLOT] = slot
    ties[place, AGENT] = other
    heads[agent, DEGREE] = degree + 1
    ties[0, 1] += 1
    return True


@register_jitable
def place_of(heads: Any, ties: Any, agent: int, link: int) -> int:
    """Return where the first link of an agent lies with this identity or a later one."""
    low = heads[agent, BEGIN]
    high = low + heads[agent, DEGREE]
    while low < high:
        middle = (low + high) // 2
        if ties[middle, LINK] < link:
            low = middle + 1
        else:
            high = middle
    return low


@register_jitable
def untie(heads: Any, ties: Any, agent: int, link: int) -> None:
    """Take a link out of an agent's list; the others keep their order."""
    last = heads[agent, BEGIN] + heads[agent, DEGREE] - 1
    for place in range(place_of(heads, ties, agent, link), last):
        for part in range(3):
            ties[place, part] = ties[place + 1, part]
    heads[agent, DEGREE] -= 1
    ties[0, 1] -= 1


@register_jitable
def step(heads: Any, ties: Any, agent: int, at: int, last: int, born: int) -> int:
    """Return the number of the next link in a walk through an agent's list, or −1 at its end.

    The list may have changed since: links that have ended are passed over, new ones are not met.

    Args:
        heads: the heads of the lists.
        ties: the array that they lie in.
        agent: the slot of the agent.
        at: the number of the last link met, −1 at the begin.
        last: its identity.
        born: the first identity of those born since the begin.
    """
    begin, degree = heads[agent, BEGIN], heads[agent, DEGREE]
    if at < 0:
        at = 0
    elif at < degree and ties[begin + at, LINK] == last:
        at += 1
    else:
        at = place_of(heads, ties, agent, last + 1) - begin
    if at >= degree or ties[begin + at, LINK] >= born:
        return -1
    return at


@register_jitable
def link_between(
    heads_out: Any, ties_out: Any, heads_in: Any, ties_in: Any, one: int, other: int
) -> int:
    """Return the slot of the link between two agents, by their slots, or −1; the short list tells.

    Args:
        heads_out: the heads of the lists of sources.
        ties_out: the array that these lie in.
        heads_in: the heads of those of targets; the same where they are not told apart.
        ties_in: likewise.
        one: the slot of the source.
        other: the slot of the target.
    """
    if heads_out[one, DEGREE] <= heads_in[other, DEGREE]:
        heads, ties, agent, sought = heads_out, ties_out, one, other
    else:
        heads, ties, agent, sought = heads_in, ties_in, other, one
    begin = heads[agent, BEGIN]
    for place in range(begin, begin + heads[agent, DEGREE]):
        if ties[place, AGENT] == sought:
            return ties[place, SLOT]
    return -1


@register_jitable
def short_of_space(ties: Any) -> bool:
    """Say whether a tick could bring more links than the lists have room for, within reason."""
    return len(ties) - ties[0, 0] < ties[0, 1] // 4 + 64


def built(
    agents: NDArray[np.int64],
    links: NDArray[np.int64],
    slots: NDArray[np.int64],
    others: NDArray[np.int64],
    count: int,
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the heads of the lists of so many agents, and the array that they lie in.

    Args:
        agents: for each entry of a list the slot of its agent; in order of the links' birth.
        links: the identity of its link.
        slots: the slot of that.
        others: the slot of the agent at the other end.
        count: how many agents there are.

    >>> heads, ties = built(*map(np.array, ([0, 1, 0], [5, 5, 8], [1, 1, 0], [1, 0, 2])), 3)
    >>> heads[:, DEGREE].tolist(), ties[heads[0, BEGIN] :][:2].tolist()
    ([2, 1, 0], [[5, 1, 1], [8, 0, 2]])
    """
    degree = np.bincount(agents, minlength=count).astype(np.int64)
    room = np.where(degree > 0, np.maximum(LEAST, degree + degree // 2), 0)
    begin = 1 + np.cumsum(room) - room
    top = 1 + int(room.sum())
    free = len(agents) + LEAST * count + min(16 * count, 4 * AT_FIRST) + 256
    ties = np.zeros((top + free, 3), np.int64)
    ties[0, :2] = top, len(agents)
    sorting = np.argsort(agents, kind="stable")
    before = np.cumsum(degree) - degree
    sorted_agents = agents[sorting]
    places = begin[sorted_agents] + np.arange(len(agents)) - before[sorted_agents]
    for part, values in ((LINK, links), (SLOT, slots), (AGENT, others)):
        ties[places, part] = values[sorting]
    return np.column_stack([begin, degree, room]), ties
