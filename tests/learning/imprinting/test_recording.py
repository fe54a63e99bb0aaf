"""Recordings: what they hold, how they join, and their tables."""

import numpy as np
import pytest

from socialmind.errors import ModelError
from socialmind.mind import Perceptron, Skill

torch = pytest.importorskip("torch")

from socialmind.learning.imprinting.recording import Recording  # noqa: E402

SKILL = Skill("Seek", ["SE:Left", "SH:Left:5"], ["MO:Motor"], Perceptron(layers=0))


def test_it_knows_its_episodes():
    recording = Recording(np.full((5, 2), 0.5), np.full((5, 1), 1.0), (2, 0, 3))
    assert recording.lengths == (2, 3)
    assert recording.episodes == [slice(0, 2), slice(2, 5)]
    assert repr(recording) == "<recording of 5 records in 2 episodes: 2 inputs, 1 output>"


def test_it_joins_another():
    first = Recording([[0.1, 0.2]], [[0.3]])
    second = Recording([[0.4, 0.5], [0.6, 0.7]], [[0.8], [0.9]], (1, 1))
    both = first.joined(second)
    assert both.inputs.tolist() == [[0.1, 0.2], [0.4, 0.5], [0.6, 0.7]]
    assert both.outputs.tolist() == [[0.3], [0.8], [0.9]]
    assert both.lengths == (1, 1, 1)


def test_it_is_a_copy_that_cannot_be_written():
    inputs = np.array([[0.1]])
    recording = Recording(inputs, [[0.2]])
    inputs[0, 0] = 0.9
    assert recording.inputs.tolist() == [[0.1]]
    with pytest.raises(ValueError, match="read-only"):
        recording.inputs[0, 0] = 0.9


def test_its_table_reads_back(tmp_path):
    rng = np.random.default_rng(1)
    recording = Recording(rng.random((6, 2)), rng.random((6, 1)), (1, 4, 1))
    recording.write(tmp_path / "driven.csv", SKILL)
    again = Recording.read(tmp_path / "driven.csv", SKILL)
    assert again.inputs.tolist() == recording.inputs.tolist()
    assert again.outputs.tolist() == recording.outputs.tolist()
    assert again.lengths == (1, 4, 1)


def test_a_table_saved_by_excel_keeps_its_episodes(tmp_path):
    lines = "episode,SE:Left,SH:Left:5,MO:Motor\r\n1,0.5,0.5,1\r\n2,0.5,0.5,1\r\n"
    (tmp_path / "driven.csv").write_text(lines, "utf-8-sig", newline="")
    assert Recording.read(tmp_path / "driven.csv", SKILL).lengths == (1, 1)


def test_what_a_skill_has_twice_has_two_columns(tmp_path):
    counts = Skill("Count", ["VA:M", "SE:Left"], ["VA:M"], Perceptron(layers=0))
    recording = Recording([[0.25, 0.5]], [[0.75]])
    recording.write(tmp_path / "counted.csv", counts)
    again = Recording.read(tmp_path / "counted.csv", counts)
    assert (again.inputs.tolist(), again.outputs.tolist()) == ([[0.25, 0.5]], [[0.75]])
    (tmp_path / "counted.csv").write_text("SE:Left,VA:M\n0.5,0.5\n", "utf-8")
    with pytest.raises(ModelError, match="1 columns 'VA:M'; expected each 2 times, as the skill"):
        Recording.read(tmp_path / "counted.csv", counts)


def test_a_table_cannot_be_a_folder(tmp_path):
    with pytest.raises(ModelError, match="cannot be written"):
        Recording([[0.5, 0.5]], [[0.5]]).write(tmp_path, SKILL)


def test_a_table_in_another_order_without_episodes(tmp_path):
    table = tmp_path / "driven.csv"
    table.write_text("MO:Motor,note,SH:Left:5,SE:Left\n1,go,0.5,0.25\n0,stop,0.75,1\n", "utf-8")
    recording = Recording.read(table, SKILL)
    assert recording.inputs.tolist() == [[0.25, 0.5], [1.0, 0.75]]
    assert recording.outputs.tolist() == [[1.0], [0.0]]
    assert recording.lengths == (2,)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            "SE:Left,MO:Motor\n0.5,1\n",
            "driven.csv:1: found a table without the column 'SH:Left:5'; expected the columns "
            "SE:Left, SH:Left:5, MO:Motor",
        ),
        (
            "SE:Left,SH:Left:5,MO:Motor\n0.5,0.5,1\n0.5,0.5,1.5\n",
            "driven.csv:3: found '1.5' for MO:Motor; expected a number, 0 … 1",
        ),
        (
            "SE:Left,SH:Left:5,MO:Motor\n0.5,half,1\n",
            "driven.csv:2: found 'half' for SH:Left:5; expected a number, 0 … 1",
        ),
        (
            "SE:Left,SH:Left:5,MO:Motor\n0.5,0.5\n",
            "driven.csv:2: found '' for MO:Motor; expected a number, 0 … 1",
        ),
        (
            "SE:Left,SH:Left:5,MO:Motor\n0.5,0.5,1\n0.5,0.5,1,0.25\n",
            "driven.csv:3: found 4 cells; expected 3, one for each column",
        ),
        (
            "SE:Left,SH:Left:5,MO:Motor,SE:Left\n0.5,0.5,1,0.5\n",
            "driven.csv:1: found 2 columns 'SE:Left'; expected each once",
        ),
        (
            "episode,SE:Left,SH:Left:5,MO:Motor,episode\n1,0.5,0.5,1,2\n",
            "driven.csv:1: found 2 columns 'episode'; expected each once",
        ),
    ],
)
def test_broken_tables_name_their_line(text, expected, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "driven.csv").write_text(text, "utf-8")
    with pytest.raises(ModelError) as caught:
        Recording.read("driven.csv", SKILL)
    assert str(caught.value) == expected


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        (
            lambda: Recording([[0.5]], [[0.5], [0.5]]),
            "found a recording of 1 inputs and 2 outputs; expected as many of one as of the other",
        ),
        (
            lambda: Recording([[0.5], [1.5]], [[0.5], [0.5]]),
            "found 1.5 in record 1 of the inputs of a recording; expected a number, 0 … 1",
        ),
        (
            lambda: Recording([[0.5]], [[float("nan")]]),
            "found nan in record 0 of the outputs of a recording; expected a number, 0 … 1",
        ),
        (
            lambda: Recording([0.5], [0.5]),
            "found inputs of a recording of shape (1,); expected (records, values)",
        ),
        (
            lambda: Recording([[0.5]], [["go"]]),
            "found outputs of a recording that are no table; expected rows of numbers",
        ),
        (
            lambda: Recording([[0.5]], [[0.5]], (2,)),
            "found episodes of (2,) records; expected 1 records in all",
        ),
        (
            lambda: Recording([[0.5]], [[0.5]], (1.7,)),
            "records of an episode: found 1.7; expected a whole number, 0 or more",
        ),
        (
            lambda: Recording([[0.5]], [[0.5]]).joined(Recording([[0.5, 0.5]], [[0.5]])),
            "found <recording of 1 record in 1 episode: 2 inputs, 1 output> to be joined; expected "
            "one like <recording of 1 record in 1 episode: 1 input, 1 output>",
        ),
        (
            lambda: Recording([[0.5]], [[0.5]]).write("driven.csv", SKILL),
            "found the skill 'Seek' to be trained on 1 inputs and 1 outputs; expected 2 and 1, as "
            "it has",
        ),
    ],
)
def test_refusals(made, expected):
    with pytest.raises(ModelError) as caught:
        made()
    assert str(caught.value) == expected
