"""Shocks in sweeps: in every run as in a run of its own, kept, and made again."""

import json
import shutil

import pandas as pd
import pytest

from socialmind.catalogue import load_model
from socialmind.errors import SocialmindError
from socialmind.experiments import Change, Run, Shock, Sweep, remake_run, resume_sweep, run, sweep
from socialmind.experiments.sweeps import leading
from socialmind.experiments.sweeps.tables import window

PLAGUE = """
from parts import LEFT


def strike(society, rng):
    society.walkers.money *= [LEFT * rng.random() for _ in society.walkers]


def tax(society):
    society.walkers.money = society.walkers.money - 1.0


def fail_for_many(society):
    1 // (4 - society.n)
"""
DESIGN = {"largest_gift": [0.5, 2.0], "n": [3, 4]}
OPTIONS = {"seeds": range(2), "every": 5, "agents": 10, "compiled": False, "workers": 1}


@pytest.fixture(scope="module")
def plague(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plague")
    (folder / "parts.py").write_text("LEFT = 0.5\n")
    (folder / "plague.py").write_text(PLAGUE)
    return folder / "plague.py"


@pytest.fixture(scope="module")
def shocks(plague):
    """Of ticks that are recorded and that are not, not in their order."""
    texts = ("13:{}:strike", "0:{}:tax", "10:{}:tax", "20:{}:tax")
    return [Shock.parsed(one.format(plague)) for one in texts]


@pytest.fixture(scope="module")
def shocked(gifts, shocks, tmp_path_factory):
    out = tmp_path_factory.mktemp("shocked") / "sweep"
    return sweep(gifts, DESIGN, 20, shocks=shocks, out=out, **OPTIONS)


def own(table, number):
    return table[table["run"] == number].drop(columns="run").reset_index(drop=True)


def test_each_run_is_as_one_of_its_own_with_the_shocks(gifts, shocks, shocked, tmp_path):
    found = Sweep(shocked)
    row = found.runs.iloc[3]
    alone = Run(
        run(
            load_model(gifts), ticks=20, seed=int(row["seed"]), every=5, agents_every=10,
            parameters={"largest_gift": 2.0, "n": 4}, interventions=shocks, compiled=False,
            out=tmp_path / "alone",
        )
    )  # fmt: skip
    pd.testing.assert_frame_equal(own(found.series, 3), alone.series, check_exact=True)
    pd.testing.assert_frame_equal(
        own(found.agents, 3)[list(alone.agents)], alone.agents, check_exact=True
    )
    assert row["richest"] == alone.series["richest"].iloc[-1]
    again = Run(remake_run(shocked, 3, tmp_path / "again"))
    pd.testing.assert_frame_equal(again.series, alone.series, check_exact=True)
    pd.testing.assert_frame_equal(again.agents, alone.agents, check_exact=True)
    assert again.manifest.identity() == alone.manifest.identity()
    assert [one["tick"] for one in found.manifest.interventions] == [0, 10, 13, 20]


def test_without_shocks_it_is_another(gifts, shocked, tmp_path):
    plain = sweep(gifts, DESIGN, 20, out=tmp_path / "s", **OPTIONS)
    before, after = own(Sweep(plain).series, 3), own(Sweep(shocked).series, 3)
    assert before["richest"][0] == after["richest"][0] == 10.0  # a shock comes after its tick's row
    assert (before["richest"][1:] != after["richest"][1:]).all()
    assert Sweep(plain).manifest.interventions == []


def test_two_workers_come_to_the_same_from_files_and_from_copies(
    gifts, shocks, shocked, contents, tmp_path, monkeypatch
):
    monkeypatch.setattr(leading, "JOB_SECONDS", 0.0)
    monkeypatch.setattr(window, "WINDOW_SECONDS", (0.0, 0.0))

    class Enough(Exception):
        pass

    def tell(done, _):
        if done >= 2:
            raise Enough

    out = tmp_path / "s"
    with pytest.raises(Enough):
        sweep(gifts, DESIGN, 20, shocks=shocks, out=out, on_progress=tell,
              **{**OPTIONS, "workers": 2})  # fmt: skip
    assert (Sweep(out).runs["status"] == "finished").sum() < 4
    resume_sweep(out, workers=2)
    assert contents(out) == contents(shocked)


def test_a_copy_that_was_changed_is_not_gone_on_with(shocked, tmp_path):
    shutil.copytree(shocked, tmp_path / "s")
    (record, *_) = json.loads((shocked / "manifest.json").read_text())["interventions"]
    copy = tmp_path / "s" / record["file"]
    copy.write_text(copy.read_text().replace("1.0", "2.0"))
    with pytest.raises(SocialmindError, match=r"plague\.py: is not the file"):
        resume_sweep(tmp_path / "s", retry=True, workers=1)
    with pytest.raises(SocialmindError, match=r"plague\.py: is not the file"):
        remake_run(tmp_path / "s", 0, tmp_path / "run")


def test_one_that_fails_is_its_run_s_failure_alone(gifts, plague, tmp_path):
    shock = Shock.parsed(f"7:{plague}:fail_for_many")
    out = sweep(gifts, DESIGN, 20, shocks=[shock], out=tmp_path / "s", **OPTIONS)
    runs = Sweep(out).runs
    assert runs["status"].tolist() == ["finished", "finished", "failed", "failed"]
    assert runs["ticks"].tolist() == [20, 20, 7, 7]
    line = PLAGUE.splitlines().index("    1 // (4 - society.n)") + 1
    assert runs["error"][2] == (
        f"run: {plague}:{line}: the shock fail_for_many at tick 7 stopped with ZeroDivisionError: "
        "integer division or modulo by zero"
    )


STOPPED = '''
from socialmind import Agent, Model, Population, each


class Walker(Agent):
    money: float = 10.0


def spend(walker, model):
    walker.money -= 1.0


class Spending(Model):
    """Walkers spend money until there is none."""

    walkers = Population(Walker, 2)
    schedule = (each(walkers, spend),)

    def stop_when(self):
        return self.walkers.money.max() <= 0.0

    def series(self):
        return {"money": self.walkers.money.sum()}


def rob(society):
    society.walkers.money = 0.0
'''


@pytest.mark.parametrize(
    ("tick", "every", "money"), [(4, 2, 12.0), (5, 2, 0.0), (4, 0, 12.0), (5, 0, 10.0)]
)
def test_a_shock_that_ends_a_society_ends_it_as_in_a_run(tmp_path, tick, every, money):
    (tmp_path / "spending").mkdir()
    (tmp_path / "spending" / "model.py").write_text(STOPPED)
    model = load_model(tmp_path / "spending")
    shock = Shock.parsed(f"{tick}:{tmp_path}/spending/model.py:rob")
    out = sweep(model, None, 8, every=every, agents="last", shocks=[shock], compiled=False,
                workers=1, out=tmp_path / "s")  # fmt: skip
    alone = Run(run(model, ticks=8, every=every or 1, interventions=[shock], compiled=False,
                    out=tmp_path / "run"))  # fmt: skip
    (row,) = Sweep(out).runs.itertuples()
    assert row.ticks == tick
    assert row.money == alone.series["money"].iloc[-1] == money
    if every:
        pd.testing.assert_frame_equal(own(Sweep(out).series, 0), alone.series, check_exact=True)
    assert Sweep(out).agents["tick"].tolist() == [tick] * 2


def test_what_is_no_shock_of_a_file_is_refused_before_a_run(gifts, tmp_path):
    def refused(message, *shocks):
        with pytest.raises(SocialmindError, match=message):
            sweep(gifts, None, 5, shocks=shocks, out=tmp_path / "s", **OPTIONS)
        assert not (tmp_path / "s").exists()

    refused(r"shocks: found .*; expected Shock\(TICK, FUNCTION\)", Change(3, {"largest_gift": 2.0}))
    refused("is not at the top of a file", Shock(3, lambda society: None))
