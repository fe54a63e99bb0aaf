"""The README's model runs as it stands, alike at both speeds."""

import re
from pathlib import Path

from socialmind.catalogue import load_model

README = Path(__file__).parents[2] / "README.md"


def model_block():
    """The README's model, without the lines that run it, and those lines."""
    blocks = re.findall(r"```python\n(.*?)```", README.read_text("utf-8"), re.DOTALL)
    block = next(text for text in blocks if "(Model)" in text)
    declared, _, run = block.partition("society = ")
    return block, declared, "society = " + run


def test_the_model_is_as_short_as_it_says():
    block, _, _ = model_block()
    assert len(block.splitlines()) <= 30


def test_the_model_runs_alike_at_both_speeds(tmp_path):
    _, declared, run = model_block()
    (tmp_path / "model.py").write_text(declared, "utf-8")
    gifts = load_model(str(tmp_path))
    assert "society.advance(10_000)" in run
    compiled, interpreted = gifts(seed=1, reach=8.0), gifts(seed=1, reach=8.0, compiled=False)
    for society in (compiled, interpreted):
        society.advance(50)
    assert compiled.walkers.money.tolist() == interpreted.walkers.money.tolist()
    assert abs(compiled.walkers.money.sum() - 1000.0) < 1e-9
    assert compiled.walkers.money.std() > 0.0
