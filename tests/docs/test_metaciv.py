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


def test_its_humans_reap_and_flee(both):
    assert min(both[0].humans.corn) > 0
    assert {"farm", "rest"} <= set(both[0].agents()["plan"])
