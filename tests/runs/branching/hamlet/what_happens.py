"""What tests let happen to the hamlet."""

HARVEST = 2.5


def famine(society, rng):
    society.people.grain *= [rng.random() for _ in society.people]


def gift(society):
    society.people.grain += HARVEST


def move_minds(society):
    for person in society.people:
        if person.id % 2 == 0:
            person.mind.set_cogniton_value("greed", 9.0)
            person.mind.set_culturon_value("guild", "custom", 5.0)


def exodus(society):
    for person in list(society.people)[1:3]:
        person.die()


def fails(society):
    society.people.grain = [1.0]
