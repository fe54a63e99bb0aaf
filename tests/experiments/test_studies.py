"""Studies: the ways in which they come by trainings, and the pages that they write."""

import pytest

from socialmind.experiments import studies
from socialmind.experiments.studies import Study, Way, reproduce, write_page


def test_a_study_of_trainings_can_be_made_in_each_way(tmp_path):
    def make(way, out):
        return [out / way.name]

    study = Study.of_trainings("figure-0", "nothing", make)
    assert study.make(tmp_path) == [tmp_path / "FULL"]
    assert study.quick(tmp_path) == [tmp_path / "QUICK"]
    assert study.kept(tmp_path) == [tmp_path / "KEPT"]


def test_a_study_that_nothing_is_kept_of_is_made_as_a_whole_and_that_is_said(monkeypatch, tmp_path):
    def make(out):
        return [out / "whole"]

    known = {
        "long": Study("long", "takes long", make, quick=make),
        "short": Study("short", "takes a second", make),
    }
    monkeypatch.setattr(studies, "find", lambda name: [(known[name], tmp_path)])
    with pytest.warns(UserWarning, match="long: no results are kept") as said:
        assert list(reproduce(["long", "short"], tmp_path, kept=True)) == [tmp_path / "whole"] * 2
    assert len(said) == 1


@pytest.mark.parametrize(
    ("way", "command"),
    [(Way.FULL, "figure-0`"), (Way.QUICK, "figure-0 --quick`"), (Way.KEPT, "figure-0 --kept`")],
)
def test_results_say_the_command_that_made_them(way, command):
    assert f"by `socialmind reproduce {command}" in way.said("figure-0", "topic")


def test_a_page_says_how_it_was_made_before_what_was_found(tmp_path):
    page = write_page("found", "Found", ["Made.", "`a`: trained."], ["42."], tmp_path / "new")
    assert page == tmp_path / "new" / "found.md"
    assert page.read_text() == "# Found\n\nMade.\n\n- `a`: trained.\n\n42.\n"
