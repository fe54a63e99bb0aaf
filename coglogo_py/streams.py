"""Counter-based random streams: a number is a function of its key, not of what was drawn before.

- `philox`: the Philox4x32-10 block of Salmon et al. (2011), "Parallel random numbers: as easy as
  1, 2, 3". Four 32-bit words out of a 128-bit counter and a 64-bit key.
- `uniforms`: two numbers in [0, 1) out of one block.

Both are ordinary Python over whole numbers, and numba compiles the same text: 64-bit products wrap
there and grow here, but the bits that are kept are the same.
"""

from numba.extending import register_jitable

LOW_32 = 0xFFFFFFFF
MIND_STREAMS = 0x4D490000
"""Tag of the streams that decisions draw from; the model's other streams have other tags."""
MIND_BIRTH_STREAMS = 0x4D420000
"""Tag of those that say what a mind has at birth, by mind and name of the cogniton."""


@register_jitable
def philox(c0: int, c1: int, c2: int, c3: int, k0: int, k1: int) -> tuple[int, int, int, int]:
    """Return the Philox4x32-10 block of a counter under a key.

    Args:
        c0: the counter's first word, 0 … 2³² − 1.
        c1: its second word.
        c2: its third word.
        c3: its fourth word.
        k0: the key's first word, 0 … 2³² − 1.
        k1: its second word.

    Returns:
        Four whole numbers in 0 … 2³² − 1.

    >>> [hex(word) for word in philox(0, 0, 0, 0, 0, 0)]
    ['0x6627e8d5', '0xe169c58d', '0xbc57ac4c', '0x9b00dbd8']
    """
    for _ in range(10):
        product_0 = 0xD2511F53 * c0
        product_1 = 0xCD9E8D57 * c2
        c0 = ((product_1 >> 32) & LOW_32) ^ c1 ^ k0
        c2 = ((product_0 >> 32) & LOW_32) ^ c3 ^ k1
        c1 = product_1 & LOW_32
        c3 = product_0 & LOW_32
        k0 = (k0 + 0x9E3779B9) & LOW_32
        k1 = (k1 + 0xBB67AE85) & LOW_32
    return c0, c1, c2, c3


@register_jitable
def uniforms(c0: int, c1: int, c2: int, c3: int, k0: int, k1: int) -> tuple[float, float]:
    """Return two numbers in [0, 1), each with 53 random bits, of a counter under a key.

    >>> 0.0 <= uniforms(0, 0, 0, 0, 1, 0)[0] < 1.0
    True
    """
    c0, c1, c2, c3 = philox(c0, c1, c2, c3, k0, k1)
    first = ((c0 >> 5) * 67108864 + (c1 >> 6)) / 9007199254740992.0
    second = ((c2 >> 5) * 67108864 + (c3 >> 6)) / 9007199254740992.0
    return first, second
