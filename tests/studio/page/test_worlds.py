"""Several societies side by side, looks, buttons and turns, in a real browser."""

import pytest

from socialmind.experiments import Run, replay
from tests.studio.page.test_run import COLOURS, SCRUB, TICK, wait_for_tick

READY = "[data-test=go]:not([disabled])"
PANES = "document.querySelectorAll('[data-test=pane]')"


@pytest.fixture(scope="module")
def studio(program):
    return program("wolves-sheep", "--seed", "5", "--set", "n_sheep=80")


def look_at(page, place):
    page.click(f"[data-test=pane]:nth-child({place}) header .title")


def pause(page):
    """Let it stand, and return where: when no frame comes any more."""
    page.click("[data-test=go]")
    page.wait_for_selector("[data-test=step]:not([disabled])")
    while (tick := page.evaluate(TICK)) != (page.wait_for_timeout(500), page.evaluate(TICK))[1]:
        assert tick
    return tick


def stand(page, tick, how="=="):
    """Wait until both stand at a tick."""
    for place in (1, 2):
        look_at(page, place)
        wait_for_tick(page, tick, how)
    return page.evaluate(TICK)


def test_a_society_branches_and_both_go_on_with_one_clock(browser, studio):
    page = studio.page(browser)
    assert page.evaluate(COLOURS) > 20  # meadow, sheep and wolves as the model says
    page.select_option("[data-test=pace]", label="10 ticks a frame")
    page.click("[data-test=go]")
    wait_for_tick(page, 60, ">=")
    stood = pause(page)
    # The same society once more, from here on.
    page.click("[data-test=branch]")
    page.wait_for_function(f"{PANES}.length == 2")
    page.wait_for_selector(READY)
    assert stand(page, stood) == stood

    # Both show the same part of the world, until they shall not.
    def drawn():
        return page.evaluate(f"[...{PANES}].map((one) => one.querySelector('canvas').toDataURL())")

    whole = drawn()
    page.focus("[data-test=pane]:nth-child(1) canvas")
    page.keyboard.press("+")
    nearer = drawn()
    assert all(one != other for one, other in zip(whole, nearer, strict=True))
    page.uncheck("[data-test=linked]")
    page.focus("[data-test=pane]:nth-child(1) canvas")
    page.keyboard.press("0")
    assert [one == other for one, other in zip(nearer, drawn(), strict=True)] == [False, True]
    # What is done to the second does not touch the first.
    look_at(page, 2)
    page.click("text=Plague among sheep")
    page.select_option("[data-test=pace]", label="1 tick a frame")
    page.click("[data-test=go]")
    wait_for_tick(page, stood + 20, ">=")
    pause(page)
    ends = set()
    for place in (1, 2):
        look_at(page, place)
        ends.add(page.evaluate(TICK))
    assert len(ends) == 1
    end = ends.pop()
    # Scrubbing and steps are of both.
    page.evaluate(SCRUB, stood)
    stand(page, stood)
    page.evaluate(SCRUB, end)
    stand(page, end)
    page.click("[data-test=step]")
    stand(page, end + 1)
    # Each is a run of its own.
    for place, name in ((1, "undisturbed"), (2, "plague")):
        look_at(page, place)
        page.click("[data-test=save]")
        page.fill("input[aria-label=folder]", name)
        page.keyboard.press("Enter")
        page.wait_for_selector(f"text=/Saved in .*{name}/")
        page.click("[aria-label=dismiss]")
    folders = [studio.folder / name for name in ("undisturbed", "plague")]
    first, second = (Run(folder) for folder in folders)
    assert first.ticks == second.ticks == end + 1
    assert [len(one.manifest.interventions) for one in (first, second)] == [0, 1]
    assert second.manifest.interventions[0]["function"] == "plague"
    assert all(replay(folder).equal for folder in folders)
    same = first.series["tick"] <= stood
    assert first.series[same].equals(second.series[same])
    after = [one.series[~same].iloc[0]["sheep"] for one in (first, second)]
    assert after[0] > after[1]
    # Close the first; the other one stays.
    page.click("[data-test=pane]:nth-child(1) header .close")
    page.wait_for_function(f"{PANES}.length == 1")
    wait_for_tick(page, end + 1)
    assert page.failures == []
    page.close()


def test_a_kept_run_is_opened_and_a_tick_gone_through(browser, studio):
    page = studio.page(browser)
    page.click("[data-test=open]")
    page.click("[data-test=runs] button:has-text('plague')")
    page.wait_for_function("document.querySelector('[data-test=scrub]').max > 1")
    wait_for_tick(page, 0)
    end = Run(studio.folder / "plague").ticks
    page.evaluate(SCRUB)
    wait_for_tick(page, end)
    page.click("[data-test=turn]")
    page.wait_for_selector("text=/turn 1: sheep \\d+, live_sheep/")
    page.keyboard.press("Escape")
    page.focus("[data-test=world]")
    page.keyboard.press(",")
    page.wait_for_selector("text=/turn 2: /")
    page.keyboard.press(".")
    wait_for_tick(page, end + 1)
    page.click("[data-test=reset]")
    wait_for_tick(page, 0)
    assert page.failures == []
    page.close()


def test_plots_are_chosen_arranged_and_saved(browser, studio, tmp_path):
    page = studio.page(browser)
    page.wait_for_selector("[data-test=panel-series]")
    page.click("[data-test=add-histogram]")
    page.click("[data-test=add-scatter]")
    page.click("[data-test=panel-scatter] [aria-label='move left']")
    kinds = page.eval_on_selector_all("article", "all => all.map(one => one.ariaLabel)")
    assert kinds == ["series", "scatter", "histogram"]
    for form, begin in (("pdf", b"%PDF"), ("svg", b"<?xml"), ("csv", b"agent,energy")):
        page.click("[data-test=panel-histogram] summary[title^=save]")
        with page.expect_download() as download:
            page.click(f"[data-test=panel-histogram] [data-test=save-{form}]")
        page.click("[data-test=panel-histogram] summary[title^=save]")
        download.value.save_as(tmp_path / form)
        assert (tmp_path / form).read_bytes().startswith(begin)
    assert page.failures == []
    page.close()
