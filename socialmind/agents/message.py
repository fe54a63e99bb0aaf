"""Messages as rows, and how they reach the mailbox of their recipient, for both speeds.

A mailbox is a chain: a recipient's row holds the slot of the first message to it, and each message
that of the next, in the order in which they were sent. The chains are made at the end of a tick,
when the dead have left; during a tick they stay as they are.
"""

from __future__ import annotations

from typing import Any

from numba.extending import register_jitable

from socialmind.agents.agent import Agent
from socialmind.agents.bookkeeping import ENTRIES, died, is_living

NEXT = "_next"
"""The column of a message that holds the slot of the next one in its mailbox, or -1."""


def first_message(messages: str) -> str:
    """Return the column of a recipient that holds the slot of its first message, or -1."""
    return f"_first_{messages}"


class Message(Agent):
    """The base of annotated classes that declare what a message says.

    Attributes:
        sender: the identity of the agent that sent it, in its population.
        recipient: the identity of the agent to which it goes.

    >>> class Offer(Message):
    ...     price: float = 0.0
    """

    sender: int = -1
    recipient: int = -1


@register_jitable
def vanish(
    counters: Any, order: Any, alive: Any, slot_of: Any, ids: Any, to: Any, living: Any
) -> None:
    """Let the messages vanish whose recipient does not live; `living` tells slots of recipients."""
    for place in range(counters[ENTRIES]):
        slot = order[place]
        if alive[slot] and not is_living(living, to[slot]):
            died(counters, alive, slot_of, slot, ids[slot])


@register_jitable
def deliver(
    counters: Any,
    order: Any,
    alive: Any,
    following: Any,
    to: Any,
    recipients: Any,
    places: Any,
    living: Any,
    first: Any,
) -> None:
    """Make the mailboxes, once messages and recipients have settled.

    Args:
        counters: of the messages.
        order: their slots in the order in which they were sent.
        alive: whether a message is there, by slot.
        following: the next message, by slot.
        to: the recipient's identity, by slot.
        recipients: the counters of the recipients.
        places: their slots, in order of birth.
        living: their slots by identity.
        first: the first message, by the recipient's slot.
    """
    for place in range(recipients[ENTRIES]):
        first[places[place]] = -1
    for place in range(counters[ENTRIES] - 1, -1, -1):
        slot = order[place]
        if alive[slot] and is_living(living, to[slot]):
            recipient = living[to[slot]]
            following[slot] = first[recipient]
            first[recipient] = slot
