"""Words of schemes: the same as editing the file by hand, and what names can mean."""

from dataclasses import replace

import pytest

from coglogo_py import CognitiveScheme, SchemeError
from coglogo_py.changing.words import with_word, words_of
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments.sweeps.preparing import nameable

EDITS = [
    ("influence.WheatNeed.GrowWheat", 0.25, "GrowWheat: 1}", "GrowWheat: 0.25}"),
    (
        "reinforcement.Farmer.TradeWheatForTools", 0.5,
        "{TradeWheatForTools: 0.05, ", "{TradeWheatForTools: 0.5, ",
    ),
    ("decision_maker.bias", 1.5, "bias: 2.6", "bias: 1.5"),
    (
        "decision_maker.name", "WeightedStochastic",
        "BiasedWeightedStochastic, bias: 2.6", "WeightedStochastic, bias: 2.6",
    ),
    (
        "start.Artisan", 3.0,
        "at_birth: true\n    start: 0\n    colour: '#3366ff'\n    position: [447",
        "at_birth: true\n    start: 3\n    colour: '#3366ff'\n    position: [447",
    ),
    ("at_birth.ToolStock", True, "at_birth: false", "at_birth: true"),
    (
        "influence.Farmer.ProduceTools", 2.0,
        "influence: {GrowWheat: 5}", "influence: {GrowWheat: 5, ProduceTools: 2}",
    ),
]  # fmt: skip

GROUPS = """name: cattle
plans: [lead, follow]
cognitons:
  Mood: {influence: {lead: 1}, conditional: [lead, follow]}
groups:
  herd:
    leader:
      Peace: {start: 1, influence: {follow: 2}}
    member:
      Peace:
  pack:
    wolf:
      Mood: {start: 2, influence: {lead: 3}}
"""


@pytest.fixture(scope="module")
def farmers():
    return load_model("farmer_artisan")


@pytest.mark.parametrize(("name", "value", "old", "new"), EDITS, ids=[one[0] for one in EDITS])
def test_a_word_is_an_edit_of_the_file(farmers, tmp_path, name, value, old, new):
    text = (farmers.folder() / "scheme.yaml").read_text()
    assert text.count(old) == 1
    (tmp_path / "edited.yaml").write_text(text.replace(old, new))
    edited = CognitiveScheme.load(tmp_path / "edited.yaml")
    scheme = CognitiveScheme.load(farmers.folder() / "scheme.yaml")
    assert with_word(scheme, name, value) == edited != scheme


def test_culturons_have_words_too():
    scheme = CognitiveScheme.parsed(GROUPS, "cattle.yaml")
    known = words_of(scheme)
    assert known["influence.Peace.follow"][1:] == known["influence.herd.Peace.follow"][1:]
    assert "influence.Mood.lead" not in known  # a cogniton and a culturon are called so
    changed = with_word(scheme, "influence.herd.Peace.follow", 7.0)
    changed = with_word(changed, "start.pack.Mood", 4.0)
    edited = GROUPS.replace("follow: 2", "follow: 7").replace("start: 2", "start: 4")
    assert changed == CognitiveScheme.parsed(edited, "cattle.yaml")


def test_a_value_that_cannot_be_is_refused(farmers):
    there = nameable(farmers)
    bias = there.called("decision_maker.bias")
    with pytest.raises(SocialmindError, match=r"decision_maker\.bias=high; expected a number"):
        bias.read("high")
    with pytest.raises(SchemeError, match="bias -1"):
        with_word(there.schemes["humans"], bias.word.text, -1.0)


def test_names_are_found_or_hinted_at(farmers):
    there = nameable(farmers)
    assert there.called("tool-price").name == "tool_price"
    assert there.called("humans.start.Farmer").word == there.called("start.Farmer").word
    assert there.called("scheme").population == there.called("humans.scheme").population == "humans"
    for name, said in {
        "tool_prise": "did you mean 'tool_price'?",
        "influence.WheatNeed.GrowWheet": "did you mean 'influence.WheatNeed.GrowWheat'?",
        "humans.start.Farmre": "did you mean 'humans.start.Farmer'?",
        "mind": "there is no such mind in farmer_artisan",
        "villages.scheme": "there is no such scheme|has nothing called",
    }.items():
        with pytest.raises(SocialmindError, match=said.replace("?", r"\?")):
            there.called(name)


