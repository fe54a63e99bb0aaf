"""Frames hold what stands in the tables, for every model there is."""

import json

import numpy as np
import pytest

from socialmind.catalogue import catalogue, load_model
from socialmind.errors import SocialmindError
from socialmind.studio.running.colouring import (
    Coloured,
    colourings,
    of_agents,
    of_patches,
    patch_fields,
)
from socialmind.studio.running.frames import unpacked
from socialmind.studio.running.moment import Shown, frame_of
from socialmind.studio.running.outline import outline_of_model, outline_of_society
from socialmind.studio.running.watching import watched


@pytest.mark.parametrize("name", sorted(catalogue()))
def test_every_model_is_shown_coloured_and_looked_into(name):
    society = load_model(name)(seed=1, compiled=False)
    society.advance(2)
    header, columns = unpacked(frame_of(society, Shown.of(society), more="said"))
    assert header["tick"] == 2
    assert header["more"] == "said"
    for population, said in header["populations"].items():
        assert said["count"] == len(society.tables[population])
        assert columns[f"{population}.id"].tolist() == society.tables[population].id.tolist()
    for population in society.populations:
        for colouring in colourings(society, population):
            found = of_agents(society, population, colouring)
            assert len(found.values) == len(society.tables[population])
        for identity in society.tables[population].id.tolist()[:2]:
            json.dumps(watched(society, population, identity), allow_nan=False)
    for field in patch_fields(society):
        assert len(of_patches(society, field).values) == len(society.ground.world.rows)
    json.dumps(outline_of_model(type(society)), allow_nan=False)
    json.dumps(outline_of_society(society), allow_nan=False)


def test_places_and_plans_are_those_of_the_tables():
    society = load_model("farmer_artisan")(seed=1, compiled=False)
    society.advance(30)
    header, columns = unpacked(frame_of(society, Shown.of(society)))
    assert np.allclose(columns["humans.x"], society.humans.x)
    words = header["populations"]["humans"]["words"]
    assert [words[place] for place in columns["humans.colour"]] == society.plans(society.humans)


def test_numbers_stand_along_a_scale_and_what_is_none_beside_it():
    found = Coloured(np.array([1.0, 3.0, np.nan, 2.0, 9.0], np.float32), ends=(None, 5.0))
    assert found.range == (1.0, 5.0)
    assert found.places(*found.range).tolist() == [0, 127, 255, 64, 254]
    alike = np.full(3, 7.0, np.float32)
    assert Coloured(alike).places(7.0, 7.0).tolist() == [127] * 3
    assert Coloured(alike, colours=("#000000", "#ffffff")).places(7.0, 7.0).tolist() == [0] * 3
    nobody = Coloured(np.zeros(0, np.float32))
    assert nobody.places(*nobody.range).tolist() == []


def test_a_watched_agent_has_the_receipt_of_its_next_decision():
    society = load_model("farmer_artisan")(seed=1, compiled=False)
    society.advance(30)
    seen = watched(society, "humans", 3)
    receipt = society.humans[3].mind.explain()
    assert seen["receipt"]["choice"] == receipt.choice
    assert seen["words"][0].startswith(f"The next decision is {receipt.choice}")
    assert seen["fields"]["wheat"] == society.humans[3].wheat


def test_looking_changes_nothing():
    society, other = (load_model("civil_norms")(seed=1, compiled=False) for _ in range(2))
    for one in (society, other):
        one.advance(10)
    for identity in society.gatherers.id.tolist():
        watched(society, "gatherers", identity)
    for one in (society, other):
        one.advance(10)
    assert society.series() == other.series()


def test_what_there_is_not_is_refused():
    society = load_model("schelling")(seed=1, compiled=False)
    with pytest.raises(SocialmindError, match="kind"):
        of_agents(society, "people", "field kindd")
    with pytest.raises(SocialmindError, match="identity 5000"):
        watched(society, "people", 5000)
