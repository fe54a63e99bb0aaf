"""The room of sweeps, in a real browser: empty, going on, with failures, and one of its runs."""

import json

import pytest

from socialmind.catalogue import load_model
from socialmind.experiments import Sweep, sweep

LIST = "[data-test=sweeps] a"


@pytest.fixture(scope="module")
def studio(program):
    return program()


def test_a_sweep_is_watched_drawn_and_one_of_its_runs_opened(browser, studio):
    page = studio.page(browser, "#/experiments", "text=There is no sweep below this folder yet")
    # Two points, one of which has more people than places.
    folder = sweep(
        load_model("schelling"),
        {"n_agents": [8, 20]},
        5,
        range(3),
        fixed={"world_size": 4},
        compiled=False,
        workers=1,
        out=studio.folder / "sweeps" / "crowded",
        progress=False,
    )
    broken = studio.folder / "sweeps" / "broken"
    broken.mkdir()
    (broken / "manifest.json").write_text(json.dumps({"kind": "sweep"}))
    page.click(f"{LIST}:has-text('crowded')")
    page.wait_for_selector("[data-test=figure]")
    assert "3 finished, 3 failed" in page.inner_text("[data-test=progress]")
    assert "free patch" in page.inner_text("[data-test=failed]")
    assert page.locator("[data-test=latest] tbody tr").count() == 3
    # A run that failed says why once more; one that did not is opened, with its whole seed.
    page.click("[data-test=failed] button >> nth=0")
    page.wait_for_selector("[role=alert]:has-text('free patch')")
    page.click("[data-test=open-1]")
    page.wait_for_selector("[data-test=setup]:not([disabled])")
    seed = int(Sweep(folder).runs["seed"][1])
    page.wait_for_function(f"document.querySelector('[data-test=seed]').value == '{seed}'")
    assert page.input_value("[data-test=parameter-n_agents]") == "8"
    # What cannot be read says so.
    page.goto(f"http://127.0.0.1:{studio.port}/#/experiments?sweep=sweeps/nothing")
    page.wait_for_selector("[role=alert]:has-text('no such folder')")
    page.wait_for_selector(f"{LIST}:has-text('broken') .wrong")
    assert page.failures == []
    page.close()
