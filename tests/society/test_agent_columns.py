"""All populations in one table of agents, and runs that were made before there was one."""

import json

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from socialmind.agents.agent_columns import as_before, one_table
from socialmind.catalogue import load_model
from socialmind.experiments import Run, replay, resume, run
from socialmind.runs.tables.files import content_of

FARM = """
from socialmind import Agent, Model, Population, Torus, each, once


class Cow(Agent):
    milk: float = 0.5
    calves: int | None = None


class Dog(Agent):
    age: int = 0
    milk: bool = True
    agent: int = 7


def graze(cow, model, rng):
    cow.milk += rng.uniform(0, 1)
    if model.tick == 5 and cow.id == 1:
        cow.die()


def grow(dog, model, rng):
    dog.age += 1
    if dog.age == 3 and dog.id == 1:
        dog.hatch()


class Farm(Model):
    ticks = 10
    cows = Population(Cow, 2)
    dogs = Population(Dog, 3)
    world = Torus(5)
    schedule = (each(cows, graze), each(dogs, grow))
"""


@pytest.fixture(scope="module")
def farm(tmp_path_factory):
    """The class, from a folder that replays load it from as well."""
    folder = tmp_path_factory.mktemp("models") / "farm"
    folder.mkdir()
    (folder / "model.py").write_text(FARM)
    return load_model(folder)


def made(farm, out, ticks=10):
    return run(farm, ticks, seed=3, out=out, every=2, agents_every=5, compiled=False)


def made_before(folder, finished=True):
    """Turn a run into what the version before would have written: the first population alone."""
    manifest = json.loads((folder / "manifest.json").read_text())
    paths = [folder / "agents.parquet"] if finished else sorted(folder.glob("parts/agents-*"))
    for path in paths:
        table = pq.read_table(path)
        cows = table.filter(pa.compute.equal(table["population"], "cows"))
        cows = cows.select(["tick", "agent", "x", "y", "milk", "calves"])
        pq.write_table(cows, path, compression="zstd")
        if finished:
            manifest["tables"]["agents"] = vars(content_of(path))
    (folder / "manifest.json").write_text(json.dumps(manifest))


def test_everybody_is_in_the_table(farm, tmp_path):
    folder = made(farm, tmp_path / "run")
    schema = pq.read_schema(folder / "agents.parquet")
    assert schema.names == [
        "tick", "population", "agent", "x", "y", "milk", "calves", "age", "dogs.agent",
    ]  # fmt: skip
    assert str(schema.field("population").type) == "string"
    assert str(schema.field("age").type) == "int64"  # though cows have none
    agents = Run(folder).agents
    counts = agents.groupby(["tick", "population"]).size().unstack()
    assert counts["cows"].tolist() == [2, 2, 1]
    assert counts["dogs"].tolist() == [3, 4, 4]
    last = agents[agents["tick"] == 10].set_index(["population", "agent"])
    assert last.loc["dogs", "age"].tolist() == [10, 10, 10, 10]
    assert last.loc["dogs", "milk"].tolist() == [1, 1, 1, 1]  # a truth value beside numbers
    assert last.loc["cows", "age"].isna().all()
    assert last["calves"].isna().all()
    assert replay(folder).equal


def test_one_population_has_its_table_as_it_is():
    ids = np.arange(2)
    assert one_table({"cows": {"agent": ids, "milk": ids / 2}})["agent"] is ids


def test_a_run_made_before_is_replayed_by_what_it_has(farm, tmp_path):
    folder = made(farm, tmp_path / "run")
    made_before(folder)
    assert replay(folder).equal
    table = pq.read_table(folder / "agents.parquet").to_pandas()
    table.loc[3, "milk"] += 1.0
    pq.write_table(pa.Table.from_pandas(table, preserve_index=False), folder / "agents.parquet")
    assert [str(one).split(" differs")[0] for one in replay(folder).differences] == [
        "agents: agents.parquet is not the table that the run wrote",
        "agents: column milk first",
    ]
    pq.write_table(pq.read_table(folder / "agents.parquet").slice(0, 3), folder / "agents.parquet")
    assert "agents: 3 rows in the run, 5 now" in map(str, replay(folder).differences)


def test_a_run_made_before_is_made_longer_as_it_began(farm, tmp_path):
    long, short = made(farm, tmp_path / "long", 17), made(farm, tmp_path / "short", 11)
    made_before(long)
    made_before(short)
    resume(short, 17)
    for name in ("series.parquet", "agents.parquet"):
        assert pq.read_table(short / name).equals(pq.read_table(long / name)), name


def test_columns_in_another_order_are_the_same_columns():
    assert list(as_before({"population": ["a"], "agent": [0]}, ["agent", "population"], "a")) == [
        "agent",
        "population",
    ]
    other = {"agent": [0], "x": [1.0]}
    assert as_before(other, ["agent", "y"], "a") is other  # which the table then refuses


def test_a_first_population_that_has_died_out_leaves_no_rows():
    columns = {"population": ["dogs"], "agent": [0], "age": [4]}
    assert as_before(columns, ["agent"], "cows") == {"agent": []}
