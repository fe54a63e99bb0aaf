"""The farmer-artisan society in the browser: `solara run models/farmer_artisan/app.py`."""

from pathlib import Path

from mesa.visualization import Slider, SolaraViz, make_plot_component, make_space_component
from mesa.visualization.components import AgentPortrayalStyle, PropertyLayerStyle

from socialmind.catalogue import load_model
from socialmind.drawing import style as paper

COLOURS = {
    "GrowWheat": paper.BLUE,
    "ProduceTools": paper.RED,
    "TradeWheatForTools": paper.GOLD,
    "TradeToolsForWheat": paper.PURPLE,
}


def portray(agent):
    """Draw a villager in the colour of its plan, a village as a black square."""
    x, y = agent.pos
    if agent.population == "villages":
        return AgentPortrayalStyle(x, y, "black", "s", size=60)
    return AgentPortrayalStyle(x, y, COLOURS.get(agent.plan, "grey"), size=25)


def portray_land(layer):
    """Colour a patch by the work done on it: blue for wheat, red for tools."""
    if getattr(layer, "name", layer) != "tool_activity":  # Mesa 4 gives the name alone
        return None
    return PropertyLayerStyle(colormap="RdBu_r", vmin=11_700, vmax=13_700, colorbar=False)


def legend(axes):
    """Say which colour is which plan."""
    for plan, colour in COLOURS.items():
        axes.scatter([], [], color=colour, label=plan)
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    axes.set_axis_off()


FarmerArtisan = load_model(Path(__file__).parent)
parameters = {
    "seed": {"type": "InputText", "value": "1", "label": "seed"},
    "n_agents": Slider("agents", 25, 5, 100, 5),
    "n_villages": Slider("villages", 1, 1, 4, 1),
    "tool_price": Slider("price of a tool, wheat", 167.0, 20.0, 400.0, 1.0),
    "starvation": {"type": "Checkbox", "value": False, "label": "starvation"},
}
page = SolaraViz(
    FarmerArtisan(seed=1).mesa(),
    components=[
        make_space_component(portray, portray_land, legend, draw_grid=False),
        make_plot_component({"farmers": paper.BLUE, "artisans": paper.RED}),
        make_plot_component("specialisation"),
        make_plot_component({"wheat_demand": paper.BLUE, "tool_demand": paper.RED}),
    ],
    model_params=parameters,
    name="Farmers and artisans",
    render_interval=50,
)
