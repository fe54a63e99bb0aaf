"""How smooth the studio is, and what it costs: in a real Chromium without a window.

- *Frames a second* that the page draws while a society runs, a tick a frame: 10,000 agents and
  100,000 on patches, 25 robots with rays on a plane. A society sends thirty at most.
- *Speed* of a society that runs as fast as possible while a page shows it, as a share of its speed
  while nobody looks, in turns.
- *Click to watcher*: from letting go of the mouse on an agent to its name at the side.
- *To the first picture*: from the command to the first frame that is drawn, all compiled.
- *Memory* of the program and of the page (its heap, after collecting garbage), while a society runs
  as fast as possible: after a sixth of the time, and at its end. Over an hour the page shows an
  agent, a histogram and a series too.

Chromium starts as it does by itself. Without a graphics card it draws by software, on the same
cores as all else: with one there are more frames.

    python benchmarks/studio.py            # under four minutes
    python benchmarks/studio.py --hour     # memory over an hour, and nothing else

The results go to benchmarks/studio.json and, as a table, to benchmarks/README.md.
"""

import argparse
import gzip
import json
import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import psutil
from harness import HERE, describe_machine, spread, write
from playwright.sync_api import Browser, Page, Playwright, sync_playwright
from websockets.sync.client import connect
from websockets.typing import Origin

import socialmind.studio
from socialmind.catalogue import load_model
from socialmind.studio.running.frames import unpacked

BUILT = Path(socialmind.studio.__file__).parent / "built"
WALKERS = str(HERE / "studio_walkers.py")
HOUR = 3600.0
SECONDS = 6.0
"""Of one measurement of frames or of speed."""
COUNTING = """
window.frames_drawn = 0; window.first_frame = 0;
const Plain = WebSocket;
window.WebSocket = class extends Plain {
  send(said) {  // a page asks for the next frame once it has drawn one
    if (said.includes('"seen"')) {
      window.frames_drawn += 1;
      window.first_frame ||= Date.now();
    }
    super.send(said);
  }
};
"""
CLICKED = """() => new Promise((done) => {
  let begun = 0;
  addEventListener("pointerup", () => (begun = performance.now()), { capture: true, once: true });
  const seen = new MutationObserver(() => {
    if (!begun || !document.querySelector("[data-test=watched]")) return;
    seen.disconnect();
    done(performance.now() - begun);
  });
  seen.observe(document.body, { childList: true, subtree: true, characterData: true });
  window.clicking = true;
})"""
WORLDS = {
    "10,000 agents on 101 × 101 patches": (WALKERS, {}),
    "25 robots with rays": ("foraging", {"n_robots": 25}),
    "100,000 agents on 317 × 317 patches": (WALKERS, {"n_walkers": 100_000, "world_size": 317}),
}


class Program:
    """`socialmind studio` in a process of its own."""

    def __init__(self, model: str, settings: dict[str, Any], folder: Path) -> None:
        with socket.socket() as one:
            one.bind(("127.0.0.1", 0))
            self.port = one.getsockname()[1]
        words = [word for item in settings.items() for word in ("--set", "=".join(map(str, item)))]
        command = [sys.executable, "-m", "socialmind", "studio", model, *words]
        command += ["--port", str(self.port), "--no-browser"]
        self.begun = time.time()
        self.process = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL)

    def wait(self) -> None:
        """Wait until it listens."""
        for _ in range(6000):
            try:
                socket.create_connection(("127.0.0.1", self.port), 1).close()
                return
            except OSError:
                time.sleep(0.01)
        raise SystemExit("the studio does not listen")

    def tick(self) -> tuple[int, float]:
        """Where the society is, and when."""
        address = f"127.0.0.1:{self.port}"
        with connect(
            f"ws://{address}/live/first", origin=Origin(f"http://{address}"), max_size=None
        ) as line:
            while not isinstance(message := line.recv(), bytes):
                pass
            return unpacked(message)[0]["tick"], time.perf_counter()

    def memory(self) -> float:
        """Mebibytes of the server and of the society's process."""
        own = psutil.Process(self.process.pid)
        return sum(one.memory_info().rss for one in [own, *own.children(recursive=True)]) / 2**20

    def end(self) -> None:
        """End it."""
        self.process.terminate()
        self.process.wait()


@contextmanager
def program(model: str, settings: dict[str, Any]) -> Iterator[Program]:
    """Let a studio run in a folder of its own."""
    with tempfile.TemporaryDirectory() as folder:
        made = Program(model, settings, Path(folder))
        try:
            made.wait()
            yield made
        finally:
            made.end()


