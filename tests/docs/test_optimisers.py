"""The page on optimisers: its code runs, and its table is that of the settings."""

import re
from pathlib import Path

import numpy as np
import pytest

from socialmind.learning.optimisers.registry import OPTIMISERS

PAGE = (Path(__file__).parents[2] / "docs" / "optimisers.md").read_text("utf-8")


def test_its_code_does_what_it_says():
    pytest.importorskip("neat")
    names = {"__name__": "page"}
    code = "\n".join(re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL))
    exec(compile(code, "docs/optimisers.md", "exec"), names)
    assert names["genomes"].shape == (30, 3)
    assert names["best"] == pytest.approx(np.full(3, 0.5), abs=0.05)
    assert names["growing"].best in names["individuals"]
    assert names["skill"].genome.tolist() == names["growing"].best.weights.tolist()


def test_its_table_has_every_setting():
    rows = [
        f"| `{keyword}` | `{name}` | {one.default:g} | {one.expected} | {one.meaning} |"
        for keyword, kind in OPTIMISERS.items()
        for name, one in kind.known_settings.items()
    ]
    assert re.findall(r"^\| `\w+` \| `\w+` \|.*$", PAGE, re.MULTILINE) == rows


@pytest.mark.parametrize("keyword", OPTIMISERS)
def test_it_says_when_to_take_each(keyword):
    assert len(re.findall(rf"^\| `{keyword}` \| [^`]", PAGE, re.MULTILINE)) == 1
