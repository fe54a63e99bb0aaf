"""Interactions in YAML: read from the nodes, so that an error names its line."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from coglogo_py.border.errors import SchemeError
from coglogo_py.decision import DecisionMaker, WeightedStochastic, decision_maker_called
from coglogo_py.files.reading import text_in
from coglogo_py.files.yaml_nodes import NOTHING, Nodes, composed
from socialmind.errors import of_model_file

if TYPE_CHECKING:
    import yaml


def described(path: Path, sides: tuple[str, ...]) -> dict[str, Any]:
    """Return what a file says of an interaction: the arguments to make it with.

    Args:
        path: the file.
        sides: whose abilities weigh the outcomes.

    Raises:
        ModelError: it describes none, with its line.
    """
    with of_model_file():
        nodes = Nodes(path)
        return _described(nodes, composed(text_in(path), path, "an interaction"), sides)


def _described(nodes: Nodes, root: yaml.Node, sides: tuple[str, ...]) -> dict[str, Any]:
    known = ("name", "decision_maker", "outcomes", "base", *sides)
    given = nodes.fields(root, "the interaction", known)
    for needed in ("name", "outcomes"):
        if needed not in given:
            raise nodes.error(root, f"an interaction without {needed}", f"{needed}:")
    outcomes = nodes.names(given["outcomes"], "outcomes")
    links = {
        side: {
            ability: _weights(nodes, node, outcomes, f"{ability!r} of the {side}")
            for ability, _, node in nodes.entries(given.get(side, NOTHING), side)
        }
        for side in sides
    }
    return links | {
        "name": nodes.name(given["name"], "name of the interaction"),
        "outcomes": outcomes,
        "base": _weights(nodes, given.get("base", NOTHING), outcomes, "base"),
        "decision_maker": _maker(nodes, given.get("decision_maker")),
        "_at": (nodes.file, root.start_mark.line + 1),
    }


def _weights(
    nodes: Nodes, node: yaml.Node, outcomes: tuple[str, ...], where: str
) -> dict[str, float]:
    fields = nodes.fields(node, where, outcomes)
    return {name: nodes.number(value, f"{where} to {name!r}") for name, value in fields.items()}


def _maker(nodes: Nodes, node: yaml.Node | None) -> DecisionMaker:
    if node is None:
        return WeightedStochastic()
    name, bias = node, 1.0
    if not nodes.is_plain(node):
        given = nodes.fields(node, "decision_maker", ("name", "bias"))
        if "name" not in given:
            raise nodes.error(node, "decision_maker without a name", "name: and bias:")
        name = given["name"]
        bias = nodes.number(given["bias"], "bias of decision_maker") if "bias" in given else 1.0
    try:
        return decision_maker_called(nodes.name(name, "decision_maker"), bias)
    except SchemeError as error:
        raise error.at(nodes.file, node.start_mark.line + 1) from None
