"""The documentation as a site: built strictly, whole, and asking nothing of the internet."""

import importlib
import re
import shutil
from html.parser import HTMLParser
from pathlib import Path

import pytest

from socialmind.sources.loading import load_file

pytest.importorskip("material", reason="mkdocs-material is not installed")

ROOT = Path(__file__).parents[2]
FETCHED = {"script": "src", "link": "href", "img": "src", "iframe": "src", "source": "src"}
PACKAGES = (
    "coglogo_py",
    "socialmind",
    "socialmind.economy",
    "socialmind.envs",
    "socialmind.experiments",
    "socialmind.learning",
    "socialmind.mind",
    "socialmind.worlds.plane",
)


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The folder of the built site."""
    from mkdocs.commands.build import build
    from mkdocs.config import load_config

    folder = tmp_path_factory.mktemp("site")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(ROOT)
        build(load_config("mkdocs.yml", strict=True, site_dir=str(folder)))
    return folder


class Fetches(HTMLParser):
    """What a browser fetches by itself when it shows a page, and where the page leads."""

    def __init__(self):
        super().__init__()
        self.fetched, self.links, self.names = [], [], set()

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        if tag in FETCHED and FETCHED[tag] in given and given.get("rel") not in ("prev", "next"):
            self.fetched.append(given[FETCHED[tag]])
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        self.names.add(given.get("id"))


@pytest.fixture(scope="module")
def pages(site):
    found = {}
    for path in sorted(site.rglob("*.html")):
        found[path.relative_to(site).as_posix()] = reader = Fetches()
        reader.feed(path.read_text("utf-8"))
    return found


def test_it_fetches_nothing_from_outside(site, pages):
    outside = [
        (name, one)
        for name, page in pages.items()
        for one in page.fetched
        if re.match(r"(\w+:)?//", one)
    ]
    assert outside == []
    for path in site.rglob("*.css"):
        assert re.findall(r"url\([\"']?(?:https?:)?//[^)]+\)", path.read_text("utf-8")) == [], path
    # The theme fetches this library for pages that draw with it.
    assert not any('class="mermaid"' in (site / name).read_text("utf-8") for name in pages)


def test_its_links_lead_somewhere(site, pages):
    wrong = []
    for name, page in pages.items():
        if name == "404.html":
            continue
        for link in page.links:
            path, _, anchor = link.partition("#")
            if re.match(r"(\w+:|//)", link):
                continue
            target = (site / name).parent / path if path else site / name
            inside = target.resolve().relative_to(site.resolve()).as_posix()
            if not target.is_file() or (anchor and anchor not in pages[inside].names):
                wrong.append((name, link))
    assert wrong == []


def test_every_page_is_in_its_nav():
    nav = re.findall(r"docs/[\w/]+\.md", (ROOT / "mkdocs.yml").read_text("utf-8"))
    assert sorted(nav) == sorted(
        path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md")
    )


@pytest.mark.parametrize("package", PACKAGES)
def test_the_reference_holds_every_public_name(package):
    text = "".join(path.read_text("utf-8") for path in (ROOT / "docs/reference").glob("*.md"))
    told = {line.rpartition(".")[2] for line in re.findall(r"^::: (\S+)", text, re.MULTILINE)}
    if f"::: {package}\n" in text:
        return
    module = importlib.import_module(package)
    public = getattr(module, "__all__", None) or [
        name
        for file in ("bodies", "devices.actuators", "devices.device", "devices.interruptions",
                     "devices.measures", "devices.rewards", "devices.sensors", "plane")
        for name in importlib.import_module(f"{package}.{file}").__all__
    ]  # fmt: skip
    assert sorted(set(public) - told - {"__version__"}) == []


def test_its_pictures_are_small_shown_and_made_by_the_command(monkeypatch):
    # The script imports what stands beside it.
    monkeypatch.syspath_prepend(str(ROOT / "docs/site"))
    pictures = load_file(ROOT / "docs/site/pictures.py")
    made = {one for page in pictures.PAGES.values() for one in page}
    made |= {*pictures.COMMANDS, *pictures.SCREENS}
    there = {path.stem: path for path in (ROOT / "docs/figures").iterdir()}
    assert made == set(there)
    text = "".join(
        path.read_text("utf-8") for path in (ROOT / "README.md", *(ROOT / "docs").rglob("*.md"))
    )
    for name, path in there.items():
        assert path.suffix == ".png" and path.stat().st_size <= pictures.MOST, name
        assert f"figures/{name}.png)" in text, name


def test_examples_in_docstrings_are_code(site):
    page = (site / "reference/coglogo_py.html").read_text("utf-8")
    assert "<blockquote>" not in page
    assert page.count('<span class="gp">') > 10


def test_the_commands_stand_with_their_options(site):
    page = (site / "reference/commands.html").read_text("utf-8")
    assert "socialmind sweep" in page and "--grid NAME=V1,V2" in page


def test_it_is_read_and_searched_from_a_folder(site):
    sync_api = pytest.importorskip("playwright.sync_api", reason="Playwright is not installed")
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    with sync_api.sync_playwright() as driver:
        try:
            browser = driver.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        except sync_api.Error:
            pytest.skip("no Chromium here: the site is not looked at")
        page = browser.new_page(viewport={"width": 1280, "height": 720})
        page.set_default_timeout(120_000)
        asked, failures = [], []
        page.on("request", lambda request: asked.append(request.url))
        page.on("pageerror", lambda error: failures.append(str(error)))
        page.goto((site / "index.html").as_uri())
        page.get_by_role("link", name="A society with a culture").first.click()
        page.wait_for_url("**/tutorials/culture.html")
        page.fill("[data-md-component=search-query]", "participation")
        page.wait_for_selector(".md-search-result__item")
        browser.close()
    assert [one for one in asked if not one.startswith(("file:", "data:", "blob:"))] == []
    assert failures == []
