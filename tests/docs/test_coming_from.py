"""The pages for who comes from NetLogo or Mesa: their models run alike at both speeds."""

import re
from pathlib import Path

import pytest

from socialmind import Model
from socialmind.sources.loading import load_file

DOCS = Path(__file__).parents[2] / "docs"
BLOCK = re.compile(r"```python\n(.*?)```", re.DOTALL)
MODELS = {"netlogo": ("Pasture", "Segregation", "Rumour"), "mesa": ("Money",)}


@pytest.fixture(scope="module", params=list(MODELS))
def models(request, tmp_path_factory):
    """The models of a page."""
    file = tmp_path_factory.mktemp(request.param) / "model.py"
    text = (DOCS / f"coming_from_{request.param}.md").read_text("utf-8")
    file.write_text("\n".join(BLOCK.findall(text)), "utf-8")
    page = load_file(file)
    found = [one for one in vars(page).values() if isinstance(one, type) and issubclass(one, Model)]
    assert tuple(one.__name__ for one in found if one is not Model) == MODELS[request.param]
    return {one.__name__: one for one in found}


def test_they_run_alike_at_both_speeds(models):
    for name, kind in models.items():
        if kind is Model:
            continue
        fast, slow = kind(seed=3), kind(seed=3, compiled=False)
        for society in (fast, slow):
            society.advance(8)
        for population, table in fast.tables.items():
            other = slow.tables[population]
            assert table.id.tolist() == other.id.tolist(), name
            for field in table.shape.fields:
                found = table.columns[field][table.slots].tolist()
                assert found == other.columns[field][other.slots].tolist(), (name, field)


def test_they_do_what_the_page_says(models):
    if "Money" in models:
        society = models["Money"](seed=1)
        society.advance(50)
        assert society.walkers.coins.sum() == 100
        assert society.series()["richest"] > 1
        return
    rumour = models["Rumour"](seed=1)
    rumour.advance(60)
    assert rumour.villagers.knows.sum() > 50
    town = models["Segregation"](seed=1)
    town.advance(1)
    before = town.people.happy.sum()
    town.advance(30)
    assert town.people.happy.sum() > before
    pasture = models["Pasture"](seed=1)
    pasture.advance(100)
    assert len(pasture.sheep) > 30
