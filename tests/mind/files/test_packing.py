"""The files of a mind, as they are packed and compared."""

from pathlib import Path

from socialmind.mind import MindDescription, Perceptron, Skill
from socialmind.mind.files.packing import files_of


def test_bytecode_is_no_part_of_a_mind(monkeypatch):
    skill = Skill("Go", ["SE:Near"], ["MO:Left"], Perceptron(layers=0), [1.0, 1.0])
    mind = MindDescription("small", ["Near"], ["Left"], skills=[skill])
    before = files_of(mind)
    save = MindDescription.save

    def with_bytecode(one, folder):
        save(one, folder)
        (Path(folder) / "__pycache__").mkdir()
        (Path(folder) / "__pycache__" / "programs.pyc").write_bytes(b"code")

    monkeypatch.setattr(MindDescription, "save", with_bytecode)
    assert files_of(mind) == before and before