TWO_BREEDS = '''"""Two breeds with schemes, and a parameter called as a whole mind."""

from socialmind import Agent, Model, Population, each, parameter


class Cow(Agent):
    food: float = 0.0


def decide(cow, model, rng):
    cow.plan = cow.mind.choose_next_plan()
    cow.run_plan(model, rng)


def eat(cow):
    cow.food += 1.0


def rest(cow):
    cow.food -= 0.5


class Cattle(Model):
    mind: float = parameter(1.0, low=0.0, high=2.0)
    cows = Population(Cow, 4, mind="cows.yaml", plans={"eat": eat, "rest": rest})
    bulls = Population(Cow, 3, mind="bulls.yaml", plans={"eat": eat, "rest": rest})
    schedule = (each(cows, decide), each(bulls, decide))

    def series(self):
        cows, bulls = self.cows.food.sum(), self.bulls.food.sum()
        return {"cows_food": float(cows), "bulls_food": float(bulls)}
'''

SCHEME = """name: {name}
decision_maker: {{name: BiasedWeightedStochastic, bias: 1}}
plans: [eat, rest]
cognitons:
  Hunger: {{start: 2, influence: {{eat: 1}}, conditional: [eat]}}
  Sleepy: {{start: 1, influence: {{rest: 1}}, conditional: [rest]}}
"""


@pytest.fixture(scope="module")
def cattle(tmp_path_factory):
    folder = tmp_path_factory.mktemp("two") / "cattle"
    folder.mkdir()
    (folder / "model.py").write_text(TWO_BREEDS)
    for name in ("cows", "bulls"):
        (folder / f"{name}.yaml").write_text(SCHEME.format(name=name))
    return folder


def test_several_breeds_want_the_population_in_front(cattle):
    there = nameable(load_model(cattle))
    with pytest.raises(SocialmindError, match=r"say whose is meant: cows\.influence\.Hunger\.eat"):
        there.called("influence.Hunger.eat")
    assert there.called("bulls.influence.Hunger.eat").population == "bulls"
    with pytest.raises(SocialmindError, match=r"a scheme of each of cows, bulls; say whose"):
        there.called("scheme")
    assert there.called("cows.scheme").kind == "scheme"


def test_a_parameter_wins_over_a_whole_mind_and_that_is_said(cattle):
    there = replace(nameable(load_model(cattle)), minded=("cows",))
    assert there.called("mind").kind == "parameter"
    assert there.called("cows.mind").kind == "mind"
    (said,) = there.clashes(["mind"])
    assert said.startswith("mind is taken for the parameter of cattle, not for its mind")
    assert there.clashes(["cows.mind"]) == []


def test_swept_words_come_to_what_an_edited_file_does(cattle, tmp_path):
    from socialmind.experiments import Run, Sweep, remake_run, sweep

    edited = tmp_path / "edited.yaml"
    edited.write_text(SCHEME.format(name="bulls").replace("eat: 1}", "eat: 9}"))
    design = {
        "bulls.influence.Hunger.eat": [1.0, 9.0, 4.0, 9.0],
        "cows.start.Sleepy": [1.0, 1.0, 3.0, 3.0],
    }
    out = sweep(cattle, design, 30, [5], common=True, compiled=False, workers=1, every=10,
                out=tmp_path / "s")  # fmt: skip
    runs = Sweep(out).runs
    cls = load_model(cattle)
    society = cls(5, compiled=False, scheme={"bulls": edited})
    society.advance(30)
    assert dict(society.series()) == runs.loc[1, ["cows_food", "bulls_food"]].to_dict()
    assert runs["bulls_food"].nunique() > 1 and runs["cows_food"].nunique() > 1
    run = Run(remake_run(out, 2, tmp_path / "run"))
    series = Sweep(out).series.query("run == 2").drop(columns="run").reset_index(drop=True)
    assert run.series.equals(series)
    assert (run.folder / "scheme-bulls.yaml").is_file()


def test_whole_schemes_vary_and_the_sweep_keeps_them(cattle, tmp_path):
    from socialmind.experiments import Sweep, remake_run, sweep

    lazy = tmp_path / "lazy.yaml"
    lazy.write_text(SCHEME.format(name="lazy").replace("start: 1", "start: 8"))
    design = {"cows.scheme": [str(cattle / "cows.yaml"), str(lazy)], "bulls.start.Hunger": [2, 2]}
    out = sweep(cattle, design, 20, [5], common=True, compiled=False, workers=1,
                out=tmp_path / "s")  # fmt: skip
    lazy.unlink()
    runs = Sweep(out).runs
    assert runs["cows_food"][1] < runs["cows_food"][0]
    assert runs["bulls_food"][1] == runs["bulls_food"][0]
    remade = remake_run(out, 1, tmp_path / "run")
    assert CognitiveScheme.load(remade / "scheme-cows.yaml").name == "lazy"
    lazy.write_text(SCHEME.format(name="lazy").replace("Sleepy", "Tired"))
    with pytest.raises(SocialmindError, match=r"lazy\.yaml: this scheme has no start\.Sleepy"):
        sweep(cattle, {"cows.scheme": [str(lazy)]}, 1, fixed={"cows.start.Sleepy": 2.0})
