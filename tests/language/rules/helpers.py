"""Constructs with functions of the author's. Each rule is tried at both speeds and as Python."""
# ruff: noqa

import math

from socialmind.economy import proportional_decay, towards_neutral

RATE = 0.1
_prices = None  # the module beside this one; the tests put it here


def helper(person):
    _grow(person)


def _grow(person):
    person.f += 1


def helper_with_result(person):
    person.f = _twice(person.f) + _twice(person.g)


def helper_for_both_kinds(person):
    person.f = _twice(person.f)
    person.i = _twice(person.i)


def _twice(x):
    return 2 * x


def several_results(person):
    low, high = _ordered(person.f, person.g)
    person.f = low
    person.g = high


def _ordered(a, b):
    if a < b:
        return a, b
    return b, a


def results_of_both_kinds(person):
    person.f = _clipped(person.f)


def _clipped(x):
    if x > 2:
        return 2
    if x < -2:
        return -2
    return x


def truth_as_result(person):
    person.b = _is_rich(person) and not _is_rich(person)
    if _is_rich(person):
        person.i = 0


def _is_rich(person):
    """Say so."""
    return person.f > 1 and person.g > 0


def defaults(person):
    person.f = _power(person.f)
    person.g = _power(person.g, 3)
    person.vf[0] = _power(2.0, n=1)


def _power(x, n=2):
    result = 1.0
    for _ in range(n):
        result *= x
    return result


def defaults_of_the_file(person):
    RATE = 77  # noqa: N806
    person.f = _taxed(person.f) + RATE


def _taxed(x, rate=RATE):
    return x * (1 - rate)


def keyword_arguments(person):
    person.f = _difference(b=person.f, a=person.g)


def keywords_draw_in_their_order(person, model, rng):
    person.f = _difference(b=rng.random(), a=rng.random())
    person.g = _difference(rng.random(), b=rng.random())


def _difference(a, b):
    return a - b


def helpers_in_helpers(person):
    person.f = _sum_of_squares(person.f, person.g)


def _sum_of_squares(a, b):
    return _square(a) + _square(b)


def _square(a):
    return a * a


def everything_passed_on(person, model, rng):
    _lives(person, model, rng)


def _lives(person, model, rng):
    person.f = rng.random() * model.price


def other_names_for_the_same(person, model, rng):
    m = model
    r = rng
    me = person
    me.f = r.random() + m.price
    _lives(rng=r, model=m, person=me)


def parameters_named_like_others(person, model, rng):
    person.f = _with_odd_names(person.f, person.g, person.i)


def _with_odd_names(model, rng, sum):
    return model + rng * sum


def a_helper_named_like_its_result(person):
    price = _prices.price(person.f)
    person.f = price
    ordered, price_2 = _prices.pair(price, 2)
    person.g = ordered + price_2


def helpers_named_like_generated_ones(person):
    person.f = advance(person.f) + prepare(person.g) + np(1) + _stream(2) + range_of(3)


def advance(x):
    return x + 1


def prepare(x):
    return x + 2


def np(x):
    return x + 3


def _stream(x):
    return x + 4


def range_of(range):
    return range + 1


def shared_models(person):
    person.f = proportional_decay(person.f, 0.25)
    person.g = towards_neutral(person.g, 0.5, 0.0, 2.0)


def arrays_passed_on(person):
    person.f = _mean(person.vf)
    person.g = _mean(person.vi)
    _fill(person.vf, 3)


def _mean(values):
    return sum(values) / len(values)


def _fill(values, x):
    for k in range(len(values)):
        values[k] = x


def agents_returned(person, model):
    best = _richest(model)
    best.i += 100
    person.j = best.id


def _richest(model):
    best = model.persons[0]
    for other in model.persons:
        if other.f > best.f:
            best = other
    return best


def populations_passed_on(person, model):
    person.i = _size(model.persons) + _size(model.houses)


def _size(population):
    n = 0
    for _ in population:
        n += 1
    return n


def a_parameter_changed_inside(person):
    person.f = _counted_down(person.j)


def _counted_down(n):
    steps = 0
    while n > 0:
        n -= 1
        steps += 1
    return steps + n


def nothing_returned(person):
    _nothing(person)


def _nothing(person):
    if person.b:
        return
    person.f = 0


def a_result_that_is_not_used(person):
    _twice(person.f)
    max(person.i, 3)


def always_returning(person):
    person.i = _sign(person.f)


def _sign(x):
    if x > 0:
        return 1
    elif x < 0:
        return -1
    else:
        return 0


def return_from_loops(person):
    person.i = _first_divisor(person.j + 10)


def _first_divisor(n):
    for k in range(2, n):
        if n % k == 0:
            return k
    return n


def endless_until_return(person):
    person.f = _bisected(2.0 + person.j)


def _bisected(x):
    low, high = 0.0, x
    while True:
        middle = (low + high) / 2
        if high - low < 1e-12 * x:
            return middle
        if middle * middle < x:
            low = middle
        else:
            high = middle


def a_helper_of_the_same_name_elsewhere(person):
    person.f = _square(person.f) + _prices._square(person.g)


def module_constants_elsewhere(person):
    person.f = _prices.PRICE * math.pi


def annotations(person):
    person.f = _annotated(person.f, 3)


def _annotated(x: float, n: int = 2) -> float:
    y: float = x
    return y * n
