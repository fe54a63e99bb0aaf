"""`socialmind list`, `new`, `check` and `explain`."""

import re
import shutil
from dataclasses import replace

import pytest

from coglogo_py import CognitiveScheme
from socialmind.experiments import Run

SCHEME = """
name: odd
decision_maker: MaximumWeight
plans: [Sit, Fly]
cognitons:
  Tired: {at_birth: true, start: 1, influence: {Sit: 1, Fly: 1}, conditional: [Sit]}
"""


def test_list_shows_every_model_and_parameter(socialmind):
    result = socialmind("list")
    assert result.exit_code == 0, result.output
    assert re.search(r"^farmer_artisan: Trade makes", result.stdout, re.MULTILINE)
    assert re.search(r"^  tool_price +167 +wheat a tool +1e-06 or more", result.stdout, re.M)
    assert re.search(r"^  starvation +false +true or false", result.stdout, re.M)
    assert re.search(r"^tutorial: ", result.stdout, re.MULTILINE)


def test_list_of_one_model(socialmind, grazers, refused):
    result = socialmind("list", "collect")
    assert result.exit_code == 0, result.output
    assert re.search(r"^  half_width +70 +units +60 or more", result.stdout, re.M)
    assert re.search(r"^  robots +1 +Collector +skills mind +.*delivered", result.stdout, re.M)
    assert re.search(r"^  measures +objects, survived, collisions$", result.stdout, re.M)
    assert re.search(r"^  lessons +GoToObject, GoToDropZone, Avoid", result.stdout, re.M)
    own = socialmind("list", grazers).stdout
    assert re.search(r"^  n_grazers +\d+", own, re.M)
    assert re.search(r"^  grazers +n_grazers +Grazer +scheme scheme.yaml", own, re.M)
    assert f"  folder  {grazers}\n" in own
    assert "did you mean" in refused("list", "colect")


def test_the_small_model_is_small_checks_and_runs(socialmind, grazers, done):
    assert sorted(p.name for p in grazers.iterdir()) == ["README.md", "model.py", "scheme.yaml"]
    code = (grazers / "model.py").read_text().splitlines()
    assert len([line for line in code if line.strip()]) < 40
    result = socialmind("check", grazers)
    assert result.exit_code == 0
    assert result.stdout == f"{grazers}: nothing odd found\n"
    assert Run(done).manifest.parameters == {"n_grazers": 3, "regrowth": 0.01}
    assert set(Run(done).agents["plan"].dropna()) == {"Wander", "Graze"}


