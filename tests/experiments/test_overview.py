"""The thesis's results beside ours: verdicts follow from tables, and the page is not stale."""

import csv
import shutil
import sys
from pathlib import Path

import pytest

from socialmind.errors import ModelError, SocialmindError
from socialmind.experiments import overview
from socialmind.experiments.judging import CRITERION, Finding, Verdict
from socialmind.experiments.overview import Entry, Result

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
    return Entry(result, findings, ("socialmind reproduce study",), "1 s", "")


@pytest.fixture(scope="module")
def entries():
    return overview.entries()


# Verdicts ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("findings", "verdict"),
    [
        ((AGREES,), Verdict.REPRODUCED),
        ((AGREES, DIFFERS, APART), Verdict.DIFFERENT),
        ((AGREES, AGREES, APART), Verdict.REPRODUCED),
        ((AGREES, APART), Verdict.NOT_COMPARABLE),
        ((DIFFERS, APART, APART), Verdict.NOT_COMPARABLE),
        ((APART,), Verdict.NOT_COMPARABLE),
    ],
)
def test_a_result_has_a_verdict_where_most_can_be_compared_and_is_different_if_anything_is(
    findings, verdict
):
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
    counts = "1 reproduced, 1 different, 0 not comparable"
    assert text.splitlines()[2] == f"Of 2 rows: {counts}. Of 2 entries: {counts}."
    assert 'id="table-1.1"' in page


def test_both_pages_say_by_which_criterion_and_what_is_to_be_known_of_several_rows():
    result = Result("table 1.1", "something", "study", tuple)
    found = [Entry(result, (AGREES,), ("one", "two"), "1 s", "", ("Rows share seeds.",))]
    text, page = overview.as_markdown(found), overview.as_html(found)
    assert all(one in text for one in CRITERION)
    assert "One criterion holds for all rows. A number is reproduced" in page
    assert "- Rows share seeds." in text
    assert "- `one`, `two`, 1 s." in text
    assert "Rows share seeds." in page


def test_a_kept_table_that_is_missing_is_named_with_what_makes_it(tmp_path):
    with pytest.raises(SocialmindError, match=r"no\.csv: not there, .* --kept --out"):
        overview.rows_of(tmp_path / "no.csv")
    (tmp_path / "two.csv").write_text("a,b\n1,2\n1,3\n")
    with pytest.raises(SocialmindError, match="2 rows with"):
        overview.row_of(tmp_path / "two.csv", a="1")


def test_a_result_needs_a_study_and_a_topic_results(tmp_path):
    with pytest.raises(ModelError, match=r"study 'nowhere' for figure 1\.1"):
        overview.commands_of(Result("figure 1.1", "", "nowhere", tuple), {})
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


BY_CONSTRUCTION = [
    ("figure 3.11", "an artisan grows wheat"), ("figure 3.14", "some runs have fewer artisans"),
    ("figure 6.6", "step 2"), ("figure 8.4", "step 8"), ("figure 8.6", "step 1"),
]  # fmt: skip
SEARCHED = ["3.14", "6.6", "7.2", "7.3", "7.5", "7.6", "8.3", "8.4"]
"""Figures of a run that was searched for."""


@pytest.mark.parametrize(("name", "about"), BY_CONSTRUCTION)
def test_what_cannot_fail_is_not_comparable(entries, name, about):
    (one,) = (entry for entry in entries if entry.result.name == name)
    (finding,) = (each for each in one.findings if each.about.startswith(about))
    assert finding.verdict is Verdict.NOT_COMPARABLE


def test_figures_of_a_run_that_was_searched_for_say_how_many_were_looked_through(entries):
    told = {
        one.result.name.removeprefix("figure ")
        for one in entries
        for finding in one.findings
        if "of the runs looked through" in f"{finding.ours} {finding.apart}"
    }
    assert told == set(SEARCHED)


def test_numbers_that_depend_on_the_untold_length_of_runs_are_not_compared(entries):
    for one in entries:
        if one.result.name.startswith("table"):
            for what in (": objects", ": share of the run survived"):
                numbers = [each for each in one.findings if what in each.about]
                assert len(numbers) >= 2
                assert all("does not tell" in each.reason for each in numbers)


def changed(monkeypatch, tmp_path, name, change, *files, place="KEPT"):
    """Return the findings of a result after a change of kept tables.

    Args:
        monkeypatch: the fixture.
        tmp_path: where the changed tables are put.
        name: of the result.
        change: takes the rows of a table and its name, and returns them.
        files: the tables.
        place: what its module calls the folder of the tables, or the one table.
    """
    folders = [one for one in overview.topics().values() if (one / overview.THESIS_FILE).is_file()]
    results = {one.name: one for folder in folders for one in overview.results_in(folder)}
    found = results[name].found
    own = found.__globals__
    package = own["__name__"].rpartition(".")[0]
    near = {name: one for name, one in sys.modules.items() if name.startswith(f"{package}.")}
    kept = next(one[place] for one in (own, *map(vars, near.values())) if place in one)
    for table in (kept if kept.is_dir() else kept.parent).glob("*.csv"):
        shutil.copy(table, tmp_path)
    for file in files:
        rows = change(overview.rows_of(tmp_path / file), file)
        with (tmp_path / file).open("w", newline="") as written:
            writer = csv.DictWriter(written, list(rows[0]))
            writer.writeheader()
            writer.writerows(rows)
    instead = tmp_path if kept.is_dir() else tmp_path / kept.name
    if place in own:
        monkeypatch.setitem(own, place, instead)
    for module in near.values() if package else ():  # findings may stand on modules beside them
        if getattr(module, place, None) == kept:
            monkeypatch.setattr(module, place, instead)
    return {one.about: one for one in found()}


