"""How compiled rules find agents, as text."""

from __future__ import annotations

from typing import Any

from socialmind.compiling.layout import dtype_text
from socialmind.language.shape import ModelShape
from socialmind.worlds.neighbours.cells import CELLS
from socialmind.worlds.neighbours.entries import ENTRY

HEAD = f"""from socialmind.worlds.neighbours import birth_order as _birth_order
from socialmind.worlds.neighbours import cells as _near_cut
from socialmind.worlds.neighbours import entries as _near_entry
from socialmind.worlds.neighbours import few as _few
from socialmind.worlds.neighbours import lattice as _lattice
from socialmind.worlds.neighbours import questions as _neighbours

NEAR_CELLS = {dtype_text(CELLS)}
NEAR_ENTRY = {dtype_text(ENTRY)}"""

_INDEX = """@_inner
def _near_cells_NAME(_model):
    return carray(_as_pointer(_model._NAME_near_cells), (1,), NEAR_CELLS)[0]


@_inner
def _near_entries_NAME(_model):
    size = _model._NAME_near_entries_0
    return carray(_as_pointer(_model._NAME_near_entries), (size,), NEAR_ENTRY)


@_inner
def _near_starts_NAME(_model):
    return carray(_as_pointer(_model._NAME_near_starts), (_model._NAME_near_starts_0,), np.int32)


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
def _near_places_NAME(_model):
    size = _model._NAME_near_places_0
    return carray(_as_pointer(_model._NAME_near_places), (size,), np.float64)


@_inner
def _near_moved_NAME(_model, agent):
    MOVED_AMONG_FEW
    _near_entry.moved(
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
    BORN_AMONG_FEW
    _near_entry.born(
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
    DIED_AMONG_FEW
    _near_entry.died(
        _near_cells_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        _near_spots_NAME(_model),
        agent._slot,
    )


@_inner
def _near_begin_NAME(_model):
    return _near_cells_NAME(_model).top


@_inner
def _near_order_NAME(_model, begin, end):
    if _near_cells_NAME(_model).few:  # found in this order
        return
    places = _counters_NAME(_model)[_bookkeeping.ENTRIES]
    _birth_order.in_order(
        _near_found_NAME(_model), begin, end, _near_marks_NAME(_model), places
    )


@_inner
def _near_keep_NAME(_model, begin, end, ordered):
    if ordered:
        _near_order_NAME(_model, begin, end)
    _near_cells_NAME(_model).top = end
    if _counters_NAME(_model)[_bookkeeping.ALIVE] > CACHED:
        rows = _rows_NAME(_model)
        found = _near_found_NAME(_model)
        order = _order_NAME(_model)
        for place in range(begin, end):
            _fetch_ahead(rows, order[found[place]])


@_inner
def _near_keep_slots_NAME(_model, begin, end):
    _near_cells_NAME(_model).top = end
    if _counters_NAME(_model)[_bookkeeping.ALIVE] > CACHED:
        rows = _rows_NAME(_model)
        found = _near_found_NAME(_model)
        for place in range(begin, end):
            _fetch_ahead(rows, found[place])


@_inner
def _near_slot_as_it_is_NAME(_model, place):
    return _near_found_NAME(_model)[_index(place)]


@_inner
def _near_leave_NAME(_model, begin):
    _near_cells_NAME(_model).top = begin


@_inner
def _near_slot_NAME(_model, place):
    return _order_NAME(_model)[_index(_near_found_NAME(_model)[_index(place)])]


@_inner
def _near_one_NAME(_model, end, rng):
    begin = _near_cells_NAME(_model).top
    if end == begin:
        return -1
    found = _near_found_NAME(_model)
    _near_order_NAME(_model, begin, end)
    return _order_NAME(_model)[found[begin + _rng_integers(rng, 0, end - begin)]]"""

