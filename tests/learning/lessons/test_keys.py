"""Seeds by key: the same numbers on every machine, for good."""

from socialmind.learning.lessons.keys import WORLD, seed_for, seeds_for


def test_seeds_are_fixed_numbers():
    # By hand: the first eight bytes of the hash of "str:5:world/int:1:7", halved.
    import hashlib

    digest = hashlib.sha256(b"str:5:world/int:1:7").hexdigest()
    assert seed_for(WORLD, 7) == int(digest[:16], 16) // 2
    assert seed_for(WORLD, 7) == 3162407431692558556


def test_seeds_of_different_keys_differ():
    keys = [("a", 1), ("a", "1"), ("a", 11), ("a1",), ("a", 1, 1), ("/str:1:a", 1)]
    assert len({seed_for(*key) for key in keys}) == len(keys)
    many = [one for lesson in ("Go", "Turn") for g in range(500) for one in seeds_for(4, lesson, g)]
    assert len(set(many)) == 4000
    assert all(0 <= one < 2**63 for one in many)
