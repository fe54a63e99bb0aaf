"""Bringing what was found into the order of birth."""

from __future__ import annotations

from typing import Any

from numba.extending import register_jitable

from socialmind.compiling.memory import index, lowest_bit

FEW = 8
"""So many are brought into order by comparing them, more by marking their places."""
SPARSE = 4
"""Up to so many times as many words of marks are looked through as there are marks."""
SMALL = 8
"""And so many words whatever there is in them: quicker than to compare."""


@register_jitable
def in_order(found: Any, begin: int, end: int, marks: Any, places: int) -> None:
    """Bring what was pushed, from begin to end, into the order of birth.

    There are so many places in that order. The marks are a bit for each, all 0, and so they are
    left.
    """
    if end - begin < 2:
        return
    first, last = 0, (places - 1) >> 6
    if last > SMALL and end - begin > FEW:
        first = last = found[index(begin)] >> 6
        for at in range(begin + 1, end):
            word = found[index(at)] >> 6
            first = min(first, word)
            last = max(last, word)
    if last - first < SMALL or (end - begin > FEW and last - first < SPARSE * (end - begin)):
        for at in range(begin, end):
            place = found[index(at)]
            marks[index(place >> 6)] |= 1 << (place & 63)
        at = begin
        for word in range(first, last + 1):
            bits = marks[index(word)]
            marks[index(word)] = 0
            while bits != 0:
                found[index(at)] = (word << 6) | lowest_bit(bits)
                at += 1
                bits &= bits - 1
        return
    gap = 1
    if end - begin > 3 * FEW:
        while gap < end - begin:
            gap = 3 * gap + 1
    while gap > 0:
        for at in range(begin + gap, end):
            place = found[index(at)]
            other = at
            while other - gap >= begin and found[index(other - gap)] > place:
                found[index(other)] = found[index(other - gap)]
                other -= gap
            found[index(other)] = place
        gap //= 3
