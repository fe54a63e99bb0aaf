"""A society under Mesa is the same society, and Mesa's own tools work on it."""

import subprocess
import sys
import textwrap

import mesa
import numpy as np
import pytest
from mesa.datacollection import DataCollector

from socialmind import (
    Agent,
    Grid,
    Model,
    ModelError,
    Patch,
    Population,
    Torus,
    each,
    once,
    parameter,
)
from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError

FarmerArtisan = load_model("farmer_artisan")


class Sheep(Agent):
    energy: float = 5.0
    age: int = 0
    mother: int | None = None
    seen: list[float] = [0.0] * 3


class Wolf(Agent):
    energy: float = 9.0


class Meadow(Patch):
    grass: float = 1.0
    cut: bool = False


def arrive(sheep, model, rng):
    sheep.x = rng.uniform(model.world.low, model.world.high)
    sheep.y = rng.uniform(model.world.low, model.world.high)


def graze(sheep, model, rng):
    model.world.right(sheep, rng.uniform(0, 90))
    model.world.forward(sheep, 1)
    patch = model.world.patch(sheep.x, sheep.y)
    sheep.energy += patch.grass - model.hunger
    patch.grass = 0
    sheep.age += 1
    if sheep.energy < 0:
        sheep.die()
    elif sheep.energy > 5.5:
        sheep.energy /= 2
        lamb = sheep.hatch()
        lamb.mother = sheep.id
        lamb.age = 0
        model.births += 1


def grow(model):
    for patch in model.world.patches:
        patch.grass = min(patch.grass + model.growth, 1)


class Pasture(Model):
    """Sheep that eat, breed and starve."""

    ticks = 200
    n_sheep: int = parameter(12, low=0)
    hunger: float = parameter(0.6, low=0.0)
    growth: float = parameter(0.08, low=0.0)
    births: int = 0
    world = Torus(9, Meadow)
    sheep = Population(Sheep, "n_sheep")
    wolves = Population(Wolf, 2)
    setup = (each(sheep, arrive),)
    schedule = (each(sheep, graze), once(grow))


class Walker(Agent):
    steps_taken: int = 0


def walk(walker):
    walker.steps_taken += 1


class Placeless(Model):
    """Agents without a world."""

    walkers = Population(Walker, 3)
    schedule = (each(walkers, walk),)


def herd(**settings):
    return Pasture(**{"seed": 3, "compiled": False} | settings)


# The run ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize("make", [FarmerArtisan, Pasture])
def test_a_step_is_a_tick(make, compiled):
    alone = make(seed=5, compiled=compiled)
    model = make(seed=5, compiled=compiled).mesa()
    assert isinstance(model, mesa.Model)
    for _ in range(60):
        alone.advance(1)
        model.step()
        assert repr(model.society.series()) == repr(alone.series())
    state = alone.state()
    del state["context"]  # addresses, beside the variables
    for name, array in state.items():
        # As text: NaN is equal to NaN, and the gaps between fields do not count.
        assert repr(array.tolist()) == repr(model.society.state()[name].tolist()), name


def test_mesas_own_draws_do_not_disturb_the_society():
    alone, model = herd(), herd().mesa()
    for _ in range(10):
        model.random.random()
        model.agents.shuffle_do(lambda agent: agent.random.random())
        model.step()
    alone.advance(10)
    assert model.society.series() == alone.series()
    assert model.sheep.x.tolist() == alone.sheep.x.tolist()


def test_run_model_ends_at_the_models_own_length():
    model = herd().mesa()
    model.society.advance(195)
    model.run_model()
    assert model.tick == 200
    assert model.running is False


def test_two_models_share_nothing():
    one, other = herd().mesa(), herd().mesa()
    one.agent_class["sheep"](one)
    for agent in one.agents:
        agent.energy = 1.0
    one.births = 7
    one.datacollector = DataCollector({"births": "births"})
    one.step()
    assert other.tick == 0
    assert other.births == 0
    assert len(other.agents) == 14
    assert other.agents.agg("energy", set) == {5.0, 9.0}
    assert "hunger" not in other.datacollector.model_vars
    assert "sheep" in other.datacollector.model_vars
    assert not set(one.agents_by_type) & set(other.agents_by_type)


# Agents -----------------------------------------------------------------------------------------


def test_each_population_has_a_class_of_agents():
    model = herd().mesa()
    classes = model.agents_by_type
    assert [kind.__name__ for kind in classes] == ["Sheep", "Wolf"]
    assert [len(agents) for agents in classes.values()] == [12, 2]
    assert classes[model.agent_class["wolves"]].get("energy") == [9.0, 9.0]
    assert len(model.agents.select(agent_type=Sheep)) == 12
    assert [agent.id for agent in model.agents] == [*range(12), 0, 1]
    assert [agent.unique_id for agent in model.agents] == list(range(1, 15))