def test_new_leaves_a_folder_in_use_alone(refused, tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    assert refused("new", tmp_path).endswith("is not empty; give a fresh folder")
    assert refused("new", tmp_path / "mine.txt").endswith("is a file; give a folder")
    assert [p.name for p in tmp_path.iterdir()] == ["mine.txt"]


def test_check_of_a_scheme(socialmind, refused, tmp_path):
    path = tmp_path / "odd.yaml"
    path.write_text(SCHEME)
    result = socialmind("check", path)
    assert result.exit_code == 1
    assert "Fly" in result.stdout
    assert result.stdout.startswith(f"{path}: plan never available")
    clean = SCHEME.replace("[Sit]", "[Sit, Fly]").replace("MaximumWeight", "WeightedStochastic")
    path.write_text(clean)
    result = socialmind("check", path)
    assert (result.exit_code, result.stdout) == (0, f"{path}: nothing odd found\n")
    path.write_text("cognitons: [")
    assert refused("check", path).startswith(f"socialmind: {path}:")
    assert refused("check", tmp_path / "none.cogscheme").endswith("no such file")


def test_check_of_a_model_whose_rule_is_outside_the_language(refused, grazers, tmp_path):
    shutil.copytree(grazers, tmp_path / "bad")
    model = tmp_path / "bad" / "model.py"
    text = model.read_text().replace("    grazer.energy -= 0.2\n", "    del grazer.energy\n")
    model.write_text(text)
    line = text.splitlines().index("    del grazer.energy") + 1
    assert f"{model}:{line}: del in the rule 'live'" in refused(
        "check", tmp_path / "bad", "--trust"
    )


def test_check_of_a_model_knows_its_plans(socialmind, grazers, tmp_path):
    shutil.copytree(grazers, tmp_path / "odd")
    scheme = tmp_path / "odd" / "scheme.yaml"
    scheme.write_text(scheme.read_text().replace("conditional: [Wander]", "conditional: [Graze]"))
    result = socialmind("check", tmp_path / "odd")
    assert result.exit_code == 1
    assert f"{scheme}: plan never available: plan 'Wander'" in result.stdout


def test_check_says_what_it_did_not_look_at(socialmind, grazers, tmp_path):
    shutil.copytree(grazers, tmp_path / "odd")
    model = tmp_path / "odd" / "model.py"
    text = model.read_text()
    line = next(n for n, one in enumerate(text.splitlines(), 1) if "= Population(" in one)

    def said(old="", new=""):
        model.write_text(text.replace(old, new))
        result = socialmind("check", tmp_path / "odd")
        assert (result.exit_code, result.stdout) == (0, f"{tmp_path / 'odd'}: nothing odd found\n")
        return [one for one in result.stderr.splitlines() if "not looked at; --trust" in one]

    assert said() == []
    place = f"{model}:{line}: Population(…"
    (one,) = said('"scheme.yaml"', "NAME + '.yaml'")
    assert one.startswith(f"{place}, mind=NAME + '.yaml') was not")
    (one,) = said('plans={"Wander": wander, "Graze": graze}', "plans=PLANS")
    assert one.startswith(f"{place}, plans=…): whether the scheme has these plans was not")
    (one,) = said('Population(\n        Grazer, "n_grazers", mind', "sm.Population(\n**MORE, mind")
    assert one.startswith(f"{place}, **MORE) was not")
    (one,) = said('mind="scheme.yaml"', 'mind="scheme.yaml", hierarchy="mind"')
    assert one.startswith(f"{place}, hierarchy='mind') was not")
    scheme = tmp_path / "odd" / "scheme.yaml"
    scheme.write_text(scheme.read_text().replace("WeightedStochastic", "Mine"))
    (one,) = said()
    assert one.startswith(f"{scheme}: the scheme, whose decision maker may be the model's own was")


def test_check_of_a_file_that_may_have_been_cut_off(socialmind, grazers, tmp_path):
    scheme = replace(CognitiveScheme.load(grazers / "scheme.yaml"), plan_order=None)
    for name in ("a.cogscheme", "a.yaml"):
        path = tmp_path / name
        scheme.save(path)
        whole = path.read_bytes()
        assert socialmind("check", path).exit_code == 0
        lines = whole.splitlines(keepends=True)
        cut = whole[:-1] if name == "a.yaml" else b"".join(lines[:-1])  # without its ENDCS
        path.write_bytes(cut)
        result = socialmind("check", path)
        assert result.exit_code == 1
        assert result.stdout.startswith(f"{path}:") and "cut off" in result.stdout


def test_explain_prints_the_receipt(socialmind, done):
    result = socialmind("explain", done, "--agent", 1, "--tick", 20)
    assert result.exit_code == 0, result.output
    assert "Hunger" in result.stdout
    assert "probability" in result.stdout


@pytest.mark.parametrize(
    ("agent", "tick", "message"),
    [
        (99, 20, "no agent 99 lives at tick 20"),
        (1, 41, "tick 41: expected 1 … 40"),
        (1, 0, "tick 0: expected 1 … 40"),
    ],
)
def test_explain_of_nothing(refused, done, agent, tick, message):
    assert message in refused("explain", done, "--agent", agent, "--tick", tick)


def test_check_runs_nothing_and_lists_programs(socialmind, grazers, tmp_path):
    shutil.copytree(grazers, tmp_path / "bad")
    model = tmp_path / "bad" / "model.py"
    model.write_text(model.read_text() + "raise SystemExit(7)\n")
    result = socialmind("check", tmp_path / "bad")
    assert result.exit_code == 0
    assert str(model) in result.stderr
    mind = tmp_path / "M"
    mind.mkdir()
    (mind / "M.botdesc").write_text("SENSORS\nACTUATORS\nA:motor\n")
    (mind / "M.vardesc").write_text("V:RegulatedVariableModule::f.py:f\n")
    (mind / "f.py").write_text("raise SystemExit(7)\ndef f(value):\n    return value\n")
    result = socialmind("check", mind)
    assert "f.py" in result.stderr
    assert result.exit_code != 7


def test_check_of_a_model_knows_fields_and_what_its_rules_set(
    socialmind, refused, grazers, tmp_path
):
    shutil.copytree(grazers, tmp_path / "odd")
    scheme = tmp_path / "odd" / "scheme.yaml"
    plain = scheme.read_text()
    scheme.write_text(plain.replace("  Hunger:\n", "  Hunger:\n    type: percept\n"))
    assert socialmind("check", tmp_path / "odd", "--trust").exit_code == 0
    more = "  Light:\n    type: percept\n    conditional: [Graze]\n  Hunger:\n"
    scheme.write_text(plain.replace("  Hunger:\n", more))
    result = socialmind("check", tmp_path / "odd", "--trust")
    assert "not as its type: percept 'Light': no rule and no condition sets it" in result.stdout
    scheme.write_text(
        plain.replace("  Hunger:\n", more.replace("type: percept", "active_while: lux>1"))
    )
    line = refused("check", tmp_path / "odd", "--trust")
    number = scheme.read_text().split("\n").index("    active_while: lux>1") + 1
    assert f"{scheme}:{number}: found 'lux' in the condition 'lux > 1'" in line
