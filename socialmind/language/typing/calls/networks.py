"""Typing of networks: linking and unlinking agents, and what is asked of links."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from socialmind.language import types
from socialmind.language.nodes import Typed, constant, marked
from socialmind.language.shape import LinksShape
from socialmind.language.typing.calls.minds import method_call
from socialmind.language.typing.calls.neighbours import AGENTS, agent_there

if TYPE_CHECKING:
    from socialmind.language.typer import Typer

PAIRS = ("link", "unlink", "linked", "between")
"""What is asked of a network about two agents."""
ALL = {"neighbours": "agents", "links_of": "links"}
"""What is asked about one agent, where its links as a source and as a target are not two things."""
ONE_WAY = {
    "successors": ("out", "agents"),
    "predecessors": ("in", "agents"),
    "links_from": ("out", "links"),
    "links_to": ("in", "links"),
}
"""What is asked where they are two, and which list answers."""

_INSTEAD = {
    **dict.fromkeys(
        ("create", "hatch", "add", "add_edge", "create_link_with", "create_link_to", "connect"),
        "write model.{net}.link({one}, {other})",
    ),
    **dict.fromkeys(
        ("remove", "remove_edge", "delete", "disconnect"),
        "write model.{net}.unlink({one}, {other})",
    ),
    **dict.fromkeys(
        ("has_edge", "link_neighbor", "is_linked", "contains_edge"),
        "write model.{net}.linked({one}, {other})",
    ),
}
"""What networkx, Mesa and NetLogo call these."""


def network_call(
    typer: Typer, node: ast.Call, base: ast.expr, links: LinksShape, net: str
) -> Typed | None:
    """Return what is asked of a network as both speeds run it; None for what any population has."""
    func = node.func
    assert isinstance(func, ast.Attribute)  # a method
    name = func.attr
    if name in PAIRS:
        pair = _pair(typer, node, links, net, name)
        mark = ("network", net, name)
        if name == "link":
            typer.program.bears(net)
        if name in ("link", "unlink"):
            typer.program.effects.changes(net)
        result: types.AnyType = types.BOOL if name == "linked" else types.NONE
        if name == "link":
            result = types.RowType(net)
        if name == "between":
            result = types.MaybeRowType(net)
        return method_call(node, base, name, pair, mark), result
    if name in ALL or name in ONE_WAY:
        return _linked(typer, node, base, links, net, name)
    if name in AGENTS:
        advice = f"ask the agents: model.{links.source}.{name}(…)"
        typer.refuse(node, f"{name}() of the network {net!r}, whose links are nowhere", advice)
    if name in _INSTEAD:
        typer.refuse(node, f"{name}() of the network {net!r}", _written(_INSTEAD[name], links, net))
    return None


def _linked(
    typer: Typer, node: ast.Call, base: ast.expr, links: LinksShape, net: str, name: str
) -> Typed:
    """Return the agents that one is linked with, or its links: a set."""
    if len(node.args) != 1 or node.keywords:
        typer.refuse(node, f"{name}() like this", f"write model.{net}.{name}(agent)")
    who, kind = typer.expression(node.args[0])
    if isinstance(kind, types.MaybeRowType):
        who, kind = agent_there(who, kind)
    one = links.source == links.target
    if name in ALL and links.directed and one:
        instead = "links_from or links_to" if name == "links_of" else "successors or predecessors"
        typer.refuse(node, f"{name}() of the directed network {net!r}", f"write {instead}")
    if name in ONE_WAY and not links.apart:
        instead = "links_of" if name.startswith("links") else "neighbours"
        typer.refuse(node, f"{name}() of {net!r}, which is not directed", f"write {instead}")
    population = kind.population if isinstance(kind, types.RowType) else ""
    if name in ALL:
        side, what = "out" if population == links.source else "in", ALL[name]
    else:
        side, what = ONE_WAY[name]
    of, ends = links.source, links.target
    if side == "in":
        of, ends = ends, of
    if population != of:
        expected = f"an agent of {of!r}"
        if name in ALL and not one:
            expected = f"an agent of {links.source!r} or {links.target!r}"
        typer.refuse(node, f"{kind} for {name}() of {net!r}", "give it an agent it links", expected)
    texts = [constant(side, node), constant(what, node)]
    made = method_call(node, base, "linked_set", [*texts, who], ("linked", net, side, what))
    return made, types.FoundType(net if what == "links" else ends, (net, side))


def one_linked(typer: Typer, node: ast.Call, base: ast.expr, kind: types.FoundType) -> Typed:
    """Return one of those that an agent is linked with, or of its links, or None."""
    kinds = [typer.expression(argument) for argument in node.args]
    if [found for _, found in kinds] != [types.RNG] or node.keywords:
        typer.refuse(node, "one_of() without the random stream", "write ….one_of(rng)")
    made = method_call(node, base, "one_of", [kinds[0][0]], ("one_linked",))
    return made, types.MaybeRowType(kind.population)


def _pair(typer: Typer, node: ast.Call, links: LinksShape, net: str, name: str) -> list[ast.expr]:
    """Return the two agents of a call, the source and the target of a link."""
    wanted = f"model.{{net}}.{name}({{one}}, {{other}})"
    if len(node.args) != 2 or node.keywords:
        typer.refuse(node, f"{name}() like this", f"write {_written(wanted, links, net)}")
    found = []
    for argument, population in zip(node.args, (links.source, links.target), strict=True):
        value, kind = typer.expression(argument)
        if isinstance(kind, types.MaybeRowType):
            value, kind = agent_there(value, kind)
        if kind != types.RowType(population):
            typer.refuse(
                argument,
                f"{kind} for {name}() of {net!r}",
                f"write {_written(wanted, links, net)}",
                f"an agent of {population!r}",
            )
        found.append(value)
    return found


def link_attribute(node: ast.Attribute, links: LinksShape, net: str) -> Typed | None:
    """Return the source or the target of a link, an agent; None for its other attributes."""
    if node.attr not in ("source", "target"):
        return None
    of = links.source if node.attr == "source" else links.target
    return marked(node, ("link_end", net, node.attr)), types.RowType(of)


def link_call(
    typer: Typer, node: ast.Call, base: ast.expr, links: LinksShape, net: str, name: str
) -> Typed | None:
    """Return what is asked of a link as both speeds run it; None for what any row has."""
    if name == "hatch":
        advice = _written("write model.{net}.link({one}, {other})", links, net)
        typer.refuse(node, f"hatch() of a link of {net!r}", f"between two there is one: {advice}")
    if name != "other":
        return None
    kinds = [typer.expression(argument) for argument in node.args]
    ends = {links.source: links.target, links.target: links.source}
    if len(kinds) == 1 and not node.keywords:
        value, kind = kinds[0]
        if isinstance(kind, types.MaybeRowType):
            value, kind = agent_there(value, kind)
        if isinstance(kind, types.RowType) and kind.population in ends:
            side = ""
            if len(ends) == 2:
                side = "_source" if kind.population == links.source else "_target"
            made = method_call(node, base, name, [value], ("link_other", net, side))
            return made, types.RowType(ends[kind.population])
    found = " and ".join(str(kind) for _, kind in kinds) or "nothing"
    return typer.refuse(
        node, f"other() of {found}", "write link.other(agent)", "one of the agents it joins"
    )


def _written(advice: str, links: LinksShape, net: str) -> str:
    one, other = links.source.rstrip("s"), links.target.rstrip("s")
    if one == other:
        one, other = "one", "other"
    return advice.format(net=net, one=one, other=other)
