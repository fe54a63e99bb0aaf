"""`socialmind reproduce`: figures made again by name, in their formats, as often as wanted."""

import pytest

import socialmind.experiments.studies as finding
from socialmind.errors import ModelError, SocialmindError
from socialmind.sources import folders

STUDY = """
from socialmind.experiments.studies import Study

def table(out):
    out.mkdir(exist_ok=True)
    (out / "{name}.csv").write_text("a long one")
    return [out / "{name}.csv"]

def quick_table(out):
    out.mkdir(exist_ok=True)
    (out / "{name}.csv").write_text("a quick one")
    return [out / "{name}.csv"]

def kept_table(out):
    out.mkdir(exist_ok=True)
    (out / "{name}.csv").write_text("a kept one")
    return [out / "{name}.csv"]

def broken(out):
    return [] + missing

studies = (
    Study("{name}", "numbers that take long", table, quick_table, kept_table),
    Study("broken-{name}", "what cannot be made", broken),
)
"""


@pytest.fixture
def installed(tmp_path, monkeypatch):
    """A package that stands in the folder `place`, without studies yet."""
    package = tmp_path / "place" / "socialmind"
    package.mkdir(parents=True)
    for module in (folders, finding):
        monkeypatch.setattr(module, "PACKAGE", package)
    return package


def topic(home, name, text):
    (home / name).mkdir(parents=True)
    (home / name / "studies.py").write_text(text)


# The figures of the thesis ---------------------------------------------------------------------


def test_one_command_makes_the_figures_of_variables(socialmind, tmp_path):
    names = ["figure-4.6", "figure-4.7", "figure-4.8"]
    result = socialmind("reproduce", *names)
    assert result.exit_code == 0, result.output
    expected = [f"figures/{name}.{suffix}" for name in names for suffix in ("pdf", "png", "csv")]
    assert result.stdout.split() == expected
    for name in names:
        assert (tmp_path / f"figures/{name}.pdf").read_bytes().startswith(b"%PDF")
        assert (tmp_path / f"figures/{name}.png").read_bytes().startswith(b"\x89PNG")
        assert "value" in (tmp_path / f"figures/{name}.csv").read_text().splitlines()[0]


def test_a_figure_made_again_is_the_same_file(socialmind, tmp_path):
    for out in ("once", "again"):
        assert socialmind("reproduce", "figure-6.6-numbers", "--out", out).exit_code == 0
    for suffix in ("pdf", "png", "csv"):
        file = f"figure-6.6-numbers.{suffix}"
        once, again = (tmp_path / out / file for out in ("once", "again"))
        assert once.read_bytes() == again.read_bytes()


def test_the_list_says_what_can_be_made_and_makes_nothing(socialmind, tmp_path):
    result = socialmind("reproduce", "--list")
    assert result.exit_code == 0
    for name in ("figure-4.6", "figure-4.7", "figure-4.8", "figure-6.6"):
        assert any(line.split()[0] == name for line in result.stdout.splitlines() if line)
    assert list(tmp_path.iterdir()) == []


def test_the_overview_is_of_all_results_as_two_pages(socialmind, refused, tmp_path):
    assert "no names" in refused("reproduce", "figure-4.6", "--overview")
    result = socialmind("reproduce", "--overview", "--out", "there")
    assert result.stdout.split() == ["there/overview.md", "there/overview.html"]
    assert "<h1>The thesis" in (tmp_path / "there" / "overview.html").read_text("utf-8")


def test_unknown_names_are_met_before_anything_is_made(refused, tmp_path):
    line = refused("reproduce", "figure-4.7", "figure-4.66")
    assert line == "socialmind: no study called figure-4.66; did you mean 'figure-4.6'?"
    assert list(tmp_path.iterdir()) == []


def test_a_name_is_needed(refused):
    line = refused("reproduce")
    assert line == "socialmind: which study? `socialmind reproduce --list` shows them"


# Finding studies -------------------------------------------------------------------------------


def test_a_topic_stands_for_its_studies(socialmind, installed, tmp_path):
    text = (
        STUDY.format(name="table-1")
        .replace('Study("broken', 'Study("other')
        .replace("broken),", "table),")
    )
    topic(installed.parent / "analysis", "tables_of_one", text)
    result = socialmind("reproduce", "tables-of-one", "table-1")
    assert result.stdout.split() == ["figures/table-1.csv"] * 2  # of two studies, each once
    assert (tmp_path / "figures/table-1.csv").read_text() == "a long one"


def test_quick_makes_the_smaller_version_where_there_is_one(socialmind, installed, tmp_path):
    topic(installed.parent / "analysis", "tables", STUDY.format(name="table-1"))
    assert socialmind("reproduce", "table-1", "--quick", "--out", "q").exit_code == 0
    assert (tmp_path / "q/table-1.csv").read_text() == "a quick one"


def test_what_takes_long_can_be_made_from_kept_results(socialmind, installed, tmp_path):
    topic(installed.parent / "analysis", "tables", STUDY.format(name="table-1"))
    assert socialmind("reproduce", "table-1", "--kept", "--out", "k").exit_code == 0
    assert (tmp_path / "k/table-1.csv").read_text() == "a kept one"
    both = socialmind("reproduce", "table-1", "--kept", "--quick")
    assert both.exit_code == 2
    assert "expected one of both" in both.stderr


def test_studies_in_the_package_come_before_those_beside_it(socialmind, installed):
    topic(installed / "_analysis", "inside", STUDY.format(name="table-1"))
    topic(installed.parent / "analysis", "beside", STUDY.format(name="table-2"))
    result = socialmind("reproduce", "--list")
    assert "table-1" in result.stdout
    assert "table-2" not in result.stdout


def test_folders_without_studies_are_no_topics(installed):
    (installed.parent / "analysis" / "notes").mkdir(parents=True)
    topic(installed.parent / "analysis", "tables", STUDY.format(name="table-1"))
    assert list(finding.topics()) == ["tables"]
    with pytest.raises(SocialmindError, match="no study called x; there is table-1, "):
        finding.find("x")


def test_without_studies_the_error_says_where_they_should_be(refused, installed):
    for words in (["--list"], ["figure-4.6"]):
        line = refused("reproduce", *words)
        assert line.startswith(f"socialmind: the studies are not installed in {installed.parent}; ")
        assert "from a checkout" in line


def test_a_study_that_stops_is_one_line_with_its_place(refused, installed):
    topic(installed.parent / "analysis", "tables", STUDY.format(name="table-1"))
    line = refused("reproduce", "broken-table-1")
    assert "tables/studies.py:20: broken-table-1 stopped with NameError" in line


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "found no `studies`; expected the studies of the topic"),
        ("studies = ['figure-1']", "found list as `studies`"),
        ("studies = (", "not valid Python"),
    ],
)
def test_a_wrong_file_of_studies_is_named(installed, text, message):
    topic(installed.parent / "analysis", "odd", text)
    with pytest.raises(ModelError, match=r"odd/studies\.py") as caught:
        finding.catalogue_of_studies()
    assert message in str(caught.value)


def test_a_name_belongs_to_one_study(installed):
    for name in ("first", "second"):
        topic(installed.parent / "analysis", name, STUDY.format(name="table-1"))
    with pytest.raises(ModelError, match="a second study called 'table-1'") as caught:
        finding.catalogue_of_studies()
    assert str(installed.parent / "analysis" / "first") in str(caught.value)