_ASK = """@_inner
def _near_ask_starts_NAME(_model, agent):
    cells = _near_cells_NAME(_model)
    starts = _near_starts_NAME(_model)
    for turn in range(3):
        cell = _near_entry.cells_around(cells, agent.x, agent.y, turn)
        if cell >= 0:
            _fetch_ahead(starts, cell)


@_inner
def _near_ask_entries_NAME(_model, agent):
    cells = _near_cells_NAME(_model)
    starts = _near_starts_NAME(_model)
    entries = _near_entries_NAME(_model)
    for turn in range(3):
        cell = _near_entry.cells_around(cells, agent.x, agent.y, turn)
        if cell >= 0:
            for spot in range(starts[cell] - 2, starts[cell] + 5, 2):
                _fetch_ahead(entries, spot)"""

_ASK_LISTS = """@_inner
def _near_ask_starts_NAME(_model, agent):
    cells = _near_cells_NAME(_model)
    _fetch_ahead(_near_heads_NAME(_model), _near_entry.cells_around(cells, agent.x, agent.y, 1))


@_inner
def _near_ask_entries_NAME(_model, agent):
    cells = _near_cells_NAME(_model)
    heads = _near_heads_NAME(_model)
    cell = _near_entry.cells_around(cells, agent.x, agent.y, 1)
    _fetch_ahead(_near_entries_NAME(_model), heads[cell])"""

_LIST = """@_inner
def _near_list_NAME(_model):
    counters = _counters_NAME(_model)
    cells = _near_cells_NAME(_model)
    starts = _near_starts_NAME(_model)
    entries = _near_entries_NAME(_model)
    heads = _near_heads_NAME(_model)
    spots = _near_spots_NAME(_model)
    rows = _rows_NAME(_model)
    order = _order_NAME(_model)
    alive = _alive_NAME(_model)
    low_x, low_y, width, height = RECTANGLE
    ALL_OF_FEW
    _near_cut.cut(
        cells, counters[_bookkeeping.ALIVE], len(heads), low_x, low_y, width, height, BORDERS, SIDE
    )
    _near_entry.LIST(cells, starts, entries, heads, spots, rows, counters, order, alive)"""

_NO_LIST = """@_inner
def _near_list_NAME(_model):
    _near_cells_NAME(_model).top = 0"""

_ASKED_BY = """@_inner
def _near_NAME_ASKER(_model, who, radius):
    FIND_AMONG_FEW
    return _neighbours.find_near(
        _near_cells_NAME(_model),
        _near_starts_NAME(_model),
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
        _near_starts_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        WHO_X,
        WHO_Y,
        _neighbours.checked(radius),
        SPOT,
    )
    return place if place < 0 else _order_NAME(_model)[place]"""

_ON_PATCHES = """@_inner
def _near_patches_NAME_ASKER(_model, who, steps, kind):
    ON_PATCHES_OF_FEW
    return _neighbours.find_on_patches(
        _near_cells_NAME(_model),
        _near_starts_NAME(_model),
        _near_entries_NAME(_model),
        _near_heads_NAME(_model),
        _near_found_NAME(_model),
        WHO_X,
        WHO_Y,
        _neighbours.checked(steps),
        kind,
        SPOT,
    )"""

_ON_TAKEN = """@_inner
def _near_PUSHED_NAME_ASKER(_model, who, steps, kind):
    return _lattice.find_on_taken(
        _world_taken(_model),
        _near_entries_NAME(_model),
        _near_spots_NAME(_model),
        _near_found_NAME(_model),
        _near_cells_NAME(_model).top,
        WHO_X,
        WHO_Y,
        _neighbours.checked(steps),
        kind,
        OWN,
        AS_PLACES,
        TAKEN,
    )"""

_COUNTED = """@_inner
def _near_area_NAME_ASKER(_model, who, steps):
    if _counters_NAME(_model)[_bookkeeping.ALIVE] == 0:
        return 0, 0, 0, 0, 0, 0
    return _lattice.area(WHO_X, WHO_Y, _neighbours.checked(steps), SPACE)


@_inner
def _near_standing_NAME_ASKER(_model, who, kind, area, column, row):
    return _lattice.standing(_world_taken(_model), area, column, row, kind, OWN, TAKEN)"""

