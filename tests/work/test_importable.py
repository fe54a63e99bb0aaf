"""Classes and functions of files with private names, found by another process."""

import pickle
from pathlib import Path

from socialmind.sources.folders import catalogue
from socialmind.sources.loading import load_file
from socialmind.work.importable import found, referred


def test_a_class_of_a_model_s_file_is_found_by_the_model_s_name():
    name, folder = next(iter(catalogue().items()))
    cls = next(
        one for one in vars(load_file(folder / "model.py")).values()
        if isinstance(one, type) and one.__module__.startswith("_socialmind")
    )  # fmt: skip
    reference = pickle.loads(pickle.dumps(referred(cls)))
    assert (reference.model, reference.file) == (name, "model.py")
    assert found(reference) is cls


def test_a_class_of_any_other_file_is_found_by_its_path(tmp_path):
    (tmp_path / "slopes.py").write_text("class Slope:\n    pass\n")
    slopes = load_file(tmp_path / "slopes.py")
    reference = referred(slopes.Slope)
    assert (reference.model, Path(reference.file).name) == ("", "slopes.py")
    assert found(pickle.loads(pickle.dumps(reference))) is slopes.Slope


def test_what_can_be_imported_stays_as_it_is():
    assert referred(Path) is Path
    assert found(Path) is Path
    assert referred(None) is None
