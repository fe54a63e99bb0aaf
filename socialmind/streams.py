"""Random streams of rules: one for each agent, phase and tick, whatever else is drawn.

A number depends on the seed, the phase (by the name of its rule), the agent's identity, the tick
and how many numbers the rule has drawn since: adding an agent, a monitor or a second rule disturbs
nobody else's luck. The functions take a stream's state with the fields of `STREAM`, as a `Stream`
here and as a record in compiled code.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from numba.extending import register_jitable

from coglogo_py.streams import LOW_32, philox, uniforms

STREAM = np.dtype(
    [(name, "i8") for name in ("agent", "tick", "tag", "key_0", "key_1", "draws")]
    + [("spare", "f8")],
    align=True,
)
"""A stream's state: the counter's words, the key, the numbers drawn and the one left over."""

ORDER_TAG = 0x4F00
SCHEDULE_TAG = 0x8000
SETUP_TAG = 0xC000
"""Tag of the streams that shuffle agents; first tags of the phases of a tick and of the setup."""
TAGS = 0x4000
"""How many tags there are for the phases of a tick, and for those of the setup."""


def phase_tags(first: int, rules: Sequence[str]) -> list[int]:
    """Return the tags of phases, by the names of their rules, wherever they stand.

    A phase keeps its tag when others come before it, unless two names give the same one (one time
    in 16,384) or are the same: then the later takes the next.

    Args:
        first: the first tag, `SCHEDULE_TAG` or `SETUP_TAG`.
        rules: the names of the phases' rules, in the order of the schedule.

    >>> one, other = phase_tags(SCHEDULE_TAG, ["live", "grow"])
    >>> phase_tags(SCHEDULE_TAG, ["watch", "live", "grow"])[1:] == [one, other]
    True
    """
    tags: list[int] = []
    for rule in rules:
        place = zlib.crc32(rule.encode()) % TAGS
        while first + place in tags:
            place = (place + 1) % TAGS
        tags.append(first + place)
    return tags


@register_jitable
def begin(stream: Any, tag: int, agent: int, tick: int) -> None:
    """Turn a stream to an agent's numbers of a phase and a tick."""
    stream.agent = agent & LOW_32
    stream.tick = tick & LOW_32
    stream.tag = (tag << 16) | ((tick >> 32) & 0xFFFF)
    stream.draws = 0


@register_jitable
def random(stream: Any) -> float:
    """Draw a number in [0, 1)."""
    drawn = stream.draws
    stream.draws = drawn + 1
    if drawn & 1:
        return stream.spare
    first, second = uniforms(
        drawn >> 1, stream.agent, stream.tick, stream.tag, stream.key_0, stream.key_1
    )
    stream.spare = second
    return first


@register_jitable
def uniform(stream: Any, low: float, high: float) -> float:
    """Draw a number between two others."""
    return low + (high - low) * random(stream)


@register_jitable
def integers(stream: Any, low: int, high: int) -> int:
    """Draw a whole number from low … high − 1."""
    span = high - low
    if span <= 0 or span > 9007199254740992:
        raise ValueError("rng.integers() wants a range that is not empty, of at most 2**53 numbers")
    return low + int(random(stream) * span)


@register_jitable
def normal(stream: Any, mean: float, deviation: float) -> float:
    """Draw from a normal distribution (Box and Muller)."""
    if not deviation >= 0.0:
        raise ValueError("rng.normal() wants a deviation of 0 or more")
    radius = math.sqrt(-2.0 * math.log(1.0 - random(stream)))
    return mean + deviation * (radius * math.cos(6.283185307179586 * random(stream)))


@register_jitable
def exponential(stream: Any, scale: float) -> float:
    """Draw from an exponential distribution with the given mean."""
    if not scale >= 0.0:
        raise ValueError("rng.exponential() wants a mean of 0 or more")
    return -scale * math.log(1.0 - random(stream))


@register_jitable
def shuffle(stream: Any, places: Any, n: int) -> None:
    """Bring the first n elements of an array into a random order (Fisher and Yates).

    A swap takes 32 random bits, by Lemire's (2019) unbiased multiplication; n is below 2³².
    """
    block = 0
    left = 0
    a = b = c = d = 0
    for i in range(n - 1, 0, -1):
        span = i + 1
        while True:
            if left == 0:
                a, b, c, d = philox(
                    block, stream.agent, stream.tick, stream.tag, stream.key_0, stream.key_1
                )
                block += 1
                left = 4
            left -= 1
            product = a * span
            a, b, c = b, c, d
            rest = product & LOW_32
            if rest >= span or rest >= (LOW_32 + 1 - span) % span:
                break
        j = product >> 32
        kept = places[i]
        places[i] = places[j]
        places[j] = kept


class Stream:
    """A random stream as an interpreted rule holds it.

    Args:
        seed: 0 … 2⁶⁴ − 1.
    """

    __slots__ = ("agent", "draws", "key_0", "key_1", "spare", "tag", "tick")

    def __init__(self, seed: int) -> None:
        self.key_0 = seed & LOW_32
        self.key_1 = seed >> 32
        self.agent = self.tick = self.tag = self.draws = 0
        self.spare = 0.0

    def begin(self, tag: int, agent: int, tick: int) -> None:
        """Turn to an agent's numbers of a phase and a tick."""
        begin(self, tag, agent, tick)

    def random(self) -> float:
        """Draw a number in [0, 1)."""
        return float(random(self))

    def uniform(self, low: float, high: float) -> float:
        """Draw a number between two others."""
        return float(uniform(self, low, high))

    def integers(self, low: int, high: int | None = None) -> int:
        """Draw a whole number from low … high − 1, or from 0 … low − 1."""
        return int(integers(self, 0, low) if high is None else integers(self, low, high))

    def normal(self, mean: float, deviation: float) -> float:
        """Draw from a normal distribution."""
        return float(normal(self, mean, deviation))

    def exponential(self, scale: float) -> float:
        """Draw from an exponential distribution with the given mean."""
        return float(exponential(self, scale))
