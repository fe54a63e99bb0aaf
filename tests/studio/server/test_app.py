"""What a page may ask for, and what it may not."""

import pytest

from socialmind.studio.server.app import Studio
from socialmind.studio.server.folders import Folders


@pytest.fixture
def studio(tmp_path):
    (tmp_path / "link").symlink_to("/tmp")
    first = {"do": "setup", "model": "my/own", "scheme": "wild.yaml"}
    return Studio(first, Folders(tmp_path))


@pytest.mark.parametrize(
    "command",
    [
        {"do": "setup", "model": "farmer_artisan"},
        {"do": "setup", "model": "my/own"},
        {"do": "save", "folder": None},
        {"do": "save", "folder": "runs/one"},
        {"do": "go"},
        {"do": "open", "folder": "runs/one"},
        {"do": "branch", "into": "w1"},
    ],
)
def test_models_of_the_catalogue_and_folders_below_are_allowed(studio, command):
    assert studio._refusal(command) is None


@pytest.mark.parametrize(
    "command",
    [
        {"do": "setup", "model": "/tmp/evil"},
        {"do": "setup", "model": "../evil"},
        {"do": "setup"},
        {"do": "save", "folder": "../elsewhere"},
        {"do": "save", "folder": "/etc/cron.d/x"},
        {"do": "open", "folder": "/tmp/run"},
        {"do": "join"},
        {"do": "copy", "folder": "runs/one"},
        {"do": "branch", "into": ["w1"]},
        {"do": "open", "folder": "link"},
        {"do": "__init__"},
        {},
    ],
)
def test_nothing_else_is(studio, command):
    assert studio._refusal(command)


def test_the_scheme_of_the_command_line_is_for_its_model_alone(studio):
    own = studio._with_scheme({"do": "setup", "model": "my/own", "scheme": "/etc/passwd"})
    other = studio._with_scheme({"do": "setup", "model": "schelling", "scheme": "/etc/passwd"})
    assert own["scheme"] == "wild.yaml"
    assert other["scheme"] is None
