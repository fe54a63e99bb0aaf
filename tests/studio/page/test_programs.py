"""A skill's own program in a real browser: read, typed with the keyboard alone, checked, saved."""

import pytest

from socialmind.mind import MindDescription

ROOM = "#/skills?file=robot"
NODE = ".svelte-flow__node[aria-label='skill {}']"
TEXT = "document.querySelector('[data-test=program]').value"
CARET = "document.querySelector('[data-test=program]').selectionStart"
FOCUSED = "document.activeElement.dataset.test ?? document.activeElement.tagName"
NONE = "!document.querySelector('[data-test=program-findings] li')"
SAVED = "!document.querySelector('[data-test=file]').innerText.includes('changed')"


@pytest.fixture(scope="module")
def studio(robot_studio):
    return robot_studio


def test_a_program_is_edited_checked_and_saved(browser, studio):
    file = studio.folder / "robot" / "Skills" / "ClawControl" / "claw_control.py"
    was = file.read_text()
    page = studio.page(browser, f"?token={studio.token}{ROOM}", NODE.format("ClawControl"))
    # The token is no part of the address any more.
    assert "token" not in page.url
    page.click(NODE.format("ClawControl"))
    page.wait_for_selector("[data-test=program-file]:text-is('claw_control.py')")
    assert page.evaluate(TEXT) == was
    # By the keyboard: a new line is indented as the last one, Tab indents, Shift-Tab takes it back.
    page.focus("[data-test=program]")
    page.keyboard.press("Control+End")
    page.keyboard.type("\ndef half(x):")
    page.keyboard.press("Enter")
    page.keyboard.type("if x > 1:")
    page.keyboard.press("Enter")
    page.keyboard.type("return 1.0")
    page.keyboard.press("Enter")
    page.keyboard.press("Shift+Tab")
    page.keyboard.type("return 0.5 * (x")
    typed = was + "\ndef half(x):\n    if x > 1:\n        return 1.0\n    return 0.5 * (x"
    assert page.evaluate(TEXT) == typed
    # What is wrong is said with its line, and not saved; the line is found from there.
    line = len(typed.split("\n"))
    page.wait_for_selector(f"[data-test=program-findings] >> text=line {line}: not valid Python")
    assert page.is_disabled("[data-test=save-mind]")
    page.click("[data-test=program-findings] button")
    assert page.evaluate(CARET) == len(typed) - len("    return 0.5 * (x")
    page.keyboard.press("End")
    page.keyboard.type(")")
    page.wait_for_function(NONE)
    # What the language of rules has not is said in the words of its compiler, and can be saved.
    page.keyboard.press("Control+Home")
    page.keyboard.press("ArrowDown")
    page.keyboard.press("End")
    page.keyboard.type("\nprint(SENSDZ)")
    page.wait_for_selector("[data-test=program-findings] >> text=line 3: it could not run")
    assert page.is_enabled("[data-test=save-mind]")
    # Undo goes word by word, and stays in the text.
    page.keyboard.press("Control+z")
    page.wait_for_function(f"!{TEXT}.includes('print')")
    assert page.evaluate(FOCUSED) == "program"
    page.wait_for_function(NONE)
    # Escape lets Tab leave, forward and back; else it stays.
    page.keyboard.press("Escape")
    page.keyboard.press("Tab")
    assert page.evaluate(FOCUSED) != "program"
    page.focus("[data-test=program]")
    page.keyboard.press("Escape")
    page.keyboard.press("Shift+Tab")
    assert page.evaluate(FOCUSED) == "wide"
    page.keyboard.press("Enter")
    page.wait_for_selector("[data-test=wide][aria-pressed=true]")
    page.keyboard.press("Control+s")
    page.wait_for_function(SAVED)
    page.wait_for_selector("text=Saved in robot")
    assert file.read_text().startswith(was + "\ndef half(x):\n    if x > 1:")
    function = MindDescription.load(studio.folder / "robot").skills["ClawControl"].function
    assert function.function(1.0, 0.0) == 1.0
    # A further skill begins with a program that is whole.
    page.evaluate("document.activeElement.blur()")
    page.keyboard.press("k")
    page.wait_for_selector("[data-test=part-name]:focus")
    page.select_option("[data-test=add-inputs]", "SE:SENSDZ")
    page.select_option("[data-test=add-outputs]", "MO:MotL")
    page.select_option("[data-test=function]", "hardCoded")
    page.wait_for_selector("[data-test=program-file]:text-is('Skill1.py')")
    assert page.evaluate(TEXT) == "def skill1(SENSDZ):\n    return 0.5\n"
    page.wait_for_function("!document.querySelector('[data-test=findings] .wrong')")
    assert page.failures == []
    page.close()


def test_without_the_token_programs_are_read_and_not_written(browser, studio):
    file = studio.folder / "robot" / "Skills" / "ClawControl" / "claw_control.py"
    before = file.read_bytes()
    page = studio.page(browser, ROOM, NODE.format("ClawControl"))
    page.click(NODE.format("ClawControl"))
    page.focus("[data-test=program]")
    page.keyboard.type("# a word\n")
    page.wait_for_selector("[data-test=file]:has-text('changed')")
    page.click("[data-test=save-mind]")
    page.wait_for_selector("text=asked without the token")
    assert file.read_bytes() == before
    assert page.failures == []
    page.close()
