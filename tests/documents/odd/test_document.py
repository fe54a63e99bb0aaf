"""ODD documents: what declarations, docstrings and words come to, and when they are stale."""

import re

import pytest

from socialmind.catalogue import load_model
from socialmind.documents.odd.document import UNSAID, begin_words, odd
from socialmind.documents.odd.words import ELEVEN, QUESTIONS
from socialmind.errors import SocialmindError

MODEL = '''
from socialmind import Agent, Model, Patch, Population, Torus, each, once, parameter


class Tree(Agent):
    """A tree, and how old it is.

    Attributes:
        age: since it sprouted.
    """

    age: int = 3
    marks: list[bool] = [False] * 4


class Soil(Patch):
    """What trees stand on."""

    water: float = 0.5


def sprout(tree, rng):
    """Stand anywhere."""
    tree.x = rng.uniform(0, 5)


def live(tree, model):
    """Drink, or die of thirst.

    Args:
        tree: who.
    """
    drink(tree, model)
    if tree.age > model.oldest:
        tree.die()


def drink(tree, model):
    """Take what the soil gives."""
    model.world.patch(tree.x, tree.y).water -= 0.1


def rain(model):
    """Count the days."""
    model.days += 1


def grow(tree):
    """Grow older."""
    tree.age += 1


def rest(tree):
    """Do nothing."""


class Wood(Model):
    """Trees that drink."""

    ticks = 1200
    oldest: int = parameter(90, unit="years", low=1, doc="age of the oldest")
    days: int = 0
    world = Torus(5, Soil)
    trees = Population(Tree, 7, mind="scheme.yaml", plans={"Grow": grow, "Rest": rest})
    setup = (each(trees, sprout, shuffled=False),)
    schedule = (each(trees, live), once(rain))
'''
SCHEME = """
name: trees
decision_maker: {name: MaximumWeight}
plans: [Grow, Rest]
cognitons:
  Thirst:
    at_birth: false
    start: 0
    influence: {Grow: -0.5, Rest: 2}
    conditional: [Rest]
    reinforcement: {Grow: 0.25}
groups:
  grove:
    elder:
      Shade: {start: 1, influence: {Grow: -3}}
"""
WORDS = (
    "# A wood\n\nTrees of a wood.\n\n"
    + "".join(
        f"## {name}\n\nSaid of {name.lower()}.\n\n"
        for name in QUESTIONS
        if name not in ("Design concepts", "Entities, state variables and scales")
    )
    + "## Design concepts\n\n"
    + "".join(f"### {name}\n\nSaid of {name.lower()}.\n\n" for name in ELEVEN)
    + """## Entities, state variables and scales

A wood.

### Trees

They stand.

| variable | unit | start | meaning |
|---|---|---|---|
| `marks` | – | | who leant on it |
| `x` | paces | anywhere | eastings |

### Mind of trees

| cogniton | stands for |
|---|---|
| Thirst | dry roots |

### Patches

| variable | unit | meaning |
|---|---|---|
| `water` | litres | in the soil |

### The model

| variable | unit | meaning |
|---|---|---|
| `days` | days | so far |

### Scales

A tick is a day.
"""
)


@pytest.fixture
def wood(tmp_path):
    folder = tmp_path / "wood"
    folder.mkdir()
    for name, text in (("model.py", MODEL), ("scheme.yaml", SCHEME), ("odd_words.md", WORDS)):
        (folder / name).write_text(text, "utf-8")
    return folder


def rows_of(text, heading):
    section = text.split(f"{heading}\n", 1)[1].split("\n#", 1)[0]
    return [line for line in section.splitlines() if line.startswith("|")]


def test_it_has_the_seven_elements_and_eleven_concepts_in_order(wood):
    made = odd(load_model(wood))
    assert made.gaps == ()
    found = re.findall(r"^## (.+)$", made.text, re.MULTILINE)
    assert found == [*(f"{n}. {one}" for n, one in enumerate(QUESTIONS, 1)), "References"]
    concepts = made.text.split("## 4. ")[1].split("\n## ")[0]
    assert re.findall(r"^### (.+)$", concepts, re.MULTILINE) == list(ELEVEN)
    assert "10.18564/jasss.4259" in made.text


def test_declarations_docstrings_and_words_meet_in_its_tables(wood):
    text = odd(load_model(wood)).text
    assert "| `trees` | 7 | cognitive scheme | A tree, and how old it is. |" in text
    assert rows_of(text, "### Trees")[2:] == [
        "| `x` | number | paces | anywhere | eastings |",
        "| `y` | number | patches | by the setup | place, to the north |",
        "| `heading` | number | degrees | 0 | direction; 0 is north, clockwise |",
        "| `age` | whole number | – | 3 | since it sprouted |",
        "| `marks` | 4 times true or false | – | false each | who leant on it |",
        "| `plan` | the name of a plan | – | none | the plan that it follows |",
    ]
    assert rows_of(text, "### Patches")[2:] == ["| `water` | number | litres | 0.5 | in the soil |"]
    assert rows_of(text, "### The model")[2:] == ["| `days` | whole number | days | 0 | so far |"]
    assert rows_of(text, "### Parameters")[2:] == [
        "| `oldest` | years | 1 or more | 90 | age of the oldest |"
    ]


