"""What a social scientist would write in a rule runs alike at both speeds.

Each rule of the files in `rules/` is one construct. A model tries one in each tick; both speeds,
and Python without the front end, must leave the same society behind, to the last bit.
"""

import pytest

SEED = 5
PLAIN = (
    *("numbers", "control", "helpers", "bodies", "tables_and_draws"),
    "generator_expressions",
)
"""Files whose rules Python runs without the front end as well."""


def compared(society, walk, speeds, stem):
    cls, rules = walk(stem)
    compiled = speeds.watched(cls(SEED))
    interpreted = cls(SEED, compiled=False)
    python = speeds.plain(cls(SEED, compiled=False))
    different = []
    for rule in rules:
        for model in (compiled, interpreted, python):
            model.advance(1)
        for name, other in (("interpreted", interpreted), ("Python", python)):
            if found := speeds.differences(compiled, other):
                different.append(f"{rule.__name__}: compiled and {name} differ in {found}")
        if different:
            break
    assert not different, "\n".join(different)
    assert compiled._met == []


@pytest.mark.parametrize("stem", PLAIN)
def test_constructs_run_alike(society, walk, speeds, stem):
    compared(society, walk, speeds, stem)


def test_commands_run_alike(society, walk, speeds):
    # A birth may find no room in the middle of a compiled tick, which is then done again.
    cls, rules = walk("worlds_and_minds")
    compiled, interpreted = speeds.watched(cls(SEED)), cls(SEED, compiled=False)
    for rule in rules:
        compiled.advance(1)
        interpreted.advance(1)
        assert not speeds.differences(compiled, interpreted), rule.__name__
    assert set(compiled._met) <= {"NoRoomError"}


def test_more_than_a_hundred_constructs(walk):
    stems = (*PLAIN, "worlds_and_minds")
    assert sum(len(walk(stem)[1]) for stem in stems) > 150
