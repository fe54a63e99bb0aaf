"""The room of schemes, in a real browser: a mind is built, saved, run and changed."""

import random
import subprocess
import sys
from pathlib import Path

import pytest

from coglogo_py import CognitiveScheme
from coglogo_py.decision import BUILT_IN
from socialmind.catalogue import load_model
from socialmind.experiments import Run, replay, run

READY = "[data-test=canvas]"
TICK = "Number((document.querySelector('[data-test=tick]')?.innerText ?? '').replace(/\\D/g, ''))"
CHECKED = "[data-test=findings]"


@pytest.fixture(scope="module")
def studio(program):
    return program()


def mind(studio, browser, place="#/mind"):
    page = studio.page(browser, place, READY)
    page.wait_for_selector(f"{CHECKED} li")
    return page


def box(name):
    return f".svelte-flow__node[data-name='{name}']"


def draw(page, source, target):
    """Draw a link with the mouse, from the dot at a box's right side to another box."""
    handle = page.where(f"{box(source)} .svelte-flow__handle-right")
    there = page.where(box(target))
    page.mouse.move(handle["x"] + handle["width"] / 2, handle["y"] + handle["height"] / 2)
    page.mouse.down()
    page.mouse.move(there["x"] + 30, there["y"] + 30, steps=6)
    page.mouse.move(there["x"] + 8, there["y"] + there["height"] / 2, steps=4)
    page.mouse.up()


def type_name(page, name):
    page.wait_for_selector("[data-test=name]:focus")
    page.keyboard.type(name)
    page.keyboard.press("Enter")


def weigh(page, weight):
    """Type the weight of the link that was just drawn."""
    page.fill("[data-test=weight]", weight)
    page.keyboard.press("Enter")


def test_the_turtle_of_the_tutorial_is_built_from_an_empty_page(browser, studio):
    page = mind(studio, browser)
    for maker in BUILT_IN:
        page.wait_for_selector(f"option:text-is('{maker.name}')", state="attached")
    page.fill("[data-test=scheme-name]", "turtles")
    # By keys: the plans in their order, then the cognitons.
    page.focus("[data-test=canvas] .svelte-flow__pane, [data-test=open]")
    for plan in ("goto-red", "goto-blue", "goto-green"):
        page.keyboard.press("p")
        type_name(page, plan)
    for cogniton in ("wantRed", "wantBlue"):
        page.keyboard.press("c")
        type_name(page, cogniton)
    page.fill("[data-test=start]", "1")  # of wantBlue, which is selected
    page.keyboard.press("Enter")
    # By the mouse: links, their weights typed.
    for cogniton, own, other in (
        ("wantRed", "goto-red", "goto-blue"),
        ("wantBlue", "goto-blue", "goto-red"),
    ):
        draw(page, cogniton, own)
        weigh(page, "1")
        draw(page, cogniton, other)
        weigh(page, "-1")
    page.check("input[value=conditional]")
    draw(page, "wantRed", "goto-red")
    draw(page, "wantBlue", "goto-blue")
    # By the keyboard alone: the third one in the inspector's table.
    page.keyboard.press("c")
    type_name(page, "wantGreen")
    for plan, influence, opens, feeds in (
        ("goto-green", "1", True, ""),
        ("goto-red", "-1", False, "0.005"),
        ("goto-blue", "-1", False, "0.005"),
    ):
        page.focus("[data-test=add-link]")
        page.keyboard.type(plan)
        page.keyboard.press("Enter")
        page.wait_for_selector(f"input[aria-label='influence {plan}']:focus")
        page.keyboard.type(influence)
        page.keyboard.press("Tab")
        if opens:
            page.keyboard.press("Space")
        page.keyboard.press("Tab")
        page.keyboard.type(feeds)
    page.select_option("[data-test=scheme-model]", "tutorial")
    page.wait_for_selector("text=Nothing odd.")
    # Save, in both forms.
    for name in ("turtle.yaml", "turtle.cogscheme"):
        page.click("[data-test=save-as]")
        page.fill("[data-test=save-file]", name)
        page.press("[data-test=save-file]", "Enter")
        page.wait_for_function("!document.querySelector('[data-test=save-file]')")
        assert f"Saved in {name}" in page.inner_text("header [role=status]")
    wanted = CognitiveScheme.load("models/tutorial/scheme.yaml")
    for name in ("turtle.yaml", "turtle.cogscheme"):
        built = CognitiveScheme.load(studio.folder / name)
        assert built.plans[:2] == wanted.plans[:2]
        assert [(c.name, c.start_value, c.starting) for c in built.cognitons] == [
            (c.name, c.start_value, c.starting) for c in wanted.cognitons
        ]
        for one, other in zip(built.cognitons, wanted.cognitons, strict=True):
            assert (dict(one.influence), one.conditional, dict(one.reinforcement)) == (
                dict(other.influence), other.conditional, dict(other.reinforcement)
            )  # fmt: skip
            assert one.position is not None
    # The command line runs and draws the file, and the run is that of the model's own scheme.
    own = run(load_model("tutorial"), 300, 3, out=studio.folder / "own", progress=False)
    words = [
        "run",
        "tutorial",
        "--scheme",
        "turtle.yaml",
        "--seed",
        "3",
        "--ticks",
        "300",
        "--out",
        "built",
        "--quiet",
    ]
    for command in (words, ["draw", "turtle.yaml"]):
        subprocess.run(
            [sys.executable, "-m", "socialmind", *command], cwd=studio.folder, check=True
        )
    assert Run(studio.folder / "built").series.equals(Run(own).series)
    # Run in the studio, it is the same run too; a saved one repeats.
    page.click("[data-test=run-scheme]")
    page.wait_for_selector("[data-test=step]:not([disabled])")
    page.fill("[data-test=seed]", "3")
    page.click("[data-test=setup]")
    page.wait_for_selector("[data-test=step]:not([disabled])")
    page.select_option("[data-test=pace]", label="100 ticks a frame")
    page.click("[data-test=go]")
    page.wait_for_function(f"{TICK} >= 300")
    page.click("[data-test=go]")
    page.wait_for_selector("[data-test=save]:not([disabled])")
    page.click("[data-test=save]")
    page.fill("input[aria-label=folder]", "shown")
    page.keyboard.press("Enter")
    page.wait_for_selector("text=Saved in")
    kept = Run(studio.folder / "shown")
    assert kept.seed == 3
    repeated = run(load_model("tutorial"), kept.ticks, 3, scheme=studio.folder / "turtle.yaml",
                   out=studio.folder / "repeated", progress=False)  # fmt: skip
    assert kept.series.equals(Run(repeated).series)
    assert replay(studio.folder / "shown").equal
    assert page.failures == []
    page.close()


