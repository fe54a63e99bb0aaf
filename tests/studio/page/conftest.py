"""A real browser and the program that it looks at.

Chromium is found as Debian has it (`apt install chromium`) or as Playwright installs it; without a
browser these tests say so and are skipped.
"""

import shutil
import socket
import subprocess
import sys
import time
from functools import partial

import pytest

from socialmind.sources.folders import model_folder

playwright = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
SECONDS = 120_000


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as driver:
        try:
            found = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        except playwright.Error:
            pytest.skip("no Chromium here: the page is not tested")
        yield found
        found.close()


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


AT_REST = """element => new Promise(resolve => {
  let before = "", frames = 0;
  const look = () => {
    const { x, y, width, height } = element.getBoundingClientRect();
    const now = JSON.stringify({ x, y, width, height });
    frames = now === before ? frames + 1 : 0;
    before = now;
    frames < 20 ? requestAnimationFrame(look) : resolve(JSON.parse(now));
  };
  look();
})"""


def where(page, selector):
    """Return where something is, once it has stood still for twenty frames of the page.

    A canvas moves when a box comes that is out of sight, and the mouse does not wait for it.
    """
    return page.locator(selector).first.evaluate(AT_REST)


def stands(page, selector):
    """Return where a box of a canvas stands in the drawing, as its file has it."""
    x, y = page.locator(selector).evaluate("one => one.style.transform.match(/-?[\\d.]+(?=px)/g)")
    return [int(x), int(y)]


def drag(page, selector, right, down):
    """Drag a box of a canvas by so many pixels of the screen; return where it stands then."""
    at, was = where(page, selector), stands(page, selector)
    x, y = at["x"] + at["width"] / 2, at["y"] + at["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + right, y + down, steps=8)
    page.mouse.up()
    where(page, selector)
    assert stands(page, selector) != was
    return stands(page, selector)


class Program:
    """`socialmind studio` in a process of its own."""

    def __init__(self, folder, *words):
        self.port = free_port()
        command = [sys.executable, "-m", "socialmind", "studio", *words]
        command += ["--port", str(self.port), "--no-browser"]
        self.process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, text=True)
        said = self.process.stdout.readline()
        self.token = said.partition("?token=")[2].split()[0]
        for _ in range(600):
            try:
                socket.create_connection(("127.0.0.1", self.port), 1).close()
                return
            except OSError:
                time.sleep(0.1)
        raise TimeoutError("the studio does not listen")

    def page(
        self, browser, place="", ready="[data-test=setup]:not([disabled])", begin=lambda page: None
    ):
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        page.set_default_timeout(SECONDS)
        page.failures = []
        page.where = partial(where, page)
        page.stands, page.drag = partial(stands, page), partial(drag, page)
        page.on("pageerror", lambda error: page.failures.append(str(error)))
        begin(page)
        page.goto(f"http://127.0.0.1:{self.port}/{place}")
        page.wait_for_selector(ready)
        return page

    def end(self):
        self.process.terminate()
        self.process.wait()


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """Begin a studio in a folder of its own: `program(WORD, …)`."""
    begun = []

    def begin(*words):
        folder = tmp_path_factory.mktemp("studio")
        begun.append(Program(folder, *words))
        begun[-1].folder = folder
        return begun[-1]

    yield begin
    for one in begun:
        one.end()


@pytest.fixture(scope="module")
def robot_studio(program):
    """A studio in whose folder `robot` is a copy of the mind of `collect`."""
    begun = program()
    shutil.copytree(model_folder("collect") / "mind", begun.folder / "robot")
    return begun
