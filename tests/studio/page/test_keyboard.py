"""All rooms by keyboard alone, and as a screen reader has them."""

import shutil

import pytest

from socialmind.sources.folders import model_folder

CONTROLS = {
    "button", "link", "textbox", "combobox", "checkbox", "radio", "slider", "spinbutton", "switch",
    "tab", "listbox", "option", "menuitem", "application", "dialog", "progressbar", "region",
}  # fmt: skip
MARK = """() => {
  // Each control that can be seen and used, numbered in the order of the document.
  const can = "a[href], button, input, select, textarea, summary, [tabindex]";
  const all = [...document.querySelectorAll(can)].filter((one) =>
    one.tabIndex >= 0 && !one.disabled && one.checkVisibility({ visibilityProperty: true })
    && !(one.type === "radio" && !one.checked));
  all.forEach((one, place) => (one.dataset.place = place));
  return all.length;
}"""
LOOKS = """(one) => [one, ...one.querySelectorAll("*")].slice(0, 40).map((each) => {
  const style = getComputedStyle(each);
  return [style.outline, style.stroke, style.strokeWidth, style.borderColor].join();
}).join(";")"""
FOCUSED = f"""() => {{
  const one = document.activeElement;
  if (!one || one === document.body) return null;
  const looks = {LOOKS};
  const box = one.getBoundingClientRect();
  const seen = looks(one);
  const inside = box.bottom > 0 && box.right > 0 && box.top < innerHeight && box.left < innerWidth;
  const said = one.outerHTML.slice(0, 120);
  window.focused = [...(window.focused ?? []), [one, seen]];
  const place = one.dataset.place === undefined ? null : Number(one.dataset.place);
  return {{ place, inside, said }};
}}"""
UNSEEN = f"""() => {{
  document.activeElement?.blur();
  const looks = {LOOKS};
  return window.focused.filter(([one, seen]) => one.isConnected && looks(one) === seen)
    .map(([one]) => one.outerHTML.slice(0, 120));
}}"""


@pytest.fixture(scope="module")
def studio(program):
    begun = program("farmer-artisan", "--set", "n_agents=6")
    shutil.copytree(model_folder("collect") / "mind", begun.folder / "robot")
    shutil.copy(model_folder("farmer_artisan") / "scheme.yaml", begun.folder)
    return begun


def nameless(page):
    """Return the controls that a screen reader has no name for."""
    session = page.context.new_cdp_session(page)
    found = session.send("Accessibility.getFullAXTree")["nodes"]
    return [
        (one["role"]["value"], one.get("name", {}).get("value"), one.get("properties"))
        for one in found
        if not one["ignored"]
        and one["role"]["value"] in CONTROLS
        and not one.get("name", {}).get("value", "").strip()
    ]


def held_to_the_keyboard(page):
    """Go through a page by Tab, once around: each control in its turn, seen, and left again."""
    assert nameless(page) == []
    count = page.evaluate(MARK)
    page.evaluate("window.focused = []; document.activeElement?.blur()")
    page.evaluate("document.body.tabIndex = -1; document.body.focus()")
    page.evaluate("document.body.removeAttribute('tabindex')")
    visited = []
    for _ in range(count + 30):
        page.keyboard.press("Tab")
        at = page.evaluate(FOCUSED)
        if at is None or (visited and at["place"] is not None and at["place"] == visited[0]):
            break
        assert at["inside"], f"out of sight: {at['said']}"
        if at["place"] is not None:
            visited.append(at["place"])
    else:
        raise AssertionError(f"a trap at {at['said']}")
    assert visited == sorted(visited), "not in the order in which one reads"
    assert set(range(count)) == set(visited)
    assert page.evaluate(UNSEEN) == []


def test_the_room_of_a_run(browser, studio):
    page = studio.page(browser)
    page.click("[data-test=step]")
    page.click("[data-test=add-histogram]")
    page.focus("[data-test=world]")
    page.keyboard.press("n")
    page.wait_for_selector("[data-test=watched]")
    held_to_the_keyboard(page)
    # A dialog takes the keyboard, and Escape gives it back to what opened it.
    page.focus("[data-test=open]")
    page.keyboard.press("Enter")
    page.wait_for_selector("dialog[open]")
    assert nameless(page) == []
    assert page.evaluate("document.activeElement.closest('dialog') !== null")
    page.keyboard.press("Escape")
    page.wait_for_selector("dialog[open]", state="detached")
    assert page.evaluate("document.activeElement.dataset.test") == "open"
    page.close()


@pytest.mark.parametrize(
    ("room", "ready"),
    [
        ("mind?file=scheme.yaml", ".svelte-flow__node"),
        ("skills?file=robot", ".svelte-flow__node"),
        ("learning", "[data-test=none]"),
        ("experiments", "text=There is no sweep"),
        ("first-hour", "[data-test=begin-turtle]"),
    ],
)
def test_other_rooms(browser, studio, room, ready):
    page = studio.page(browser, f"#/{room}", ready)
    page.wait_for_timeout(300)
    if "file" in room:
        page.focus(".svelte-flow__node")
        page.keyboard.press("Enter")
        page.wait_for_timeout(300)
    held_to_the_keyboard(page)
    page.close()
