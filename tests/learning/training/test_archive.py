"""Arrays with a record in one file."""

import numpy as np
import pytest

from socialmind.errors import SocialmindError
from socialmind.learning.training import archive
from socialmind.runs.arrays_file import save_arrays


def test_what_is_saved_is_loaded_and_replaces_what_was_there(tmp_path):
    path = tmp_path / "one.npz"
    save_arrays(path, {"done": 1}, {"x": np.arange(3.0)})
    save_arrays(path, {"done": 2, "names": ["é"]}, {"y/a": np.array([1, 2])})
    record, arrays = archive.load(path)
    assert record == {"done": 2, "names": ["é"]}
    assert arrays["y/a"].tolist() == [1, 2]
    assert [one.name for one in tmp_path.iterdir()] == ["one.npz"]


@pytest.mark.parametrize("content", [b"", b"no archive", None])
def test_what_is_no_whole_file_is_refused(tmp_path, content):
    path = tmp_path / "one.npz"
    save_arrays(path, {}, {"x": np.arange(1000.0)})
    path.write_bytes(path.read_bytes()[:2000] if content is None else content)
    with pytest.raises(SocialmindError, match=r"one\.npz: not a whole file of a training"):
        archive.load(path)
