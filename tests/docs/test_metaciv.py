"""The page on agents as in MetaCiv: its model runs alike at both speeds."""

import re
from pathlib import Path

import numpy as np
import pytest

from socialmind import Interaction
from socialmind.catalogue import load_model

PAGE = (Path(__file__).parents[2] / "docs" / "metaciv.md").read_text("utf-8")


@pytest.fixture(scope="module")
def homestead(tmp_path_factory):
    folder = tmp_path_factory.mktemp("homestead")
    code = "\n\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
    (folder / "model.py").write_text(code, "utf-8")
    return load_model(folder)


@pytest.fixture(scope="module")
def both(homestead):
    societies = homestead(seed=1), homestead(seed=1, compiled=False)
    for society in societies:
        society.advance(150)
    return societies


def test_its_model_runs_alike_at_both_speeds(both):
    fast, slow = both
    for name in fast.tables:
        one, other = fast.tables[name], slow.tables[name]
        for column in one.dtype.names:
            found = [table.columns[column][table.slots] for table in (one, other)]
            np.testing.assert_array_equal(*found, err_msg=f"{name}.{column}")


def test_its_file_says_the_same_as_its_python(homestead, tmp_path):
    file = tmp_path / "theft.yaml"
    file.write_text(re.search(r"```yaml\n(.*?)```", PAGE, re.DOTALL)[1])
    assert Interaction.load(file) == homestead.theft


def test_hunger_comes_at_one_threshold_and_goes_at_another(homestead):
    society = homestead(seed=1)
    hungry = np.zeros((150, len(society.humans)), bool)
    energy = np.zeros(hungry.shape)
    for tick in range(150):
        society.advance(1)
        hungry[tick] = ~np.isnan(society.humans.cogniton("Famished"))
        energy[tick] = society.humans.energy
    assert hungry[energy < 3].all() and not hungry[energy > 8].any()
    between = (energy > 3) & (energy < 8)
    assert 0 < hungry[between].sum() < between.sum()
    fasting = (energy[1:] < energy[:-1]) & between[1:] & between[:-1]
    assert (hungry[1:] == hungry[:-1])[fasting].all()


def test_thrift_spreads(homestead, both):
    begun = ~np.isnan(homestead(seed=1).humans.cogniton("Thrift"))
    assert 0 < begun.sum() < len(begun)
    assert not np.isnan(both[0].humans.cogniton("Thrift")).any()


def test_its_humans_reap_and_flee(both):
    assert min(both[0].humans.corn) > 0
    assert {"farm", "rest"} <= set(both[0].agents()["plan"])
