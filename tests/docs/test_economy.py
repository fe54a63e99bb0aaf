"""The page on the economy: its village runs alike at both speeds; all of the economy is told."""

import re
from pathlib import Path

import pytest

from socialmind import economy
from socialmind.catalogue import load_model

PAGE = (Path(__file__).parents[2] / "docs" / "economy.md").read_text("utf-8")


@pytest.fixture(scope="module")
def village(tmp_path_factory):
    folder = tmp_path_factory.mktemp("village")
    code = re.search(r"```python\n(.*?)```", PAGE, re.DOTALL)[1]
    (folder / "model.py").write_text(code, "utf-8")
    return load_model(folder)


def test_its_village_runs_alike_at_both_speeds(village):
    fast, slow = village(seed=1), village(seed=1, compiled=False)
    for society in (fast, slow):
        society.advance(300)
    assert fast.villagers.wheat.tolist() == slow.villagers.wheat.tolist()
    assert fast.markets.ware.tolist() == slow.markets.ware.tolist()
    # The ware was scarce at first; some have become smiths, and the market has tools.
    assert 0 < sum(fast.villagers.smith > 0) <= 20
    assert fast.markets.ware[0] > 10
    assert fast.markets.staple[0] >= 0


def test_it_tells_all_of_the_economy():
    assert all(f"`{name}(" in PAGE or f"`{name}`" in PAGE for name in economy.__all__)
    assert all(f"`{field}`" in PAGE for field in economy.Market.__annotations__)
