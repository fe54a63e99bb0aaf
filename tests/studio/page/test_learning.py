"""The room of trainings, and robots steered by hand, in a real browser."""

import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

from socialmind.catalogue import load_model
from socialmind.experiments import Run, replay
from socialmind.learning import Training
from socialmind.learning.imprinting.recording import Recording
from socialmind.learning.imprinting.steered import recording_of_run

TESTS = Path(__file__).parents[2]
ROVER = TESTS / "studio" / "learning" / "rover"
ROVERS = TESTS / "interventions" / "rovers"
TICK = "Number((document.querySelector('[data-test=tick]')?.innerText ?? '').replace(/\\D/g, ''))"
GENERATION = TICK.replace("tick", "generation")
ACTS = "/tick [1-9]/.test(document.querySelector('[data-test=act-tick]')?.innerText)"
LINE = TICK.replace("[data-test=tick]", "[data-test=attempt-1-of-Long] td:last-child")
PAST = "Number(document.querySelector('[data-test=past]').dataset.ticks)"


@pytest.fixture(scope="module")
def studio(program):
    return program(str(ROVERS))


def learning(folder, *words):
    """Begin a training as somebody at a terminal does."""
    command = [sys.executable, "-m", "socialmind", "learn", str(ROVER), *words, "--quiet"]
    return subprocess.Popen(
        command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )


def test_a_training_is_watched_paused_and_resumed(browser, studio):
    page = studio.page(browser, "#/learning", "[data-test=none]")
    elsewhere = learning(studio.folder, "--out", "trainings/tiny", "--attempts", "2", "--seed", "3")
    try:
        page.wait_for_selector("[data-test='training-trainings/tiny']")
        # The first lesson is soon over, the second one goes on; each generation is another point.
        page.wait_for_selector("[data-test=generation]")
        page.wait_for_function(f"{GENERATION} > 20")
        assert page.inner_text("[data-test=standing]") == "goes on"
        assert page.is_visible("text=Begun elsewhere, as process")
        page.wait_for_selector("[data-test=curve-Long] canvas")
        assert "ticks/s" in page.inner_text("[data-test=speed]")
        assert "about" in page.inner_text("[data-test=left]")
        before = page.evaluate(GENERATION)
        page.wait_for_function(f"{GENERATION} > {before}")
        page.wait_for_function(f"{LINE} > {before}")
        # Paused from the page it ends where it was begun, which is told there.
        page.click("[data-test=pause]")
        _, said = elsewhere.communicate(timeout=120)
    finally:
        elsewhere.kill()
        elsewhere.wait()
    assert elsewhere.returncode == 130
    assert re.search(
        r"socialmind: paused by the studio in attempt 1, Long, after generation [\d,]+; go on with "
        r"`socialmind learn --resume .*tiny`, or from where it was paused\n$",
        said,
    )
    page.wait_for_selector("[data-test=standing]:text-is('paused')")
    safe = page.evaluate(GENERATION)
    # On it goes from here, as the same training; and it is paused in the same way.
    page.click("[data-test=resume]")
    page.wait_for_selector("[data-test=standing]:text-is('goes on')")
    page.wait_for_function(f"{GENERATION} > {safe}")
    # Meanwhile what was found so far acts in a world.
    page.click("[data-test=act]")
    page.wait_for_function(
        "/tick [1-9]/.test(document.querySelector('[data-test=act-tick]')?.innerText)"
    )
    assert page.is_visible("[data-test=acting] canvas")
    page.click("[data-test=pause]")
    page.wait_for_selector("[data-test=standing]:text-is('paused')")
    training = Training(studio.folder / "trainings" / "tiny")
    assert training.manifest.status == "interrupted"
    curve = training.curve.query("lesson == 'Long'")
    assert curve["generation"].tolist() == list(range(1, len(curve) + 1))
    assert len(curve) > safe
    # What is broken is said where it stands.
    (studio.folder / "trainings" / "torn").mkdir()
    (studio.folder / "trainings" / "torn" / "manifest.json").write_text("{")
    page.click("[data-test='training-trainings/torn']")
    page.wait_for_selector("[data-test=failure]")
    assert "manifest" in page.inner_text("[data-test=failure]")
    assert page.failures == []
    page.close()


def test_a_robot_is_steered_and_its_hierarchy_followed(browser, studio):
    page = studio.page(browser)
    page.click("[data-test=step]")
    page.wait_for_function(f"{TICK} == 1")
    page.focus("[data-test=world]")
    page.keyboard.press("n")
    page.wait_for_selector("[data-test=watched]")
    # The hierarchy: click a motor, and see how it went.
    page.click("[data-node='MO:MotL']")
    page.wait_for_function("document.querySelector('[data-test=past]')?.dataset.last == '0.75'")
    # Take it, and let it turn left.
    page.focus("[data-test=world]")
    page.keyboard.press("t")
    page.wait_for_selector("[data-test=in-hand]")
    page.click("[data-test=go]")
    page.focus("[data-test=world]")
    page.keyboard.down("ArrowUp")
    page.keyboard.down("a")
    time.sleep(1.0)
    page.keyboard.up("a")
    page.keyboard.up("ArrowUp")
    page.keyboard.press("Escape")
    page.wait_for_selector("[data-test=take]")
    page.click("[data-test=go]")
    page.wait_for_selector("[data-test=step]:not([disabled])")
    stood = page.evaluate(TICK)
    # Live and in the past: every tick of what the motor was told by its mind, by repeating.
    page.wait_for_function(f"{PAST} >= {min(stood, 301)}")
    page.keyboard.press("t")
    page.wait_for_selector("[data-test=in-hand]")
    page.click("[data-test=imprint]")
    page.fill("[data-test=shown-file]", "shown.csv")
    page.click("[data-test=write]")
    page.wait_for_selector("text=Saved in shown.csv")
    page.click("[data-test=give-back]")
    page.click("[data-test=save]")
    page.fill("input[aria-label=folder]", "steered")
    page.keyboard.press("Enter")
    page.wait_for_selector("text=/Saved in .*steered/")
    run = Run(studio.folder / "steered")
    told = [one["commands"] for one in run.manifest.interventions]
    assert [1.0, 1.0] in told and [0.75, 1.0] in told and None in told
    assert replay(studio.folder / "steered").equal
    skill = load_model(ROVERS).populations["rovers"].hierarchy.skills["Drive"]
    shown = Recording.read(studio.folder / "shown.csv", skill)
    again = recording_of_run(studio.folder / "steered", "Drive")
    assert shown.inputs.tolist() == again.inputs.tolist()
    assert shown.outputs.tolist() == again.outputs.tolist()
    assert len(shown) >= 10
    assert page.failures == []
    page.close()
