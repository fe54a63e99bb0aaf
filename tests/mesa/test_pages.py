"""Mesa's pages in the browser, drawn without one, and the program of docs/mesa.md."""

import re
import runpy
from pathlib import Path

import pytest

from socialmind.catalogue import load_model

solara = pytest.importorskip("solara", reason="the extra viz is not installed")

import ipyvuetify  # noqa: E402
import ipywidgets  # noqa: E402
from mesa.visualization import SolaraViz, SpaceRenderer, make_plot_component  # noqa: E402
from mesa.visualization.components import AgentPortrayalStyle  # noqa: E402

HOME = Path(__file__).parents[2]
FarmerArtisan = load_model("farmer_artisan")


class Shown:
    """A page of SolaraViz as solara draws it, with its buttons and its pictures."""

    def __init__(self, page):
        @solara.component
        def Laid():
            with solara.AppLayout():
                page.component(*page.args, **page.kwargs)

        self.model = page.args[0]
        _, self.context = solara.render(Laid(), handle_error=False)

    def click(self, label):
        buttons = self.context.find(ipyvuetify.Btn).widgets
        next(one for one in buttons if one.children == [label]).click()

    @property
    def pictures(self):
        return [bytes(one.value) for one in self.context.find(ipywidgets.Image).widgets]


def check_step_and_reset(shown, n_pictures):
    begin = shown.pictures
    assert len(begin) == n_pictures
    assert all(picture.startswith(b"\x89PNG") for picture in begin)
    shown.click("Step")
    assert shown.model.tick > 0
    moved = shown.pictures
    assert all(one != other for one, other in zip(begin, moved, strict=True))
    shown.click("Reset")
    assert shown.pictures == begin
    shown.click("Step")
    assert shown.pictures == moved


def portray(agent):
    return AgentPortrayalStyle(*agent.pos, "red" if agent.population == "humans" else "black")


def test_solara_viz_with_a_space_renderer():
    model = FarmerArtisan(seed=3, n_agents=10, compiled=False).mesa()
    renderer = SpaceRenderer(model)
    if hasattr(renderer, "setup_agents"):  # from Mesa 3.4 on
        renderer.setup_agents(portray).render()
    else:
        renderer.render(agent_portrayal=portray)
    page = SolaraViz(
        model,
        renderer,
        components=[make_plot_component("wheat"), make_plot_component({"tools": "tab:blue"})],
        render_interval=15,
    )
    shown = Shown(page)
    check_step_and_reset(shown, 3)


def test_the_app_of_the_farmer_artisan_society():
    path = HOME / "models" / "farmer_artisan" / "app.py"
    check_step_and_reset(Shown(runpy.run_path(str(path))["page"]), 4)


def test_the_program_of_the_page_about_mesa(capsys):
    text = (HOME / "docs" / "mesa.md").read_text(encoding="utf-8")
    agents, data, browser = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    names = {}
    exec(agents, names)
    assert names["model"].tick == 100
    assert "GrowWheat" in capsys.readouterr().out
    exec(data, names)
    assert len(names["series"]) == 121
    assert names["agents"].index.get_level_values("Step").unique().tolist() == list(range(101, 121))
    exec(browser, names)
    shown = Shown(names["page"])
    shown.click("Step")
    assert shown.model.tick == 1
    assert len(shown.pictures) == 2