@pytest.mark.parametrize("compiled", [False, True])
def test_births_and_deaths_are_followed(compiled):
    model = herd(compiled=compiled).mesa()
    first = list(model.agents)
    born, died = 0, 0
    before = set(range(12))
    for _ in range(120):
        model.step()
        living = model.sheep.id.tolist()
        sheep = model.agents_by_type[model.agent_class["sheep"]]
        assert sheep.get("id") == living
        assert len(model.agents) == len(living) + 2
        born += len(set(living) - before)
        died += len(before - set(living))
        before = set(living)
    assert born > 10
    assert died > 10
    # Who stays, stays the same object, whatever slots of the rows were given anew.
    assert {wolf for wolf in first if wolf.population == "wolves"} <= set(model.agents)
    assert [agent.row.id for agent in model.agents] == model.agents.get("id")
    lambs = model.agents.select(lambda one: one.population == "sheep" and one.id >= 12)
    assert len(lambs) > 0
    assert all(lamb.mother < lamb.id and lamb.age < 120 for lamb in lambs)


def test_agents_follow_a_society_that_ran_by_itself():
    model = herd().mesa()
    agents = model.agents
    model.society.advance(80)
    living = model.sheep.id.tolist()
    assert living != list(range(12))
    assert model.agents.select(agent_type=Sheep).get("id") == living
    assert len(agents) == len(living) + 2


def test_agents_follow_a_restored_state():
    model = herd().mesa()
    state = model.society.state()
    model.society.advance(80)
    assert model.agents.select(agent_type=Sheep).get("id") != list(range(12))
    model.society.restore(state)
    assert sorted(model.agents.select(agent_type=Sheep).get("id")) == list(range(12))
    assert model.agents.select(agent_type=Sheep).get("age") == [0] * 12


def test_writing_to_an_agent_writes_to_the_society():
    model = herd().mesa()
    agent = list(model.agents)[4]
    agent.energy = 1.25
    agent.mother = 2
    agent.seen[1] = 3.5
    row = model.society.sheep[4]
    assert (row.energy, row.mother, list(row.seen)) == (1.25, 2, [0.0, 3.5, 0.0])
    agent.mother = None
    assert row.mother is None
    row.energy = 4.0
    assert agent.energy == 4.0


def test_minds_and_plans():
    model = FarmerArtisan(seed=2).mesa()
    model.step()
    human = list(model.agents_by_type[model.agent_class["humans"]])[3]
    human.plan = "ProduceTools"
    human.mind.set_cogniton_value("Farmer", 4.5)
    assert model.society.plans(model.humans)[3] == "ProduceTools"
    assert model.humans.cogniton("Farmer")[3] == 4.5
    with pytest.raises(ValueError, match="no plan 'Sleep'"):
        human.plan = "Sleep"


@pytest.mark.parametrize("compiled", [False, True])
def test_removing_an_agent_lets_it_die(compiled):
    model = herd(compiled=compiled).mesa()
    agents = list(model.agents)
    agents[3].remove()
    agents[3].remove()
    assert 3 not in model.sheep.id
    assert len(model.agents) == 13
    assert not agents[3].alive
    with pytest.raises(AttributeError, match="agent 3 of 'sheep' is dead"):
        _ = agents[3].energy
    with pytest.raises(AttributeError, match="is dead"):
        agents[3].energy = 2.0
    model.step()
    assert agents[3] not in model.agents
    assert agents[4].age == 1
    model.remove_all_agents()
    assert len(model.agents) == len(model.sheep) == len(model.wolves) == 0
    model.step()


@pytest.mark.parametrize("compiled", [False, True])
def test_agents_made_under_mesa_act_from_the_next_step_on(compiled):
    model = herd(compiled=compiled, hunger=0.0, growth=0.0).mesa()
    mother = next(iter(model.agents))
    lamb = mother.hatch()
    other = model.agent_class["sheep"](model, energy=2.0, x=1.0)
    assert (lamb.id, other.id) == (12, 13)
    assert (lamb.x, other.x, other.energy) == (mother.x, 1.0, 2.0)
    model.step()
    assert (mother.age, lamb.age, other.age) == (1, 1, 1)
    assert {lamb, other} <= set(model.agents)
    made = model.agent_class["wolves"].create_agents(model, 2, energy=[1.0, 2.0])
    assert made.get("energy") == [1.0, 2.0]
    assert model.wolves.energy.tolist() == [9.0, 9.0, 1.0, 2.0]


