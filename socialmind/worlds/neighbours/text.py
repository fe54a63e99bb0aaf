"""How compiled rules find agents, as text."""

from __future__ import annotations

from socialmind.compiling.layout import dtype_text
from socialmind.language.shape import ModelShape
from socialmind.worlds.neighbours.kernel import CELLS, ENTRY

HEAD = f"""from socialmind.worlds.neighbours import kernel as _neighbours

NEAR_CELLS = {dtype_text(CELLS)}
NEAR_ENTRY = {dtype_text(ENTRY)}"""

_INDEX = """@_inner
def _near_cells_NAME(_model):
    return carray(_as_pointer(_model._NAME_near_cells), (1,), NEAR_CELLS)[0]


@_inner
def _near_entries_NAME(_model):
    return carray(_as_pointer(_model._NAME_near_entries), (_model._NAME_room,), NEAR_ENTRY)


@_inner
def _near_heads_NAME(_model):
    return carray(_as_pointer(_model._NAME_near_heads), (_model._NAME_near_heads_0,), np.int32)


@_inner
def _near_spots_NAME(_model):
    return carray(_as_pointer(_model._NAME_near_spots), (_model._NAME_near_spots_0,), np.int32)


@_inner
def _near_found_NAME(_model):
    return carray(_as_pointer(_model._NAME_near_found), (_model._NAME_near_found_0,), np.int64)


@_inner
def _near_marks_NAME(_model):
    return carray(_as_pointer(_model._NAME_near_marks), (_model._NAME_near_marks_0,), np.int64)


@_inner
def _near_list_NAME(_model):
    counters = _counters_NAME(_model)
    cells = _near_cells_NAME(_model)
    entries = _near_entries_NAME(_model)
    heads = _near_heads_NAME(_model)
    spots = _near_spots_NAME(_model)
    rows = _rows_NAME(_model)
    order = _order_NAME(_model)
    alive = _alive_NAME(_model)
    low_x, low_y, width, height = RECTANGLE
    _neighbours.cut(
        cells, counters[_bookkeeping.ALIVE], len(heads), low_x, low_y, width, height, BORDERS
    )
    _neighbours.list_all(cells, entries, heads, spots, rows, counters, order, alive)


@_inner
def _near_moved_NAME(_model, agent):
    _neighbours.moved(
        _near_cells_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        _near_spots_NAME(_model),
        agent._slot,
        agent.x,
        agent.y,
    )


@_inner
def _near_born_NAME(_model, agent):
    _neighbours.born(
        _near_cells_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        _near_spots_NAME(_model),
        agent._slot,
        _counters_NAME(_model)[_bookkeeping.ENTRIES] - 1,
        agent.x,
        agent.y,
    )


@_inner
def _near_died_NAME(_model, agent):
    _neighbours.died(
        _near_cells_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        _near_spots_NAME(_model),
        agent._slot,
    )


@_inner
def _near_ask_heads_NAME(_model, agent):
    cells = _near_cells_NAME(_model)
    heads = _near_heads_NAME(_model)
    for turn in range(3):
        cell = _neighbours.cells_around(cells, agent.x, agent.y, turn)
        if cell >= 0:
            _fetch_ahead(heads, cell)


@_inner
def _near_ask_entries_NAME(_model, agent):
    cells = _near_cells_NAME(_model)
    heads = _near_heads_NAME(_model)
    entries = _near_entries_NAME(_model)
    for turn in range(3):
        cell = _neighbours.cells_around(cells, agent.x, agent.y, turn)
        if cell >= 0 and heads[cell] >= 0:
            for spot in range(heads[cell] - 2, heads[cell] + 5, 2):
                _fetch_ahead(entries, spot)


@_inner
def _near_begin_NAME(_model):
    return _near_cells_NAME(_model).top


@_inner
def _near_keep_NAME(_model, begin, end, ordered):
    if ordered:
        _neighbours.in_order(_near_found_NAME(_model), begin, end, _near_marks_NAME(_model))
    _near_cells_NAME(_model).top = end
    if _counters_NAME(_model)[_bookkeeping.ALIVE] > CACHED:
        rows = _rows_NAME(_model)
        found = _near_found_NAME(_model)
        order = _order_NAME(_model)
        for place in range(begin, end):
            _fetch_ahead(rows, order[found[place]])


@_inner
def _near_leave_NAME(_model, begin):
    _near_cells_NAME(_model).top = begin


@_inner
def _near_slot_NAME(_model, place):
    return _order_NAME(_model)[_near_found_NAME(_model)[place]]


@_inner
def _near_one_NAME(_model, end, rng):
    begin = _near_cells_NAME(_model).top
    if end == begin:
        return -1
    found = _near_found_NAME(_model)
    _neighbours.in_order(found, begin, end, _near_marks_NAME(_model))
    return _order_NAME(_model)[found[begin + _rng_integers(rng, 0, end - begin)]]"""

_ASKED_BY = """@_inner
def _near_NAME_ASKER(_model, who, radius):
    return _neighbours.find_near(
        _near_cells_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        _near_found_NAME(_model),
        WHO_X,
        WHO_Y,
        _neighbours.checked(radius),
        SPOT,
    )


@_inner
def _near_first_NAME_ASKER(_model, who, radius):
    place = _neighbours.nearest(
        _near_cells_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        WHO_X,
        WHO_Y,
        _neighbours.checked(radius),
        SPOT,
    )
    return place if place < 0 else _order_NAME(_model)[place]


@_inner
def _near_patches_NAME_ASKER(_model, who, steps, kind):
    return _neighbours.find_on_patches(
        _near_cells_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        _near_found_NAME(_model),
        WHO_X,
        WHO_Y,
        _neighbours.checked(steps),
        kind,
        SPOT,
    )"""

CACHED = 5000
"""Up to so many agents the processor's cache holds a population without being asked."""


def text(shape: ModelShape, sought: tuple[str, ...]) -> str:
    """Return how compiled rules find agents of the populations that they look for.

    Args:
        shape: the model's.
        sought: the populations.
    """
    *rectangle, wraps_x, wraps_y, whole = shape.world.extent
    found = "_neighbours.bounds(rows, counters, order, alive)"
    own = {
        "RECTANGLE": ", ".join(rectangle) if int(whole) else found,
        "BORDERS": f"{wraps_x}, {wraps_y}, {whole}",
        "CACHED": str(CACHED),
    }
    askers = {
        "own": ("who.x", "who.y", "_near_spots_NAME(_model)[who._slot]"),
        "other": ("who.x", "who.y", "-1"),
    }
    numbers = shape.world.numbers
    if shape.world.patch is not None:
        askers["patch"] = (
            f"float(who // {numbers['height']} + {numbers['low_x']})",
            f"float(who % {numbers['height']} + {numbers['low_y']})",
            "-1",
        )
    parts = [HEAD]
    for name in sought:
        index = _INDEX
        for mark, fill in own.items():
            index = index.replace(mark, fill)
        parts.append(index)
        for asker, (x, y, spot) in askers.items():
            part = _ASKED_BY.replace("ASKER", asker).replace("SPOT", spot)
            parts.append(part.replace("WHO_X", x).replace("WHO_Y", y))
        parts[-1 - len(askers) :] = [one.replace("NAME", name) for one in parts[-1 - len(askers) :]]
    return "\n\n\n".join(parts)
