"""Tuples of constants, and draws among several values."""
# ruff: noqa

DIRECTIONS = ((0, 1), (1, 0), (0, -1), (-1, 0))
PRICES = (1.5, 2.5, 0.25)
MIXED = (1, 2.5, -3)
COUNTS = (3, 1, 0, 7, 2)
FLAGS = (True, False, True)
ROWS = ((1, 0.5, True), (2, 1.5, False), (-3, 2.0, True))
WEIGHTS = (0, 1, 2.5)
LONG = tuple(range(300))
QUIET = ("rest", "trade")


def loop_over_pairs(person):
    for dx, dy in DIRECTIONS:
        person.f += dx * 2 + dy
        person.i = person.i * 3 + dx - dy


def loop_over_numbers(person):
    for price in PRICES:
        person.f = person.f * 0.5 + price
    for count in COUNTS:
        person.i += count


def loop_over_mixed_numbers(person):
    for number in MIXED:
        person.f = person.f / 3 + number


def loop_over_flags(person):
    for flag in FLAGS:
        if flag:
            person.f += 1.25
        person.b = flag


def loop_over_rows(person):
    for count, price, flag in ROWS:
        person.i += count
        person.f += price if flag else -price


def loop_over_written_values(person):
    for k in (3, 1, 2):
        person.i = person.i * 2 + k
    for x, y in ((1, 0.5), (2, 0.25)):
        person.f += x * y


def loop_with_break_and_else(person):
    for dx, dy in DIRECTIONS:
        if dx == -1:
            break
        person.i += dy
    else:
        person.i = 99
    for count in COUNTS:
        if count == 99:
            break
    else:
        person.j = 7


def index_by_a_number(person):
    person.f = PRICES[person.id % 3] + PRICES[-1]
    person.i = COUNTS[person.i % 5]
    person.b = FLAGS[person.id % 3]
    person.f += MIXED[person.id % 3 - 3]


def index_and_take_apart(person):
    dx, dy = DIRECTIONS[person.id % 4]
    person.x += dx
    person.y += dy
    person.i = DIRECTIONS[person.id % 4][1]
    count, price, flag = ROWS[person.id % 3]
    person.i += count
    person.f = price
    person.c = flag


def index_where_it_is_written(person):
    person.i = (10, 20, 30)[person.id % 3]
    person.f = LONG[person.id % 300] / 7


def ask_what_is_in_it(person):
    person.b = person.i in COUNTS
    person.c = person.j not in COUNTS
    if person.id in (2, 5):
        person.f = -1


def ask_for_plans(person):
    person.b = person.plan in QUIET
    person.plan = "rest"
    person.c = person.plan in QUIET


def length_sum_and_extremes(person):
    person.i = len(DIRECTIONS) + len(PRICES) + len((1, 2))
    person.f = sum(PRICES) + min(PRICES) * max(MIXED)
    person.j = sum(COUNTS) + min(COUNTS) - max(COUNTS) + sum(FLAGS)
    person.b = max(FLAGS)


def _nearest(person, places):
    best = -1
    for k in range(len(places)):
        x, y = places[k]
        if best < 0 or abs(person.x - x) < abs(person.y - y):
            best = k
    return best


def _among(value, values):
    return value in values


def hand_on(person):
    person.i = _nearest(person, DIRECTIONS)
    person.j = _nearest(person, places=((5, 5), (1, 2), (0, 0)))
    person.b = _among(person.id, COUNTS)
    person.c = _among(person.id, PRICES)


def nested_loops(person):
    for dx, dy in DIRECTIONS:
        for k in COUNTS:
            person.i = (person.i + dx * k - dy) % 1000


def draw_poisson(person, rng):
    person.i = rng.poisson(2.5)
    person.j = rng.poisson(abs(person.f) + 12)
    person.f = rng.poisson(0) + rng.poisson(1000) + rng.poisson(1e9)


def draw_gamma(person, rng):
    person.f = rng.gamma(2.5, 3)
    person.g = rng.gamma(0.3, 1) + rng.gamma(1, 0.5) + rng.gamma(1e-3, 2) + rng.gamma(1e6, 1)


def draw_a_choice(person, rng):
    person.f = rng.choice(PRICES)
    person.i = rng.choice(COUNTS) + rng.choice(9)
    person.b = rng.choice(FLAGS)
    person.g = rng.choice(person.vf)
    person.j = rng.choice(person.vi)
    person.c = rng.choice(person.vb)


def draw_a_pair(person, rng):
    dx, dy = rng.choice(DIRECTIONS)
    person.i = dx
    person.j = dy
    count, price, flag = rng.choice(ROWS, p=WEIGHTS)
    person.f = count * price
    person.b = flag


def draw_by_weights(person, rng):
    person.f = rng.choice(PRICES, p=WEIGHTS)
    person.i = rng.choice(3, p=WEIGHTS)
    person.j = rng.choice((7, 8, 9), p=(1, 0, 3))
    for k in range(4):
        person.vf[k] = abs(person.vf[k])
    person.g = rng.choice(person.vf, p=person.vf)
    person.i += rng.choice(len(person.vf), p=person.vf)
    person.vb[0] = True
    person.f += rng.choice(person.vb, p=person.vb)


def _picked(rng, values, weights):
    return rng.choice(values, p=weights)


def draw_in_a_helper(person, rng):
    person.f = _picked(rng, PRICES, WEIGHTS)
    person.i = _picked(rng, COUNTS, COUNTS)


def go_through_in_a_random_order(person, rng):
    for k in rng.permutation(len(DIRECTIONS)):
        dx, dy = DIRECTIONS[k]
        person.i = person.i * 3 + dx - dy
    for k in rng.permutation(person.id):
        person.j = (person.j * 7 + k) % 1009
        if k == 5:
            continue
    for k in rng.permutation(0):
        person.f = 99


def shuffle_arrays(person, model, rng):
    rng.shuffle(person.vf)
    rng.shuffle(person.vi)
    rng.shuffle(person.vb)
    rng.shuffle(model.board)


def draws_in_a_row(person, rng):
    person.f = rng.random() + rng.gamma(1.5, 1) + rng.random() + rng.poisson(20) + rng.random()
    for k in rng.permutation(3):
        person.g += k * rng.random()
