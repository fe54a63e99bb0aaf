"""How compiled rules reach a network, as text: its lists of links, linking and unlinking."""

from __future__ import annotations

from socialmind.language.shape import PopulationShape

HEAD = "from socialmind.networks import adjacency as _adjacency"

_NOT_APART = """@_inner
def _heads_in_NAME(_model):
    return _heads_out_NAME(_model)


@_inner
def _ties_in_NAME(_model):
    return _ties_out_NAME(_model)"""

_LINKS = """@_inner
def _link_between_NAME(_model, one, other):
    return _adjacency.link_between(
        _heads_out_NAME(_model),
        _ties_out_NAME(_model),
        _heads_in_NAME(_model),
        _ties_in_NAME(_model),
        one,
        other,
    )


@_inner
def _untie_NAME(_model, link):
    joined = _joined_NAME(_model)
    source, target = joined[link._slot, 0], joined[link._slot, 1]
    _adjacency.untie(_heads_out_NAME(_model), _ties_out_NAME(_model), source, link._id)
    _adjacency.untie(_heads_in_NAME(_model), _ties_in_NAME(_model), target, link._id)


@_inner
def _tie_NAME(_model, link, one, other):
    joined = _joined_NAME(_model)
    joined[link._slot, 0] = one
    joined[link._slot, 1] = other
    if not (
        _adjacency.tie(
            _heads_out_NAME(_model), _ties_out_NAME(_model), one, link._id, link._slot, other
        )
        and _adjacency.tie(
            _heads_in_NAME(_model), _ties_in_NAME(_model), other, link._id, link._slot, one
        )
    ):
        raise _bookkeeping.NoRoomError("more links in a tick than their lists have room for")


@_inner
def _network_link_NAME(_model, one, other):
    if not (_alive_SOURCE(_model)[one._slot] and _alive_TARGET(_model)[other._slot]):
        raise ValueError("link() of an agent that is dead")
    if SAME and one._slot == other._slot:
        raise ValueError("link() of an agent with itself")
    slot = _link_between_NAME(_model, one._slot, other._slot)
    rows = _rows_NAME(_model)
    if slot < 0:
        slot = _place_for_NAME(_model)
        rows[slot] = carray(_as_pointer(_model._NAME_default), (1,), NAME_ROW)[0]
        link = _named_NAME(_model, slot)
        link._source = one._id
        link._target = other._id
        _tie_NAME(_model, link, one._slot, other._slot)
    return rows[slot]


@_inner
def _network_unlink_NAME(_model, one, other):
    slot = _link_between_NAME(_model, one._slot, other._slot)
    if slot >= 0:
        _die_NAME(_model, _rows_NAME(_model)[slot])


@_inner
def _network_linked_NAME(_model, one, other):
    return _link_between_NAME(_model, one._slot, other._slot) >= 0


@_inner
def _network_born_NAME(_model):
    return _counters_NAME(_model)[_bookkeeping.NEXT_ID]


@_inner
def _network_between_NAME(_model, one, other):
    return _link_between_NAME(_model, one._slot, other._slot)


@_inner
def _end_links_NAME(_model, heads, ties, slot):
    while heads[slot, _adjacency.DEGREE] > 0:
        last = heads[slot, _adjacency.BEGIN] + heads[slot, _adjacency.DEGREE] - 1
        _die_NAME(_model, _rows_NAME(_model)[ties[last, _adjacency.SLOT]])


@_inner
def _link_source_NAME(_model, link):
    return _agent_SOURCE(_model, link._source)


@_inner
def _link_target_NAME(_model, link):
    return _agent_TARGET(_model, link._target)"""

