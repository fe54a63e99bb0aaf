"""How compiled rules find who is in a group, and who asks to be, as text."""

from __future__ import annotations

HEAD = "from socialmind.society.groups import lists as _lists"

_LISTS = """@_inner
def _KIND_heads_NAME(_model):
    return carray(_as_pointer(_model._NAME_KIND_heads), (_model._NAME_KIND_heads_0,), np.int32)


@_inner
def _KIND_entries_NAME(_model):
    return carray(
        _as_pointer(_model._NAME_KIND_entries), (_model._NAME_KIND_entries_0, 3), np.int32
    )


@_inner
def _KIND_found_NAME(_model):
    return carray(_as_pointer(_model._NAME_KIND_found), (_model._NAME_KIND_found_0,), np.int64)


@_inner
def _KIND_marks_NAME(_model):
    return carray(_as_pointer(_model._NAME_KIND_marks), (_model._NAME_KIND_marks_0,), np.int64)


@_inner
def _KIND_list_NAME(_model):
    _lists.list_all(
        _KIND_heads_NAME(_model),
        _KIND_entries_NAME(_model),
        _KIND_found_NAME(_model),
        _rows_NAME(_model),
        _minds_NAME(_model),
        _counters_NAME(_model),
        _order_NAME(_model),
        _alive_NAME(_model),
        ASKING,
    )


@_inner
def _KIND_begin_tick_NAME(_model):
    if _KIND_found_NAME(_model)[_lists.STALE]:
        _KIND_list_NAME(_model)


@_inner
def _KIND_follow_NAME(_model, agent):
    _lists.follow(
        _KIND_heads_NAME(_model),
        _KIND_entries_NAME(_model),
        _minds_NAME(_model),
        agent._mind,
        agent._slot,
        ASKING,
    )


@_inner
def _KIND_of_NAME(_model, group, identity):
    minds = _minds_NAME(_model)
    return _lists.gather(
        _KIND_heads_NAME(_model),
        _KIND_entries_NAME(_model),
        _KIND_found_NAME(_model),
        _rows_NAME(_model),
        minds,
        group,
        _kernel.find_group(minds, group, identity),
        ASKING,
    )


@_inner
def _KIND_begin_NAME(_model):
    return _KIND_found_NAME(_model)[_lists.TOP]


@_inner
def _KIND_keep_NAME(_model, begin, end, ordered):
    _lists.keep(
        _KIND_found_NAME(_model),
        _KIND_marks_NAME(_model),
        _slot_of_NAME(_model),
        begin,
        end,
        ordered,
    )


@_inner
def _KIND_slot_NAME(_model, place):
    return _KIND_found_NAME(_model)[place]


@_inner
def _KIND_leave_NAME(_model, begin):
    _KIND_found_NAME(_model)[_lists.TOP] = begin


@_inner
def _KIND_one_NAME(_model, end, rng):
    found = _KIND_found_NAME(_model)
    begin = found[_lists.TOP]
    if end == begin:
        return -1
    slot_of = _slot_of_NAME(_model)
    _lists.in_order(found, begin, end, _KIND_marks_NAME(_model), len(slot_of))
    return slot_of[found[begin + _rng_integers(rng, 0, end - begin)]]"""


def lists_text(population: str, kind: str) -> str:
    """Return the functions by which compiled rules find agents of a population.

    Args:
        population: its name.
        kind: "members" or "asking".
    """
    text = _LISTS.replace("KIND", kind).replace("ASKING", str(kind == "asking"))
    return text.replace("NAME", population)