def page_of(browser: Browser, made: Program) -> Page:
    """Open the page, and wait until a society is there."""
    page = browser.new_page(viewport={"width": 1280, "height": 720})
    page.set_default_timeout(180_000)
    page.add_init_script(COUNTING)
    page.goto(f"http://127.0.0.1:{made.port}/")
    page.wait_for_selector("[data-test=setup]:not([disabled])")
    page.wait_for_function("window.frames_drawn > 0")
    return page


def go(page: Page, pace: str) -> None:
    """Let it run, and wait until its rules are compiled."""
    page.select_option("[data-test=pace]", label=pace)
    page.click("[data-test=go]")
    page.wait_for_function("document.querySelector('[data-test=tick]').innerText !== '0'")
    page.wait_for_timeout(500)


def frames(page: Page, seconds: float) -> float:
    """Frames a second that a page draws."""
    counted = "() => [window.frames_drawn, performance.now()]"
    before, begin = page.evaluate(counted)
    page.wait_for_timeout(1000 * seconds)
    after, end = page.evaluate(counted)
    return 1000 * (after - before) / (end - begin)


def measure_frames(browser: Browser, seconds: float, rounds: int) -> dict[str, list[float]]:
    """Frames a second of each world, a tick a frame."""
    found = {}
    for name, (model, settings) in WORLDS.items():
        with program(model, settings) as made:
            page = page_of(browser, made)
            go(page, "1 tick a frame")
            found[name] = [frames(page, seconds) for _ in range(rounds)]
            page.close()
    return found


def measure_speed(browser: Browser, seconds: float, rounds: int) -> dict[str, list[float]]:
    """Ticks a second as fast as possible, with a page and without, and their ratio."""
    found: dict[str, list[float]] = {"with a page": [], "without": [], "ratio": []}

    def speed(made: Program) -> float:
        before, begin = made.tick()
        time.sleep(seconds)
        after, end = made.tick()
        return (after - before) / (end - begin)

    with program(WALKERS, {}) as made:
        page = page_of(browser, made)
        go(page, "as fast as possible")
        for _ in range(rounds):
            shown = speed(made)
            page.close()
            time.sleep(0.5)
            alone = speed(made)
            page = page_of(browser, made)
            found["with a page"].append(shown)
            found["without"].append(alone)
            found["ratio"].append(shown / alone)
        page.close()
    return found


def measure_click(browser: Browser, times: int) -> list[float]:
    """Milliseconds from letting go of the mouse on an agent to its name at the side."""
    found = []
    with program("farmer_artisan", {}) as made:
        page = page_of(browser, made)
        go(page, "1 tick a frame")
        page.click("[data-test=go]")
        page.wait_for_timeout(500)
        page.focus("[data-test=world]")
        page.keyboard.press("n")
        page.wait_for_selector("[data-test=watched]")
        page.check(".tools input[type=checkbox]")  # follow: it is in the middle from now on
        page.click("[data-test=step]")
        page.wait_for_timeout(500)
        box = page.locator("[data-test=world]").bounding_box()
        assert box is not None
        middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        for _ in range(times):
            page.click("[aria-label='watch nobody']")
            page.wait_for_selector("[data-test=watched]", state="detached")
            page.wait_for_timeout(200)
            page.evaluate(f"window.clicked = ({CLICKED})(), undefined")
            page.mouse.click(*middle)
            found.append(page.evaluate("window.clicked"))
        page.close()
    return found


def measure_first_picture(browser: Browser, times: int) -> list[float]:
    """Seconds from the command to the first frame that a page has drawn."""
    found = []
    for _ in range(times):
        with program("farmer_artisan", {}) as made:
            page = page_of(browser, made)
            found.append(page.evaluate("window.first_frame") / 1000 - made.begun)
            page.close()
    return found[1:]  # the first one warms files and caches


def measure_memory(browser: Browser, seconds: float) -> dict[str, float]:
    """Mebibytes of program and page after a sixth of the time and at its end."""
    with program("farmer_artisan", {}) as made:
        page = page_of(browser, made)
        go(page, "as fast as possible")
        if seconds >= HOUR:
            page.click("[data-test=add-histogram]")
            page.focus("[data-test=world]")
            page.keyboard.press("n")
        session = page.context.new_cdp_session(page)

        def heap() -> float:
            """The least of some: what is just being drawn counts too."""
            found = []
            for _ in range(9):
                page.wait_for_timeout(300)
                session.send("HeapProfiler.collectGarbage")
                found.append(float(session.send("Runtime.getHeapUsage")["usedSize"]) / 2**20)
            return min(found)

        page.wait_for_timeout(1000 * seconds / 6)
        before = made.memory(), heap()
        page.wait_for_timeout(1000 * seconds * 5 / 6)
        after = made.memory(), heap()
        ticks = made.tick()[0]
        page.close()
    return {
        "seconds": seconds, "ticks": ticks,
        "program_before": before[0], "program_after": after[0],
        "page_before": before[1], "page_after": after[1],
    }  # fmt: skip


