"""The paragraph of methods: what a run or a sweep was, from its manifest."""

import pandas as pd
import pytest

from socialmind.catalogue import load_model
from socialmind.documents.methods import methods, paragraph_of_sweep
from socialmind.errors import SocialmindError
from socialmind.experiments import Change, Shock, designs, run, sweep

MODEL = '''
from socialmind import Agent, Model, Population, each, parameter


class Walker(Agent):
    """Somebody."""

    steps: int = 0


def walk(walker, model):
    """Go on."""
    walker.steps += model.stride


class Walk(Model):
    """People who walk."""

    stride: int = parameter(2, unit="steps", low=1, doc="a tick")
    limit: float = parameter(1.5, unit="km", low=0.0, doc="of the way")
    fast: bool = parameter(False, doc="whether they run")
    walkers = Population(Walker, 3)
    schedule = (each(walkers, walk),)
'''


@pytest.fixture
def walk(tmp_path):
    folder = tmp_path / "walk"
    folder.mkdir()
    (folder / "model.py").write_text(MODEL, "utf-8")
    return folder


@pytest.fixture
def made(walk, tmp_path):
    return run(
        load_model(walk), ticks=20, seed=7, parameters={"stride": 3}, out=tmp_path / "run",
        compiled=False,
    )  # fmt: skip


def test_it_says_model_version_hash_seed_parameters_software_and_how_to_repeat(made, walk):
    text = methods(made)
    assert text.startswith("The model walk, whose source has the SHA-256 ")
    assert "socialmind 0." in text and "NumPy" in text and "Numba" in text
    assert "One run of 20 ticks was made with the seed 7." in text
    assert "stride = 3 steps (default 2) differed from the defaults." in text
    assert "their defaults: limit = 1.5 km and fast = false." in text
    options = "--ticks 20 --seed 7 --every 1 --agents-every 10 --set stride=3"
    assert f"`socialmind run {walk} {options}`" in text
    assert f"`socialmind replay {made}`" in text
    assert "\n" not in text


def test_a_model_that_has_changed_is_said_to_have(made, walk):
    (walk / "model.py").write_text(MODEL.replace("steps += ", "steps += 2 * "), "utf-8")
    text = methods(made)
    assert "not at hand as they ran" in text
    assert f"`socialmind replay {made} --source kept`" in text


def test_without_its_model_all_values_are_told(made, walk):
    (walk / "model.py").unlink()
    assert "Its parameters were stride = 3, limit = 1.5 and fast = false." in methods(made)


SWEEP = {
    "kind": "sweep",
    "model": {"name": "walk", "path": None, "source_sha256": "ab" * 32},
    "design": {"name": "grid"},
    "points": 6,
    "columns": ["stride", "limit"],
    "fixed": {"fast": True},
    "replicates": {"seeds": list(range(20)), "common": False, "until": None, "most": 20},
    "ticks": 1000,
    "every": 10,
    "measures": {"far": {"expression": "mean(steps[-100:])"}},
    "counts": {"finished": 118, "failed": 1, "timed_out": 1},
    "versions": {"socialmind": "0.1.0", "python": "3.11.7"},
    "platforms": [{"system": "Linux", "machine": "x86_64"}],
}
POINTS = pd.DataFrame({"stride": [1, 2, 3] * 2, "limit": [0.5] * 3 + [1.5] * 3})


def test_a_sweep_is_told_by_design_replicates_and_what_came_of_its_runs(tmp_path):
    text = paragraph_of_sweep(SWEEP, POINTS, tmp_path)
    assert (
        "What was varied is stride (1, 2, 3) and limit (0.5, 1.5), by a full factorial design "
        "of 6 points." in text
    )
    assert "At each point 20 replicates were run, each with a seed of its own" in text
    assert "118 runs of 1,000 ticks were finished (1 failed and 1 timed out)." in text
    assert "In all of them fast = true; all other parameters had their defaults." in text
    assert "far = mean(steps[-100:])" in text
    assert f"socialmind run --from-sweep {tmp_path} --number N" in text


def test_ranges_common_seeds_and_intervals_of_a_sweep(tmp_path):
    many = pd.DataFrame({"stride": range(1, 201), "limit": [i / 100 for i in range(200)]})
    replicates = {"seeds": [4, 9], "common": True, "until": None, "most": 2}
    text = paragraph_of_sweep(
        {**SWEEP, "design": {"name": "lhs"}, "replicates": replicates}, many, tmp_path
    )
    assert "stride (1 … 200) and limit (0 … 1.99), by a Latin hypercube sample" in text
    assert "with the seeds 4, 9 at all points (common random numbers)" in text
    replicates = {**replicates, "until": "5%:far", "most": 80}
    text = paragraph_of_sweep({**SWEEP, "replicates": replicates}, None, tmp_path)
    assert "until the 95 % interval of far was within 5%, at most 80." in text


