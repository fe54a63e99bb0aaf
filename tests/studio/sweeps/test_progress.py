"""What a page is told of a sweep is what its tables hold."""

import json

import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Sweep, sweep
from socialmind.studio.sweeps.figures import drawn
from socialmind.studio.sweeps.progress import told


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Two seeds at two sizes, one of which has more people than places."""
    return sweep(
        load_model("schelling"),
        {"n_agents": [8, 20]},
        5,
        [1, 2**63 - 1],
        fixed={"world_size": 4},
        compiled=False,
        workers=1,
        out=tmp_path_factory.mktemp("sweeps") / "one",
        progress=False,
    )


def test_its_runs_are_counted_and_the_failed_ones_say_why(folder):
    found = told(folder)
    assert (found["runs"], found["done"]) == (4, 4)
    assert found["counts"] == {"finished": 2, "failed": 2}
    assert (found["status"], found["left"]) == ("finished", None)
    assert all("free patch" in one["error"] for one in found["failed"])
    assert {one["n_agents"] for one in found["failed"]} == {20}
    seeds = {one["seed"] for one in found["latest"]}
    assert seeds == set(Sweep(folder).runs["seed"].astype(str)[:2])  # whole, as texts
    json.dumps(found, allow_nan=False)


def test_its_figures_are_those_that_its_design_calls_for(folder):
    found = drawn(folder)
    names = [one["name"] for one in found["figures"]]
    assert any(name.startswith("response-") for name in names)
    assert all("<svg" in one["svg"] for one in found["figures"])
    assert drawn(folder, "happy")["figures"]


def test_what_is_no_sweep_is_refused(tmp_path):
    with pytest.raises(SocialmindError, match="no such folder"):
        told(tmp_path / "nothing")
