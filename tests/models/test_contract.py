"""The contract of a model, held over every model that ships."""

import re

import pytest

from coglogo_py import CognitiveScheme
from socialmind.catalogue import load_model
from socialmind.documents.odd.document import odd
from socialmind.errors import SocialmindError
from socialmind.sources.folders import catalogue
from socialmind.worlds.plane.trajectories import RECORDED

WITHOUT_LUCK = ("tutorial",)  # models that draw nothing
TICKS = 300
TICKS_INTERPRETED = 120
SEEDS = (0, 2**40 + 7)


@pytest.fixture(scope="module", params=list(catalogue()))
def model(request):
    """The class of each model."""
    return load_model(request.param)


@pytest.fixture(scope="module")
def document(model):
    return (model.folder() / "ODD.md").read_text("utf-8")


def table_of(document, title):
    """Return the rows of the table under a heading, cells stripped of their backquotes."""
    text = document.split(f"# {title}\n", 1)[1].split("\n#", 1)[0]
    rows = [line.strip().strip("|").split("|") for line in text.splitlines() if line[:1] == "|"]
    return [[cell.strip().replace("`", "") for cell in row] for row in rows[2:]]


def populations_of(society, table):
    """Return the population of each row of a table of agents.

    Where the table does not say: the robots of a plane, the first that has minds, or the first.
    """
    robots = society.shape.world.robots
    first = next(iter(robots or society.schemes or society.tables))
    return table.get("population", [first] * len(table["agent"]))


# What a model declares ----------------------------------------------------------------------------


def test_it_says_what_it_is(model):
    assert model.name == model.folder().name
    assert model.__doc__
    assert model.ticks > 0
    assert model.schedule


def test_parameters_have_a_unit_a_range_and_a_meaning(model):
    for one in model.parameters.values():
        assert one.doc, one.name
        if one.kind is not bool:
            assert one.unit, one.name
            assert one.low is not None or one.high is not None, one.name


def test_rules_are_typed_at_both_speeds(model):
    for compiled in (True, False):
        program = model.typed(compiled)
        assert len(program.schedule) == len(model.schedule)


def test_schemes_have_no_findings_and_a_function_for_each_plan(model):
    for population in model.populations.values():
        if population.mind is not None:
            path = model.folder() / population.mind
            scheme = CognitiveScheme.load(path, population.decision_makers)
            assert scheme.check(plans=population.plans) == []
            assert sorted(scheme.plans) == sorted(population.plans)


# What its documents say ---------------------------------------------------------------------------


def test_its_odd_document_is_whole_and_up_to_date(model):
    made = odd(model)
    assert list(made.gaps) == []
    assert made.stale(model.folder() / "ODD.md") == [], (
        f"make it again: socialmind odd {model.folder().name}"
    )


def test_its_readme_has_purpose_commands_and_a_way_to_the_odd_document(model):
    readme = (model.folder() / "README.md").read_text("utf-8")
    found = re.findall(r"^## (.+)$", readme, re.MULTILINE)
    assert found in (["Purpose", "Results"], ["Purpose and results"])
    assert f"    socialmind run {model.name}" in readme.replace("-", "_")
    assert "](ODD.md)" in readme


def test_what_documents_link_to_is_there(model):
    for name in ("README.md", "ODD.md"):
        text = (model.folder() / name).read_text("utf-8")
        for place in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", text):
            assert (model.folder() / place).exists(), f"{name}: {place}"


def test_its_odd_document_has_the_parameters_of_the_code(model, document):
    rows = table_of(document, "Parameters")
    if not model.parameters:
        assert rows == []
    assert [row[0] for row in rows] == list(model.parameters)
    for (_, unit, span, default, meaning), one in zip(rows, model.parameters.values(), strict=True):
        assert (unit, span, meaning) == (one.unit or "–", one.range, one.doc)
        assert one.read(default) == one.default


@pytest.mark.parametrize("title", ["Series", "Agents"])
def test_its_odd_document_has_the_columns_of_the_tables(model, document, title):
    society = model(compiled=False)
    columns = list(society.series() if title == "Series" else society.agents())
    described = [row[0] for row in table_of(document, title) if row[0] != "tick"]
    patterns = [re.escape(one).replace("<Name>", ".+").replace("<Plan>", ".+") for one in described]
    # What every robot has stands in docs/runs.md.
    for name in [one for one in columns if one not in RECORDED]:
        assert any(re.fullmatch(one, name) for one in patterns), f"{name} is not in ODD.md"
    for one in patterns:
        assert any(re.fullmatch(one, name) for name in columns), f"{one} is not in the table"


