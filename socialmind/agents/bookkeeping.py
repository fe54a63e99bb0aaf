"""Who is alive: slots, identities and the order of a population, for both speeds.

An agent keeps its slot in the arrays while it lives and its identity for ever. `order` lists the
slots of the living in order of birth; those born in a tick are appended, those who die in it are
taken out, and their slots freed, when the tick is over.
"""

from __future__ import annotations

from typing import Any

from numba.extending import register_jitable

COUNT = 0
ENTRIES = 1
ALIVE = 2
NEXT_ID = 3
FREE = 4
GONE = 5
GONE_SCORE = 6
SIZE = 8
"""Places in a population's counters: who acts in this tick, entries in the order, the living, the
next identity, free slots; of robots how many have died, and their scores' sum, the bits of a float;
and how many places there are."""


class NoRoomError(Exception):
    """More agents were born in one tick than the arrays hold; the model makes room and goes on."""


@register_jitable
def born(counters: Any, order: Any, alive: Any, slot_of: Any, free: Any) -> int:
    """Take a slot for a new agent, with the next identity; return −1 when there is no room."""
    identity = counters[NEXT_ID]
    if counters[FREE] == 0 or identity >= len(slot_of):
        return -1
    counters[FREE] -= 1
    slot = free[counters[FREE]]
    order[counters[ENTRIES]] = slot
    alive[slot] = True
    slot_of[identity] = slot
    counters[ENTRIES] += 1
    counters[ALIVE] += 1
    counters[NEXT_ID] += 1
    return slot


@register_jitable
def died(counters: Any, alive: Any, slot_of: Any, slot: int, identity: int) -> None:
    """Mark an agent as dead; its slot is free when the tick is over."""
    alive[slot] = False
    slot_of[identity] = -1
    counters[ALIVE] -= 1


@register_jitable
def settle(counters: Any, order: Any, alive: Any, free: Any) -> None:
    """End a tick: the dead leave the order and free their slots, the new-born act from now on."""
    if counters[ALIVE] != counters[ENTRIES]:
        kept = 0
        for place in range(counters[ENTRIES]):
            slot = order[place]
            if alive[slot]:
                order[kept] = slot
                kept += 1
            else:
                free[counters[FREE]] = slot
                counters[FREE] += 1
        counters[ENTRIES] = kept
    counters[COUNT] = counters[ENTRIES]


MARGIN = 64
"""How many more births than there are agents a tick has room for."""


@register_jitable
def short_of_slots(counters: Any) -> bool:
    """Say whether a tick could bring more births than there are free slots, within reason."""
    return counters[FREE] < counters[COUNT] + MARGIN


@register_jitable
def short_of_identities(counters: Any, slot_of: Any) -> bool:
    """Say whether a tick could bring more births than identities can be known, within reason."""
    return len(slot_of) - counters[NEXT_ID] < counters[COUNT] + MARGIN


@register_jitable
def short_of_room(counters: Any, slot_of: Any) -> bool:
    """Say whether a tick could bring more births than there is room for, within reason."""
    return short_of_slots(counters) or short_of_identities(counters, slot_of)


@register_jitable
def slot_of_agent(slot_of: Any, identity: int) -> int:
    """Return the slot of a living agent; raise for any other identity."""
    if identity < 0 or identity >= len(slot_of) or slot_of[identity] < 0:
        raise IndexError("no living agent has this identity")
    return slot_of[identity]


@register_jitable
def is_living(slot_of: Any, identity: int) -> bool:
    """Say whether an agent of this identity lives."""
    return 0 <= identity < len(slot_of) and slot_of[identity] >= 0


@register_jitable
def nth_living(counters: Any, order: Any, alive: Any, place: int) -> int:
    """Return the slot of the living agent at a place in the order of birth."""
    if counters[ALIVE] == counters[ENTRIES]:
        return order[place]
    for entry in range(counters[ENTRIES]):
        slot = order[entry]
        if alive[slot]:
            if place == 0:
                return slot
            place -= 1
    return -1
