"""A travel agency: brokers bring clients and professionals together, who bargain by numbers.

Agents, groups and roles as in AGR (Gutknecht 2001; thesis, section 2.5.2, figure 2.33). What an
agent does follows from the roles that it plays; a contract is a group of its own.
"""

import numpy as np

from socialmind import Agent, Model, Population, each, once, parameter
from socialmind.observation import mind_columns

BROKER, CLIENT, PROFESSIONAL = 0, 1, 2  # whom one is, which never changes
LEAST_VALUE, LARGEST_VALUE = 50.0, 150.0  # what a journey is worth to a client
LEAST_COST, LARGEST_COST = 30.0, 130.0  # what it costs a professional
LEAST_SOFTNESS, LARGEST_SOFTNESS = 0.05, 0.25  # share of the way to the limit given in a round


class Person(Agent):
    """Somebody in the trade: a request or an offer, and the number said last in bargaining."""

    kind: int = BROKER
    open: bool = False  # whether there is a request, or an offer
    journey: int = 0  # where to
    limit: float = 0.0  # the reservation price: most that a buyer pays, least that a seller takes
    softness: float = 0.0  # how fast one gives way
    asked: float = 0.0  # what an offer is advertised at
    number: float = 0.0  # said last to the partner
    partner: int | None = None
    broker: int | None = None  # who brought them together
    rounds: int = 0
    waited: int = 0  # since the request or offer was made
    contracts: int = 0


# Setup ------------------------------------------------------------------------------------------


def open_agencies(model, rng):
    """Let brokers found or join the two groups, and clients and professionals come."""
    for broker in model.people:
        broker.kind = BROKER
        if broker.id == 0 or model.apart:
            broker.mind.create_and_join_group("Customers", "Broker")
            broker.mind.create_and_join_group("Professionals", "Broker")
        else:
            first = model.people[0].mind
            broker.mind.join_group("Customers", "Broker", first.get_group_id("Customers"))
            broker.mind.join_group("Professionals", "Broker", first.get_group_id("Professionals"))
    for _ in range(model.n_clients):
        client = come(CLIENT, model, rng)
        agency = model.people[rng.integers(model.n_brokers)].mind
        client.mind.join_group("Customers", "Client", agency.get_group_id("Customers"))
    for _ in range(model.n_professionals):
        professional = come(PROFESSIONAL, model, rng)
        agency = model.people[rng.integers(model.n_brokers)].mind
        group = agency.get_group_id("Professionals")
        professional.mind.join_group("Professionals", "Provider", group)


def come(kind, model, rng):
    """Return somebody new."""
    person = model.people.create()
    person.kind = kind
    person.softness = rng.uniform(LEAST_SOFTNESS, LARGEST_SOFTNESS)
    return person


# A tick -----------------------------------------------------------------------------------------


def act(person, model, rng):
    """Do what one's roles ask for."""
    if person.open:
        person.waited += 1
    person.plan = person.mind.choose_next_plan()
    person.run_plan(model, rng)


def request(client, model, rng):
    """Wish for a journey now and then; give the wish up after waiting in vain."""
    if not client.open:
        if rng.random() < model.request_rate:
            client.open = True
            client.waited = 0
            client.journey = rng.integers(model.n_journeys)
            client.limit = rng.uniform(LEAST_VALUE, LARGEST_VALUE)
            model.requests += 1
    elif client.waited > model.waiting:
        client.open = False
        model.withdrawn += 1


def offer(professional, model, rng):
    """Have a journey to offer."""
    if not professional.open:
        professional.open = True
        professional.waited = 0
        professional.journey = rng.integers(model.n_journeys)
        professional.limit = rng.uniform(LEAST_COST, LARGEST_COST)
        professional.asked = professional.limit * (1 + model.opening)


def match(broker, model, rng):
    """Take a client's request, and bring the client to whoever asks least for that journey."""
    client = rng.choice(
        one
        for one in model.people
        if one.kind == CLIENT and is_free(one) and same_group(one, broker, "Customers")
    )
    if client is not None:
        professional = min(
            (
                one
                for one in model.people
                if one.kind == PROFESSIONAL
                and is_free(one)
                and one.journey == client.journey
                and same_group(one, broker, "Professionals")
            ),
            key=lambda one: one.asked,
            default=None,
        )
        if professional is not None:
            bring_together(client, professional, broker, model)


def is_free(person):
    """Say whether somebody has a request or an offer and bargains with nobody."""
    return person.open and person.partner is None


def same_group(one, other, group):
    """Say whether two are in the same instance of a group."""
    return one.mind.get_group_id(group) == other.mind.get_group_id(group)