def starting(findings, about):
    (found,) = (one for name, one in findings.items() if name.startswith(about))
    return found


def test_a_table_that_changes_changes_the_verdict(entries, tmp_path, monkeypatch):
    """Robots that fail are counted on the kept table: with six of ten figure 6.5 differs."""
    about = "attempts that succeed in under ten generations"
    (kept,) = (one for one in entries if one.result.name == "figure 6.5")
    assert starting({one.about: one for one in kept.findings}, about).agrees

    def with_failures(rows, _):
        low = {str(number) for number in (1, 2, 3, 4)}
        return [{**row, "shared": "1.0"} if row["attempt"] in low else row for row in rows]

    table = "figure-6.5-attempts.csv"
    findings = changed(monkeypatch, tmp_path, "figure 6.5", with_failures, table)
    found = starting(findings, about)
    assert found.ours.startswith("5 of 10")
    assert not found.agrees


def test_attempts_that_share_draws_are_pairs(tmp_path, monkeypatch):
    """Where Encapsulated survives 10 % more in each pair, that it does is certain."""

    def ten_more(rows, _):
        shares = {"Retrained": 0.0, "Encapsulated": 0.1}
        for row in rows:
            variant = row["structure"].split(",")[0]
            row["survived"] = str(int(row["attempt"]) / 10 + shares[variant])
        return rows

    table = "table-6.3-attempts.csv"
    findings = changed(monkeypatch, tmp_path, "table 6.3", ten_more, table)
    found = starting(findings, "on the original Avoid, Encapsulated survives for longer")
    assert found.ours == "+10% (+10% to +10%), attempt by attempt"
    assert found.agrees


def test_a_representation_counts_where_its_attempt_is_as_good_as_the_best(tmp_path, monkeypatch):
    def with_one_worse(rows, _):
        for row in rows:
            if row["training"] == "counter" and row["step 5"] == "0.1":
                row["sequences"] = "1.5"
        return rows

    table = "representations.csv"
    findings = changed(monkeypatch, tmp_path, "figure 7.5", with_one_worse, table)
    assert not starting(findings, "attempts settle").agrees


@pytest.mark.parametrize(("others", "agrees"), [("6", True), ("5", False)])
def test_how_many_are_artisans_is_to_lie_among_most_runs(others, agrees, tmp_path, monkeypatch):
    """That one run has six says nothing where all others have five."""

    def with_others(rows, _):
        return [{**row, "artisans": others if place else "6"} for place, row in enumerate(rows)]

    table, place = "results.csv", "SEEDS"
    findings = changed(monkeypatch, tmp_path, "figure 3.13", with_others, table, place=place)
    assert starting(findings, "six of 25").agrees is agrees


def test_roles_collapse_as_often_as_most_change_after_next_to_none(entries, tmp_path, monkeypatch):
    (result,) = (one.result for one in entries if one.result.name == "figure 8.6")
    peaks = result.found.__globals__["peaks"]
    assert peaks([0, 2, 5, 8, 4, 5, 1, 3, 6, 0, 2], 9) == [3, 8]
    assert peaks([3, 3, 2, 3, 4], 9) == []

    def with_fewer(rows, _):
        """The first time most are in A these are six; later there are eight, which says less."""
        return [
            {**row, "in_a": str(min(6, int(row["in_a"])))} if int(row["tick"]) < 2000 else row
            for row in rows
        ]

    findings = changed(monkeypatch, tmp_path, "figure 8.6", with_fewer, "figure-8.6.csv")
    assert not starting(findings, "step 2").agrees


def test_lessons_added_with_equal_ticks_are_read_from_the_table(entries, tmp_path, monkeypatch):
    def of_one_attempt_less(rows, file):
        return [row for row in rows if row["attempt"] != "3"]

    (entry,) = (one for one in entries if one.result.name == "table 6.1")
    same = {one.about: one for one in entry.findings}
    found = starting(same, "monolith by curriculum, equal ticks in each lesson: share")
    lessons = ["after Collect", "after More of Collect", "after Still more of Collect; 10 attempts"]
    places = [found.ours.index(one) for one in lessons]
    assert places == sorted(places)
    objects = "a collision ends the run, equal ticks in each lesson: the monolith collects more"
    level = "table-6.1-equal-ticks-attempts.csv"
    less = changed(monkeypatch, tmp_path, "table 6.1", of_one_attempt_less, level)
    assert starting(less, objects).ours != starting(same, objects).ours
    assert "lie between 0.0 and 7.1 objects" in starting(less, objects).reason
