"""The files that docs/minds_files.md shows can be read, and say what the page says."""

import re
from pathlib import Path

import pytest

from socialmind.mind import MindDescription, Skill
from socialmind.mind.files import layout
from socialmind.mind.files.evoagents import (
    ades,
    botdesc,
    genome_file,
    network_lines,
    simbatch,
    vardesc,
)
from socialmind.mind.functions.perceptron import Perceptron

PAGE = (Path(__file__).parents[2] / "docs" / "minds_files.md").read_text("utf-8")


def block(language):
    """The one block of a language on the page."""
    (text,) = re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)
    return text


def test_sensors_and_variables():
    _, actuators = botdesc.parse(block("botdesc"), "page")
    assert [one.neutral for one in actuators] == [0.5, 0.0]
    assert len(vardesc.parse(block("vardesc"), "page")) == 4


def test_where_modules_are_drawn():
    assert layout.parse(block("layout"), "page") == {
        "sensors": {"S1": (-190, 40)}, "skills": {"Avoid": (480, 120)}
    }  # fmt: skip


def test_skills_and_tasks():
    assert ades.parse(block("ades"), "page").inputs[1].ticks == 5
    assert simbatch.parse(block("simbatch"), "page").generations == 50


def test_weights_stand_in_the_order_that_the_page_says():
    seek = Skill("Seek", ["SE:S1"], ["MO:M1"], Perceptron(layers=1, added=1))
    seek = genome_file.parse(block("genome"), "page", seek)
    assert seek.genome.tolist() == [0.5, 0.1, -0.25, 0.0, 1.0, -1.5, 0.125]
    assert genome_file.written(seek) == block("genome")


def test_the_yaml_form(tmp_path):
    (tmp_path / "robot.yaml").write_text(block("yaml"), "utf-8")
    mind = MindDescription.load(tmp_path / "robot.yaml")
    assert mind.order == ("Top", "See")
    assert mind.actuators["MotR"].neutral == 0.25


@pytest.mark.parametrize(
    "keyword",
    sorted({word for words in network_lines.KEYWORDS.values() for word in words}),
)
def test_every_keyword_of_networks_is_on_the_page(keyword):
    assert f"`{keyword}" in PAGE


def test_every_key_and_type_of_tasks_is_on_the_page():
    for word in (*simbatch.TEXTS, *simbatch.NUMBERS, *simbatch.TYPES, *simbatch.OTHER_NAMES):
        assert f"`{word}`" in PAGE
