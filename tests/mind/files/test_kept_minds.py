"""Minds of folders are understood once, while the folder holds what it held."""

import pytest

from socialmind.errors import ModelError
from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.mind.evaluation.arrays import assemble
from socialmind.mind.files.kept_minds import KeptMinds


def mind(weight):
    skill = Skill("Seek", ["SE:Eye"], ["MO:Leg"], Perceptron(layers=0), [weight, 0.0])
    return MindDescription("seeker", ["Eye"], ["Leg"], skills=[skill])


def test_a_folder_is_read_again_once_it_holds_something_else(tmp_path):
    kept = KeptMinds()
    mind(0.25).save(tmp_path)
    first = kept.load(tmp_path)
    assert kept.load(tmp_path) is first
    mind(0.75).save(tmp_path)
    second = kept.load(tmp_path)
    assert second.skills["Seek"].genome.tolist() == [0.75, 0.0]
    assert first.skills["Seek"].genome.tolist() == [0.25, 0.0]
    (tmp_path / "Skills" / "Other").mkdir()
    (tmp_path / "Skills" / "Other" / "odd.ades").write_text("nothing\n")
    with pytest.raises(ModelError):
        kept.load(tmp_path)


def test_a_folder_that_is_gone_is_no_mind(tmp_path):
    with pytest.raises(ModelError, match="no such folder"):
        KeptMinds().load(tmp_path / "nowhere")


def test_arrays_of_a_mind_are_shared_but_for_its_sizes():
    one, other = (assemble(description, "Seek") for description in [mind(0.5)] * 2)
    assert one.structure.sizes is not other.structure.sizes
    assert one.structure.tap_module is other.structure.tap_module
    assert one.codes is other.codes
