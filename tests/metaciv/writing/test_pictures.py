"""How imported models look: peoples and terrains in the colours of the files."""

import pytest

from socialmind.experiments import draw_figures, run
from socialmind.studio.running.colouring import looks_of

from .folders import files_of, imported, joined

BUILD = {"Work": "A_CreatePrivateFacility,a(Amenagement Barn)"}
WILL = {"Will": (True, "Work", {"Work": 1})}


@pytest.fixture(scope="module")
def two_peoples(tmp_path_factory):
    """Those who build on grass, and those who stand on rock of the same colour."""
    ground = {"terrains": {"Rock": (25, False)}, "rows": ["0,0,1,1,1"] * 4}
    builders = files_of(plans=BUILD, cognitons=WILL, facilities=("Barn",), agents=2, **ground)
    idle = {"plans": {"Rest": "A_DoNothing"}, "cognitons": {"Calm": (True, "Rest", {"Rest": 1})}}
    others = files_of(scheme="Idle", people="Others", agents=3, **idle, **ground)
    name = "simulation/civilisations/Others.metaciv"
    others[name] = others[name].replace("0.1,1.0,1.0", "0.5,1.0,0.5")
    return imported(tmp_path_factory.mktemp("two"), joined(builders, others))


def test_the_studio_shows_peoples_buildings_and_terrains(two_peoples):
    society = two_peoples(seed=1, compiled=False)
    society.advance(4)
    found = looks_of(society)
    assert found["humans"].palette == ("#ff9900", "#008080")
    assert found["humans"].words == ("People", "Others")
    assert list(found["humans"].values("humans", 5)) == [0, 0, 1, 1, 1]
    assert found["barns"].shape == "house"
    assert found["patches"].words == ("Grass", "Rock")
    assert found["patches"].values("patches", 20).sum() == 12


def test_a_run_draws_its_map(two_peoples, tmp_path):
    folder = run(two_peoples, 4, out=tmp_path / "run", compiled=False)
    drawn = {path.name for path in draw_figures(folder)}
    assert drawn == {"map.pdf", "map.png", "series.pdf", "series.png"}


def test_ground_of_one_kind_is_no_map(tmp_path):
    model = imported(tmp_path, files_of(plans=BUILD, cognitons=WILL, facilities=("Barn",)))
    assert set(model(seed=1, compiled=False).looks()) == {"humans", "barns"}
    folder = run(model, 4, out=tmp_path / "run", compiled=False)
    assert len(draw_figures(folder)) == 4