_SETS = """@_inner
def _network_degree_NAME_SIDE(_model, agent):
    return _heads_SIDE_NAME(_model)[agent._slot, _adjacency.DEGREE]


@_inner
def _network_one_NAME_SIDE(_model, agent, rng, part):
    heads = _heads_SIDE_NAME(_model)
    degree = heads[agent._slot, _adjacency.DEGREE]
    if degree == 0:
        return -1
    place = heads[agent._slot, _adjacency.BEGIN] + _rng_integers(rng, 0, degree)
    return _ties_SIDE_NAME(_model)[place, part]


@_inner
def _network_one_NAME_SIDE_agents(_model, agent, rng):
    return _network_one_NAME_SIDE(_model, agent, rng, _adjacency.AGENT)


@_inner
def _network_one_NAME_SIDE_links(_model, agent, rng):
    return _network_one_NAME_SIDE(_model, agent, rng, _adjacency.SLOT)


@_inner
def _network_step_NAME_SIDE(_model, agent, at, last, born):
    return _adjacency.step(
        _heads_SIDE_NAME(_model), _ties_SIDE_NAME(_model), agent, at, last, born
    )


@_inner
def _network_at_NAME_SIDE(_model, agent, at, part):
    return _ties_SIDE_NAME(_model)[_heads_SIDE_NAME(_model)[agent, _adjacency.BEGIN] + at, part]


@_inner
def _network_link_at_NAME_SIDE(_model, agent, at):
    return _network_at_NAME_SIDE(_model, agent, at, _adjacency.LINK)


@_inner
def _network_agents_NAME_SIDE(_model, agent, at):
    return _rows_ENDS(_model)[_network_at_NAME_SIDE(_model, agent, at, _adjacency.AGENT)]


@_inner
def _network_links_NAME_SIDE(_model, agent, at):
    return _rows_NAME(_model)[_network_at_NAME_SIDE(_model, agent, at, _adjacency.SLOT)]"""

_OTHER = """@_inner
def _link_other_NAME(_model, link, agent):
    if link._source == agent._id:
        return _agent_TARGET(_model, link._target)
    if link._target == agent._id:
        return _agent_SOURCE(_model, link._source)
    raise ValueError("other() of an agent that the link does not join")"""

_OTHERS = """@_inner
def _link_other_NAME_source(_model, link, agent):
    if link._source != agent._id:
        raise ValueError("other() of an agent that the link does not join")
    return _agent_TARGET(_model, link._target)


@_inner
def _link_other_NAME_target(_model, link, agent):
    if link._target != agent._id:
        raise ValueError("other() of an agent that the link does not join")
    return _agent_SOURCE(_model, link._source)"""


def network_text(network: PopulationShape) -> str:
    """Return the functions by which compiled rules reach a network, beside those of its rows."""
    links = network.links
    assert links is not None  # a network's
    same = links.source == links.target
    fills = {
        "SAME": str(same),
        "SOURCE": links.source,
        "TARGET": links.target,
        "NAME": network.name,
    }
    sides = ("out", "in") if links.apart else ("out",)
    ends = {"out": links.target, "in": links.source}
    sets = [_SETS.replace("SIDE", side).replace("ENDS", ends[side]) for side in sides]
    text = "\n\n\n".join(
        [*([] if links.apart else [_NOT_APART]), _LINKS, _OTHER if same else _OTHERS, *sets]
    )
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return text


def untying(network: PopulationShape) -> str:
    """Return the line by which a link that ends leaves the lists of its agents."""
    return f"_untie_{network.name}(_model, agent)"


def ending_links(population: str, networks: list[PopulationShape]) -> list[str]:
    """Return the lines by which the links of an agent that dies end."""
    lines = []
    for network in networks:
        links = network.links
        assert links is not None  # a network's
        ends = {"out": links.source, "in": links.target}
        if not links.apart:
            del ends["in"]
        lines += [
            f"_end_links_{network.name}(_model, _heads_{end}_{network.name}(_model), "
            f"_ties_{end}_{network.name}(_model), agent._slot)"
            for end, of in ends.items()
            if of == population
        ]
    return lines
