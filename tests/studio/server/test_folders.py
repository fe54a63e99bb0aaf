"""No path leaves the folders that the program was given."""

import pytest

from socialmind.errors import SocialmindError
from socialmind.studio.server.folders import Folders


@pytest.fixture
def folders(tmp_path):
    for name in ("home", "given", "models", "other"):
        (tmp_path / name).mkdir()
    (tmp_path / "home" / "link").symlink_to(tmp_path / "other")
    home, given, models = (tmp_path / name for name in ("home", "given", "models"))
    return Folders(home, (given,), (models,))


def test_below_home_and_what_was_given_is_read_and_written(folders, tmp_path):
    for said in ("new.yaml", "deep/new.yaml", ".", str(tmp_path / "given" / "one.yaml")):
        assert folders.to_read(said) == folders.to_write(said)
    assert folders.shown(folders.to_write("deep/../new.yaml")) == "new.yaml"


def test_models_are_read_alone(folders, tmp_path):
    said = str(tmp_path / "models" / "scheme.yaml")
    assert folders.shown(folders.to_read(said)) == said
    with pytest.raises(SocialmindError, match="not below"):
        folders.to_write(said)


@pytest.mark.parametrize("said", ["../other/x", "/etc/passwd", "link/x", "a/../../other", "a\0b"])
def test_nothing_else_is_reached(folders, said):
    for way in (folders.to_read, folders.to_write):
        with pytest.raises(SocialmindError, match=r"not below|no path"):
            way(said)


@pytest.mark.parametrize("said", [None, 3, "", " ", ["x"]])
def test_what_is_no_path_is_refused(folders, said):
    with pytest.raises(SocialmindError, match="no path"):
        folders.to_read(said)
