"""The tutorial page builds a model in under 40 lines that is the one in models/tutorial."""

import re
from pathlib import Path

import pytest

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_model

ROOT = Path(__file__).parents[2]
BLOCK = re.compile(r"```(\w+)\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with the two files that the page tells the reader to write."""
    blocks = BLOCK.findall((ROOT / "docs" / "tutorial.md").read_text("utf-8"))
    written = tmp_path_factory.mktemp("tutorial")
    scheme = next(text for kind, text in blocks if kind == "yaml")
    model = next(text for kind, text in blocks if kind == "python")
    assert len(model.splitlines()) < 40
    (written / "scheme.yaml").write_text(scheme, "utf-8")
    (written / "model.py").write_text(model, "utf-8")
    return written


def test_its_scheme_has_no_findings_and_is_that_of_the_shipped_model(folder):
    scheme = CognitiveScheme.load(folder / "scheme.yaml")
    shipped = CognitiveScheme.load(ROOT / "models" / "tutorial" / "scheme.yaml")
    assert scheme.check() == []
    assert scheme.plans == shipped.plans
    assert [(c.name, c.influence, c.conditional, c.reinforcement) for c in scheme.cognitons] == [
        (c.name, c.influence, c.conditional, c.reinforcement) for c in shipped.cognitons
    ]


def test_its_model_runs_alike_at_both_speeds_and_as_the_shipped_one(folder):
    page, shipped = load_model(str(folder)), load_model("tutorial")
    compiled, interpreted = page(seed=2), page(seed=2, compiled=False)
    models = compiled, interpreted, shipped(seed=2)
    for _ in range(15):
        for model in models:
            model.advance(100)
        places = [(m.turtles.x[0], m.turtles.y[0], m.visits, m.turtles[0].plan) for m in models]
        assert places[0] == places[1] == places[2]
    assert compiled.visits > 3


def test_the_turtle_commutes_between_red_and_blue_and_then_goes_to_green(folder):
    model = load_model(str(folder))(seed=1, compiled=False)
    plans = []
    for _ in range(300):
        model.advance(1)
        plans.append(model.turtles[0].plan)
    first_green = plans.index("goto-green")
    assert {"goto-red", "goto-blue"} == set(plans[:first_green])
    # wantGreen grows by 0.0055 a step and wins when it is above the one wish that is 1, less its
    # own pull on that plan: above 0.5, after 91 steps.
    assert first_green == 91
    assert model.visits > 0
