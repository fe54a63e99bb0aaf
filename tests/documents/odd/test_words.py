"""An author's words of an ODD document: read, taken over from other models, refused."""

import pytest

from coglogo_py import SchemeError
from socialmind.documents.odd.words import (
    CONCEPTS,
    ELEVEN,
    ENTITIES,
    PURPOSE,
    QUESTIONS,
    SUBMODELS,
    facts_in,
    skeleton,
    words_of,
)
from socialmind.errors import ModelError, SocialmindError


def written(folder, text):
    folder.mkdir(exist_ok=True)
    (folder / "odd_words.md").write_text(text, "utf-8")
    return words_of(folder, "little_wood")


def test_words_stand_under_their_elements(tmp_path):
    words = written(
        tmp_path,
        "# A wood\n\nTrees.\n\n## 1. Purpose and patterns\n\nWhy.\n\n## Submodels\n\nAll.\n\n"
        "### Grow\n\n```\n## no heading\n```\n\n## References\n\nOak (1900).\n",
    )
    assert (words.title, words.introduction) == ("A wood", "Trees.")
    assert words.references == "Oak (1900)."
    assert words.elements[PURPOSE].text == "Why."
    assert words.elements[SUBMODELS].text == "All."
    assert words.elements[SUBMODELS].part("grow") == "```\n## no heading\n```"
    assert words.elements[ENTITIES].text == ""


def test_without_a_file_nothing_is_said(tmp_path):
    words = words_of(tmp_path, "little_wood")
    assert words.title == "Little wood"
    assert not any(one.text or one.parts for one in words.elements.values())


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("## Porpose and patterns\n", r":1: found the heading .*did you mean 'Purpose and"),
        ("## Purpose and patterns\n\n## Purpose and patterns\n", ":3: a second"),
        ("## Design concepts\n\n### Luck\n", ":3: found the design concept 'Luck'; expected one"),
        ("### Grow\n", ":1: 'Grow' under no element"),
        ("## Submodels\n\n### A\n\n### A\n", ":5: a second 'A'"),
    ],
)
def test_headings_that_odd_does_not_have_are_refused(tmp_path, text, told):
    with pytest.raises(ModelError, match=told):
        written(tmp_path, text)


def test_the_words_of_another_model_are_taken_over(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("wood", "forest"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "model.py").write_text("")
    monkeypatch.setattr("socialmind.documents.odd.words.model_folder", lambda name: tmp_path / name)
    (tmp_path / "wood/odd_words.md").write_text(
        "## Design concepts\n\nAll.\n\n### Emergence\n\nShade.\n\n### Sensing\n\nLight.\n\n"
        "### Learning\n\nNone.\n\n## Submodels\n\n### Grow\n\nUp.\n"
    )
    words = written(
        tmp_path / "forest",
        "## Design concepts\n\n{{wood}}\n\n### Sensing\n\n{{wood}}\n\nAnd water.\n\n"
        "### Learning\n\n## Submodels\n\nMore.\n",
    )
    concepts = words.elements[CONCEPTS]
    assert concepts.text == "All."
    assert concepts.part("emergence") == "Shade."
    assert concepts.part("sensing") == "Light.\n\nAnd water."
    assert concepts.part("learning") == ""
    assert words.elements[SUBMODELS].parts == {}
    with pytest.raises(ModelError, match="the model itself"):
        written(tmp_path / "forest", "## Submodels\n\n{{forest}}\n")


def test_models_that_speak_for_each_other_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("socialmind.documents.odd.words.model_folder", lambda name: tmp_path / name)
    for name, other in (("wood", "forest"), ("forest", "wood")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "odd_words.md").write_text(f"## Submodels\n\n{{{{{other}}}}}\n")
    with pytest.raises(ModelError, match=r"forest/odd_words.md.*\{\{wood\}\}.* in a circle"):
        words_of(tmp_path / "wood", "wood")


def test_a_file_that_is_not_utf_8_is_refused_with_its_line(tmp_path):
    (tmp_path / "odd_words.md").write_bytes("## Submodels\n\nDécroît.\n".encode("latin-1"))
    with pytest.raises(SchemeError, match=r"odd_words.md.*3.*0xe9.*expected text in UTF-8"):
        words_of(tmp_path, "wood")


def test_another_model_that_there_is_not_is_refused(tmp_path):
    with pytest.raises(SocialmindError, match="no model called wod"):
        written(tmp_path, "## Submodels\n\n{{wod}}\n")


def test_what_variables_mean_stands_in_a_table():
    text, facts = facts_in(
        "They grow.\n\n| variable | unit | meaning |\n|---|---|---|\n"
        "| `x`, `y` | m | place |\n| `age` | a \\| b | |\n\n"
        "| kind | what |\n|---|---|\n| oak | t |\n"
    )
    assert text.startswith("They grow.") and "oak" in text and "`x`" not in text
    assert facts == {
        "x": {"unit": "m", "meaning": "place"},
        "y": {"unit": "m", "meaning": "place"},
        "age": {"unit": "a | b", "meaning": ""},
    }


def test_a_skeleton_asks_everything_and_says_nothing(tmp_path):
    text = skeleton("Wood", {"trees": ["age"]})
    assert all(f"## {element}" in text for element in QUESTIONS)
    assert all(f"### {concept}" in text for concept in ELEVEN)
    words = written(tmp_path, text)
    assert not any(one.text for one in words.elements.values())
    assert not any(words.elements[CONCEPTS].parts.values())
    assert facts_in(words.elements[ENTITIES].part("trees"))[1] == {
        "age": {"unit": "", "start": "", "meaning": ""}
    }
