"""The page about sensitivity: its commands and code run, and its tables name what there is."""

import re
import shlex
from pathlib import Path

from typer.main import get_command
from typer.testing import CliRunner

from socialmind.cli import app
from socialmind.experiments import designs

PAGE = (Path(__file__).parents[2] / "docs" / "sensitivity.md").read_text("utf-8")
(BLOCK,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


def test_its_commands_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    lines = re.findall(r"^socialmind (.*)$", PAGE, re.MULTILINE)
    assert [line.split()[0] for line in lines] == ["sweep", "sensitivity"]
    for line in lines:
        words = shlex.split(line)
        for old, new in {"20000": "4", "morris:20": "morris:4", "0:3": "0:2"}.items():
            words = [new if word == old else word for word in words]
        words += ["--interpreted", "--workers", "1", "--quiet"] if "--sample" in words else []
        result = CliRunner().invoke(app, words)
        assert result.exit_code == 0, (line, result.output)
    assert "wheat_each: 20 points (morris), 40 runs" in result.stdout
    named = re.search(r"writes `(\S+)/`: (.*?)and the figure", PAGE, re.DOTALL)
    files = {path.name for path in (tmp_path / named[1]).iterdir()}
    assert files == {*re.findall(r"`(\w+\.\w+)`", named[2]), "sensitivity.pdf", "sensitivity.png"}


def test_its_code_ends_in_a_figure(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    short = (
        BLOCK.replace("50_000", "30")
        .replace("artisans[", "tools[")
        .replace("256)", "8)")
        .replace("range(3)", "range(2)")
    )
    short = short.replace("every=500", "every=1, compiled=False, workers=1")
    names = {"__name__": "__main__"}
    exec(compile(short, "docs/sensitivity.md", "exec"), names)
    assert names["total"].index.tolist() == ["tool_price", "tool_durability"]
    assert 0 <= names["share"]["settled"] <= 1
    assert names["axes"].get_xlabel() == "share of the variance"
    assert (names["folder"] / "sensitivity.pdf").stat().st_size > 1000


def test_its_options_and_sizes_are_there():
    options = {
        one for parameter in get_command(app).commands["sensitivity"].params
        for one in parameter.opts
    }  # fmt: skip
    table = PAGE.partition("| option | |")[2].partition("\n\n")[0]
    assert set(re.findall(r"--[a-z]+", table)) <= options
    sizes = re.findall(r"`(\w+):(\d+)`(?:, a grid, a table)? \| ([^|]+) \|", PAGE)
    assert [name for name, _, _ in sizes] == ["morris", "saltelli", "fast", "lhs"]
    for name, size, said in sizes:
        text = (
            re.sub(r"(\d) \(", r"\1 * (", said).replace("2 k", "2 * k").replace("129 k", "129 * k")
        )
        assert designs.SAMPLERS[name].points(int(size), 3) == eval(text, {"k": 3})
