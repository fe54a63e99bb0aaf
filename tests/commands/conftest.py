"""What the tests of the commands share: the commands themselves, a model and a run."""

import pytest
from typer.testing import CliRunner

from socialmind.cli import app


def invoke(*words):
    return CliRunner().invoke(app, [str(word) for word in words])


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="session")
def socialmind():
    """Call a command, word by word."""
    return invoke


@pytest.fixture(scope="session")
def refused():
    """Call a command that ends with exit code 2; gives its one line on stderr."""

    def call(*words):
        result = invoke(*words)
        assert result.exit_code == 2, result.output
        assert result.stdout == ""
        (line,) = result.stderr.splitlines()
        return line

    return call


@pytest.fixture(scope="session")
def grazers(tmp_path_factory):
    """The folder of the model that `socialmind new` writes."""
    folder = tmp_path_factory.mktemp("model") / "grazers"
    assert invoke("new", folder).exit_code == 0
    return folder


@pytest.fixture(scope="session")
def done(grazers, tmp_path_factory):
    """A run of it, 40 ticks, interpreted."""
    out = tmp_path_factory.mktemp("done") / "run"
    words = ("--ticks", 40, "--seed", 4, "--set", "n_grazers=3", "--interpreted", "--out", out)
    result = invoke("run", grazers, *words)
    assert result.exit_code == 0, result.output
    return out
