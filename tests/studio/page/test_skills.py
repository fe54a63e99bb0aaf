"""The room of skills in a real browser: a hierarchy is opened, changed, saved and run."""

import shutil
import subprocess
import sys

import pytest

from socialmind.mind import MindDescription
from socialmind.sources.folders import model_folder
from socialmind.studio.skills.files import tree_of

NODE = ".svelte-flow__node[aria-label='{}']"
ROOM = "#/skills?file=robot"
TYPING = "document.activeElement?.matches('[data-test=part-name]')"
SAVED = "!document.querySelector('[data-test=file]').innerText.includes('changed')"


@pytest.fixture(scope="module")
def studio(robot_studio):
    return robot_studio


def add(page, part, name):
    """Add a part by its key, and type its name."""
    page.keyboard.press("Escape")
    page.evaluate("document.activeElement?.blur()")
    page.keyboard.press(part)
    page.wait_for_function(TYPING)
    page.keyboard.type(name)
    page.keyboard.press("Enter")


def key(page, name):
    page.evaluate("document.activeElement?.blur()")
    page.keyboard.press(name)


def test_a_hierarchy_is_opened_changed_saved_and_run(browser, studio):
    robot = studio.folder / "robot"
    before = tree_of(robot)
    page = studio.page(browser, ROOM, NODE.format("skill Avoid"))
    page.wait_for_selector("text=Nothing odd.")
    # Saved as it is, it is as it was.
    page.click("[data-test=save-mind]")
    page.wait_for_selector("text=Saved in robot")
    assert tree_of(robot) == before
    # A wrong name is refused where it is typed; a right one goes along all links.
    page.click(NODE.format("skill Avoid"))
    page.fill("[data-test=part-name]", "Go:away")
    assert page.is_visible("text=no name has")
    page.fill("[data-test=part-name]", "KeepClear")
    page.keyboard.press("Enter")
    page.wait_for_selector(NODE.format("skill KeepClear"))
    # A changed size: what it means for what was learned is said, and taken back by undo.
    page.fill("[data-test=size-LAYERS]", "1")
    page.wait_for_selector("[data-test=weights]:has-text('trained anew')")
    assert "do not fit any more" in page.inner_text("[data-test=findings]")
    key(page, "Control+z")
    page.wait_for_selector("[data-test=weights]:text-is('422 weights, learned.')")
    assert page.is_visible(NODE.format("skill KeepClear"))
    # A further skill by the keyboard; until it is whole, what is amiss stands where it is.
    add(page, "k", "Rest")
    page.wait_for_selector("[data-test=findings] >> text=without outputs")
    page.select_option("[data-test=add-outputs]", "MO:MotL")
    page.select_option("[data-test=add-outputs]", "MO:MotR")
    page.wait_for_selector("[data-test=findings] >> text=no weights")
    page.select_option("[data-test=function]", "hardCoded")
    page.wait_for_selector("[data-test=program-file]:text-is('Rest.py')")
    key(page, "Control+z")
    page.wait_for_selector("[data-test=save-mind]:not([disabled])")
    page.click("[data-test=delete]")
    page.wait_for_selector(NODE.format("skill Rest"), state="detached")
    # A variable, kept for later.
    add(page, "v", "MOOD")
    page.fill("[data-test=field-default]", "0.25")
    page.wait_for_selector("[data-test=findings] >> text=unused variable")
    page.click("[data-test=save-mind]")
    page.wait_for_function(SAVED)
    mind = MindDescription.load(robot)
    assert mind.variables["MOOD"].default == 0.25
    weights = MindDescription.load(model_folder("collect") / "mind").skills["Avoid"].genome
    assert mind.skills["KeepClear"].genome.tolist() == weights.tolist()
    after = tree_of(robot)
    assert {name for name in before if before[name] != after.get(name)} == {
        "Collect.vardesc",
        "Skills/Avoid/Avoid.ades",
        "Skills/Avoid/Avoid.genome",
        "Skills/GoToDropZone+Avoid/GoToDropZone+Avoid.ades",
        "Skills/GoToObject+Avoid/GoToObject+Avoid.ades",
    }
    # Under another name, as our own form; and a mind that stands there is not lost unasked.
    page.click("[data-test=save-as]")
    page.fill("[data-test=save-file]", "robot.yaml")
    page.keyboard.press("Enter")
    page.wait_for_selector("[data-test=file]:text-is('robot.yaml')")
    page.click("[data-test=save-as]")
    page.fill("[data-test=save-file]", "robot")
    page.keyboard.press("Enter")
    page.wait_for_selector("button:text-is('Replace it')")
    assert page.failures == []
    page.close()
    # The command line runs it.
    command = [sys.executable, "-m", "socialmind", "run", "collect", "--mind", "robot.yaml"]
    command += ["--ticks", "20", "--out", "run", "--quiet"]
    subprocess.run(command, cwd=studio.folder, check=True)
    (kept,) = (studio.folder / "run" / "minds").iterdir()
    assert "KeepClear" in MindDescription.load(kept).skills


