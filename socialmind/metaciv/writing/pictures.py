"""How a model looks in the studio, and figures of its runs: in the colours of MetaCiv's files."""

from __future__ import annotations

import colorsys

from socialmind.metaciv.description import Hsb
from socialmind.metaciv.writing.acts.form import as_text
from socialmind.metaciv.writing.layout import laid_out, sentence
from socialmind.metaciv.writing.map_text import MapText
from socialmind.metaciv.writing.sheet import Sheet


def rgb(colour: Hsb) -> str:
    """Return a colour as `#rrggbb`."""
    red, green, blue = colorsys.hsv_to_rgb(*colour)
    return "#" + "".join(f"{round(255 * part):02x}" for part in (red, green, blue))


def colours_of_terrains(map_text: MapText) -> list[str]:
    """Return the constant that says which colour each terrain has, by its index on the map."""
    found: dict[str, str] = {}
    for name, terrain in zip(map_text.model.environment.terrains, map_text.terrains, strict=True):
        number = 1 + sum(one == name or one.startswith(f"{name} (") for one in found)
        key = name if number == 1 else f"{name} ({number})"
        found[key] = rgb(terrain.colour) if terrain is not None else "#787878"
    pairs = [f'{as_text(name)}: "{colour}"' for name, colour in found.items()]
    return laid_out("TERRAINS = {", pairs, "}")


def looks(sheet: Sheet, map_text: MapText) -> list[str]:
    """Return the lines of the method that says how agents and patches look."""
    peoples = sheet.people.civilisations
    if len(peoples) == 1:
        before, humans = [], f'Looks("person", "{rgb(peoples[0].colour)}")'
    else:
        before = [
            "        peoples = {one.name: one.colour for one in type(self).humans.civilisations}",
            "        belongs = [list(peoples).index(one) for one in self.humans.civilisation]",
        ]
        humans = 'Looks("person", peoples, by=belongs)'
    rows = [f'"humans": {humans},']
    rows += [f'"{one.population}": Looks("house"),' for one in sheet.used_facilities]
    if map_text.mapped:
        rows.append('"patches": Looks(colour=TERRAINS, by=self.world.terrain),')
    doc = "Return how the studio shows peoples and ground: in the colours of MetaCiv's files."
    return [
        "    def looks(self):",
        sentence(doc, "        "),
        *before,
        "        return {",
        *(f"            {one}" for one in rows),
        "        }",
    ]


def figures(sheet: Sheet, map_text: MapText) -> str:
    """Return the file of the figures of a model's runs."""
    environment = sheet.model.environment
    text = _FIGURES.replace("MODEL", sheet.title)
    names = [as_text(one.population) for one in sheet.used_facilities]
    listed = f"({', '.join(names)}{',' * (len(names) == 1)})"
    text = text.replace("BUILT\n", _BUILT.replace("NAMES", listed) if names else "")
    if map_text.mapped:
        text = text.replace("GROUND\n", _GROUND)
        return text.replace("from .model import ", "from .model import TERRAINS, ")
    for line in ("from pathlib import Path\n\n", "import numpy as np\n", "GROUND\n"):
        text = text.replace(line, "")
    text = text.replace("from matplotlib.colors import ListedColormap\n", "")
    size = f"{environment.width}, {environment.height}"
    return text.replace("ground.shape[::-1]", size)


_FIGURES = '''"""The figures of a run: its series, and who is where at its end."""

from pathlib import Path

import numpy as np
from matplotlib.colors import ListedColormap
from socialmind.drawing import style as paper
from socialmind.runs.figures import draw_series

from .model import MODEL


def draw(run):
    """Return the series, and the map at the last recorded tick."""
    return {"series": draw_series(run), "map": draw_map(run)}


def draw_map(run):
    """Draw the map: what is built as squares, agents in the colours of their peoples."""
    tick = int(run.series["tick"].max())
    now = run.agents[run.agents["tick"] == tick]
    with paper.style():
        figure = paper.figure(paper.COLUMN, paper.COLUMN)
        axes = figure.subplots()
GROUND
        wide, high = ground.shape[::-1]
BUILT
        for people in MODEL.humans.civilisations:
            own = now[now["civilisation"] == people.name]
            axes.scatter(
                own["x"], own["y"], 9, people.colour, ec=paper.INK, lw=0.3, label=people.name
            )
        axes.set(xlim=(-0.5, wide - 0.5), ylim=(-0.5, high - 0.5), xlabel="x", ylabel="y")
        axes.set(aspect="equal", title=f"tick {tick:,}")
        figure.legend(loc="outside lower center", ncols=3)
    return figure
'''

_BUILT = """\
        for name in NAMES:
            own = now[now["population"] == name]
            axes.scatter(own["x"], own["y"], s=9, marker="s", color=paper.INK, label=name)
"""

_GROUND = """\
        ground = np.loadtxt(Path(__file__).parent / "terrain.csv", delimiter=",", ndmin=2)[::-1]
        colours = ListedColormap(list(TERRAINS.values()))
        axes.imshow(ground, colours, vmin=0, vmax=len(TERRAINS), origin="lower", alpha=0.5)
"""
