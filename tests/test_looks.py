"""A model says how it looks, and what is wrong with that is said."""

import numpy as np
import pytest

from socialmind import Looks
from socialmind.catalogue import catalogue, load_model
from socialmind.errors import SocialmindError
from socialmind.looks import COLOURS
from socialmind.model import Model
from socialmind.studio.running.colouring import looks_of
from socialmind.studio.running.frames import unpacked
from socialmind.studio.running.moment import Shown, frame_of

SHOWN = sorted(name for name in catalogue() if load_model(name).looks is not Model.looks)


@pytest.mark.parametrize("name", SHOWN)
def test_models_that_say_it_are_drawn_so(name):
    society = load_model(name)(seed=1, compiled=False)
    society.advance(3)
    shown = Shown.of(society)
    before = society.state()
    header, _ = unpacked(frame_of(society, shown))
    for population, looks in looks_of(society).items():
        said = header["patches"] if population == "patches" else header["populations"][population]
        if population != "patches":
            assert shown.agents[population] == "looks"
            assert said["shape"] == looks.shape
        assert tuple(said["colours"]) == looks.palette
    assert all(np.array_equal(before[n], one) for n, one in society.state().items())


def test_wolves_and_sheep_are_as_large_as_they_are_fed():
    society = load_model("wolves_sheep")(seed=1, compiled=False)
    header, columns = unpacked(frame_of(society, Shown.of(society)))
    assert columns["sheep.size"] == pytest.approx(0.7 + 0.02 * society.sheep.energy)
    assert header["patches"]["range"] == [0, society.regrowth]
    along = columns["patches"] / 254 * society.regrowth
    assert along == pytest.approx(society.world.growing.ravel(), abs=society.regrowth / 254)


def test_bodies_on_a_plane_have_colours_and_shapes_too(monkeypatch):
    kind = load_model("collect")

    def looks(self):
        return {
            "robots": Looks("arrow", {"idle": "grey", "done": "red"}, by=self.robots.delivered > 0),
            "drop_zones": Looks(colour="gold"),
        }

    monkeypatch.setattr(kind, "looks", looks)
    society = kind(seed=1, compiled=False)
    header, columns = unpacked(frame_of(society, Shown.of(society)))
    said = header["populations"]
    assert (said["robots"]["shape"], said["robots"]["words"]) == ("arrow", ["idle", "done"])
    assert columns["robots.colour"].tolist() == [0]
    assert said["drop_zones"]["colours"] == [COLOURS["gold"]]
    assert "objects.colour" not in columns


def test_words_have_their_colours_and_a_scale_its_ends():
    words = Looks(colour={"no": "grey", "yes": "#ff0000"}, by=[True, False])
    assert words.palette == (COLOURS["grey"], "#ff0000")
    assert (words.words, words.is_scale) == (("no", "yes"), False)
    assert Looks(colour=("white", "green"), by=[1, 2]).is_scale
    assert Looks(size=2).sizes("sheep", 3).tolist() == [2, 2, 2]


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"shape": "discus"}, "did you mean 'disc'"),
        ({"colour": "grene"}, "did you mean 'green'"),
        ({"colour": "#12345"}, "or #rrggbb"),
        ({"colour": {"a": "red", "b": "blue"}}, "give by="),
        ({"colour": ("red",), "by": [1]}, "scale of one colour"),
    ],
)
def test_what_is_wrong_is_said(wrong, said):
    with pytest.raises(SocialmindError, match=said):
        Looks(**wrong)


def test_values_are_one_for_each():
    with pytest.raises(SocialmindError, match="2 values; expected one for each of 3"):
        Looks(colour=("white", "green"), by=np.array([1, 2])).values("sheep", 3)
    with pytest.raises(SocialmindError, match="no numbers"):
        Looks(colour=("white", "green"), by=["a", "b"]).values("sheep", 2)
