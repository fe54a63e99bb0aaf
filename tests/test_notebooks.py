"""What societies, schemes and minds show of themselves in a notebook."""

import re

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from socialmind.catalogue import load_model


def cells(shown):
    """The rows of the table that is shown, as texts."""
    rows = re.findall(r"<tr>(.*?)</tr>", shown)
    return [re.findall(r"<t[hd]>(.*?)</t[hd]>", row) for row in rows]


def test_a_society_shows_where_it_is():
    society = load_model("herds")(seed=4, compiled=False)
    society.advance(2)
    rows = dict(cells(society._repr_html_()))
    assert rows["society"] == "herds" and rows["seed"] == "4" and rows["tick"] == "2"
    assert rows["cows"] == str(len(society.cows))
    assert rows["growth"] == str(society.growth)


def test_a_scheme_shows_its_links():
    law = Culturon("law", 2, influence={"trade": -0.5})
    hunger = Cogniton("a < b", start_value=3, influence={"eat": 2}, conditional=("eat", "trade"))
    scheme = CognitiveScheme("folk", (hunger,), (Group("town", (Role("citizen", (law,)),)),))
    assert cells(scheme._repr_html_()) == [
        ["folk", "start", "eat", "trade"],
        ["a &lt; b", "3", "+2 ○", "○"],
        ["law", "2", "", "-0.5"],
    ]


def test_a_mind_shows_its_parts():
    (assembly,) = load_model("collect")(compiled=False).assemblies.values()
    mind = assembly.description
    rows = dict(cells(mind._repr_html_()))
    assert rows["mind"] == mind.name
    assert rows["skills"].split(", ") == list(mind.skills)
