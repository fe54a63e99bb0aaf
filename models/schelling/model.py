"""Schelling's segregation: who wants a few neighbours of its own kind leaves, and kinds part.

Schelling (1971), by the rules of the public comparison of agent-based frameworks
(DOI 10.5281/zenodo.8016506).
"""

from socialmind import Agent, Grid, Looks, Model, Population, each, parameter


class Person(Agent):
    """A person: its kind, 0 or 1, and whether it is content where it lives."""

    kind: int = 0
    happy: bool = False


def arrive(person, model, rng):
    """Take a free place; every other person is of the second kind."""
    person.kind = person.id % 2
    move(person, model, rng)


def settle(person, model, rng):
    """Stay among enough neighbours of one's kind, or move to any free place."""
    alike = sum(
        1 for other in model.people.neighbours(person, model.radius) if other.kind == person.kind
    )
    person.happy = alike >= model.minimum
    if not person.happy:
        move(person, model, rng)


def move(person, model, rng):
    """Move to any free place."""
    place = model.world.one_free(rng)
    model.world.move_to(person, place.x, place.y)


def mix(society, rng):
    """Let everybody change its kind or not, by chance."""
    for person in society.people:
        person.kind = rng.integers(2)


class Schelling(Model):
    """Who wants a few neighbours of its own kind leaves, and kinds part (Schelling 1971)."""

    ticks = 20

    n_agents: int = parameter(1000, unit="persons", low=0, doc="persons, half of each kind")
    world_size: int = parameter(40, unit="patches", low=1, high=20_000, doc="side of the world")
    radius: int = parameter(1, unit="patches", low=1, doc="how far a person looks")
    minimum: int = parameter(3, unit="persons", low=0, doc="neighbours of its kind that it wants")

    world = Grid("world_size", "world_size", wraps=False, one_per_patch=True)
    people = Population(Person, "n_agents")
    setup = (each(people, arrive),)
    schedule = (each(people, settle),)
    buttons = {"Mix the kinds": mix}

    def series(self):
        """Return how many are content."""
        return {"happy": int(self.people.happy.sum()), "people": len(self.people)}

    def looks(self):
        """Return persons in the colour of their kind, smaller where they are not content."""
        kinds = {"one kind": "blue", "the other": "gold"}
        people = self.people
        return {"people": Looks("person", kinds, people.kind, size=0.75 + 0.35 * people.happy)}