def test_boxes_that_are_dragged_stand_there_again(browser, studio):
    robot = shutil.copytree(model_folder("collect") / "mind", studio.folder / "dragged")
    before = tree_of(robot)
    boxes = ("skill Avoid", "sensor RADOBJ", "actuator MotL")
    page = studio.page(browser, "#/skills?file=dragged", NODE.format(boxes[0]))
    rest = page.stands(NODE.format("skill Collect"))
    places = [page.drag(NODE.format(one), 30, -25) for one in boxes]
    # Undo takes a drag back, and redo makes it again.
    key(page, "Control+z")
    page.where(NODE.format(boxes[2]))
    assert page.stands(NODE.format(boxes[2])) != places[2]
    key(page, "Control+Shift+z")
    page.click("[data-test=save-mind]")
    page.wait_for_function(SAVED)
    page.close()
    # Nothing but the places was written.
    after = tree_of(robot)
    assert after.pop("Collect.layout").decode().split() == [
        "SENSORS", "RADOBJ:{}:{}".format(*places[1]),
        "ACTUATORS", "MotL:{}:{}".format(*places[2]),
        "SKILLS", "Avoid:{}:{}".format(*places[0]),
    ]  # fmt: skip
    assert after == before
    page = studio.page(browser, "#/skills?file=dragged", NODE.format(boxes[0]))
    assert [page.stands(NODE.format(one)) for one in boxes] == places
    assert page.stands(NODE.format("skill Collect")) == rest
    assert page.failures == []
    page.close()


def test_a_hierarchy_is_drawn_from_nothing(browser, studio):
    page = studio.page(browser, "#/skills", "[data-test=open]")
    page.click("[data-test=open]")
    page.click("[data-test=open-empty]")
    page.wait_for_selector("dialog", state="detached")
    add(page, "s", "EYE")
    add(page, "m", "MotL")
    add(page, "k", "Turn")
    # A link by the mouse, from dot to dot; the other by the list.
    dots = [NODE.format("sensor EYE") + " .source", NODE.format("skill Turn") + " .target"]
    start, end = (page.where(one) for one in dots)
    page.mouse.move(start["x"] + 5, start["y"] + 5)
    page.mouse.down()
    page.mouse.move(end["x"] - 20, end["y"] + 5, steps=5)
    page.mouse.move(end["x"] + 5, end["y"] + 5, steps=5)
    page.mouse.up()
    page.wait_for_selector(".svelte-flow__edge[aria-label='Turn reads EYE']", state="attached")
    page.click(NODE.format("skill Turn"))
    page.select_option("[data-test=add-outputs]", "MO:MotL")
    page.wait_for_selector("[data-test=findings] >> text=no weights")
    page.keyboard.press("Control+s")
    page.fill("[data-test=save-file]", "turner")
    page.keyboard.press("Enter")
    page.wait_for_selector("text=Saved in turner")
    mind = MindDescription.load(studio.folder / "turner")
    assert [str(one) for one in mind.skills["Turn"].links] == ["SE:EYE", "MO:MotL"]
    command = [sys.executable, "-m", "socialmind", "check", "turner"]
    said = subprocess.run(command, cwd=studio.folder, capture_output=True, text=True)
    assert "no weights" in said.stdout
    assert page.failures == []
    page.close()
