"""Commands of the world and of minds, births and deaths; tried at both speeds.
# ruff: noqa

What plain Python does is not asked here: the commands are the front end's.
"""

FARMING = "Greed"


def the_same_agent(person, model):
    friend = model.persons[3]
    if person is friend:
        person.i = 1
    if person is not friend:
        person.i = 2


def facing(person, model):
    model.world.face(person, 3, -4)
    person.f = model.world.towards(person, 0, 0)


def going_forward(person, model):
    model.world.forward(person, 2.75)
    model.world.right(person, 30)
    model.world.forward(person, -person.j)
    model.world.left(person, 400)


def going_to(person, model):
    model.world.move_to(person, person.x + 50, -person.y * 7)


def walking(person, model):
    model.world.walk_to(person, 3, 3, 1)
    person.b = model.world.is_on(person, 3, 3)


def walking_to_where_one_is(person, model):
    model.world.walk_to(person, person.x, person.y, 0)
    model.world.walk_to(person, person.x, person.y, 1)


def distances(person, model):
    person.f = model.world.distance(person, 4, -4)
    other = model.persons[0]
    person.g = model.world.distance(person, other.x, other.y)


def named_arguments_of_the_world(person, model):
    model.world.walk_to(person, length=1, y=2, x=-1)


def cognitons(person):
    person.mind.set_cogniton_value("Hunger", person.f)
    person.mind.add_to_cogniton_value("Greed", person.i)
    person.g = person.mind.get_cogniton_value("Hunger")
    person.mind.activate_cogniton("Sloth")
    if person.b:
        person.mind.deactivate_cogniton("Means")


def a_mind_in_a_variable(person):
    mind = person.mind
    mind.set_cogniton_value("Hunger", 5)
    person.f = mind.get_cogniton_value("Hunger")


def texts_passed_on(person):
    _double(person, "Hunger")
    _double(person, FARMING)
    _double(person, name="Hunger")


def _double(person, name):
    person.mind.set_cogniton_value(name, 2 * person.mind.get_cogniton_value(name))


def deciding(person, model, rng):
    person.plan = person.mind.choose_next_plan()
    person.run_plan(model, rng)


def keeping_a_decision(person, model, rng):
    plan = person.mind.choose_next_plan()
    if plan is None:
        person.i = -1
    elif plan == "grow":
        person.i = 1
    if plan != "trade":
        person.plan = plan
    person.mind.feed_back_from_plan("grow", 0.5)
    if person.plan is not None:
        person.mind.feed_back_from_plan(person.plan, 0.25)


def setting_plans(person, model, rng):
    if person.b:
        person.plan = "trade"
    else:
        person.plan = None
    person.run_plan(model, rng)
    person.c = person.plan == "trade"
    person.b = person.plan != model.persons[0].plan
    if person.plan in ("trade", "grow"):
        person.i += 1


def founding_groups(person):
    if person.id == 0:
        person.b = person.mind.create_and_join_group("Family", "Parent")
        person.i = person.mind.get_group_id("Family")


def joining_groups(person, model):
    family = model.persons[0].mind.get_group_id("Family")
    if person.id > 0 and family >= 0:
        person.c = person.mind.join_group("Family", "Child", family)
    person.mind.set_participation("Family", 0.5)
    person.mind.add_to_participation("Family", 0.25)
    person.f = person.mind.get_participation("Family")
    person.j = person.mind.get_group_role_id("Family", "Child")


def culturons(person, model, rng):
    if person.mind.get_group_id("Family") >= 0:
        person.mind.set_culturon_value("Family", "Play", 1.5)
        person.mind.add_to_culturon_value("Family", "Care", person.g)
        person.f = person.mind.get_culturon_value("Family", "Care")
    person.plan = person.mind.choose_next_plan()


def leaving_groups(person):
    if person.id % 2:
        person.mind.leave_group("Family")
    elif person.b:
        person.mind.leave_all_groups()


def making_agents(person, model):
    if person.b and len(model.houses) < 40:
        house = model.houses.create()
        house.rent = person.f
        house.owner = person.id
        house.x = person.x


def hatching(person, model):
    if person.id < 3:
        child = person.hatch()
        child.f = -1
        person.i = child.id
    elif person.id < 5:
        person.hatch(keep_groups=True).g = 4


def hatching_while_looping(person, model):
    for house in model.houses:
        if len(model.houses) < 60:
            house.hatch().rent = 0


def dying(person, model):
    if person.id % 4 == 1:
        person.die()
        person.f = 123
        person.die()


def others_dying(person, model):
    for house in model.houses:
        if house.owner is not None and house.owner == person.id:
            house.die()
    person.i = len(model.houses)


def dying_while_looping(person, model):
    n = 0
    for house in model.houses:
        n += 1
        for other in model.houses:
            if other.id == house.id + 1:
                other.die()
    person.i = n


def born_and_dead_in_a_tick(person, model):
    child = person.hatch()
    child.die()
    person.b = model.persons.contains(child.id)
    person.c = child == person


def growing_many(person, model):
    for _ in range(30):
        model.houses.create().rooms = person.id


def all_dying(person, model):
    for house in model.houses:
        house.die()
    person.i = len(model.houses)


def uphill(person, model):
    best = max(model.world.neighbours(person), key=lambda patch: patch.grass + patch.x * 0.01)
    best.visits += 1
    model.world.move_to(person, best.x, best.y)


def least_grown(person, model):
    low = min((p for p in model.world.patches if not p.taken), key=lambda p: p.grass - p.y)
    low.grass += 0.25


def one_with_a_condition(person, model, rng):
    friend = rng.choice(other for other in model.persons if other.b and other.id != person.id)
    if friend is not None:
        person.i = friend.id
    place = rng.choice(patch for patch in model.world.in_radius(person, 2) if patch.x >= -4)
    person.f = place.x + place.y * 10


def strongest_near(person, model):
    found = max(
        (other for other in model.persons.near(person, 3.0) if other.b),
        key=lambda other: other.f,
        default=None,
    )
    if found is not None:
        found.g += 1
    person.j = sum(1 for other in model.persons.on(person))
