"""Any scheme, saved and loaded, is the same scheme, in both forms of file."""

from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from coglogo_py import (
    BiasedWeightedStochastic,
    CognitiveScheme,
    Cogniton,
    Culturon,
    DecisionMaker,
    Group,
    MaximumWeight,
    Role,
    SchemeError,
    WeightedStochastic,
)
from coglogo_py.files.cogscheme_file import KEYWORDS


class Loyal(DecisionMaker):
    """Always the first plan: a modeller's own."""

    name = "Loyal"

    @staticmethod
    def choose(weights, bias, u):
        return 0

    @staticmethod
    def probabilities(weights, bias):
        raise AssertionError("files decide nothing")


odd_names = st.sampled_from(
    ["yes", "No", "null", "~", "", " ", "10", "1e3", "- a", "a: b", "#a", "'", '"', "\\", "<<",
     "{a}", "[a]", "&a", "*a", "!a", "%a", "@a", "?", "a #b", "\t", "é", "农民", "\x85", "\u2028",
     "\ufeff", "\x00", "😀", "=", "a=b", "COG", "ENDCS", "a\nb", "\r"]
)  # fmt: skip
any_names = st.text(max_size=6) | odd_names | st.sampled_from("abcd")
line_names = any_names.filter(lambda n: not set(n) & set("\0\r\n=") and n not in KEYWORDS)
numbers = st.floats(allow_nan=False, allow_infinity=False) | st.integers(-3, 3)
coordinates = st.tuples(*[st.integers(-(2**31), 2**31 - 1)] * 2)
anywhere = st.none() | coordinates
makers = st.sampled_from([MaximumWeight, WeightedStochastic, BiasedWeightedStochastic, Loyal])


def descriptions(kind, names, *more):
    links = st.dictionaries(names, numbers, max_size=4)
    return st.builds(
        kind,
        names,
        *more,
        numbers,
        st.tuples(*[st.integers(0, 255)] * 3),
        anywhere,
        links,
        st.lists(names, max_size=4),
        links,
    )


def named_once(values):
    return st.lists(values, max_size=4, unique_by=lambda value: value.name)


def schemes(names, orders, places=anywhere):
    roles = st.builds(Role, names, named_once(descriptions(Culturon, names)), places)
    groups = st.builds(Group, names, named_once(roles), position=places)
    return st.builds(
        CognitiveScheme,
        names,
        named_once(descriptions(Cogniton, names, st.booleans())),
        named_once(groups),
        st.builds(lambda maker, bias: maker(bias), makers, st.floats(0, 1e9, exclude_min=True)),
        st.lists(names, unique=True, max_size=3),
        st.dictionaries(names, coordinates, max_size=3),
        orders,
    )


def saved_and_loaded(scheme, name):
    with TemporaryDirectory() as folder:
        path = Path(folder) / name
        scheme.save(path)
        return CognitiveScheme.load(path, decision_makers=[Loyal])


@pytest.mark.filterwarnings("ignore:.*has groups but no cogniton")
@given(schemes(line_names, st.none(), places=st.none()))
def test_as_a_coglogo_file(scheme):
    loaded = saved_and_loaded(scheme, "a.cogscheme")
    assert loaded == scheme
    assert repr(loaded) == repr(scheme)  # the order of links, and the sign of 0, too
    assert loaded.repeated == ()


@given(schemes(any_names, st.none() | st.lists(any_names, unique=True, max_size=4)))
def test_as_a_yaml_file(scheme):
    loaded = saved_and_loaded(scheme, "a.yaml")
    assert loaded == scheme
    order = scheme.linked_plans if scheme.plan_order is None else scheme.plan_order
    assert loaded.plan_order == order
    assert repr(loaded.cognitons) == repr(scheme.cognitons)
    assert repr(loaded.groups) == repr(scheme.groups)


@pytest.mark.parametrize(("suffix", "line"), [("cogscheme", 3), ("yaml", 4)])
def test_a_modellers_own_decision_maker_goes_by_name(tmp_path, suffix, line):
    path = tmp_path / f"cows.{suffix}"
    scheme = CognitiveScheme("cows", decision_maker=Loyal(0.5))
    scheme.save(path)
    assert "Loyal" in path.read_text()
    assert CognitiveScheme.load(path, decision_makers=[Loyal]) == scheme
    with pytest.raises(SchemeError) as failure:
        CognitiveScheme.load(path)
    assert f"{path}:{line}: found decision maker 'Loyal'; expected one of" in str(failure.value)
