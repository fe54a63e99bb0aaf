"""Constructs with fields, populations and the world; tried at both speeds and as Python."""
# ruff: noqa


def optional_fields(person):
    if person.oi is None:
        person.oi = 5
    elif person.oi is not None and person.oi > 8:
        person.oi = None


def optional_numbers(person):
    if person.of is not None:
        person.f = person.of * 2
        person.of += 1
        person.g = -person.of
    if not person.of is None and person.ob is not None:  # noqa: E714
        person.b = person.ob


def optional_of_others(person, model):
    other = model.persons[(person.id + 1) % 7]
    if other.oi is None:
        other.oi = person.id
    else:
        person.i = other.oi + model.persons[other.id].oi


def optional_with_a_draw(person, model, rng):
    for other in model.persons:
        other.of = 1.5
    person.f = model.persons.one_of(rng).of + 1
    model.persons.one_of(rng).of = rng.random()
    model.persons.one_of(rng).oi = None
    person.g = rng.random()


def arrays(person):
    person.vf[0] = person.vf[1] + person.vf[-1]
    person.vf[-2] = 3
    person.vi[person.j % 5] += 2
    person.vb[1] = not person.vb[0]


def array_loops(person):
    for value in person.vf:
        person.f += value
    for flag in person.vb:
        if flag:
            person.i += 1


def a_loop_sees_what_it_changes(person):
    for value in person.vi:
        person.vi[4] = 50
        person.i += value


def array_totals(person):
    person.f = sum(person.vf)
    person.i = sum(person.vi) + sum(person.vb)
    person.g = min(person.vf) + max(person.vf)
    person.j = min(person.vi) - max(person.vi) + len(person.vi)
    person.b = max(person.vb)


def array_of_a_draw(person, model, rng):
    person.vi[rng.integers(5)] += 10
    model.persons.one_of(rng).vf[rng.integers(4)] *= 2
    person.f = rng.random()


def a_place_is_found_before_the_value(person, model, rng):
    person.i = 0
    person.vi[person.i] += _next_place(person)
    model.persons[person.i].f += _next_place(person)


def _next_place(person):
    person.i += 1
    return person.i


def truth_fields(person):
    person.b = True
    person.c = person.i > 3
    if person.b and not person.c:
        person.b = False


def small_fields(person):
    person.small += 100
    person.small = person.small * 2 - 5
    person.tiny = min(person.tiny + 120, 127)
    person.i = person.small * 1000 * 1000
    person.f = person.tiny / 3


def identities(person):
    person.i = person.id * 2


def variables_of_the_model(person, model):
    model.total += person.f
    model.count += 1
    model.open = not model.open
    if model.last is None:
        model.last = person.id
    else:
        person.i = model.last
        model.last = None
    model.board[person.id % 3] += 1
    person.g = sum(model.board)


def parameters_of_the_model(person, model):
    person.f = model.price * model.years
    if model.war:
        person.i = 0
    person.j = model.tick


def sizes(person, model):
    person.i = len(model.persons) + len(model.houses)


def loops_over_agents(person, model):
    for other in model.persons:
        if other.id == person.id:
            continue
        person.g += other.f
        if other.i > 6:
            break
    for house in model.houses:
        house.rent += person.f


def nested_loops_over_agents(person, model):
    for one in model.persons:
        for other in model.persons:
            if one.id < other.id and one.b == other.b:
                person.i += 1


def agents_by_identity(person, model):
    friend = model.persons[(person.id + 3) % 7]
    friend.f += 1
    model.persons[0].g = 5
    model.houses[person.id % 3].rooms += 1
    person.i = model.persons[1].j


def agents_compared(person, model):
    friend = model.persons[3]
    person.b = person == friend
    person.c = person != friend


def agents_kept(person, model):
    first = model.persons[0]
    second = first
    for other in model.persons:
        if other.f > first.f:
            second = first
            first = other
    person.i = first.id * 10 + second.id
    chosen = first if person.b else second
    chosen.g = 1.5


def contains(person, model):
    person.b = model.persons.contains(person.i)
    person.c = model.persons.contains(-1) or model.persons.contains(1000)


def one_of(person, model, rng):
    other = model.persons.one_of(rng)
    other.f = 3
    model.houses.one_of(rng).rent += 1
    person.g = rng.random()


def patches(person, model):
    patch = model.world.patch(person.x, person.y)
    patch.grass -= 0.25
    patch.visits += 1
    patch.taken = not patch.taken
    patch.owner = person.id
    person.i = patch.x * 100 + patch.y
    model.world.patch(100.5, -37).grass = 7


def all_patches(person, model):
    for patch in model.world.patches:
        if patch.taken:
            person.f += patch.grass
            if patch.owner is not None:
                person.i += patch.owner


def patches_around(person, model):
    n = 0
    for patch in model.world.in_radius(person, 2.5):
        n += 1
        patch.grass += 0.5
    for patch in model.world.in_radius(model.world.patch(4, 4), 1):
        patch.visits += 1
        if patch.visits > 5:
            break
    person.i = n


def patches_around_a_drawn_agent(person, model, rng):
    for patch in model.world.in_radius(model.persons.one_of(rng), 1.5):
        patch.grass *= 0.5
    person.g = rng.random()


def patches_passed_on(person, model):
    here = model.world.patch(person.x, person.y)
    _graze(person, here)
    best = _best_patch(model)
    best.grass = 0


def _graze(person, patch):
    eaten = min(patch.grass, 0.5)
    patch.grass -= eaten
    person.f += eaten


def _best_patch(model):
    best = model.world.patch(0, 0)
    for patch in model.world.patches:
        if patch.grass > best.grass:
            best = patch
    return best


def measures_of_the_world(person, model):
    world = model.world
    person.i = world.size
    person.j = world.low
    person.f = world.high - 0.5


def draws(person, model, rng):
    person.f = rng.random()
    person.g = rng.uniform(-2, 5)
    person.i = rng.integers(6)
    person.j = rng.integers(-3, 4)
    person.vf[0] = rng.normal(0, 1)
    person.vf[1] = rng.exponential(2)
    person.vf[2] = rng.normal(person.f, 0)
    person.vi[0] = rng.integers(0, 2**53)


def conditional_draws(person, model, rng):
    person.f = rng.random() if person.b else rng.normal(5, 2)
    person.g = rng.random()