HERD = """\
name: cows
cognitons:
  hunger: {influence: {eat: 1}, conditional: [eat]}
groups:  # one alone
  herd:
    leader:
      trust: {influence: {lead: 1}, conditional: [lead]}
    follower:
"""


def test_a_group_a_role_and_a_culturon_that_are_dragged_stand_there_again(browser, studio):
    file = studio.folder / "herd.yaml"
    file.write_text(HERD)
    page = mind(studio, browser, "#/mind?file=herd.yaml")
    rest = {name: page.stands(box(name)) for name in ("follower", "hunger", "lead")}
    places = {name: page.drag(box(name), 40, 35) for name in ("herd", "leader", "trust")}
    page.keyboard.press("Control+z")
    page.where(box("trust"))
    assert page.stands(box("trust")) != places["trust"]
    page.keyboard.press("Control+Shift+z")
    page.where(box("trust"))
    page.click("[data-test=save-scheme]")
    page.wait_for_selector("text=Saved in herd.yaml")
    page.close()
    culturon = "trust: {influence: {lead: 1}, conditional: [lead]"
    assert file.read_text() == HERD.replace(
        culturon, f"{culturon}, position: {places['trust']}"
    ) + (
        f"group_positions:\n  herd: {places['herd']}\n"
        f"role_positions:\n  herd: {{leader: {places['leader']}}}\n"
    )
    page = mind(studio, browser, "#/mind?file=herd.yaml")
    assert {name: page.stands(box(name)) for name in places} == places
    # What nobody dragged stands where it stood.
    assert {name: page.stands(box(name)) for name in rest} == rest
    # The other form holds a culturon's place alone, and that is said.
    page.click("[data-test=save-as]")
    page.fill("[data-test=save-file]", "herd.cogscheme")
    page.press("[data-test=save-file]", "Enter")
    page.wait_for_selector("header [role=status]:has-text('holds no places of groups and roles')")
    page.close()
    page = mind(studio, browser, "#/mind?file=herd.cogscheme")
    assert page.stands(box("trust")) == places["trust"]
    assert page.failures == []
    page.close()


def test_a_link_edited_while_a_society_runs_stands_in_its_capsule(browser, studio):
    page = studio.page(browser, ready="[data-test=model]")
    page.select_option("[data-test=model]", "farmer_artisan")
    page.wait_for_selector("[data-test=setup]:not([disabled])")
    page.select_option("[data-test=pace]", label="10 ticks a frame")
    page.click("[data-test=go]")
    page.wait_for_function(f"{TICK} > 100")
    page.click("[data-test=room-mind]")
    page.click("[data-test=open]")
    page.click("[data-test=running-humans]")
    page.wait_for_selector("[data-test=live]:checked")
    weight = "input[aria-label='influence of Farmer on GrowWheat']"
    page.fill(weight, "7.5")
    page.keyboard.press("Enter")
    page.wait_for_function(f"document.querySelector(\"{weight}\").value === '7.5'")
    page.wait_for_timeout(600)
    # A plan goes, a cogniton comes, and one step is taken back.
    page.click("[data-part=TradeToolsForWheat]")
    page.click("[data-test=delete]")
    page.wait_for_timeout(600)
    page.click("text=+ Cogniton")
    type_name(page, "Hope")
    page.wait_for_timeout(600)
    page.keyboard.press("Control+z")
    page.wait_for_timeout(600)
    page.click("[data-test=room-run]")
    page.wait_for_function(f"{TICK} > 200")
    page.click("[data-test=go]")
    page.wait_for_selector("[data-test=save]:not([disabled])")
    page.click("[data-test=save]")
    page.fill("input[aria-label=folder]", "edited")
    page.keyboard.press("Enter")
    page.wait_for_selector("text=Saved in")
    kept = Run(studio.folder / "edited")
    changes = kept.manifest.interventions
    assert len(changes) >= 3
    files = [studio.folder / "edited" / one["schemes"]["humans"]["file"] for one in changes]
    first, last = CognitiveScheme.load(files[0]), CognitiveScheme.load(files[-1])
    weights = {one.name: dict(one.influence) for one in first.cognitons}
    assert weights["Farmer"] == {"GrowWheat": 7.5}
    assert "TradeToolsForWheat" in first.linked_plans
    assert "TradeToolsForWheat" not in last.linked_plans
    assert replay(studio.folder / "edited").equal
    assert page.failures == []
    page.close()


