"""Messages: against a plain account of mailboxes, at both speeds; births, deaths, growth."""

import numpy as np
import pytest

from socialmind import (
    Agent,
    Message,
    Messages,
    Model,
    ModelError,
    Population,
    SocialmindError,
    each,
    parameter,
)


class Human(Agent):
    log: int = 0
    read: int = 0
    lowest: float = 0.0
    sent: int = 0


class Offer(Message):
    price: float = 0.0


class Farewell(Message):
    age: int = 0


def read(human, model, rng):
    for offer in model.offers.to(human):
        human.log = (human.log * 31 + offer.sender * 7 + offer.recipient + offer.id) % 1000003
        human.read += 1
        if offer.price < 0.3:
            continue
        if rng.random() < 0.6:
            offer.die()
        if offer.price > 0.9:
            if model.humans.contains(offer.sender):
                answer = model.offers.send(human, model.humans[offer.sender])
                answer.price = offer.price / 2
                human.sent += 1
            break
    human.lowest = min((offer.price for offer in model.offers.to(human)), default=-1.0)
    for farewell in model.farewells.to(human):
        human.log += farewell.age
        farewell.die()


def write(human, model, rng):
    if rng.random() < 0.7:
        offer = model.offers.send(human, model.humans.one_of(rng))
        offer.price = rng.random()
        human.sent += 1
    draw = rng.random()
    if draw < model.mortal:
        heir = model.humans.one_of(rng)
        farewell = model.farewells.send(human, heir)
        farewell.age = model.tick
        human.die()
    elif draw < 2 * model.mortal:
        human.hatch()


class Letters(Model):
    mortal: float = parameter(0.1)
    humans = Population(Human, 8)
    offers = Messages(Offer, to=humans)
    farewells = Messages(Farewell, to=humans)
    schedule = (each(humans, read), each(humans, write))


def content(model):
    return {
        (name, column): table.columns[column][table.slots]
        for name, table in model.tables.items()
        for column in table.dtype.names
    }


def assert_same(one, other):
    for name, column in content(one).items():
        np.testing.assert_array_equal(column, content(other)[name], err_msg=str(name))


def test_both_speeds_give_the_same():
    fast, slow = Letters(seed=2), Letters(seed=2, compiled=False)
    for _ in range(6):
        for model in (fast, slow):
            model.advance(10)
        assert_same(fast, slow)
    assert len(slow.humans) > 1
    assert slow.humans.read.sum() > 100
    again = Letters(seed=2)
    again.restore(slow.state())
    for model in (again, slow):
        model.advance(10)
    assert_same(again, slow)


def test_mailboxes_hold_what_was_sent_in_order_until_it_is_read():
    model = Letters(seed=7, compiled=False)
    for _ in range(40):
        model.advance(1)
        living = set(model.humans.id.tolist())
        expected = {identity: [] for identity in living}
        for offer in model.offers:
            assert offer.recipient in living
            expected[offer.recipient].append(offer.id)
        for human in model.humans:
            assert [offer.id for offer in model.offers.to(human)] == expected[human.id]
        assert sum(map(len, expected.values())) == len(model.offers)


# By hand ----------------------------------------------------------------------------------------


class Clerk(Agent):
    got: int = 0
    got_in: int = -1


def post(clerk, model):
    if clerk.id == model.writer and model.tick == 0:
        for k in range(3):
            note = model.notes.send(clerk, model.clerks[1])
            note.age = k + 1
    for note in model.notes.to(clerk):
        clerk.got = clerk.got * 10 + note.age
        clerk.got_in = model.tick
        note.die()


def leave(clerk, model):
    if clerk.id == 1 and model.tick == model.leaves:
        clerk.die()


class Office(Model):
    writer: int = parameter(0)
    leaves: int = parameter(99)
    clerks = Population(Clerk, 3)
    notes = Messages(Farewell, to=clerks)
    schedule = (each(clerks, post, shuffled=False), each(clerks, leave))


@pytest.mark.parametrize("writer", [0, 2])
def test_messages_arrive_in_the_next_tick_whoever_acts_first(writer):
    office = Office(compiled=False, writer=writer)
    office.advance(1)
    assert office.clerks.got.tolist() == [0, 0, 0]
    assert [note.age for note in office.notes.to(office.clerks[1])] == [1, 2, 3]
    office.advance(1)
    assert office.clerks.got.tolist() == [0, 123, 0]
    assert office.clerks.got_in.tolist() == [-1, 1, -1]
    assert len(office.notes) == 0


def test_messages_to_the_dead_vanish():
    office = Office(compiled=False, leaves=0)
    office.advance(1)
    assert len(office.notes) == 0
    office.advance(2)


def test_they_can_be_sent_from_outside():
    office = Office(compiled=False, writer=9)
    clerks = office.clerks
    office.notes.send(clerks[0], clerks[2]).age = 5
    office.advance(2)
    assert clerks.got.tolist() == [0, 0, 5]
    with pytest.raises(SocialmindError, match="3 as the recipient of a message of 'notes'; expect"):
        office.notes.send(clerks[0], 3)


def test_a_message_after_the_death_of_its_recipient_from_outside_harms_nobody():
    office = Office(compiled=False)
    office.advance(1)
    office.clerks[1].die()
    again = Office(compiled=False)
    again.restore(office.state())
    again.advance(2)
    assert len(again.notes) == 0


# What is refused --------------------------------------------------------------------------------


def no_recipient(clerk, model):
    model.notes.send(clerk)


def creates(clerk, model):
    model.notes.create()


def as_value(clerk, model):
    model.notes.to(clerk)


def of_nobody(clerk, model):
    for note in model.notes.to(3):
        note.die()


def of_agent(clerk, model):
    clerk.send(model.clerks[0])


@pytest.mark.parametrize(
    ("rule", "found"),
    [
        (of_agent, "send.. of an agent of 'clerks'; declare `offers = Messages.Offer, to=clerks.`"),
        (no_recipient, "send.. of the messages 'notes' like this; expected an agent that sends, a"),
        (creates, r"create.. of the messages 'notes' like this; expected .*; write message = mode"),
        (as_value, r"to\(\) as a value; write `for message in model.notes.to\(agent\):`"),
        (of_nobody, r"to\(\) like this; expected an agent of 'clerks'; write `for message in mod"),
    ],
)
def test_rules_that_use_them_otherwise_are_refused(rule, found):
    kind = type("Wrong", (Office,), {"schedule": (each(Office.clerks, rule),)})
    with pytest.raises(ModelError, match=rf"test_messages.py:\d+: (found )?{found}"):
        kind(compiled=False)


def test_wrong_declarations_are_refused():
    clerks = Population(Clerk, 3)
    with pytest.raises(ModelError, match="as the messages of 'notes'; expected a class that inher"):
        type("Wrong", (Model,), {"clerks": clerks, "notes": Messages(Clerk, to=clerks)})
    with pytest.raises(ModelError, match="to=3 for the messages 'notes'"):
        type("Wrong", (Model,), {"clerks": clerks, "notes": Messages(Farewell, to=3)})
    with pytest.raises(ModelError, match="messages 'notes' to a population that the class does"):
        type("Wrong", (Model,), {"notes": Messages(Farewell, to=clerks)})
