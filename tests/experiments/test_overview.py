"""The thesis's results beside ours: verdicts follow from tables, and the page is not stale."""

from pathlib import Path

import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.experiments import overview
from socialmind.experiments.overview import Entry, Finding, Result, Verdict

ANALYSIS = Path(__file__).parents[2] / "analysis"
REPORTED = [
    "3.1", *(f"3.{n}" for n in range(8, 15)), "4.6", "4.7", "4.8",
    "6.2", "6.3", "6.4", "6.5", "6.6", "7.2", "7.3", "7.5", "7.6", "8.3", "8.4", "8.6", "8.7",
]  # fmt: skip
"""The figures of the thesis that show results."""
TABLES = ["6.1", "6.2", "6.3"]

AGREES = Finding("a", "1", "1", True)
DIFFERS = Finding("b", "1", "2", False, why="another seed")
APART = Finding("c", "1", "2", True, apart="another unit")


def entry(*findings, name="figure 1.1"):
    result = Result(name, "something", "study", lambda: findings)
    return Entry(result, findings, "socialmind reproduce study", "1 s", "")


@pytest.fixture(scope="module")
def entries():
    return overview.entries()


# Verdicts ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("findings", "verdict"),
    [
        ((AGREES,), Verdict.REPRODUCED),
        ((AGREES, DIFFERS, APART), Verdict.DIFFERENT),
        ((AGREES, APART), Verdict.REPRODUCED),
        ((APART,), Verdict.NOT_COMPARABLE),
    ],
)
def test_a_result_is_different_if_anything_is_and_counts_what_can_be_compared(findings, verdict):
    assert entry(*findings).verdict is verdict


def test_a_reason_is_given_where_ours_does_not_agree_and_nowhere_else():
    assert (AGREES.reason, DIFFERS.reason, APART.reason) == ("", "another seed", "another unit")
    assert Finding("d", "1", "2").reason == "unknown"
    assert entry(AGREES, DIFFERS).counted == "different (1 reproduced, 1 different)"


def test_both_pages_hold_every_finding():
    found = [entry(Finding("a|b", "1 < 2", "2", False)), entry(AGREES, name="table 1.1")]
    text, page = overview.as_markdown(found), overview.as_html(found)
    assert r"| a\|b | 1 < 2 | 2 | different | unknown |" in text
    assert "<td>a|b</td><td>1 &lt; 2</td>" in page
    assert "Of 2 entries: 1 reproduced, 1 different, 0 not comparable." in text
    assert 'id="table-1.1"' in page


def test_a_kept_table_that_is_missing_is_named_with_what_makes_it(tmp_path):
    with pytest.raises(SocialmindError, match=r"no\.csv: not there, .* --kept --out"):
        overview.rows_of(tmp_path / "no.csv")
    (tmp_path / "two.csv").write_text("a,b\n1,2\n1,3\n")
    with pytest.raises(SocialmindError, match="2 rows with"):
        overview.row_of(tmp_path / "two.csv", a="1")


def test_a_result_needs_a_study_and_a_topic_results(tmp_path):
    with pytest.raises(ModelError, match=r"study 'nowhere' for figure 1\.1"):
        overview.command_of(Result("figure 1.1", "", "nowhere", tuple), {})
    (tmp_path / "thesis.py").write_text("results = ['figure 1.1']")
    with pytest.raises(ModelError, match="found list as `results`"):
        overview.results_in(tmp_path)


# The overview itself -----------------------------------------------------------------------------


def test_all_results_of_the_thesis_are_there_in_its_order(entries):
    names = [one.result.name for one in entries]
    assert names == [f"figure {one}" for one in REPORTED] + [f"table {one}" for one in TABLES]


def test_what_does_not_agree_has_a_reason(entries):
    for one in entries:
        assert one.findings
        assert all(f.ours and f.thesis and f.about for f in one.findings)
        assert all(bool(f.reason) != (f.verdict is Verdict.REPRODUCED) for f in one.findings)


def test_the_committed_page_is_what_the_command_makes(entries):
    kept = (ANALYSIS / "overview.md").read_text("utf-8")
    assert kept == overview.as_markdown(entries), (
        "analysis/overview.md is stale: `socialmind reproduce --overview --out analysis`"
    )


def test_a_table_that_changes_changes_the_verdict(entries, tmp_path, monkeypatch):
    """The robots' failures are counted on the kept table: with none, figure 6.4 agrees."""
    topic = ANALYSIS / "collect"
    (result,) = (one for one in overview.results_in(topic) if one.name == "figure 6.4")
    findings = {one.about: one for one in result.found()}
    assert not findings["GoToObject+Avoid: attempts that succeed"].agrees
    source = topic / "results" / "figure-6.4-attempts.csv"
    rows = source.read_text().splitlines()
    column = rows[0].split(",").index("finals")
    mended = [rows[0]]
    for row in rows[1:]:
        cells = row.split(",")
        cells[column] = "4.0" if cells[0] == "GoToObject+Avoid" else cells[column]
        mended.append(",".join(cells))
    (tmp_path / source.name).write_text("\n".join(mended) + "\n")
    monkeypatch.setitem(result.found.__globals__, "KEPT", tmp_path)
    findings = {one.about: one for one in result.found()}
    assert findings["GoToObject+Avoid: attempts that succeed"].agrees
