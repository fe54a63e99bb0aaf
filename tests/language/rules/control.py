"""Constructs of logic, conditions and loops. Each rule is tried at both speeds and as Python."""
# ruff: noqa


def comparisons(person):
    person.b = person.f < person.g
    person.c = person.i >= person.j
    person.vb[0] = person.f == person.g
    person.vb[1] = person.i != 3
    person.vb[2] = person.i <= person.f


def chained_comparisons(person):
    person.b = 0 < person.i <= 5
    person.c = -1 < person.f < person.g < 100
    person.vb[0] = person.i == person.j == 3
    person.vb[1] = 1 <= person.j != 4


def a_chain_draws_once(person, model, rng):
    person.b = 0.25 < rng.random() < 0.75
    person.f = rng.random()


def among_written_values(person):
    person.b = person.i in (1, 2, 3)
    person.c = person.f not in (0.5, person.g)
    person.vb[0] = person.i in [5]
    if person.j in {0, -1} and person.i not in (7,):
        person.f = 3


def truth_values_compared(person):
    person.b = person.b == person.c
    person.c = person.c != True  # noqa: E712
    person.vb[0] = person.b < person.c
    person.vb[1] = person.b == 1


def logic(person):
    person.b = person.b and not person.c
    person.c = person.i > 3 or person.f < 0 and person.g > 0
    person.vb[0] = not (person.b or person.c)


def short_circuit(person, model, rng):
    if person.b and rng.random() < 0.5:
        person.f = 1
    if person.c or rng.random() < 0.5:
        person.f += 2
    person.g = rng.random()


def numbers_as_conditions(person):
    if person.i:
        person.f = 1
    if not person.g:
        person.f = 2
    if person.f and person.j:
        person.c = True
    while person.j:
        person.j -= 1


def conditional_expressions(person):
    person.f = 1.0 if person.b else 2.0
    person.g = person.f if person.i > 2 else -person.f if person.c else 0
    person.i = 3 if person.b else person.j
    person.c = person.b if person.i > 1 else not person.c


def both_kinds_in_a_conditional_expression(person):
    person.f = 1 if person.b else 0.5


def if_elif_else(person):
    if person.i < 0:
        person.f = -1
    elif person.i == 0:
        person.f = 0
    elif person.i < 5:
        person.f = 1
    else:
        person.f = 2


def a_value_on_every_way(person):
    if person.b:
        kind = 1
    else:
        kind = 2
    person.i = kind


def a_value_where_the_others_return(person):
    if person.b:
        kind = 1
    else:
        return
    person.i = kind


def early_return(person):
    if person.b:
        return
    person.f = 100


def return_none(person):
    person.f = 3
    if person.b:
        return None
    person.f = 4
    return None


def nothing_behind_a_return(person):
    return
    person.f = 100


def passing(person):
    if person.b:
        pass
    else:
        ...


def only_a_docstring(person):
    """Do nothing."""


def comments_and_texts(person):
    # a comment
    "a text that stands alone"
    person.f = 1  # another


def range_to(person):
    for k in range(person.j):
        person.f += k


def range_from_to(person):
    for k in range(-2, person.i):
        person.f += k


def range_with_steps(person):
    for k in range(0, 10, 3):
        person.f += k
    for k in range(person.j, -person.j, -2):
        person.g += k


def range_counts_before(person):
    n = 3
    for _ in range(n):
        n += 1
    person.i = n


def the_last_round(person):
    k = -1
    for k in range(person.j):
        person.i = k
    person.j = k


def no_round(person):
    k = 5
    for k in range(0):
        person.i = k
    person.j = k


def nested_loops(person):
    for k in range(3):
        for m in range(k, 4):
            person.f += k * m


def nested_loops_without_names(person):
    for _ in range(3):
        for _ in range(2):
            person.i += 1


def break_and_continue(person):
    for k in range(10):
        if k == person.j:
            break
        if k % 2 == 0:
            continue
        person.f += k


def for_else(person):
    for k in range(5):
        if k == person.i:
            found = k
            break
    else:
        found = -1
    person.j = found


def while_loop(person):
    n = person.j
    steps = 0
    while n != 1:
        n = n // 2 if n % 2 == 0 else 3 * n + 1
        steps += 1
    person.i = steps


def while_else(person):
    n = 0
    while n < 5:
        n += 1
        if n == person.i:
            break
    else:
        person.c = True


def while_true(person):
    while True:
        person.f += 1
        if person.f > 5:
            break


def while_true_with_a_value(person):
    while True:
        person.f += 1
        if person.f > 5:
            rest = person.f - 5
            break
    person.g = rest


def while_true_with_return(person):
    while True:
        person.f += 1
        if person.f > 5:
            return


def break_out_of_the_inner_loop(person):
    for k in range(4):
        for m in range(4):
            if m > k:
                break
            person.i += 1
        else:
            person.j += 10


def continue_in_a_while_loop(person):
    n = 0
    while n < 10:
        n += 1
        if n % 3:
            continue
        person.f += n


def a_deep_nest(person):
    for a in range(2):
        if a > 0:
            for b in range(2):
                while person.i < 10:
                    person.i += 1
                    if person.i % 2 == 0:
                        if person.b:
                            if person.c:
                                person.f += a + b
                            else:
                                person.f -= 1
                        else:
                            break


def while_draws(person, model, rng):
    person.i = 0
    while rng.random() < 0.8:
        person.i += 1


def euclid(person):
    a, b = person.j * 6, 15
    while b != 0:
        a, b = b, a % b
    person.i = a


def several_at_once(person, rng):
    x = y = 0.0
    a = person.f = b = rng.random()
    x += a
    y -= b
    person.vf[person.j % 4] = person.i = k = person.j * 2
    person.g = x * 3 + y + k
    person.of = person.oi = None