def bring_together(client, professional, broker, model):
    """Form a contract group of a buyer and a seller, who say their first numbers."""
    client.mind.create_and_join_group("Contract", "Buyer")
    professional.mind.join_group("Contract", "Seller", client.mind.get_group_id("Contract"))
    client.partner = professional.id
    professional.partner = client.id
    client.broker = broker.id
    client.number = client.limit * (1 - model.opening)
    professional.number = professional.asked
    client.rounds = 0
    professional.rounds = 0
    model.introduced += 1


# Bargaining -------------------------------------------------------------------------------------


def bid(buyer, model):
    """Say a higher number; take the seller's if it is no more."""
    seller = model.people[buyer.partner]
    give_way(buyer)
    if buyer.number >= seller.number:
        sign(buyer, seller, seller.number, model)
    elif buyer.rounds >= model.patience:
        part(buyer, seller)
        model.broken += 1


def ask(seller, model):
    """Say a lower number; take the buyer's if it is no less."""
    buyer = model.people[seller.partner]
    give_way(seller)
    if seller.number <= buyer.number:
        sign(buyer, seller, buyer.number, model)
    elif seller.rounds >= model.patience:
        part(buyer, seller)
        model.broken += 1


def give_way(person):
    """Move the number towards one's limit, never beyond it."""
    person.number += person.softness * (person.limit - person.number)
    person.rounds += 1


def sign(buyer, seller, price, model):
    """Agree on a price: request and offer are done with."""
    model.contracts += 1
    model.paid += price
    model.buyers_gain += buyer.limit - price
    model.sellers_gain += price - seller.limit
    model.waited += buyer.waited
    buyer.contracts += 1
    seller.contracts += 1
    model.people[buyer.broker].contracts += 1
    buyer.open = False
    seller.open = False
    part(buyer, seller)


def part(buyer, seller):
    """Leave the contract group, which dissolves."""
    buyer.mind.leave_group("Contract")
    seller.mind.leave_group("Contract")
    buyer.partner = None
    seller.partner = None
    buyer.broker = None


class TravelAgency(Model):
    """Brokers of a travel agency bring clients and professionals together, who bargain."""

    ticks = 2_000

    n_brokers: int = parameter(3, unit="brokers", low=1, high=1_000, doc="travel agents")
    n_clients: int = parameter(60, unit="clients", low=0, high=10_000, doc="customers")
    n_professionals: int = parameter(
        40, unit="professionals", low=0, high=10_000, doc="those who offer journeys"
    )
    apart: bool = parameter(False, doc="whether each broker has groups of its own")
    n_journeys: int = parameter(5, unit="journeys", low=1, high=1_000, doc="kinds of journeys")
    request_rate: float = parameter(
        0.02, unit="chance a tick", low=0.0, high=1.0, doc="a client without request has one"
    )
    waiting: int = parameter(
        100, unit="ticks", low=0, high=100_000, doc="how long a client waits for a contract"
    )
    opening: float = parameter(
        0.5, unit="share of the limit", low=0.0, high=1.0, doc="how far off bargaining begins"
    )
    patience: int = parameter(
        20, unit="rounds", low=1, high=10_000, doc="rounds until one breaks off"
    )

    # Since the start.
    requests: int = 0
    withdrawn: int = 0
    introduced: int = 0
    contracts: int = 0
    broken: int = 0
    paid: float = 0.0
    buyers_gain: float = 0.0
    sellers_gain: float = 0.0
    waited: int = 0

    people = Population(
        Person,
        "n_brokers",
        mind="scheme.yaml",
        plans={"Request": request, "Offer": offer, "Match": match, "Bid": bid, "Ask": ask},
    )

    setup = (once(open_agencies),)
    schedule = (each(people, act),)

    def series(self):
        """Return what was asked for, agreed and given up, at what prices."""
        signed = max(self.contracts, 1)
        return {
            "requests": int(self.requests),
            "withdrawn": int(self.withdrawn),
            "introduced": int(self.introduced),
            "contracts": int(self.contracts),
            "broken": int(self.broken),
            "open_requests": int((self.people.open & (self.people.kind == CLIENT)).sum()),
            "open_offers": int((self.people.open & (self.people.kind == PROFESSIONAL)).sum()),
            "price": self.paid / signed,
            "buyers_gain": self.buyers_gain / signed,
            "sellers_gain": self.sellers_gain / signed,
            "waited": self.waited / signed,
        }

    def agents(self):
        """Return each person's part in the trade, and mind."""
        people = self.people
        return {
            "agent": people.id,
            "kind": people.kind,
            "plan": self.plans(people),
            "open": people.open,
            "journey": people.journey,
            "limit": people.limit,
            "number": people.number,
            "contract": np.array([one.mind.get_group_id("Contract") for one in people]),
            "contracts": people.contracts,
            **mind_columns(people),
        }
