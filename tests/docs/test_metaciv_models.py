"""The page on MetaCiv's models: its commands work, and its Python runs."""

from pathlib import Path

from socialmind.sources.loading import load_file
from tests.metaciv.reading.folders import FARMERS, written

DOCS = Path(__file__).parents[2] / "docs"
follow = load_file(DOCS / "site" / "following.py").follow


def interpreted(words):
    return [*words, "--interpreted"] if words[1] == "run" else words


def test_the_page_can_be_followed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    written(tmp_path / "farmers", FARMERS)
    names, _ = follow("metaciv_models.md", interpreted)
    assert names["reading"].findings == ()
    assert capsys.readouterr().out == "['Work'] 3\n"
    assert (tmp_path / "exported/farmer.cogscheme").is_file()
