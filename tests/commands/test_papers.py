"""`socialmind odd`, `methods`, `export` and `draw`."""

import shutil

import pytest

from socialmind.commands.starting import write_model

SCHEME = """
name: sheep
decision_maker: {name: MaximumWeight}
cognitons:
  Hunger: {at_birth: true, start: 1, influence: {Eat: 2}, conditional: [Eat]}
"""


def test_odd_writes_questions_first_and_then_what_is_said(socialmind, tmp_path):
    write_model(tmp_path / "meadow")
    result = socialmind("odd", "./meadow")
    assert result.exit_code == 0, result.output
    assert "odd_words.md: fill this in" in result.stderr
    assert "missing: the author's words on the design concept 'Emergence'" in result.stderr
    assert result.stdout.split()[0] == str(tmp_path / "meadow/ODD.md")
    words = tmp_path / "meadow/odd_words.md"
    words.write_text(words.read_text("utf-8") + "\n", "utf-8")
    again = socialmind("odd", "./meadow")
    assert "fill this in" not in again.stderr


def test_odd_check_fails_on_a_stale_document_and_writes_nothing(socialmind, tmp_path):
    assert socialmind("odd", "schelling", "--check").exit_code == 0
    write_model(tmp_path / "meadow")
    result = socialmind("odd", "./meadow", "--check")
    assert result.exit_code == 1
    assert "ODD.md: no such file" in result.stdout
    assert "missing the author's words on 'Submodels'" in result.stdout
    assert not (tmp_path / "meadow/odd_words.md").exists()


def test_odd_writes_html_where_it_is_told(socialmind, tmp_path):
    result = socialmind("odd", "schelling", "--out", "schelling.html")
    assert result.stdout.split() == ["schelling.html"]
    assert (tmp_path / "schelling.html").read_text("utf-8").startswith("<!doctype html>")


def test_methods_and_export_of_a_run(socialmind, done, tmp_path):
    told = socialmind("methods", done)
    assert told.exit_code == 0, told.output
    assert "was run with socialmind" in told.stdout
    result = socialmind("export", done, "--to", "dta", "--table", "agents", "--out", "stata")
    assert result.exit_code == 0, result.output
    assert result.stdout.split() == ["stata/agents.dta"]
    assert (tmp_path / "stata/agents.dta").is_file()


def test_export_lists_what_stata_calls_otherwise(socialmind, done, tmp_path):
    import pandas as pd

    shutil.copytree(done, tmp_path / "run")
    pd.DataFrame({"weight_of_a_plan_with_a_very_long_name": [1.0]}).to_parquet("run/agents.parquet")
    result = socialmind("export", "run", "--to", "dta", "--table", "agents")
    (line,) = result.stderr.splitlines()
    name = "weight_of_a_plan_with_a_very_long_name"
    assert line == f"agents: {name} is called {name[:32]} in Stata"


@pytest.mark.parametrize("suffix", ["pdf", "svg", "png"])
def test_draw_draws_a_scheme_in_the_form_that_the_name_says(socialmind, tmp_path, suffix):
    (tmp_path / "sheep.yaml").write_text(SCHEME)
    result = socialmind("draw", "sheep.yaml", "--out", f"sheep.{suffix}")
    assert result.stdout.split() == [f"sheep.{suffix}"], result.output
    begin = {"pdf": b"%PDF", "svg": b"<?xml", "png": b"\x89PNG"}[suffix]
    assert (tmp_path / f"sheep.{suffix}").read_bytes().startswith(begin)


def test_draw_draws_a_mind_without_running_its_programs(socialmind, tmp_path):
    from socialmind.sources.folders import model_folder

    shutil.copytree(model_folder("braitenberg") / "mind", tmp_path / "wheels")
    program = tmp_path / "wheels/Skills/Wheels/Wheels.py"
    program.write_text("raise SystemExit('run')\n" + program.read_text("utf-8"), "utf-8")
    result = socialmind("draw", "wheels")
    assert result.stdout.split() == ["wheels.pdf"], result.output


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("draw", "none.yaml"), "none.yaml: no such file; expected a scheme's file"),
        (("draw", "sheep.yaml", "--out", "a.doc"), "a.doc: found .doc; expected .pdf, .svg, .png"),
        (("draw", "sheep.yaml", "--width", 10), "--width 10: expected 60 … 400 mm"),
        (("draw", "sheep.yaml", "--master", "A"), "--master is for minds of skills"),
        (("export", ".", "--to", "csv"), ".: holds no manifest.json; expected the folder of a run"),
        (("methods", "."), ".: holds no manifest.json"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(refused, tmp_path, words, told):
    (tmp_path / "sheep.yaml").write_text(SCHEME)
    assert told in refused(*words)
