"""The page on bags and facilities: its bakers live alike at both speeds, and lose no grain."""

import re
from pathlib import Path

import numpy as np
import pytest

from socialmind.catalogue import load_model

PAGE = (Path(__file__).parents[2] / "docs" / "inventories.md").read_text("utf-8")


@pytest.fixture(scope="module")
def bakers(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bakers")
    code = "\n\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
    (folder / "model.py").write_text(code, "utf-8")
    return load_model(folder)


def test_its_bakers_live_alike_at_both_speeds(bakers):
    fast, slow = bakers(seed=1), bakers(seed=1, compiled=False)
    for society in (fast, slow):
        society.advance(100)
    for name in ("humans", "barns", "wells"):
        one, other = fast.tables[name], slow.tables[name]
        for column in one.dtype.names:
            found = [table.columns[column][table.slots] for table in (one, other)]
            np.testing.assert_array_equal(*found, err_msg=f"{name}.{column}")
    assert slow.humans.eaten.sum() > 100
    assert (slow.humans.bag >= 0).all()
    assert (slow.barns.stock >= 0).all()
    assert {"village", "private"} <= {
        "village" if barn.group >= 0 else "private" for barn in slow.barns
    }
    living = set(slow.humans.id.tolist())
    assert all(barn.owner in living for barn in slow.barns if barn.owner >= 0)
    assert len(living) < 12
