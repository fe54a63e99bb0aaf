"""The page about notebooks and the notebook of the first hour: both run in a kernel."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

nbclient = pytest.importorskip("nbclient", reason="the notebooks need nbclient and ipykernel")
nbformat = pytest.importorskip("nbformat")
pytest.importorskip("ipykernel")

DOCS = Path(__file__).parents[2] / "docs"
NOTEBOOK = DOCS / "first_hour.ipynb"
LIMIT = 600
"""Seconds that a cell may take on a busy machine."""


@pytest.fixture(autouse=True)
def as_in_a_shell(monkeypatch):
    """Leave out what commands that draw set in the process of the tests."""
    monkeypatch.delenv("MPLBACKEND", raising=False)


def run_cells(cells, folder):
    """Run the cells of a notebook in a folder of its own, and return them with their outputs."""
    notebook = nbformat.v4.new_notebook(cells=cells)
    client = nbclient.NotebookClient(
        notebook, timeout=LIMIT, resources={"metadata": {"path": str(folder)}}
    )
    return [one for one in client.execute().cells if one.cell_type == "code"]


def shown(cell, kind="text/plain"):
    """What a cell gave, in one of its forms."""
    return [one["data"][kind] for one in cell.outputs if kind in one.get("data", {})]


def test_the_first_hour_runs_as_it_stands(tmp_path):
    cells = run_cells(nbformat.read(NOTEBOOK, 4).cells, tmp_path)
    ends = {cell.source.splitlines()[-1]: cell for cell in cells}
    assert shown(ends["replay(folder).equal"]) == ["True"]
    assert shown(ends["bool((slow.foragers.food == fast.foragers.food).all())"]) == ["True"]
    for line in ("society", "Run(folder)", 'village.schemes["humans"]', "Sweep(made)"):
        assert shown(ends[line], "text/html")[0].startswith("<table>")
    assert "WheatStock" in shown(ends["village.explain(agent=6, tick=20_000)"], "text/html")[0]
    pictures = [picture for cell in cells for picture in shown(cell, "image/png")]
    assert len(pictures) == 3
    table = shown(cells[-2])[0]
    assert "gini" in table and "NaN" not in table


def test_it_is_committed_without_outputs():
    for path in sorted(DOCS.parent.rglob("*.ipynb")):
        if ".ipynb_checkpoints" in path.parts:
            continue
        for cell in json.loads(path.read_text("utf-8"))["cells"]:
            if cell["cell_type"] == "code":
                assert cell["outputs"] == [] and cell["execution_count"] is None, path
            assert "metadata" in cell and cell["metadata"] == {}, path


def test_its_links_lead_somewhere():
    text = "".join(cell.source for cell in nbformat.read(NOTEBOOK, 4).cells)
    links = re.findall(r"\]\(([^)#]+)\)", text)
    assert len(links) > 5
    assert [one for one in links if not (DOCS / one).is_file()] == []


def test_the_page_runs_in_cells(tmp_path):
    page = (DOCS / "notebooks.md").read_text("utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(blocks) == 3
    short = [block.replace("workers=2", "workers=2, compiled=False") for block in blocks]
    short[2] = short[2].replace("ticks=10", "ticks=10, compiled=False")
    cells = run_cells([nbformat.v4.new_code_cell(block) for block in short], tmp_path)
    assert "Name: spread" in shown(cells[1])[-1]
    assert shown(cells[2]) == ["True"]
    assert "class Walk(Model)" in (tmp_path / "walk/source/model/cells.py").read_text()


def test_marimo_takes_it(tmp_path):
    if shutil.which("marimo") is None:
        pytest.skip("marimo is not installed")
    made = tmp_path / "first_hour.py"
    subprocess.run(["marimo", "convert", NOTEBOOK, "-o", made], check=True)
    subprocess.run([sys.executable, made], check=True, cwd=tmp_path, timeout=LIMIT)