# What a society does -----------------------------------------------------------------------------


@pytest.mark.parametrize("seed", SEEDS)
def test_both_speeds_agree_to_the_last_bit(model, differences, seed):
    compiled, interpreted = model(seed), model(seed, compiled=False)
    assert differences(compiled, interpreted) == []
    for ticks in (1, 2, TICKS_INTERPRETED - 3):
        compiled.advance(ticks)
        interpreted.advance(ticks)
        assert compiled.tick == interpreted.tick
        assert differences(compiled, interpreted) == []


def test_a_society_goes_on_from_a_saved_state_at_either_speed(model, differences):
    straight = model(3)
    straight.advance(60)
    saved = straight.state()
    straight.advance(TICKS_INTERPRETED - 60)
    for compiled in (True, False):
        other = model(3, compiled)
        other.advance(7)
        other.restore(saved)
        assert other.tick == 60
        other.advance(TICKS_INTERPRETED - 60)
        assert differences(other, straight) == []


def test_a_saved_state_stays_as_it_is(model):
    society = model(3)
    saved = society.state()
    before = {name: array.tobytes() for name, array in saved.items()}
    society.advance(50)
    society.restore(saved)
    society.advance(50)
    assert {name: array.tobytes() for name, array in saved.items()} == before


def test_the_same_seed_is_the_same_run(model, differences):
    one, other = model(5), model(5)
    one.advance(TICKS)
    for _ in range(TICKS // 50):
        other.advance(50)
    assert differences(one, other) == []


def test_another_seed_is_another_run_where_anything_is_drawn(model):
    tables = []
    for seed in (5, 6):
        society = model(seed)
        society.advance(TICKS)
        tables.append({name: list(column) for name, column in society.agents().items()})
    assert (str(tables[0]) == str(tables[1])) == (model.name in WITHOUT_LUCK)


def numbers(society):
    """Return the series but for what ended it, which is a text or nothing."""
    series = society.series()
    if society.shape.world.has_episodes and "over" in series:
        assert series.pop("over") == society.over
    return series


def test_series_and_agents_keep_their_columns(model):
    society = model(1)
    series, agents = list(numbers(society)), list(society.agents())
    kinds = {name: type(value) for name, value in numbers(society).items()}
    for _ in range(3):
        society.advance(100)
        now = numbers(society)
        assert list(now) == series
        assert {name: type(value) for name, value in now.items()} == kinds
        assert set(kinds.values()) <= {int, float}
        table = society.agents()
        assert list(table) == agents
        shown = populations_of(society, table)
        living = sum(len(society.tables[name]) for name in set(shown))
        assert {len(column) for column in table.values()} == {living}
        assert len(set(zip(shown, table["agent"], strict=True))) == living


def test_explain_gives_the_plan_that_the_table_shows(model):
    society = model(2)
    if not society.schemes:
        pytest.skip(f"{model.name} has no minds")
    if model.populations[next(iter(society.schemes))].weighing is not None:
        pytest.skip(f"hierarchies weigh the plans of {model.name}, not cognitons")
    checked = 0
    for tick in (1, 2, 60, 200):
        society.advance(tick - society.tick)
        table = society.agents()
        shown = populations_of(society, table)
        rows = [row for row, name in enumerate(shown) if name == next(iter(society.schemes))]
        for row in {rows[0], rows[len(rows) // 2], rows[-1]}:
            checked += 1
            if table["plan"][row] is None:
                with pytest.raises(SocialmindError, match="no decision"):
                    society.explain(int(table["agent"][row]), tick)
                continue
            receipt = society.explain(int(table["agent"][row]), tick)
            assert receipt.choice == table["plan"][row]
            weights = {plan.name: plan.weight for plan in receipt.plans}
            assert weights[receipt.choice] is not None
    assert checked >= 4
    assert society.tick == 200


def test_time_passes_without_idle_decisions(model):
    society = model(4)
    society.advance(TICKS)
    assert society.tick == TICKS
    assert society.idle.count == 0
