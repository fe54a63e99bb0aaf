"""Any scheme, as far as a CogLogo file holds it, is read as it was written."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from coglogo_py import CognitiveScheme, Cogniton, Culturon, Group, Role
from coglogo_py.files.cogscheme_file import parse, written
from coglogo_py.files.cogscheme_losses import for_coglogo
from tests.coglogo_py.test_round_trip import Loyal, any_names, schemes


@pytest.mark.filterwarnings("ignore:.*has groups but no cogniton")
@given(schemes(any_names, st.none() | st.lists(any_names, unique=True, max_size=4)))
def test_what_is_held_is_read_as_it_was_written(scheme):
    held, lost = for_coglogo(scheme)
    assert parse(written(held), "any.cogscheme", CognitiveScheme) == held
    if lost == ():
        assert held == scheme
    assert for_coglogo(held)[0] == held


def test_each_loss_is_named():
    scheme = CognitiveScheme(
        "cows",
        (
            Cogniton("Fear", influence={"a=b": 1}, active_while="age < 3"),
            Cogniton("COG", inherited=0.5, conditional=("a_b",)),
        ),
        (
            Group("herd", (Role("x\ny", (Culturon("Calm"),)),), (("milk", 1.0),)),
            Group("family", within=("herd", "x\ny"), position=(1, 2)),
        ),
        Loyal(),
        plan_order=("eat", "a=b"),
    )
    held, lost = for_coglogo(scheme)
    assert lost == (
        "plan 'a=b' is called 'a_b_2'",
        "cogniton 'COG' is called 'COG_'",
        "cogniton 'Fear': 'active_while' is left out",
        "cogniton 'COG': 'inherited' is left out",
        "group 'herd': its attributes 'milk' are left out",
        "group 'herd': role 'x\\ny' is called 'x y'",
        "group 'family': that it lies in 'herd' is left out",
        "group 'family': its place in the drawing and those of its roles are left out",
        "the decision maker Loyal, which CogLogo lacks, becomes MaximumWeight",
        "the order of plans, ['eat', 'a=b', 'a_b'], becomes ['a_b_2', 'a_b']",
    )
    assert held.cognitons[0].influence == {"a_b_2": 1.0}
