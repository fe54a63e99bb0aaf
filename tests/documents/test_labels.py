"""What columns of sweeps are called at axes, and their units."""

from socialmind.catalogue import load_model
from socialmind.documents.labels import labels_of_parameters, labels_of_sweep, units_recorded

MEASURES = {
    "settled": {"expression": "mean(artisans[-20:])"},
    "spread": {"expression": "std(wheat)"},
    "unequal": {"expression": "gini(agents.wheat)"},
    "share": {"expression": "last(artisans) / 25"},
    "twice": {"expression": "gini(agents.wheat)*2"},
    "is_equal": {"expression": "gini(wheat) < 0.4"},
    "left_over": {"expression": "last(artisans) % 2"},
    "own": {"file": "mine.py:own", "sha256": "0"},
}


class Manifest:
    every = 500
    columns = ("tool_price", "demand_intensity", "influence.WheatNeed.GrowWheat", "wheat")
    series_columns = ("wheat", "artisans")
    measures = MEASURES


def test_names_and_units_come_from_declarations_and_the_author_s_words():
    labels = labels_of_sweep(Manifest, load_model("farmer_artisan"))
    assert labels.axis("tool_price") == "price of a tool (wheat a tool)"
    # Its meaning, "weight of one signal of demand", is longer than an axis has room for.
    assert labels.axis("demand_intensity") == "demand intensity (demand a signal)"
    assert labels.axis("settled") == "artisans, mean of the last 10,000 ticks (agents)"
    assert labels.axis("spread") == "wheat, standard deviation of the run"
    assert labels.axis("unequal") == "Gini coefficient of wheat (0 … 1)"
    for name in ("twice", "is_equal", "left_over"):
        assert labels.axis(name) == name.replace("_", " ")
    assert labels.axis("share") == "share" and labels.axis("own") == "own"
    assert labels.axis("artisans") == "artisans (agents)"
    # What varies is called wheat; the end of the series of that name has its own column.
    assert labels.axis("series.wheat") == "wheat"


def test_without_the_model_names_alone_are_known():
    labels = labels_of_sweep(Manifest, None)
    assert labels.axis("tool_price") == "tool price"
    assert labels.axis("settled") == "artisans, mean of the last 10,000 ticks"


def test_units_of_the_series_are_those_of_its_own_table():
    units = units_recorded(load_model("farmer_artisan"))
    assert units["artisans"] == "agents" and units["specialisation"] == "0 … 1"


def test_parameters_are_called_the_same_without_a_sweep():
    labels = labels_of_parameters(load_model("farmer_artisan"))
    assert labels.axis("tool_price") == "price of a tool (wheat a tool)"
    assert labels.name("demand_intensity") == "demand intensity"