def test_the_mind_is_told_with_its_groups_and_drawn(wood):
    made = odd(load_model(wood))
    rows = rows_of(made.text, "### Mind of trees")
    assert "| Thirst | dry roots | inactive | Grow −0.5, Rest 2 | Rest | Grow 0.25 |" in rows
    assert "| grove | elder | Shade | 1 | Grow −3 |" in rows
    (picture,) = made.pictures
    assert f"]({picture.place})" in made.text


def test_schedule_setup_and_rules_are_tables(wood):
    text = odd(load_model(wood)).text
    assert rows_of(text, "## 3. Process overview and scheduling")[2:] == [
        "| 1 | each of `trees` | random, drawn anew | *live* | Drink, or die of thirst. |",
        "| 2 | the model | once | *rain* | Count the days. |",
    ]
    assert "acts no more" in text and "1,200 ticks" in text
    assert rows_of(text, "## 5. Initialisation")[2:] == [
        "| 1 | each of `trees` | order of birth | *sprout* | Stand anywhere. |"
    ]
    rules = {row.split("*")[1] for row in rows_of(text, "### The rules one by one")[2:]}
    assert rules == {"sprout", "live", "drink", "rain", "grow", "rest"}


@pytest.mark.parametrize(
    ("before", "after", "gap"),
    [
        ("### Emergence", "### emergence", None),
        ("Said of emergence.", "", "the design concept 'Emergence'"),
        ("| `days` | days | so far |", "", "the meaning of `days` of the model"),
        ("| `x` | paces", "| `height` | paces", "`height` of trees, which the model does not have"),
        ("Said of input data.", "", "the author's words on 'Input data'"),
        ("| Thirst |", "| Hunger |", "the cogniton Hunger of trees"),
        ("### Patches", "### Patch", "the table of variables under 'Patch'"),
    ],
)
def test_what_is_not_said_or_of_nothing_is_a_gap(wood, before, after, gap):
    words = wood / "odd_words.md"
    assert before in WORDS
    words.write_text(WORDS.replace(before, after), "utf-8")
    gaps = odd(load_model(wood)).gaps
    assert any(gap in one for one in gaps) if gap else not gaps


def test_a_rule_without_a_docstring_is_a_gap(wood):
    model = wood / "model.py"
    model.write_text(MODEL.replace('    """Count the days."""\n', ""), "utf-8")
    assert odd(load_model(wood)).gaps == ("a docstring of the rule rain",)


def test_a_written_document_is_stale_once_anything_is_another(wood):
    path = wood / "ODD.md"
    written = odd(load_model(wood)).write(path)
    assert [one.relative_to(wood).as_posix() for one in written] == [
        "ODD.md",
        "odd_figures/trees_scheme.png",
    ]
    assert odd(load_model(wood)).stale(path) == []
    (wood / "model.py").write_text(MODEL.replace("parameter(90", "parameter(91"), "utf-8")
    (one,) = odd(load_model(wood)).stale(path)
    assert re.search(r"ODD.md:\d+: found '\| `oldest` .* 90 .*; expected .* 91 ", one)
    (wood / "model.py").write_text(MODEL, "utf-8")
    (wood / "scheme.yaml").write_text(SCHEME.replace("Rest: 2", "Rest: 3"), "utf-8")
    assert len(odd(load_model(wood)).stale(path)) == 2  # the table and the picture
    (wood / "scheme.yaml").write_text(SCHEME, "utf-8")
    written[1].unlink()
    (one,) = odd(load_model(wood)).stale(path)
    assert "trees_scheme.png" in one


def test_as_html_it_is_one_page_with_its_pictures(wood, tmp_path):
    path = tmp_path / "wood.html"
    assert odd(load_model(wood)).write(path) == [path]
    text = path.read_text("utf-8")
    assert "<h2>4. Design concepts</h2>" in text and "<table>" in text
    assert text.count("data:image/png;base64,") == 1
    assert "odd_figures" not in text
    with pytest.raises(SocialmindError, match=r"expected .md or .html"):
        odd(load_model(wood)).write(tmp_path / "wood.docx")


def test_a_model_without_words_gets_a_file_of_questions(wood):
    (wood / "odd_words.md").unlink()
    made = odd(load_model(wood))
    assert UNSAID in made.text
    assert len(made.gaps) > len(ELEVEN)
    begin_words(load_model(wood), made.words)
    text = (wood / "odd_words.md").read_text("utf-8")
    assert "| `marks` | | | |" in text and "| `x` |" not in text
    assert odd(load_model(wood)).gaps == made.gaps