def test_operations_of_agent_sets():
    model = herd().mesa()
    sheep = model.agents_by_type[model.agent_class["sheep"]]
    sheep.set("energy", 2.0)
    assert model.sheep.energy.tolist() == [2.0] * 12
    sheep.select(lambda one: one.id < 4).do(lambda one: setattr(one, "energy", 3.0))
    assert sheep.agg("energy", sum) == 4 * 3.0 + 8 * 2.0
    assert sheep.agg("energy", [min, max]) == [2.0, 3.0]
    assert sheep.groupby("energy").count() == {3.0: 4, 2.0: 8}
    assert sheep.get(["id", "mother"])[:2] == [[0, None], [1, None]]
    order = []
    sheep.shuffle_do(lambda one: order.append(one.id))
    assert sorted(order) == list(range(12))
    assert order != sorted(order)
    assert sheep.sort("id", ascending=False).get("id") == list(range(11, -1, -1))
    assert model.agents.get("mother", handle_missing="default", default_value=-1)[-2:] == [-1, -1]
    sheep.select(at_most=3).do("remove")
    assert model.sheep.id.tolist() == list(range(3, 12))


# The model's attributes -------------------------------------------------------------------------


def test_parameters_variables_populations_and_series_are_attributes():
    model = FarmerArtisan(seed=1, tool_price=100.0).mesa()
    model.step()
    assert model.tool_price == 100.0
    assert model.village_columns == 1
    assert model.farmers == model.society.series()["farmers"]
    assert model.humans is model.society.humans
    with pytest.raises(AttributeError, match="stays as it is in a run"):
        model.tool_price = 5.0
    with pytest.raises(AttributeError, match="no attribute 'farmer'"):
        _ = model.farmer
    pasture = herd().mesa()
    pasture.births = 5
    assert pasture.society.births == 5


def test_names_that_mesa_uses_are_refused():
    class Clock(Model):
        steps: int = 0

    class Prisoner(Agent):
        cell: int = 0

    class Prison(Model):
        prisoners = Population(Prisoner, 2)

    with pytest.raises(ModelError, match=r"'steps' in clock.*rename it"):
        Clock().mesa()
    with pytest.raises(ModelError, match=r"a field 'cell' of Prisoner.*rename it"):
        Prison().mesa()


def test_the_class_makes_the_society_anew():
    model = FarmerArtisan(seed=7, compiled=False, n_agents=4, tool_price=90.0).mesa()
    model.step()
    again = type(model)()
    assert again.tick == 0
    assert (again.society.seed, again.n_agents, again.tool_price) == (7, 4, 90.0)
    assert again.society.compiled is False
    assert len(again.agents) == 5
    changed = type(model)(seed="8", n_agents=6)  # SolaraViz gives texts
    assert (changed.society.seed, changed.n_agents, changed.tool_price) == (8, 6, 90.0)
    with pytest.raises(SocialmindError, match="n_agent"):
        type(model)(n_agent=6)


# Data -------------------------------------------------------------------------------------------


def test_the_series_are_collected():
    alone, model = herd(), herd().mesa()
    rows = [alone.series()]
    for _ in range(5):
        alone.advance(1)
        rows.append(alone.series())
        model.step()
    frame = model.datacollector.get_model_vars_dataframe()
    assert frame["tick"].tolist() == list(range(6))
    for name in rows[0]:
        assert frame[name].tolist() == [row[name] for row in rows], name


def test_data_collectors():
    model = herd().mesa()
    kind = model.agent_class["sheep"]
    collector = DataCollector(
        model_reporters={
            "births": "births",
            "energy": lambda one: float(one.sheep.energy.sum()),
            "hunger": "hunger",
        },
        agent_reporters={"energy": "energy", "id": "id"},
        agenttype_reporters={kind: {"age": "age", "twice": lambda one: 2 * one.age}},
    )
    expected = []
    for _ in range(30):
        model.step()
        collector.collect(model)
        expected.append((model.society.births, model.society.sheep.energy.sum()))
    frame = collector.get_model_vars_dataframe()
    assert list(frame["births"]) == [births for births, _ in expected]
    assert list(frame["energy"]) == [energy for _, energy in expected]
    assert set(frame["hunger"]) == {0.6}
    last = collector.get_agent_vars_dataframe().loc[30]
    assert last["id"].tolist() == model.agents.get("id")
    assert last["energy"].tolist() == model.agents.get("energy")
    ages = collector.get_agenttype_vars_dataframe(kind).loc[30]
    assert sorted(ages["age"]) == sorted(model.sheep.age.tolist())
    assert (ages["twice"] == 2 * ages["age"]).all()