@pytest.fixture
def plague(tmp_path):
    file = tmp_path / "plague.py"
    file.write_text(
        "def strike(society):\n    society.walkers.steps = 0\n"
        "def far(series):\n    return 1.0 * series['tick'][-1]\n",
        "utf-8",
    )
    return file


def test_a_sweep_s_own_folder_is_told_with_shocks_and_measures(walk, plague, tmp_path):
    folder = sweep(
        walk, designs.lhs({"stride": (1, 9), "limit": (0.5, 1.5)}, 3, seed=5, whole=["stride"]), 20,
        range(2), fixed={"fast": True}, measures={"far": f"{plague}:far"}, every=5, compiled=False,
        shocks=[Shock.parsed(f"8:{plague}:strike")], timeout=60.0, workers=1,
        out=tmp_path / "a sweep",
    )  # fmt: skip
    text = methods(folder)
    assert "by a Latin hypercube sample of 3 points (size 3 and seed 5)." in text
    assert (
        "At each point 2 replicates were run, each with a seed of its own that follows from 0, 1 a"
        in text
    )
    assert "6 runs of 20 ticks were finished. Each had 60 s at most." in text
    assert "Societies were changed on their way: at tick 8 strike (plague.py, SHA-256 " in text
    assert "Of each run was measured: far = far (plague.py, SHA-256 " in text
    assert "Its series was recorded every 5 ticks." in text
    assert f"`socialmind run --from-sweep '{folder}' --number N`" in text
    alone = sweep(walk, None, 1, every=0, compiled=False, workers=1, out=tmp_path / "one")
    assert "Nothing was varied. At each point 1 replicate was run" in methods(alone)
    assert "1 run of 1 tick was finished. All other parameters had" not in methods(alone)
    told = (
        "1 run of 1 tick was finished. All parameters had their defaults: stride = 2 steps, limit"
    )
    assert told in methods(alone)
    again = f"socialmind sweep {walk} --seeds 0:1 --ticks 1 --every 0"
    assert methods(alone).endswith(f"--number N`, all of them by `{again}`.")


def test_a_sweep_without_programs_is_told_with_units_and_the_command_that_makes_it(walk, tmp_path):
    grid = designs.grid({"limit": [0.5, 2.0], "stride": [1, 3]})
    folder = sweep(walk, grid, 20, range(4, 7), common=True, every=5, compiled=False, workers=1,
                   measures={"late": "mean(tick[-2:])"}, timeout=60.0,
                   out=tmp_path / "s")  # fmt: skip
    text = methods(folder)
    assert "limit (0.5, 2 km) and stride (1, 3 steps), by a full factorial design" in text
    assert (
        "12 runs of 20 ticks were finished. Each had 60 s at most. All other parameters had their "
        "defaults: fast" in text
    )
    assert (
        f"`socialmind sweep {walk} --grid limit=0.5,2 --grid stride=1,3 --seeds 4:7 --common "
        "--ticks 20 --every 5 --timeout 60 --measure 'late=mean(tick[-2:])'`" in text
    )
    sampled = sweep(walk, designs.halton({"limit": (0.5, 2.0)}, 3), 2, every=1, compiled=False,
                    workers=1, out=tmp_path / "h")  # fmt: skip
    assert f"socialmind sweep {walk} --sample halton:3 --ranges limit=0.5:2 --s" in methods(sampled)


def test_shocks_and_changes_of_a_run_are_told(walk, plague, tmp_path):
    shock = Shock.parsed(f"8:{plague}:strike")
    options = {"ticks": 20, "compiled": False}
    folder = run(load_model(walk), interventions=[shock], out=tmp_path / "a", **options)
    text = methods(folder)
    assert "Societies were changed on their way: at tick 8 strike (plague.py, SHA-256 " in text
    copy = folder / "interventions/00-strike/source/model/plague.py"
    assert f"--shock 8:{copy}:strike`" in text
    change = Change(12, {"stride": 4})
    folder = run(load_model(walk), interventions=[shock, change], out=tmp_path / "b", **options)
    assert "at tick 12 stride = 4." in methods(folder)
    assert "socialmind run" not in methods(folder) and "socialmind replay" in methods(folder)


def test_a_folder_of_something_else_is_refused(tmp_path):
    with pytest.raises(SocialmindError, match="holds no manifest"):
        methods(tmp_path)
    with pytest.raises(SocialmindError, match="no such folder"):
        methods(tmp_path / "nothing")
