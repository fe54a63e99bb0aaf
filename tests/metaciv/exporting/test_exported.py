"""Schemes of ours as MetaCiv's folders: read again they are what was written, and losses named."""

from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, PositiveStochastic, Role
from socialmind.metaciv.description import Place, Scheme
from socialmind.metaciv.exporting import for_metaciv, scheme_files
from socialmind.metaciv.importing import import_model
from socialmind.metaciv.reading import read_folder

from ..reading.folders import FARMERS, written

SHIPPED = sorted((Path(__file__).parents[3] / "models").glob("*/*.yaml"))
SHIPPED = [one for one in SHIPPED if "cognitons:" in one.read_text("utf-8")]


def without_places(part):
    """Return a part of a description, all of it standing in one place."""
    if isinstance(part, Place):
        return Place("", 1)
    if isinstance(part, tuple):
        return tuple(without_places(one) for one in part)
    if is_dataclass(part):
        held = {one.name: without_places(getattr(part, one.name)) for one in fields(part)}
        if "written" in held and not held["written"]:
            held["written"] = held["name"]
        return replace(part, **held)
    return part


def read_again(scheme, folder):
    """Read a scheme that was written into a model of MetaCiv's."""
    files = {f"schemasCognitifs/{file}": text for file, text in scheme_files(scheme).items()}
    files |= {file: text for file, text in FARMERS.items() if "schemasCognitifs" not in file}
    civilisation = f"Nom : Farmers\nAgents : 2\nScattered : 1\nSchemaCognitif : {scheme.name}\n"
    files |= {
        "simulation/civilisations/Farmers.metaciv": civilisation,
        "simulation/objets/Bread.metaciv": "Nom : Brown bread\n",
        "simulation/effects/Fed.metaciv": "Nom : Fed\nCible : objet\nNomCible : Brown bread\n",
    }
    reading = read_folder(written(folder, files))
    assert reading.findings == ()
    (found,) = reading.model.schemes
    return found


def as_ours(scheme, factor):
    """Return what a scheme of MetaCiv's says, as one of ours."""
    lent = {name for one in scheme.groups for role in one.roles for name in role.culturons}
    held = {one.name: one for one in scheme.cognitons}

    def links(one):
        return {
            "start_value": 1,
            "colour": tuple((one.colour + 2**24) >> shift & 255 for shift in (16, 8, 0)),
            "influence": {link.plan: link.weight / factor for link in one.influences},
            "conditional": tuple(link.plan for link in one.permits),
        }

    return CognitiveScheme(
        scheme.name,
        tuple(
            Cogniton(
                one.name,
                one.initial,
                **links(one),
                active_while=[f"{t.attribute} {t.comparison} {t.constant or t.threshold}"
                              for t in one.triggers],
                type=one.type,
                inherited=0.0,
            )
            for one in scheme.cognitons if one.name not in lent
        ),
        tuple(
            Group(one.name, tuple(
                Role(role.name, tuple(Culturon(name, **links(held[name]))
                                      for name in role.culturons))
                for role in one.roles
            ))
            for one in scheme.groups
        ),
        PositiveStochastic(),
    )  # fmt: skip


@pytest.mark.parametrize("file", SHIPPED, ids=lambda one: f"{one.parent.name}-{one.stem}")
def test_schemes_that_ship_are_read_as_they_were_written(file, tmp_path):
    scheme = CognitiveScheme.load(file)
    exported = for_metaciv(scheme)
    assert without_places(read_again(exported.scheme, tmp_path)) == without_places(exported.scheme)
    assert [one.name for one in exported.scheme.plans] == list(scheme.plans)
    for ours, theirs in zip(scheme.cognitons, exported.scheme.cognitons, strict=False):
        assert theirs.name == ours.name
        assert tuple(link.plan for link in theirs.permits) == ours.conditional
        weights = {link.plan: link.weight / exported.factor for link in theirs.influences}
        assert weights == pytest.approx(dict(ours.influence))
    assert as_ours(exported.scheme, 1).check() is not None


def test_what_metaciv_can_hold_is_all_there(tmp_path):
    calm = Culturon("Calm", 1, influence={"talk": 0.5}, conditional=("talk",))
    scheme = CognitiveScheme(
        "villagers",
        (
            Cogniton("Will", True, 1, (1, 2, 3), None, {"work": 2.0}, ("work",), type="trait",
                     inherited=0),
            Cogniton("Hunger", False, 1, influence={"eat": 5.25, "work": -1}, conditional=("eat",),
                     active_while="energy < low_energy", type="percept", inherited=0),
        ),
        (Group("village", (Role("chief", (calm,)), Role("member", (calm,)))),),
        PositiveStochastic(),
    )  # fmt: skip
    exported = for_metaciv(scheme, {"energy": 7.0}, {"low_energy": 5.0})
    assert exported.factor == 100
    read = read_again(exported.scheme, tmp_path)
    assert as_ours(read, exported.factor) == scheme
    assert (read.attributes[0].start, read.constants[0].value) == (7.0, 5.0)
    assert [one.split(":")[0] for one in exported.lost] == [
        "weights are multiplied by 100, since MetaCiv's are whole numbers; "
        "that changes no decision",
        "the decision maker PositiveStochastic stands in parametres.metaciv",
        "what plans do is no part of a scheme",
    ]  # fmt: skip


