"""What agents carry, and what they make of it: bags of counted things, recipes, exchange.

A bag is an array field of whole numbers, a thing is its place in the bag, and a recipe is a tuple
of pairs (thing, how many), all constants of the model's file:

    FLOUR, WATER, BREAD = 0, 1, 2
    DOUGH = ((FLOUR, 2), (WATER, 1))

    class Baker(Agent):
        bag: list[int] = [0] * 3

MetaCiv's objects and recipes (thesis, chapter 3). Nothing here makes a number negative.
"""

from __future__ import annotations

from typing import Any


def holds(bag: Any, recipe: Any) -> bool:
    """Return whether a bag holds all that a recipe wants.

    >>> holds([2, 1, 0], ((0, 2), (1, 1))), holds([2, 0, 0], ((0, 2), (1, 1)))
    (True, False)
    """
    return all(bag[thing] >= count for thing, count in recipe)


def take(bag: Any, thing: int, count: int) -> int:
    """Take so many of a thing out of a bag, or as many as there are; return how many."""
    taken = max(min(bag[thing], count), 0)
    bag[thing] -= taken
    return taken


def transfer(giver: Any, receiver: Any, thing: int, count: int) -> int:
    """Move so many of a thing from a bag to another, or as many as there are; return how many.

    It is how goods are given, deposited in a facility and withdrawn from it.

    >>> barn, bag = [5], [0]
    >>> transfer(barn, bag, 0, 3), transfer(barn, bag, 0, 3), barn, bag
    (3, 2, [0], [5])
    """
    moved = take(giver, thing, count)
    receiver[thing] += moved
    return moved


def craft(bag: Any, recipe: Any, thing: int, count: int = 1) -> bool:
    """Make so many of a thing of what a recipe wants, if the bag holds it; return whether.

    >>> bag = [5, 1, 0]
    >>> craft(bag, ((0, 2), (1, 1)), 2), craft(bag, ((0, 2), (1, 1)), 2), bag
    (True, False, [3, 0, 1])
    """
    if not holds(bag, recipe):
        return False
    for needed, many in recipe:
        bag[needed] -= many
    bag[thing] += count
    return True


def swap(one: Any, other: Any, given: int, many: int, taken: int, price: int) -> bool:
    """Let two bags exchange goods, if both hold theirs; return whether.

    Args:
        one: gives `many` of the thing `given`, and gets the price.
        other: gives `price` of the thing `taken`.
        given: what the first gives.
        many: how many of it, 0 or more.
        taken: what the second gives.
        price: how many of it, 0 or more.

    >>> miller, baker = [4, 0], [0, 3]
    >>> swap(miller, baker, 0, 2, 1, 1), miller, baker
    (True, [2, 1], [2, 2])
    """
    if many < 0 or price < 0 or one[given] < many or other[taken] < price:
        return False
    one[given] -= many
    other[given] += many
    other[taken] -= price
    one[taken] += price
    return True
