"""The steps of figures 7.5 and 7.6."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from socialmind.errors import SocialmindError
from socialmind.experiments.studies import studies_in
from socialmind.learning import Training
from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder
from socialmind.sources.loading import load_file

FOLDER = Path(__file__).parents[2] / "analysis" / "counter"
STEPS = load_file(FOLDER / "steps.py")


def test_its_studies_are_found():
    assert [one.name for one in studies_in(FOLDER)] == ["figure-7.5", "representations"]


def test_the_steps_are_the_thesiss(tmp_path, monkeypatch):
    told = {}

    def draw_steps(folder, path, ticks, style, captions, rows):
        told[path.name] = dict(zip(ticks, captions, strict=True))
        return [path.with_name(f"{path.name}.pdf")]

    monkeypatch.setattr(STEPS, "draw_steps", draw_steps)
    written = STEPS.write_steps(tmp_path)
    assert {path.stem for path in written} == {"figure-7.5", "figure-7.6", "figure-7.5-memory"}
    rows = pd.read_csv(tmp_path / "figure-7.5-memory.csv")
    assert rows["carrying"].tolist() == [1, 0, 1, 0, 0]
    assert rows["delivered"].tolist() == [0, 1, 1, 2, 2]
    assert rows["correct"].tolist() == [0, 0, 0, 0, 1]
    assert list(told["figure-7.5"]) == rows["tick"].tolist()[:3]
    assert list(told["figure-7.6"]) == rows["tick"].tolist()[3:]
    # The task of a step is the skill that has more influence: to collect, or to validate.
    validates = rows["GoToValid+Avoid"] > rows["Collect"]
    assert validates.tolist() == [False, False, False, True, False]


def test_it_says_so_where_no_run_has_a_correct_sequence(tmp_path, monkeypatch):
    monkeypatch.setattr(STEPS, "TICKS", 10)
    monkeypatch.setattr(STEPS, "SEEDS", range(2))
    with pytest.raises(SocialmindError, match="no correct sequence in 2 runs of 10 ticks"):
        STEPS.write_steps(tmp_path)


def test_the_model_has_the_minds_of_attempts_that_are_kept():
    trainings = load_file(FOLDER / "trainings.py")
    for name, (attempt, folder) in trainings.SHIPPED.items():
        learned = Training(trainings.PLANS.kept / name).mind(attempt).skills["CountObjects"]
        shipped = MindDescription.load(model_folder("counter") / folder).skills["CountObjects"]
        assert np.array_equal(learned.genome, shipped.genome)


def test_attempts_are_told_apart_by_what_their_variable_holds():
    representations = load_file(FOLDER / "representations.py")

    def row(attempt, correct, *steps):
        return {"training": "counter", "attempt": attempt, "worlds": 9, "seed": 1,
                "correct_sequences": correct, "sequences": 1.0, "objects": 2.0, "survived": 1.0,
                **{f"step {n}": value for n, value in enumerate(steps, 1)}}  # fmt: skip

    rows = [
        row(1, 0.95, 0.1, 0.1, 0.2, 0.2, 0.0),
        row(2, 0.91, 0.1, 0.1, 0.2, 0.2, 0.0),
        row(3, 0.99, 0.1, 0.2, 0.2, 0.3, 0.1),
        row(4, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0),
        row(5, np.nan, None, None, None, None, None),
    ]
    text = "\n".join(representations.lines_of(rows))
    assert "3 of 5 attempts with 90%" in text
    assert "(best 0.99); 2 different representations among them" in text
    (axes,) = representations.draw(rows).axes
    widths = [round(line.get_linewidth(), 1) for line in axes.lines]
    assert widths == [1.3, 0.8, 0.8]  # the first two attempts come to the same
    assert [text.get_text() for text in axes.texts] == ["4 of 5 drawn"]
    assert axes.get_ylim()[0] < 0 and axes.get_ylim()[1] > 1