_AMONG_FEW = {
    "ALL_OF_FEW": """cells.few = counters[_bookkeeping.ALIVE] <= _few.LARGEST
    if cells.few:
        places = _near_places_NAME(_model)
        _few.list_few(
            cells, places, spots, rows, counters, order, alive, low_x, low_y, width, height, WRAPS
        )
        return""",
    "MOVED_AMONG_FEW": """if _near_cells_NAME(_model).few:
        places = _near_places_NAME(_model)
        _few.moved(places, _near_spots_NAME(_model), agent._slot, agent.x, agent.y)
        return""",
    "BORN_AMONG_FEW": """if _near_cells_NAME(_model).few:
        _few.born(
            _near_cells_NAME(_model),
            _near_places_NAME(_model),
            _near_spots_NAME(_model),
            agent._slot,
            _counters_NAME(_model)[_bookkeeping.ENTRIES] - 1,
            agent.x,
            agent.y,
        )
        return""",
    "DIED_AMONG_FEW": """if _near_cells_NAME(_model).few:
        _few.died(_near_places_NAME(_model), _near_spots_NAME(_model), agent._slot)
        return""",
    "FIND_AMONG_FEW": """if _near_cells_NAME(_model).few:
        return _few.find_near(
            _near_cells_NAME(_model),
            _near_places_NAME(_model),
            _near_found_NAME(_model),
            WHO_X,
            WHO_Y,
            _neighbours.checked(radius),
            SPOT,
        )""",
    "ON_PATCHES_OF_FEW": """if _near_cells_NAME(_model).few:
        return _few.find_on_patches(
            _near_cells_NAME(_model),
            _near_places_NAME(_model),
            _near_found_NAME(_model),
            WHO_X,
            WHO_Y,
            _neighbours.checked(steps),
            kind,
            SPOT,
        )""",
}
"""What stands first where all are looked at as long as they are few."""

CACHED = 5000
"""Up to so many agents the processor's cache holds a population without being asked."""


def text(shape: ModelShape, program: Any) -> str:
    """Return how compiled rules find agents of the populations that they look for.

    Args:
        shape: the model's.
        program: the typed rules, a `language.program.Program`.
    """
    *rectangle, wraps_x, wraps_y, whole = shape.world.extent
    found = "_near_cut.bounds(rows, counters, order, alive)"
    own = {
        "RECTANGLE": ", ".join(rectangle) if int(whole) else found,
        "BORDERS": f"{wraps_x}, {wraps_y}, {whole}",
        "WRAPS": f"{wraps_x}, {wraps_y}",
        "CACHED": str(CACHED),
    }
    askers = {
        "own": ("who.x", "who.y", "who._slot"),
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
    for name in program.sought:
        lists = program.sought_on_patches(name)
        kept = (_ASK_LISTS if lists else _ASK, _LIST) if name in program.indexed else (_NO_LIST,)
        index = "\n\n\n".join((_INDEX, *kept))
        few = _AMONG_FEW if program.looked_through(name) else dict.fromkeys(_AMONG_FEW, "")
        own |= {"LIST": "list_apart" if lists else "list_all", "SIDE": str(lists)}
        own["LARGEST"] = "FEW_ON_PATCHES" if lists else "FEW"
        for mark, fill in {**few, **own}.items():
            index = index.replace(mark, fill)
        parts.append(index)
        taken = shape.world.taken_by(name)
        on_patches = [_ON_PATCHES]
        if taken:
            kinds = {"patches": "True", "slots": "False"}
            on_patches = [
                _ON_TAKEN.replace("PUSHED", pushed).replace("AS_PLACES", as_places)
                for pushed, as_places in kinds.items()
            ]
            on_patches.append(_COUNTED.replace("SPACE", taken.split(", ", 2)[2]))
        for asker, (x, y, own_slot) in askers.items():
            spot = "-1" if own_slot == "-1" else f"_near_spots_NAME(_model)[{own_slot}]"
            part = "\n\n\n".join([_ASKED_BY, *on_patches]).replace("TAKEN", taken)
            for mark in ("FIND_AMONG_FEW", "ON_PATCHES_OF_FEW"):
                part = part.replace(mark, few[mark])
            part = part.replace("ASKER", asker).replace("SPOT", spot).replace("OWN", own_slot)
            parts.append(part.replace("WHO_X", x).replace("WHO_Y", y))
        parts[-1 - len(askers) :] = [one.replace("NAME", name) for one in parts[-1 - len(askers) :]]
    return "\n\n\n".join(parts)
