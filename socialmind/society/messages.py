"""Messages that agents send each other: a population whose agents are messages.

AGR's (Ferber, Gutknecht and Michel 2003; thesis, section 2.5.2): agents write to each other, each
has a mailbox and reads it when it acts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from coglogo_py.border.errors import shown
from socialmind.agents.message import NEXT, Message, deliver, first_message, vanish
from socialmind.errors import ModelError, SocialmindError
from socialmind.language.shape import PopulationShape
from socialmind.society.population import Population
from socialmind.society.table import Table


class Messages(Population):
    """The declaration of messages to the agents of a population, as an attribute of a model.

    Args:
        message: the annotated class of the messages, which inherits from `Message`.
        to: the population to whose agents they go, as declared in the same class.
    """

    def __init__(self, message: type, to: Population) -> None:
        super().__init__(message, 0)
        self.to = to

    def check(self) -> None:
        """Refuse messages that are none, and recipients that are no population.

        Raises:
            ModelError: so it is.
        """
        if not (isinstance(self.agent, type) and issubclass(self.agent, Message)):
            raise ModelError(
                f"{shown(self.agent)} as the messages of {self.name!r}",
                "a class that inherits from socialmind.Message",
                "write class Offer(Message): …",
            )
        if not isinstance(self.to, Population) or isinstance(self.to, Messages):
            raise ModelError(
                f"to={shown(self.to)} for the messages {self.name!r}",
                "a population of the class, as declared above",
            )
        super().check()

    @property
    def shape(self) -> PopulationShape:
        """What rules may know of the messages."""
        return replace(super().shape, messages_to=self.to.name)


class MessageTable(Table):
    """The messages of a running society: a population that is sent and read."""

    def send(self, sender: Any, recipient: Any) -> Any:
        """Return a message from an agent to another, to be filled; it arrives in the next tick."""
        to = getattr(recipient, "_table", None)
        if to is not self.model.tables[str(self.shape.messages_to)]:
            raise SocialmindError(
                f"{shown(recipient)} as the recipient of a message of {self.shape.name!r}; "
                f"expected an agent of {self.shape.messages_to!r}"
            )
        message = self.create()
        message.sender, message.recipient = sender.id, recipient.id
        return message

    def to(self, recipient: Any) -> Iterator[Any]:
        """Yield the messages that have arrived for an agent and are left, in order of arrival."""
        slot = recipient._table.columns[first_message(self.shape.name)].item(recipient._slot)
        while slot >= 0:
            here, slot = slot, self.columns[NEXT].item(slot)
            if self.alive[here]:
                yield self.row_class(self, here)


def with_mailboxes(shapes: Mapping[str, PopulationShape]) -> dict[str, PopulationShape]:
    """Return populations, those that get messages with their mailboxes, which no child inherits."""
    made = dict(shapes)
    for name, one in shapes.items():
        if one.messages_to is not None:
            to = made[one.messages_to]
            own = (*to.own, first_message(name))
            made[to.name] = replace(to, mailboxes=(*to.mailboxes, name), own=own)
    return made


def messages_of(tables: Mapping[str, Any]) -> Iterator[tuple[Any, Any]]:
    """Yield the tables of messages, each with that of its recipients."""
    for table in tables.values():
        if table.shape.messages_to is not None:
            yield table, tables[table.shape.messages_to]


def let_vanish(tables: Mapping[str, Any]) -> None:
    """Let messages to the dead vanish, at the end of a tick."""
    for table, to in messages_of(tables):
        columns = table.columns
        vanish(
            table.counters, table.order, table.alive, table.slot_of,
            columns["_id"], columns["recipient"], to.slot_of,
        )  # fmt: skip


def fill_mailboxes(tables: Mapping[str, Any]) -> None:
    """Let messages reach the mailboxes of their recipients, once all tables have settled."""
    for table, to in messages_of(tables):
        deliver(
            table.counters, table.order, table.alive, table.columns[NEXT],
            table.columns["recipient"], to.counters, to.order, to.slot_of,
            to.columns[first_message(table.shape.name)],
        )  # fmt: skip
