"""The page on imprinting: its code runs, and does what the page says."""

import re
from pathlib import Path

import numpy as np
import pytest

from socialmind.learning import Training
from socialmind.mind import Hierarchy, MindDescription

torch = pytest.importorskip("torch")

PAGE = (Path(__file__).parents[2] / "docs" / "imprinting.md").read_text("utf-8")


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """The names that the page's code leaves."""
    names = {"__name__": "page"}
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(tmp_path_factory.mktemp("imprinting"))
        exec(compile(code, "docs/imprinting.md", "exec"), names)
    return names


def test_the_target_does_as_well_as_the_source(page):
    done = page["done"]
    assert done.reached
    assert done.rounds[-1].target >= done.rounds[-1].source - 0.01
    # An untrained target does not: the task is one that has to be learned.
    fresh = page["target"].changed(genome=np.full(page["target"].genome_size, 0.1))
    scores = [score(page, skill) for skill in (page["source"], fresh)]
    assert scores[1] < scores[0] - 0.1


def score(page, skill):
    mind = Hierarchy(MindDescription("agent", ["EyeL", "EyeR"], ["MotL", "MotR"], skills=[skill]))

    def controller(eyes):
        return mind.evaluate(dict(zip(["EyeL", "EyeR"], eyes, strict=True))).values()

    return np.mean([page["seek_light"](controller, seed) for seed in range(10)])


def test_the_learned_skill_steers_as_a_hierarchy(page):
    assert score(page, page["learned"]) == pytest.approx(score(page, page["source"]), abs=0.02)


def test_training_lowers_the_error(page):
    losses = page["trained"].losses
    assert len(losses) == 60
    assert losses[-1] < losses[0] / 5


def test_the_table_is_read(page):
    assert page["driven"].lengths == (2, 1)
    assert len(page["both"]) == 8 * 150 + 3


def test_the_population_begins_with_the_imprinted_genome(page):
    population, genome = page["population"], page["done"].skill.genome
    assert population.shape == (50, len(genome))
    assert (population[0] == genome).all()
    assert (population[1:] - genome).std() == pytest.approx(0.1, rel=0.1)


def test_a_robot_learns_from_a_proportional_controller(page):
    towards = page["towards"]
    assert towards.reached
    assert towards.rounds[-1].target > 0.9 * towards.rounds[-1].source > 2.5


def test_the_lesson_begins_with_what_was_imprinted(page):
    curve = Training(page["folder"]).curve
    assert len(curve) == 2
    assert curve["best"].iloc[0] > 0.9 * page["towards"].rounds[-1].source


def test_a_person_who_steered_is_played_again(page):
    assert page["steered"].outputs.tolist() == [[0.9, 0.6]] * 60
    assert page["steered"].inputs.std() > 0.01
    assert page["again"].losses[-1] < 1e-3


def test_the_twin_gives_what_the_skill_gives(page):
    mind = Hierarchy(
        MindDescription("agent", ["EyeL", "EyeR"], ["MotL", "MotR"], skills=[page["learned"]])
    )
    commands = mind.evaluate({"EyeL": 0.8, "EyeR": 0.2})
    assert page["outputs"][0].tolist() == pytest.approx(list(commands.values()), abs=1e-12)
    assert (page["relearned"].genome == page["learned"].genome).all()