def test_a_society_that_goes_back_leaves_boxes_where_they_were_dragged(browser, studio):
    sockets = []
    page = studio.page(
        browser,
        ready="[data-test=model]",
        begin=lambda page: page.on("websocket", lambda one: sockets.append(one)),
    )
    page.select_option("[data-test=model]", "civil_norms")
    page.click("[data-test=step]:not([disabled])")
    page.wait_for_function(f"{TICK} === 1")
    page.click("[data-test=room-mind]")
    page.wait_for_selector("[data-part=Pity]")
    page.check("[data-test=live]")
    boxes = ("Pity", "Civilisation", "Member")
    places = [page.drag(box(name), -30, 40) for name in boxes]
    page.click(box("Pity"))
    with sockets[-1].expect_event("framesent", lambda sent: '"start":5' in sent):
        page.fill("[data-test=start]", "5")
    page.click("[data-test=room-run]")
    page.click("[data-test=step]")
    page.wait_for_function(f"{TICK} === 2")
    page.fill("[data-test=scrub]", "0")
    page.wait_for_function(f"{TICK} === 0")
    page.click("[data-test=room-mind]")
    page.wait_for_selector(f"{box('Pity')}:has-text('1')")
    assert [page.stands(box(name)) for name in boxes] == places
    assert page.failures == []
    page.close()


def test_all_edits_taken_back_leave_the_file_as_it_was_and_done_again_are_the_same(browser, studio):
    original = Path("models/civil_norms/scheme.yaml").read_bytes()
    (studio.folder / "norms.yaml").write_bytes(original)
    page = mind(studio, browser, "#/mind?file=norms.yaml")
    page.wait_for_selector("[data-part=Pity]")
    luck = random.Random(7)

    def part():
        parts = page.locator("[data-part]")
        parts.nth(luck.randrange(parts.count())).click()

    def rename():
        part()
        page.fill("[data-test=name]", f"name {luck.randrange(1000)}")

    def add():
        page.keyboard.press("Escape")
        page.focus("[data-test=open]")
        page.keyboard.press(luck.choice("cpg"))
        type_name(page, f"new {luck.randrange(1000)}")

    def delete():
        part()
        page.click("[data-test=delete]")

    def start():
        part()
        if page.locator("[data-test=start]").count():
            page.fill("[data-test=start]", str(luck.randrange(100)))

    def link():
        part()
        if (
            page.locator("[data-test=add-link]").count()
            and page.locator("[data-test=start]").count()
        ):
            page.fill("[data-test=add-link]", luck.choice(["Share", "Keep", "Rest"]))
            page.keyboard.press("Enter")
            page.keyboard.type(str(luck.randrange(9)))

    def move():
        nodes = page.locator(".svelte-flow__node")
        nodes.nth(luck.randrange(nodes.count())).focus()
        page.keyboard.press("Enter")
        for _ in range(3):
            page.keyboard.press("ArrowDown")

    def save(name):
        page.click("[data-test=save-as]")
        page.fill("[data-test=save-file]", name)
        page.press("[data-test=save-file]", "Enter")
        page.wait_for_selector(f"text=Saved in {name}")
        return (studio.folder / name).read_bytes()

    for _ in range(18):
        luck.choice([rename, add, delete, start, link, move])()
    edited = save("edited.yaml")
    assert edited != original
    for button, wanted, name in (("undo", original, "back.yaml"), ("redo", edited, "again.yaml")):
        while page.is_enabled(f"[data-test={button}]"):
            page.keyboard.press("Control+z" if button == "undo" else "Control+Shift+z")
        assert save(name) == wanted
    # What would be lost is said.
    page.keyboard.press("Control+z")
    page.click("[data-test=open]")
    page.click("[data-test=open-empty]")
    assert page.is_visible("text=has changes that are not saved")
    page.click("[data-test=lose]")
    page.wait_for_selector("text=An empty scheme. Press")
    assert page.failures == []
    page.close()
