"""A second file of a model, with functions named like those of the first."""

PRICE = 2.5


def price(x):
    return x * PRICE


def pair(a, b):
    return _square(a), _square(b)


def _square(x):
    return x + 100