def test_another_collector_collects_at_each_step_and_after_reset():
    model = herd().mesa()
    model.datacollector = DataCollector({"all": lambda one: len(one.agents)}, {"energy": "energy"})
    model.step()
    assert model.datacollector.model_vars["all"] == [len(model.agents)]
    again = type(model)()
    assert again.datacollector is not model.datacollector
    assert again.datacollector.model_vars["all"] == [14]
    assert again.datacollector.get_agent_vars_dataframe()["energy"].sum() == 12 * 5.0 + 2 * 9.0


# The grid ---------------------------------------------------------------------------------------


def test_agents_stand_in_the_cells_of_the_grid():
    model = herd().mesa()
    grid = model.grid
    for _ in range(60):
        model.step()
        standing = {agent: cell for cell in grid.all_cells for agent in cell.agents}
        assert set(standing) == set(model.agents)
        for agent, cell in standing.items():
            row = agent.row
            assert cell is agent.cell
            assert cell.coordinate == (round(row.x) + 4, round(row.y) + 4)
            assert np.abs(np.subtract(agent.pos, cell.coordinate)).max() <= 0.5
            assert not cell.empty
    assert sum(cell.empty for cell in grid.all_cells) == 81 - len(set(standing.values()))
    assert len(grid.agents) == len(model.agents)


def test_moving_to_a_cell_moves_the_agent():
    model = herd().mesa()
    agent = next(iter(model.agents))
    agent.cell = model.grid[(0, 8)]
    assert (agent.x, agent.y) == (-4.0, 4.0)
    assert agent in model.grid[(0, 8)].agents
    agent.move_to(agent.cell.connections[(-1, 0)])  # round the torus
    assert (agent.x, agent.y) == (4.0, 4.0)
    assert agent not in model.grid[(0, 8)].agents
    agent.remove()
    assert agent not in model.grid[(8, 8)].agents


def layer_values(model, name):
    layer = getattr(model.grid, name)
    return layer if isinstance(layer, np.ndarray) else layer.data  # Mesa 4, Mesa 3


def test_property_layers_are_the_patches():
    model = herd().mesa()
    cell = model.grid[(2, 7)]
    assert cell.grass == 1.0
    cell.grass = 0.25
    cell.cut = True
    patch = model.society.world.patch(-2, 3)
    assert (patch.grass, patch.cut) == (0.25, True)
    assert layer_values(model, "grass")[2, 7] == 0.25
    state = model.society.state()
    patch.grass = 0.5
    model.society.restore(state)
    assert model.grid[(2, 7)].grass == 0.25
    model.step()
    assert np.array_equal(layer_values(model, "grass"), model.society.world.grass)


def test_a_model_without_a_world_has_no_grid():
    model = Placeless(compiled=False).mesa()
    model.step()
    assert model.agents.get("steps_taken") == [1, 1, 1]
    assert not hasattr(model, "grid")
    assert not hasattr(model, "space")
    with pytest.raises(AttributeError, match="no patches"):
        _ = model.space_of_cells


def test_a_world_too_large_for_mesas_cells_is_refused():
    model = FarmerArtisan(world_size=1001, n_agents=1).mesa()
    model.step()
    with pytest.raises(SocialmindError, match="1001 × 1001 patches"):
        _ = model.grid


def test_nothing_but_mesa_imports_mesa():
    program = """
        import sys
        import socialmind, socialmind.cli
        from socialmind.catalogue import load_model
        load_model("farmer_artisan")(compiled=False).advance(2)
        found = [name for name in ("mesa", "pandas", "matplotlib", "solara") if name in sys.modules]
        print(found)
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"


class Neighbourly(Model):
    sheep = Population(Sheep, 2)
    world = Grid(5, 3, wraps=False, low=(0, -1), one_per_patch=True)


def test_a_grid_with_walls_and_room_for_one():
    society = Neighbourly(compiled=False, sheep={"x": [1, 2], "y": [0, 0]})
    model = society.mesa()
    one, other = model.agents
    assert model.grid.dimensions == (5, 3)
    assert one.pos == (1.0, 1.0) and one.cell.coordinate == (1, 1)
    assert len(model.grid[0, 0].connections) == 3  # a corner between walls
    with pytest.raises(SocialmindError, match="agent 0 of 'sheep' onto"):
        one.move_to(other.cell)
    one.move_to(model.grid[4, 2])
    assert (one.row.x, one.row.y) == (4.0, 1.0) and not society.world.is_free(4, 1)
    born = type(one)(model, x=0, y=1)
    assert born.row.x == 0.0 and not society.world.is_free(0, 1)
    with pytest.raises(SocialmindError, match="stands"):
        type(one)(model, x=0, y=1)
    assert len(society.sheep) == 3
    model.step()
    again = type(model)()  # as SolaraViz's Reset does
    assert again.society.sheep.x.tolist() == [1.0, 2.0]
