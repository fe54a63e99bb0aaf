"""The pages that are followed step by step do what they say: their files, commands and code."""

import re
from pathlib import Path

import pytest

from socialmind.experiments import Sweep
from socialmind.sources.loading import load_file

DOCS = Path(__file__).parents[2] / "docs"
follow = load_file(DOCS / "site" / "following.py").follow


@pytest.fixture(scope="module")
def home(tmp_path_factory):
    """An empty folder for all pages, as their reader has."""
    return tmp_path_factory.mktemp("newcomer")


@pytest.fixture(autouse=True)
def there(home, monkeypatch):
    monkeypatch.chdir(home)
    monkeypatch.setenv("MPLBACKEND", "agg")


def told(page, row):
    """The numbers of a row of a table in a page."""
    text = (DOCS / page).read_text("utf-8")
    line = re.search(rf"^\| {row} \|(.*)\|$", text, re.MULTILINE)[1]
    return [float(number) for number in re.findall(r"[\d.]+", line)]


def test_a_society_with_a_culture():
    names, said = follow("tutorials/culture.md")
    assert names["alone"]["fish"].iloc[-1] < 0.55
    caught = names["caught"]
    assert [caught[False]] == told("tutorials/culture.md", "no")
    assert [caught[True]] == told("tutorials/culture.md", "yes")
    villages = "nobody_bound all_bound four_free_riders"
    assert "+610.867" in said[f"socialmind compare {villages} --unit fish=fish --out villages"]
    assert Path("scheme.png").stat().st_size > 5000


def test_a_sweep_to_a_figure():
    def shorter(words):
        if words[1] == "sweep":
            words = [re.sub(r"^unbound=.*", "unbound=4,9,11", word) for word in words]
            words += ["--workers", "1"]
        return [{"0:20": "0:3", "41": "4"}.get(word, word) for word in words]

    names, _ = follow("tutorials/sweep.md", shorter, ignored=r"11 points .*")
    stock = Sweep("riders").runs.groupby("unbound")["stock"].mean()
    assert stock[4] > 400 and stock[9] > 150 and stock[11] < 1
    assert list(names["table"].columns) == ["stock", "catch"]
    assert {path.name for path in Path("tables").iterdir()} >= {"runs.csv", "series.csv"}
    assert Path("riders/figures/response-stock.png").is_file()


def test_a_robot_that_learns_and_one_that_is_programmed():
    def shorter(words):
        added = {
            "learn": ["--generations", "2", "--set", "population=8", "--workers", "1"],
            "score": ["--episodes", "4", "--workers", "1"],
            "sweep": ["--workers", "1", "--ticks", "50"],
        }
        short = {"0:40": "0:2", "n_stones=0,6,12,18,24,30": "n_stones=0,6", "day.gif": "day.svg"}
        return [short.get(word, word) for word in words] + added.get(words[1], [])

    follow("tutorials/robot.md", shorter)
    assert Path("learned/figures/curve.png").is_file() and Path("day.png").is_file()
    names, _ = follow("tutorials/comparison.md", shorter)
    assert len(names["by_hand"]) == 100
    assert Path("stones/figures/response-gathered.png").is_file()
    # The program is as good as the page says: what learns is another matter on other processors.
    low, high = told("tutorials/comparison.md", "by hand")[1:3]
    assert low < names["by_hand"]["balls"].mean() < high


def test_the_first_hour():
    def shorter(words):
        return [{"20000": "400", "10000": "200"}.get(word, word) for word in words]

    _, said = follow("first_hour.md", shorter)
    assert "farmer_artisan" in said["socialmind list"]
    assert Path("what_if/comparison.png").is_file() and Path("my_model/model.py").is_file()


def test_minds_of_cognitons(monkeypatch, home):
    (home / "models").symlink_to(DOCS.parent / "models")

    def shorter(words):
        return [{"20000": "400"}.get(word, word) for word in words if word != "--figures"]

    names, said = follow("concepts/cognitons.md", shorter)
    assert "wantGreen" in said["socialmind explain turtle --agent 0 --tick 100"]
    green = [one["wantGreen"] for one in names["wishes"]]
    assert max(green) > 0.5 and min(green[95:]) < 0.01


def test_hierarchies_of_skills():
    pytest.importorskip("torch")
    names, _ = follow("concepts/skills.md")
    assert names["robot"].influences()["Turn"] == 0.75
    assert names["values"][-1]["counter"] == 1.0
