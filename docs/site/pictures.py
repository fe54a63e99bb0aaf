"""Makes the pictures of the documentation anew: `python docs/site/pictures.py [NAME …]`.

Most are what the commands and the code of a page leave behind: the pages are followed as their
reader does. The others are made by commands that stand below, or are screenshots of the studio.
All go to docs/figures as they are made, with every colour that they have. With names, only these.
"""

import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from following import follow

ROOT = Path(__file__).parents[2]
FIGURES = ROOT / "docs" / "figures"
MOST = 200_000
"""Bytes that a picture may have."""

PAGES: dict[str, dict[str, str]] = {
    "tutorials/culture.md": {
        "lake-scheme": "scheme.png",
        "lake-villages": "villages/comparison.png",
    },
    "tutorials/sweep.md": {"lake-riders": "riders/figures/response-stock.png"},
    "tutorials/robot.md": {
        "gatherer-curve": "learned/figures/curve.png",
        "gatherer-path": "day.png",
    },
    "tutorials/comparison.md": {"gatherer-stones": "stones/figures/response-gathered.png"},
    "concepts/cognitons.md": {
        "tutorial-scheme": "tutorial.png",
        "deciding": "deciding.png",
        "wishes": "wishes.png",
    },
    "concepts/skills.md": {
        "avoid": "avoid.png",
        "variables": "variables.png",
        "imprinting": "imprinting.png",
    },
}
"""By page, in the order in which they are followed: its pictures, and the files that they are."""

COMMANDS: dict[str, tuple[tuple[str, ...], str]] = {
    "lands": (
        ("run farmer-artisan --figures --out lands",),
        "lands/figures/lands.png",
    ),
    "flock": (("run boids --figures --out boids",), "boids/figures/snapshots.png"),
    "collect": (
        (
            "run collect --seed 1 --out collecting",
            "render collecting --out collect.png --mind --tick 2200 --trail 1100",
        ),
        "collect.png",
    ),
}
"""By picture: commands of socialmind, and the file that they leave."""


def run_society(page) -> None:
    """Show the farmer-artisan society while it runs, with an agent opened."""
    page.goto(f"{page.studio}#/run")
    page.wait_for_selector("[data-test=setup]:not([disabled])")
    page.select_option("[data-test=pace]", label="100 ticks a frame")
    page.click("[data-test=go]")
    tick = "document.querySelector('[data-test=tick]').innerText.replace(/\\D/g, '')"
    page.wait_for_function(f"Number({tick}) >= 20000")
    page.click("[data-test=go]")
    page.wait_for_selector("[data-test=step]:not([disabled])")
    page.focus("[data-test=world]")
    page.keyboard.press("n")
    page.wait_for_selector("[data-test=watched]")
    page.wait_for_timeout(1500)


def draw_mind(page) -> None:
    """Show the scheme of the farmer-artisan society in its editor."""
    page.goto(f"{page.studio}#/mind?model=farmer_artisan&population=humans")
    page.wait_for_selector(".svelte-flow__node")
    page.wait_for_timeout(2000)


def walk_first_hour(page) -> None:
    """Show two minds compared in the room of the first hour."""
    page.goto(f"{page.studio}#/first-hour")
    page.click("[data-test=begin-two-minds]")
    page.click("[data-test=step-on]:not([disabled])")
    for plan in ("goto-red", "goto-blue"):
        page.fill(f"input[aria-label='reinforcement of wantGreen from {plan}']", "0.02")
        page.keyboard.press("Enter")
    page.wait_for_selector("[data-test=course-1]")
    page.wait_for_timeout(1000)


SCREENS: dict[str, Callable] = {
    "studio-run": run_society,
    "studio-mind": draw_mind,
    "studio-first-hour": walk_first_hour,
}
"""By picture: what is done in the studio before it is taken."""


def main(names: list[str]) -> None:
    """Make pictures.

    Args:
        names: which; none for all.
    """
    known = [*(one for page in PAGES.values() for one in page), *COMMANDS, *SCREENS]
    unknown = sorted(set(names) - set(known))
    if unknown:
        sys.exit(f"no picture {unknown[0]!r}; there is {', '.join(known)}")
    wanted = set(names or known)
    os.environ["MPLBACKEND"] = "agg"
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        Path("models").symlink_to(ROOT / "models")
        for page, pictures in PAGES.items():
            # The sweep and the comparison go on from the pages before.
            goes_on = {
                "tutorials/culture.md": "lake-riders",
                "tutorials/robot.md": "gatherer-stones",
            }
            if wanted & set(pictures) or goes_on.get(page) in wanted:
                follow(page)
            keep({name: file for name, file in pictures.items() if name in wanted})
        for name, (commands, file) in COMMANDS.items():
            if name in wanted:
                for words in commands:
                    subprocess.run([sys.executable, "-m", "socialmind", *words.split()], check=True)
                keep({name: file})
        if wanted & set(SCREENS):
            with studio() as page:
                for name, prepare in SCREENS.items():
                    if name in wanted:
                        prepare(page)
                        page.screenshot(path=f"{name}.png")
                        keep({name: f"{name}.png"})


def keep(pictures: dict[str, str]) -> None:
    """Put pictures among those of the documentation.

    Args:
        pictures: the file of each by its name.
    """
    for name, file in pictures.items():
        target = FIGURES / f"{name}.png"
        shutil.copyfile(file, target)
        print(target.relative_to(ROOT), target.stat().st_size)


@contextmanager
def studio() -> Iterator:
    """A page of Chromium that looks at a studio of its own, at 1280 × 720."""
    from playwright.sync_api import sync_playwright

    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    words = [sys.executable, "-m", "socialmind", "studio", "farmer-artisan"]
    program = subprocess.Popen([*words, "--port", str(port), "--no-browser"])
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    try:
        while True:
            try:
                socket.create_connection(("127.0.0.1", port), 1).close()
                break
            except OSError:
                time.sleep(0.2)
        with sync_playwright() as driver:
            browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
            page = browser.new_page(viewport={"width": 1280, "height": 720})
            page.set_default_timeout(120_000)
            page.studio = f"http://127.0.0.1:{port}/"
            yield page
            browser.close()
    finally:
        program.terminate()
        program.wait()


if __name__ == "__main__":
    main(sys.argv[1:])
