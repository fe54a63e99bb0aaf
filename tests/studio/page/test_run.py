"""The room of a run, in a real browser: what a user does, by mouse and keyboard."""

from io import BytesIO

import numpy as np
import pytest
from matplotlib.image import imread

from socialmind.catalogue import catalogue
from socialmind.experiments import Run, replay

TICK = "Number((document.querySelector('[data-test=tick]')?.innerText ?? '').replace(/\\D/g, ''))"
SCRUB = """tick => {
  const slider = document.querySelector("[data-test=scrub]");
  slider.value = tick ?? slider.max;
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""
COLOURS = """() => {
  const world = document.querySelector("[data-test=world]");
  const copy = document.createElement("canvas");
  copy.width = world.width;
  copy.height = world.height;
  const drawn = copy.getContext("2d");
  drawn.drawImage(world, 0, 0);
  const pixels = drawn.getImageData(0, 0, copy.width, copy.height).data;
  const seen = new Set();
  for (let at = 0; at < pixels.length; at += 4)
    seen.add((pixels[at] << 16) | (pixels[at + 1] << 8) | pixels[at + 2]);
  return seen.size;
}"""
COLOURED = f"({COLOURS})()"


@pytest.fixture(scope="module")
def studio(program):
    return program("farmer-artisan", "--seed", "5", "--set", "n_agents=12")


def wait_for_tick(page, tick, how="=="):
    page.wait_for_function(f"{TICK} {how} {tick}")


def test_what_was_told_shows_at_once_and_not_what_comes_late(browser, studio):
    """A frame on its way when the society was told to stand does not say that it runs again."""
    held, servers = [], []

    def hold_pauses(socket):
        servers.append(socket.connect_to_server())

        def pass_on(message):
            if '"pause"' in str(message):
                held.append(message)
            else:
                servers[-1].send(message)

        socket.on_message(pass_on)

    page = studio.page(browser, begin=lambda page: page.route_web_socket("**/live/*", hold_pauses))
    page.click("[data-test=go]")
    wait_for_tick(page, 5, ">=")
    page.click("[data-test=go]")
    wait_for_tick(page, page.evaluate(TICK) + 8, ">=")  # it has not heard yet
    assert page.inner_text("[data-test=go]") == "Go"
    page.click("[data-test=save]")
    page.wait_for_selector("input[aria-label=folder]")
    servers[-1].send(held.pop())
    page.click("text=Cancel")
    page.click("[data-test=step]")
    page.wait_for_timeout(300)
    stood = page.evaluate(TICK)
    # It goes on where another page lets it, and this one says so.
    other = studio.page(browser)
    other.click("[data-test=go]")
    wait_for_tick(page, stood + 2, ">=")
    page.wait_for_selector("[data-test=go]:text('Pause')")
    other.click("[data-test=go]")
    page.wait_for_selector("[data-test=go]:text('Go')")
    assert page.failures == other.failures == []
    other.close()
    page.close()


def test_a_society_is_run_looked_into_changed_saved_and_found_again(browser, studio):
    page = studio.page(browser)
    page.click("[data-test=reset]")
    wait_for_tick(page, 0)
    # Run, and stand.
    page.select_option("[data-test=pace]", label="100 ticks a frame")
    page.click("[data-test=go]")
    wait_for_tick(page, 1000, ">=")
    page.click("[data-test=go]")
    page.wait_for_selector("[data-test=step]:not([disabled])")
    page.click("[data-test=step]")
    page.wait_for_function(f"{TICK} % 100 == 1")
    stood = page.evaluate(TICK)
    # Open an agent by the keyboard, and change what it believes.
    page.focus("[data-test=world]")
    page.keyboard.press("n")
    page.wait_for_selector("[data-test=watched]")
    assert page.inner_text("[data-test=watched]").startswith("humans")
    page.click("aside[aria-label=Agent] button[aria-label^='Farmer:']")
    page.fill("aside[aria-label=Agent] input[aria-label=Farmer]", "21")
    page.keyboard.press("Enter")
    page.wait_for_selector("button[aria-label='Farmer: 21, change it']")
    # Go on, back and forth.
    page.click("[data-test=step]")
    wait_for_tick(page, stood + 1)
    page.evaluate(SCRUB, 200)
    wait_for_tick(page, 200)
    page.evaluate(SCRUB)
    wait_for_tick(page, stood + 1)
    # Save: the run of the command line, with what was done.
    page.click("[data-test=save]")
    page.fill("input[aria-label=folder]", "kept")
    page.keyboard.press("Enter")
    page.wait_for_selector("text=Saved in")
    run = Run(studio.folder / "kept")
    assert (run.seed, run.ticks, run.parameters["n_agents"]) == (5, stood + 1, 12)
    assert [one["part"] for one in run.manifest.interventions] == ["cogniton Farmer"]
    assert replay(studio.folder / "kept").equal
    # Another tab, and the same one after a reload, find the society as it stands.
    other = studio.page(browser)
    wait_for_tick(other, stood + 1)
    assert page.failures == other.failures == []
    page.close()
    other.close()


def test_a_wrong_parameter_is_refused_where_it_stands(browser, studio):
    page = studio.page(browser)
    page.fill("[data-test=parameter-n_agents]", "0")
    page.click("[data-test=setup]")
    assert page.is_visible("text=1 or more is needed")
    page.fill("[data-test=parameter-n_agents]", "2.5")
    page.click("[data-test=setup]")
    assert page.is_visible("text=a whole number is needed")
    page.close()


WORLD = "document.querySelector('[data-test=world]')"


def choose(page, model):
    """Set a model up, and wait until its world is drawn in place of the one before."""
    page.wait_for_function(f"{COLOURED} > 2")
    page.evaluate(f"window.before = {WORLD}.toDataURL()")
    page.select_option("[data-test=model]", model)
    page.wait_for_selector(f"h2:text-is('{model.replace('_', ' ')}')")
    page.wait_for_selector("[data-test=setup]:not([disabled])")
    page.wait_for_function(f"{WORLD}.toDataURL() !== window.before")
    page.wait_for_timeout(200)
    assert page.evaluate(COLOURS) > 2  # something else than the ground


def test_every_kind_of_world_is_drawn(browser, studio):
    page = studio.page(browser)
    for model in ("schelling", "boids", "braitenberg"):
        choose(page, model)
    assert page.failures == []
    page.close()


CARD = """() => {
  // What draws by software says that it is a card.
  const plain = WebGL2RenderingContext.prototype.getParameter;
  WebGL2RenderingContext.prototype.getParameter = function (what) {
    return what === 37446 ? "a card" : plain.call(this, what);
  };
}"""


def test_a_card_and_the_processor_draw_the_same(browser, studio):
    seen = {}
    for by in ("processor", "card"):
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        page.add_init_script(f"({CARD})()" if by == "card" else "")
        page.goto(f"http://127.0.0.1:{studio.port}/")
        page.wait_for_selector("[data-test=setup]:not([disabled])")
        for model, times in (("wolves_sheep", 0), ("foraging", 6)):
            choose(page, model)
            page.focus("[data-test=world]")
            for _ in range(times):
                page.keyboard.press("+")
            page.wait_for_timeout(200)
            kind = "webgl2" if by == "card" else "2d"
            assert page.evaluate(f"{WORLD}.getContext('{kind}') !== null")
            picture = BytesIO(page.locator("[data-test=world]").screenshot())
            seen[by, model] = imread(picture)[..., :3]
        page.close()
    for model in ("wolves_sheep", "foraging"):
        apart = np.abs(seen["processor", model] - seen["card", model]).max(axis=2)
        assert (apart > 0.25).mean() < 0.01  # soft edges
        assert apart.mean() < 0.01


@pytest.mark.study
@pytest.mark.parametrize("model", sorted(catalogue()))
def test_every_model_is_set_up_and_runs(browser, studio, model):
    page = studio.page(browser)
    page.select_option("[data-test=model]", model)
    page.wait_for_selector(f"h2:text-is('{model.replace('_', ' ')}')")
    page.wait_for_selector("[data-test=setup]:not([disabled])")
    page.wait_for_function(f"{TICK} == 0")
    for tick in (1, 2, 3):
        page.click("[data-test=step]")
        wait_for_tick(page, tick)
    assert page.evaluate(COLOURS) > 2
    assert not page.is_visible(".said.wrong"), page.inner_text(".said")
    assert page.failures == []
    page.close()
