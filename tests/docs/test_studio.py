"""The page on the studio says what the program does, and its code runs."""

import re
from pathlib import Path

import pytest

from socialmind.catalogue import load_model
from socialmind.experiments import Run, Shock
from socialmind.interventions.edit import PARTS
from socialmind.looks import SHAPES
from socialmind.studio.running.frames import unpacked
from socialmind.studio.running.live_run import LiveRun
from socialmind.studio.running.moment import Shown, frame_of

PAGE = (Path(__file__).parents[2] / "docs" / "studio.md").read_text("utf-8")


BLOCKS = re.findall(r"```python\n(.*?)```", PAGE, re.S)
EDITED, MEADOW, STEERED, SHOWN = BLOCKS


def test_its_meadow_looks_as_it_says_and_has_its_button(tmp_path):
    (tmp_path / "meadow.py").write_text(MEADOW, "utf-8")
    live = LiveRun(load_model(tmp_path / "meadow.py")(seed=1, compiled=False))
    live.advance(20)
    header, _ = unpacked(frame_of(live.society, Shown.of(live.society)))
    deer = header["populations"]["deer"]
    assert (deer["shape"], deer["words"]) == ("animal", ["fed", "hungry"])
    assert header["patches"]["range"] == [0, 1]
    live.intervene(Shock(20, type(live.society).buttons["Drought"]))
    assert live.society.world.grass.max() == 0.0


def test_it_names_every_shape():
    assert all(shape in PAGE for shape in SHAPES)


def test_its_code_runs(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    space = {}
    exec(EDITED, space)
    run = Run(space["folder"])
    promoted = run.agents.query("tick == 1000 and agent == 6")
    assert promoted["farmer"].item() == pytest.approx(25.0, abs=5.0)
    exec(STEERED, space)
    exec(SHOWN, space)
    (said,) = re.findall("<recording.*>", SHOWN)
    assert repr(space["shown"]) == said


def test_it_names_every_part_that_can_be_edited():
    for part in PARTS:
        assert f"`{part} " in PAGE
