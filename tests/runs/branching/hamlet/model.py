"""A hamlet with all that a branch has to carry on: births, deaths, links, groups, conditions."""

from socialmind import Agent, Link, Model, Network, Population, each, once, parameter


class Person(Agent):
    grain: float = 2.0
    age: int = 0


class Debt(Link):
    owed: float = 0.0


def work(person, model, rng):
    person.grain += model.yields * rng.random()
    person.mind.feed_back_from_plan("work", 1.0)


def trade(person, model, rng):
    other = model.people[0]
    if other.id != person.id and not model.debts.linked(person, other):
        debt = model.debts.link(person, other)
        debt.owed = rng.random()
    person.grain -= 0.1


def feast(person, model, rng):
    person.grain -= rng.random()
    person.mind.feed_back_from_plan("feast", 1.0)


def live(person, model, rng):
    person.age += 1
    person.grain -= 0.3
    if person.mind.get_group_id("guild") < 0 and person.age > 3:
        person.mind.create_and_join_group("guild", "master")
    person.plan = person.mind.choose_next_plan()
    person.run_plan(model, rng)
    if person.grain < -3.0 and person.id > 0:
        person.die()
        return
    if rng.random() < 0.05:
        person.hatch()


def tell(model):
    model.grain = sum(person.grain for person in model.people)


class Hamlet(Model):
    ticks = 40
    record_links = True
    n: int = parameter(6, low=1)
    yields: float = parameter(1.0, low=0.0, high=10.0)
    poverty: float = parameter(0.5)
    grain: float = 0.0
    people = Population(
        Person, "n", mind="scheme.yaml", plans={"work": work, "trade": trade, "feast": feast}
    )
    debts = Network(people, Debt)
    schedule = (each(people, live), once(tell))
