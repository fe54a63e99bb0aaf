"""Our schemes of CogLogo's models beside the original files, where those are there."""

import os
from pathlib import Path

import pytest

from coglogo_py import CognitiveScheme
from socialmind.sources.folders import model_folder

BESIDE = Path(__file__).parents[2].parent / "shared" / "data"


@pytest.mark.parametrize(
    ("name", "file", "original"),
    [
        ("herds", "scheme.yaml", "herd_cows"),
        ("wolf_cow", "cows.yaml", "wolf_cow_cows"),
        ("wolf_cow", "wolves.yaml", "wolf_cow_wolves"),
    ],
)
def test_the_scheme_equals_the_file_of_coglogo(name, file, original):
    folder = Path(os.environ.get("SOCIALMIND_SHARED_DATA", BESIDE)) / "cogscheme"
    path = folder / f"{original}.cogscheme"
    if not path.exists():
        pytest.skip(f"no {path}: set SOCIALMIND_SHARED_DATA to the folder of CogLogo's files")
    assert CognitiveScheme.load(model_folder(name) / file) == CognitiveScheme.load(path)
