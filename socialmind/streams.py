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

from coglogo_py.border.numbers import is_whole
from coglogo_py.streams import LOW_32, philox, uniforms

STREAM = np.dtype(
    [(name, "i8") for name in ("agent", "tick", "tag", "key_0", "key_1", "draws")]
    + [("spare", "f8")],
    align=True,
)
"""A stream's state: the counter's words, the key, the numbers drawn and the one left over."""

LONGEST_PERMUTATION = 10_000_000
"""How many places `rng.permutation` puts in order at most: 80 MB."""
SHOCK_TAG = 0x4000
ORDER_TAG = 0x4F00
BIRTH_TAG = 0x5000
FOUNDING_TAG = 0x7000
SCHEDULE_TAG = 0x8000
SETUP_TAG = 0xC000
"""First tag of shocks; tag of the streams that shuffle agents; first tags of rules at birth, of
where founders begin, of the phases of a tick and of the setup."""
SHOCK_TAGS = 0x0F00
TAGS = 0x4000
BIRTH_TAGS = 0x2000
FOUNDING_TAGS = 0x1000
"""How many tags there are for shocks; for the phases of a tick and for those of the setup; for
births; for where founders begin."""


def phase_tags(first: int, rules: Sequence[str], tags_there: int = TAGS) -> list[int]:
    """Return the tags of phases, by the names of their rules, wherever they stand.

    A phase keeps its tag when others come before it, unless two names give the same one (one time
    in 16,384) or are the same: then the later takes the next.

    Args:
        first: the first tag, `SCHEDULE_TAG` or `SETUP_TAG`.
        rules: the names of the phases' rules, in the order of the schedule.
        tags_there: how many tags there are.

    >>> one, other = phase_tags(SCHEDULE_TAG, ["live", "grow"])
    >>> phase_tags(SCHEDULE_TAG, ["watch", "live", "grow"])[1:] == [one, other]
    True
    """
    tags: list[int] = []
    for rule in rules:
        place = zlib.crc32(rule.encode()) % tags_there
        while first + place in tags:
            place = (place + 1) % tags_there
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
def gamma(stream: Any, shape: float, scale: float) -> float:
    """Draw from a gamma distribution of mean shape · scale.

    Marsaglia and Tsang (2000), "A simple method for generating gamma variables"; a shape below 1
    is drawn as shape + 1 and taken times u^(1 / shape), as in their section 6.
    """
    if not (shape > 0.0 and shape < math.inf):
        raise ValueError("rng.gamma() wants a shape above 0")
    if not (scale >= 0.0 and scale < math.inf):
        raise ValueError("rng.gamma() wants a scale of 0 or more")
    share = 1.0
    if shape < 1.0:
        share = math.exp(math.log(1.0 - random(stream)) / shape)
        shape = shape + 1.0
    d = shape - 1.0 / 3.0
    c = 1.0 / math.sqrt(9.0 * d)
    while True:
        x = normal(stream, 0.0, 1.0)
        v = 1.0 + c * x
        if v > 0.0:
            v = v * v * v
            u = 1.0 - random(stream)
            if math.log(u) < 0.5 * x * x + d - d * v + d * math.log(v):
                return scale * (share * (d * v))


@register_jitable
def log_factorial(k: int) -> float:
    """Return ln k! for k ≥ 0: a sum of logarithms, from 10 on Stirling's series."""
    if k < 10:
        total = 0.0
        for factor in range(2, k + 1):
            total = total + math.log(float(factor))
        return total
    n = float(k)
    square = n * n
    series = (
        1.0 / 12.0 - (1.0 / 360.0 - (1.0 / 1260.0 - 1.0 / 1680.0 / square) / square) / square
    ) / n
    return (n + 0.5) * math.log(n) - n + 0.9189385332046727 + series


@register_jitable
def poisson(stream: Any, mean: float) -> int:
    """Draw a whole number from a Poisson distribution; its mean is at most 10⁹.

    Below a mean of 10 numbers are multiplied until they fall below e^−mean (Knuth, "The Art of
    Computer Programming", 3.4.1); from there on it is PTRS of Hörmann (1993), "The transformed
    rejection method for generating Poisson random variables".
    """
    if not (mean >= 0.0 and mean <= 1e9):
        raise ValueError("rng.poisson() wants a mean of 0 … 10**9")
    if mean < 10.0:
        least = math.exp(-mean)
        count = 0
        product = random(stream)
        while product > least:
            count += 1
            product = product * random(stream)
        return count
    b = 0.931 + 2.53 * math.sqrt(mean)
    a = -0.059 + 0.02483 * b
    alpha = 1.1239 + 1.1328 / (b - 3.4)
    accepted = 0.9277 - 3.6224 / (b - 2.0)
    while True:
        u = random(stream) - 0.5
        v = 1.0 - random(stream)
        near = 0.5 - abs(u)
        if near > 0.0:
            k = math.floor((2.0 * a / near + b) * u + mean + 0.43)
            if near >= 0.07 and v <= accepted:
                return int(k)
            if k >= 0 and (near >= 0.013 or v <= near):
                likely = -mean + k * math.log(mean) - log_factorial(k)
                if math.log(v * alpha / (a / (near * near) + b)) <= likely:
                    return int(k)


@register_jitable
def weighted(stream: Any, weights: Any) -> int:
    """Draw a place among weights, each as likely as its weight: one number in their running sum."""
    total = 0.0
    for weight in weights:
        if not weight >= 0.0:
            raise ValueError("rng.choice() wants weights of 0 or more")
        total = total + weight
    if not (total > 0.0 and total < math.inf):
        raise ValueError("rng.choice() wants weights with a sum above 0, and not infinite")
    drawn = random(stream) * total
    reached = 0.0
    last = 0
    for place, weight in enumerate(weights):
        if weight > 0.0:
            reached = reached + weight
            last = place
            if drawn < reached:
                return place
    return last


@register_jitable
def shuffle_array(stream: Any, values: Any) -> None:
    """Bring an array into a random order: Fisher and Yates, one number a swap."""
    for i in range(len(values) - 1, 0, -1):
        j = int(random(stream) * (i + 1))
        kept = values[i]
        values[i] = values[j]
        values[j] = kept


@register_jitable
def permutation(stream: Any, n: int) -> Any:
    """Draw an order of 0 … n − 1, as an array."""
    if n < 0 or n > LONGEST_PERMUTATION:
        raise ValueError("rng.permutation() wants a number of 0 … 10,000,000")
    places = np.arange(n)
    shuffle_array(stream, places)
    return places


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

    def gamma(self, shape: float, scale: float) -> float:
        """Draw from a gamma distribution of mean shape · scale."""
        return float(gamma(self, shape, scale))

    def poisson(self, mean: float) -> int:
        """Draw a whole number from a Poisson distribution."""
        return int(poisson(self, mean))

    def weighted(self, weights: Sequence[float]) -> int:
        """Draw a place among weights, each as likely as its weight."""
        return int(weighted(self, weights))

    def choice(self, values: Any, p: Sequence[float] | None = None) -> Any:
        """Draw one of several values, or of 0 … values − 1; p are weights of any sum."""
        several = range(int(values)) if is_whole(values) else values
        return several[self.integers(len(several)) if p is None else self.weighted(p)]

    def permutation(self, n: int) -> list[int]:
        """Draw an order of 0 … n − 1."""
        order: list[int] = permutation(self, n).tolist()
        return order

    def shuffle(self, values: Any) -> None:
        """Bring an array into a random order."""
        shuffle_array(self, values)