def started(driver: Playwright) -> Browser:
    """Return Chromium, as it starts by itself."""
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    return driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])


def compile_all() -> None:
    """Compile what is measured, so that nothing measured waits for that."""
    for model, settings in [("farmer_artisan", {}), *WORLDS.values()]:
        load_model(model)(seed=0, **settings).advance(1)


def bundle() -> dict[str, int]:
    """Bytes of the built page, and as a server could send them."""
    contents = [path.read_bytes() for path in sorted(BUILT.rglob("*")) if path.is_file()]
    packed = sum(len(gzip.compress(content)) for content in contents)
    return {"bytes": sum(map(len, contents)), "packed": packed}


def measure(seconds: float = SECONDS, rounds: int = 3, memory: float = 75.0) -> dict[str, Any]:
    """Measure all.

    Args:
        seconds: of one measurement.
        rounds: of each.
        memory: seconds over which memory is watched.
    """
    compile_all()
    with sync_playwright() as driver:
        browser = started(driver)
        results = {
            "machine": describe_machine("numba", "starlette", "websockets"),
            "chromium": browser.version,
            "rounds": rounds,
            "first_picture": measure_first_picture(browser, rounds + 1),
            "frames": measure_frames(browser, seconds, rounds),
            "speed": measure_speed(browser, seconds, rounds),
            "click": measure_click(browser, 5 * rounds),
            "memory": measure_memory(browser, memory),
            "bundle": bundle(),
        }
        browser.close()
    return results


def table(results: dict[str, Any]) -> str:
    """Return the results as a table."""
    machine = results["machine"]
    versions = f"Python {machine['python']}, Chromium {results['chromium']} without a graphics card"
    lines = [
        f"{machine['processor']}, {machine['cores']} cores for program, society and browser "
        f"together, {machine['system']}; {versions}; {results['rounds']} rounds.",
        "",
        "| | median | least – greatest |",
        "|---|---|---|",
    ]
    for name, values in results["frames"].items():
        lines.append(f"| frames a second: {name} | {spread(values, '.1f')} |")
    share = [100 * one for one in results["speed"]["ratio"]]
    lines.append(f"| speed with a page, of that without | {spread(share, '.0f', ' %')} |")
    lines.append(f"| click to watcher | {spread(results['click'], '.0f', ' ms')} |")
    first = results["first_picture"]
    lines.append(f"| command to first picture, warm | {spread(first, '.2f', ' s')} |")
    for memory in (results["memory"], results.get("hour")):
        for what in ("program", "page") if memory else ():
            before, after = memory[f"{what}_before"], memory[f"{what}_after"]
            told = f"{before:.1f} to {after:.1f} MiB ({100 * (after / before - 1):+.1f} %)"
            lines.append(
                f"| memory of the {what}, {memory['seconds']:,.0f} s, {memory['ticks']:,} ticks "
                f"| {told} | one run |"
            )
    size = {name: f"{count / 1000:.0f} kB" for name, count in results["bundle"].items()}
    lines.append(f"| the page's files | {size['bytes']} | {size['packed']} packed |")
    return "\n".join(lines)


def main() -> None:
    """Measure, and write the results."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--hour", action="store_true", help="watch memory over an hour, alone")
    parser.add_argument("--out", type=Path, default=HERE, help="folder for the results")
    options = parser.parse_args()
    kept = options.out / "studio.json"
    before = json.loads(kept.read_text("utf-8")) if kept.is_file() else {}
    if options.hour:
        with sync_playwright() as driver:
            browser = started(driver)
            results = {**before, "hour": measure_memory(browser, HOUR)}
            browser.close()
    else:
        results = measure() | ({"hour": before["hour"]} if "hour" in before else {})
    write(results, table, "studio", options.out)
    print(table(results))
    slow = [n for n, one in results["frames"].items() if statistics.median(one) < 10]
    if slow:
        print(f"slow: {json.dumps(slow, ensure_ascii=False)}")


if __name__ == "__main__":
    main()
