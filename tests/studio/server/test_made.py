"""Runs and sweeps below the studio's folder are found, and no others."""

import json

from socialmind.catalogue import load_model
from socialmind.experiments import run
from socialmind.studio.server.folders import Folders
from socialmind.studio.server.made import folders_of


def test_runs_are_told_of_with_their_seeds_whole(tmp_path):
    seed = 2**63 + 1
    run(
        load_model("schelling"),
        1,
        seed,
        {"n_agents": 5, "world_size": 4},
        compiled=False,
        out=tmp_path / "runs" / "one",
        progress=False,
    )
    found = folders_of(Folders(tmp_path), "run")
    assert [one["folder"] for one in found] == ["runs/one"]
    assert (found[0]["model"], found[0]["seed"], found[0]["ticks_done"]) == (
        "schelling", str(seed), 1
    )  # fmt: skip
    assert folders_of(Folders(tmp_path), "sweep") == []


def test_what_cannot_be_read_is_told_of_with_the_reason(tmp_path):
    for name, text in (("torn", "{"), ("odd", json.dumps({"kind": None})), ("list", "[]")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "manifest.json").write_text(text)
    found = folders_of(Folders(tmp_path), "run")
    assert {one["folder"] for one in found} == {"torn", "odd", "list"}
    assert all(one["error"] for one in found)
    # A broken one where those of another kind lie is told of as one of these.
    (tmp_path / "odd").rename(tmp_path / "trainings")
    (tmp_path / "torn").rename(tmp_path / "trainings" / "torn")
    (tmp_path / "trainings" / "manifest.json").unlink()
    assert {one["folder"] for one in folders_of(Folders(tmp_path), "sweep")} == {"list"}


def test_links_and_hidden_folders_lead_nowhere(tmp_path):
    outside = tmp_path / "outside" / "run"
    outside.mkdir(parents=True)
    (outside / "manifest.json").write_text("{}")
    home = tmp_path / "home"
    (home / ".hidden").mkdir(parents=True)
    (home / ".hidden" / "manifest.json").write_text("{}")
    (home / "link").symlink_to(outside)
    assert folders_of(Folders(home), "run") == []
