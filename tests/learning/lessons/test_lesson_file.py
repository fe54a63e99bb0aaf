"""Lessons in `.simbatch` files: which key is which argument, and errors at their lines."""

import pytest

from socialmind.errors import ModelError
from socialmind.learning.lessons.lesson_file import load_lesson


class Arena:
    pass


def seek(mind):
    pass


def find(name, refused):
    known = {"EXP_Avoid": Arena, "Seek": seek}
    if name not in known:
        raise refused(f"of {name!r}", "another")
    return known[name]


THESIS = """TYPE:LEARNSIM
BOTMODEL:BotType6
BOTNAME:T6-NEAT
MASTERSKILL:Collect
LEARNINGSKILL:Avoid
ENV:EXP_Avoid
LEARNINGMETHOD:GENETIC
ROOTFOLDER:Minds
NUMGEN:50
EVALREP:3
TICKLIM:100000
"""


@pytest.fixture
def lesson(tmp_path):
    """Write a file and read its lesson."""

    def loaded(text):
        path = tmp_path / "AvoidThings.simbatch"
        path.write_text(text)
        return load_lesson(path, find)

    return loaded


def test_the_thesis_s_example(lesson):
    found = lesson(THESIS)
    assert found.name == "AvoidThings"
    assert (found.environment, found.skills, found.master) == (Arena, ("Avoid",), "Collect")
    assert (found.optimiser, found.generations, found.repetitions) == ("GENETIC", 50, 3)
    assert (found.ticks, found.drive) == (100_000, None)
    assert dict(found.settings) == {}


def test_further_keys(lesson):
    further = (
        "POPULATION: 30\nmutation:0.5  # bold\nDRIVEMODULE:Seek\nWORLDS:fixed\nSTART:known\n"
        "SPREAD:0.25\nBUDGET:1000\nFINALS:4\nFINALISTS:2\nCOOLING:0.9\n"
    )
    found = lesson(THESIS.replace("LEARNINGSKILL:Avoid", "LEARNINGSKILL:Avoid, Go") + further)
    # What only annealing has counts for nothing here.
    assert dict(found.settings) == {"population": 30, "mutation": 0.5}
    assert found.skills == ("Avoid", "Go")
    assert (found.drive, found.worlds, found.start, found.spread) == (seek, "fixed", "known", 0.25)
    assert (found.budget, found.finals, found.finalists) == (1000, 4, 2)


@pytest.mark.parametrize(
    ("old", "new", "line", "said"),
    [
        ("LEARNSIM", "DEMOSIM", 1, "TYPE DEMO2DSIM; expected LEARN2DSIM"),
        ("EXP_Avoid", "EXP_Other", 6, "ENV of 'EXP_Other'"),
        ("GENETIC", "LUCK", 7, "the optimiser 'LUCK'"),
        ("NUMGEN:50", "NUMGEN:0", 9, "NUMGEN 0; expected 1 or more"),
        ("NUMGEN:50", "NUMGEN:many", 9, "'many' as NUMGEN"),
        ("ENV:EXP_Avoid\n", "", None, "a lesson without ENV"),
        ("EVALREP:3", "ELITE:x", 10, "'x' as ELITE; expected a number"),
        ("EVALREP:3", "ELITE:-1", 10, "elite=-1"),
        ("EVALREP:3", "POPULATON:3", 10, "did you mean 'POPULATION'?"),
        ("EVALREP:3", "BUDGET:1.5", 10, "'1.5' as BUDGET"),
        ("EVALREP:3", "WORLDS:wet", None, "worlds='wet'"),
    ],
)
def test_errors_name_file_and_line(lesson, old, new, line, said):
    with pytest.raises(ModelError) as raised:
        lesson(THESIS.replace(old, new))
    assert said in str(raised.value)
    assert raised.value.file.endswith("AvoidThings.simbatch")
    assert raised.value.line == line
