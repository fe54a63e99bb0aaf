"""The room of the first hour, in a real browser: minds are built by hand, each step checked."""

import pytest

from coglogo_py import CognitiveScheme


@pytest.fixture(scope="module")
def studio(program):
    return program()


def done(page):
    page.wait_for_selector("[data-test=step-on]:not([disabled])")


def on(page):
    done(page)
    page.click("[data-test=step-on]")


def add(page, key, name, field="name"):
    page.focus("[data-test=step-title]")
    page.keyboard.press(key)
    page.wait_for_selector(f"[data-test={field}]:focus")
    page.keyboard.press("Control+a")
    page.keyboard.type(name)
    page.keyboard.press("Enter")


def link(page, plan, influence="", opens=False, feeds=""):
    """Link what is selected with a plan, by the table at the right."""
    if not page.locator(f"input[aria-label='influence {plan}']").count():
        page.focus("[data-test=add-link]")
        page.keyboard.type(plan)
        page.keyboard.press("Enter")
    page.focus(f"input[aria-label='influence {plan}']")
    if influence:
        page.keyboard.type(influence)
    page.keyboard.press("Tab")
    if opens:
        page.keyboard.press("Space")
    page.keyboard.press("Tab")
    if feeds:
        page.keyboard.type(feeds)
        page.keyboard.press("Enter")


def select(page, name, field="name"):
    kind = "cogniton" if field == "name" else "skill"
    page.click(f".svelte-flow__node[aria-label^='{kind}'][aria-label*='{name}']")
    page.wait_for_function(f"document.querySelector('[data-test={field}]')?.value === '{name}'")


def test_the_mind_of_the_turtle_is_built_step_by_step(browser, studio):
    page = studio.page(browser, "#/first-hour", "[data-test=begin-turtle]")
    page.click("[data-test=begin-turtle]")
    page.wait_for_selector("text=call it 'turtles'")
    assert page.locator("[data-test=step-on]").is_disabled()
    page.fill("[data-test=scheme-name]", "turtles")
    on(page)
    add(page, "p", "goto-red")
    add(page, "p", "goto-blu")
    page.wait_for_selector("text=The plan 'goto-blu' is not wanted here")
    page.keyboard.press("Control+z")
    page.wait_for_selector("text=There is no plan 'goto-blue' yet.")
    page.click("[data-test=start-over]")
    page.wait_for_selector("text=There is no plan 'goto-red' yet.")
    add(page, "p", "goto-red")
    add(page, "p", "goto-blue")
    on(page)
    add(page, "c", "wantRed")
    on(page)
    link(page, "goto-red", "1")
    link(page, "goto-blue", "1")
    page.wait_for_selector("text=weighs 1: let it weigh -1.")
    page.click("[data-test=start-over]")
    page.wait_for_selector("text=There is no influence link from wantRed to goto-red yet.")
    select(page, "wantRed")
    link(page, "goto-red", "1")
    link(page, "goto-blue", "-1")
    on(page)
    select(page, "wantRed")
    link(page, "goto-red", opens=True)
    on(page)
    add(page, "c", "wantBlue")
    page.fill("[data-test=start]", "1")
    page.keyboard.press("Enter")
    link(page, "goto-blue", "1", True)
    link(page, "goto-red", "-1")
    on(page)
    add(page, "c", "wantGreen")
    link(page, "goto-green", "1", True)
    link(page, "goto-red", "-1")
    link(page, "goto-blue", "-1")
    on(page)
    select(page, "wantGreen")
    link(page, "goto-red", feeds="0.005")
    link(page, "goto-blue", feeds="0.005")
    on(page)
    page.wait_for_selector("[data-test=course-0]")
    assert page.locator("[data-test=course-0]").inner_text() == "9"
    page.click("[data-test=save-as]")
    page.fill("[data-test=save-file]", "turtle.yaml")
    page.keyboard.press("Enter")
    page.wait_for_selector("text=Saved in turtle.yaml")
    built = CognitiveScheme.load(studio.folder / "turtle.yaml")
    assert built.plans == ("goto-red", "goto-blue", "goto-green")
    page.goto(page.url.split("#")[0] + "#/first-hour")
    page.click("[data-test=step-on]")
    page.wait_for_selector("text=done")
    assert page.failures == []
    page.close()


def test_a_vehicle_is_wired(browser, studio):
    page = studio.page(browser, "#/first-hour", "[data-test=begin-vehicle]")
    page.click("[data-test=begin-vehicle]")
    page.wait_for_selector("text=There is no sensor 'LEFT' yet.")
    for key, name in (("s", "LEFT"), ("s", "RIGHT"), ("m", "WHEEL_LEFT"), ("m", "WHEEL_RIGHT")):
        add(page, key, name, "part-name")
    on(page)
    for name in ("LeftWire", "RightWire"):
        add(page, "k", name, "part-name")
        page.fill("[data-test=size-LAYERS]", "0")
    on(page)
    for name, side in (("LeftWire", "LEFT"), ("RightWire", "RIGHT")):
        select(page, name, "part-name")
        page.select_option("[data-test=add-inputs]", f"SE:{side}")
        page.select_option("[data-test=add-outputs]", f"MO:WHEEL_{side}")
    done(page)
    page.wait_for_selector("[data-test=course-0]")
    assert float(page.locator("[data-test=course-0]").inner_text()) > 10
    on(page)
    for name, side, other in (("LeftWire", "LEFT", "RIGHT"), ("RightWire", "RIGHT", "LEFT")):
        select(page, name, "part-name")
        page.click(f"[aria-label='take MO:WHEEL_{side} out']")
        page.select_option("[data-test=add-outputs]", f"MO:WHEEL_{other}")
    done(page)
    page.wait_for_selector("[data-test=course-1]")
    assert float(page.locator("[data-test=course-0]").inner_text()) < 1
    assert page.failures == []
    page.close()


def test_two_minds_are_compared(browser, studio):
    page = studio.page(browser, "#/first-hour", "[data-test=begin-two-minds]")
    page.click("[data-test=begin-two-minds]")
    page.wait_for_selector("[data-test=course-1]")
    assert page.locator("[data-test=course-0]").inner_text() == "9"
    on(page)
    for plan in ("goto-red", "goto-blue"):
        page.fill(f"input[aria-label='reinforcement of wantGreen from {plan}']", "0.02")
        page.keyboard.press("Enter")
    done(page)
    page.wait_for_function("document.querySelector('[data-test=course-0]')?.innerText === '23'")
    assert page.locator("[data-test=course-1]").inner_text() == "9"
    assert page.failures == []
    page.close()