def test_a_scheme_of_metacivs_is_written_as_it_was_read(tmp_path):
    (scheme,) = read_folder(written(tmp_path / "old", FARMERS)).model.schemes
    files = {f"schemasCognitifs/{file}": text for file, text in scheme_files(scheme).items()}
    others = {file: text for file, text in FARMERS.items() if "schemasCognitifs" not in file}
    (again,) = read_folder(written(tmp_path / "new", files | others)).model.schemes
    assert without_places(again) == without_places(scheme)


def test_an_imported_scheme_goes_back_as_it_came(tmp_path):
    folder = written(tmp_path / "old", FARMERS)
    (came,) = read_folder(folder).model.schemes
    import_model(folder, tmp_path / "ours")
    ours = CognitiveScheme.load(tmp_path / "ours" / "scheme.yaml")
    gone = for_metaciv(ours, {"energy": 4.5}, {"meal": 3.0})
    assert gone.factor == 1
    assert [one.name for one in gone.scheme.plans] == [one.name for one in came.plans]
    links = {
        one.name: ([link.plan for link in one.permits],
                   {link.plan: link.weight for link in one.influences})
        for one in came.cognitons
    }  # fmt: skip
    for one in gone.scheme.cognitons:
        permits, weights = links[one.name]
        assert [link.plan for link in one.permits] == permits
        assert {link.plan: link.weight for link in one.influences} == weights


def test_each_loss_is_named():
    scheme = CognitiveScheme(
        "a,b",
        (
            Cogniton("Fear", start_value=2, reinforcement={"flee": 1}, conditional=("flee",),
                     chance=0.5, type="need"),
            Cogniton("Cold", False, 1, activated_when="warmth < 1", influence={"flee": 1e-7}),
            Cogniton("Wet", False, 1, active_while=["warmth < 1", "dressed == 0"]),
            Cogniton("Odd", False, 1, active_while="warmth != 1", position=(1, 2)),
        ),
        (
            Group("clan", (Role("elder"),), (("land", 2.0),)),
            Group("family", (Role("child", (Culturon("Fear", 1),)),), within=("clan", "elder")),
        ),
        breeds=("others",),
    )  # fmt: skip
    lost = "\n".join(for_metaciv(scheme).lost)
    for said in (
        "scheme 'a,b' is called 'a_b'", "'Fear': its start value 2 becomes 1",
        "'Fear': its reinforcement by 'flee' is left out", "its chance 0.5 is left out",
        "the type need becomes belief", "'Cold': activated_when is left out",
        "its weight 1e-07 on 'flee' becomes 0.0", "warmth < 1 and dressed == 0 is left out",
        "warmth != 1 is left out", "places in the drawing", "its attributes 'land' are left out",
        "that it lies in 'clan' is left out", "role 'elder' has a culturon 'clan elder'",
        "culturon 'Fear' is called 'family Fear'", "breeds are left out", "inherit nothing",
    ):  # fmt: skip
        assert said in lost


names = st.text(max_size=5) | st.sampled_from(
    ["a", "b", "A", "..", " : ", "a : b", "x,", " a", "é", "\x85", "\u2028", "a:b", "x" * 300, "/"]
)
weights = st.integers(-3, 3) | st.floats(-1e12, 1e12)
links = {
    "influence": st.dictionaries(names, weights, max_size=3),
    "conditional": st.lists(names, max_size=3),
    "colour": st.tuples(*[st.integers(0, 255)] * 3),
}


def once(values, size=4):
    return st.lists(values, max_size=size, unique_by=lambda one: one.name)


conditions = st.sampled_from(["", "energy < 5", "energy >= full", "energy != 1", "age == 1e-7"])
cognitons = st.builds(
    lambda name, starting, active, **held: Cogniton(
        name, starting, active_while=[active] if active else [], **held
    ),
    names, st.booleans(), conditions, **links,
)  # fmt: skip
roles = st.builds(Role, names, once(st.builds(Culturon, names, **links), 2))
schemes = st.builds(
    CognitiveScheme, names, once(cognitons), once(st.builds(Group, names, once(roles, 3)), 3)
)


@settings(max_examples=60)
@given(schemes)
def test_any_scheme_is_read_as_it_was_written(scheme):
    exported = for_metaciv(scheme)
    with TemporaryDirectory() as folder:
        read = read_again(exported.scheme, Path(folder))
    assert isinstance(read, Scheme)
    assert without_places(read) == without_places(exported.scheme)
    again = for_metaciv(as_ours(read, 1))
    assert without_places(again.scheme).groups == without_places(exported.scheme).groups
