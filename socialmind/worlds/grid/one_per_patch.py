"""Worlds in which a patch has room for one agent, of any population.

`taken` says for each patch who stands there, −1 for nobody. Who is born stands nowhere until its
first move; that it must have made when the setup or the tick is over. The free patches stand in a
list too, so that one is drawn at once; it begins each tick in the order of the patches, so that a
run that is resumed draws the same ones.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from socialmind.agents import bookkeeping
from socialmind.errors import ValueRefusedError
from socialmind.fields import Field
from socialmind.language.shape import AGENT, WorldCall
from socialmind.language.types import BOOL, FLOAT, NONE, RNG, PatchType
from socialmind.worlds.grid.geometry import ahead, is_inside, nearer
from socialmind.worlds.grid.patches import PatchForm, PatchRow, PatchWorld

NOBODY = -1


@register_jitable
def open_all(taken: Any, free: Any, free_at: Any) -> None:
    """List the free patches in their order; the first entry of the list is how many there are."""
    count = 0
    for place in range(len(taken)):
        # Written wherever it is: a branch would be guessed wrong every other time.
        free[count + 1] = place
        free_at[place] = count + 1
        count += taken[place] < 0
    free[0] = count


@register_jitable
def freed(taken: Any, free: Any, free_at: Any, place: int, who: int) -> None:
    """Free a patch, if this agent stands there; one that stands nowhere leaves none."""
    if taken[place] == who:
        taken[place] = NOBODY
        free[0] += 1
        free[free[0]] = place
        free_at[place] = free[0]


@register_jitable
def moved(taken: Any, free: Any, free_at: Any, old: int, new: int, who: int) -> bool:
    """Move an agent from a patch to another; False, and nothing is done, when that is taken."""
    if taken[new] == who:
        return True
    if taken[new] >= 0:
        return False
    freed(taken, free, free_at, old, who)
    taken[new] = who
    # The last of the list takes the place of the one that is taken out.
    last = free[free[0]]
    free[free_at[new]] = last
    free_at[last] = free_at[new]
    free[0] -= 1
    return True


# In rules -----------------------------------------------------------------------------------------


def forward(world: Any, agent: Any, length: float) -> None:
    """Move an agent along its heading, in steps of one; it stops before a wall."""
    x, y = ahead(world, agent, length)
    world.move_to(agent, x, y)


def walk_to(world: Any, agent: Any, x: float, y: float, length: float) -> None:
    """Turn an agent to a point and move it there by a length, or onto it when it is nearer."""
    new_x, new_y, heading = nearer(world, agent, x, y, length)
    agent.heading = heading
    world.move_to(agent, new_x, new_y)


MOVING = {function.__name__: function for function in (forward, walk_to)}
NUMBERS: Mapping[str, str] = {"free_count": "_world_free(_model)[0]"}
COLUMNS = tuple(
    f"world_{name}{axis}" for name in ("taken", "free", "free_at") for axis in ("", "_0")
)
INSTEAD = "a patch has room for one: move in one step, world.move_to(agent, x, y)"
CALLS: Mapping[str, WorldCall] = {
    "move_to": WorldCall((AGENT, FLOAT, FLOAT), NONE, "move_to(agent, x, y)"),
    "is_free": WorldCall((FLOAT, FLOAT), BOOL, "is_free(x, y)"),
    "one_free": WorldCall((RNG,), PatchType(), "one_free(rng)"),
}
NOWHERE = "an agent that stands nowhere; place it with world.move_to(agent, x, y) when it is born"
NONE_FREE = "one_free() of a world without a free patch; ask world.free_count before"

_TEXT = """from socialmind.worlds.grid import one_per_patch as _one_per_patch

_is_inside = _inner(_one_per_patch.inside)


@_inner
def _world_taken(_model):
    return carray(_as_pointer(_model._world_taken), (_model._world_taken_0,), np.int64)


@_inner
def _world_free(_model):
    return carray(_as_pointer(_model._world_free), (_model._world_free_0,), np.int64)


@_inner
def _world_free_at(_model):
    return carray(_as_pointer(_model._world_free_at), (_model._world_free_at_0,), np.int64)


@_inner
def _world_is_free(_model, x, y):
    if not _is_inside(x, y, SPACE):
        return False
    return _world_taken(_model)[_patch_index(x, y, SPACE)] < 0


@_inner
def _world_one_free(_model, rng):
    free = _world_free(_model)
    if free[0] == 0:
        raise ValueError("one_free() of a world without a free patch")
    return free[1 + _rng_integers(rng, 0, free[0])]


@_inner
def _world_begin(_model):
    _one_per_patch.open_all(_world_taken(_model), _world_free(_model), _world_free_at(_model))


@_inner
def _world_end(_model):
    taken = _world_taken(_model)
    standing = len(taken) - _world_free(_model)[0]
    if standing != LIVING:
        raise ValueError("an agent that stands nowhere")"""

_OF_POPULATION = """@_inner
def _world_left_NAME(_model, agent):
    _one_per_patch.freed(
        _world_taken(_model),
        _world_free(_model),
        _world_free_at(_model),
        _patch_index(agent.x, agent.y, SPACE),
        agent._slot * COUNT + NUMBER,
    )


@_inner
def _world_move_to_NAME(_model, agent, x, y):
    x = KEEP_X
    y = KEEP_Y
    if _alive_NAME(_model)[agent._slot] and not _one_per_patch.moved(
        _world_taken(_model),
        _world_free(_model),
        _world_free_at(_model),
        _patch_index(agent.x, agent.y, SPACE),
        _patch_index(x, y, SPACE),
        agent._slot * COUNT + NUMBER,
    ):
        raise ValueError("a patch that is taken")
    agent.x = x
    agent.y = y
    MOVED"""

TICK = "    _world_begin(_model)\nPHASES    _world_end(_model)\n"


def text(populations: tuple[str, ...], fills: Mapping[str, str], indexed: tuple[str, ...]) -> str:
    """Return how compiled rules move agents of which a patch has room for one.

    Args:
        populations: all of the model.
        fills: how compiled code finds where the world is, and keeps a place in it.
        indexed: the populations of which an index is kept.
    """
    living = [f"_counters_{name}(_model)[_bookkeeping.ALIVE]" for name in populations]
    parts = [_TEXT.replace("LIVING", f"({' + '.join(living) or '0'})")]
    for number, name in enumerate(populations):
        own = {"COUNT": str(len(populations)), "NUMBER": str(number), **fills, "NAME": name}
        moved = "_near_moved_NAME(_model, agent)" if name in indexed else "return"
        part = _OF_POPULATION.replace("MOVED", moved)
        for mark, fill in own.items():
            part = part.replace(mark, fill)
        parts.append(part)
    return "\n\n\n".join(parts).replace("SPACE", fills["SPACE"])


def inside(
    x: float, y: float, low_x: int, low_y: int, width: int, height: int, wraps_x: int, wraps_y: int
) -> bool:
    """Say whether the world has a patch at a point."""
    across = wraps_x != 0 or low_x - 0.5 <= x < low_x - 0.5 + width
    return across and (wraps_y != 0 or low_y - 0.5 <= y < low_y - 0.5 + height)


# A running world ----------------------------------------------------------------------------------


class OnePerPatch(PatchWorld):
    """A running world in which a patch has room for one agent.

    Args:
        fields: the fields of a patch.
        numbers: where the world is.
    """

    def __init__(
        self,
        fields: dict[str, Field],
        numbers: Mapping[str, int],
        form: PatchForm | None = None,
    ) -> None:
        super().__init__(fields, numbers, form)
        size = len(self.rows)
        self._taken = np.full(size, NOBODY, np.int64)
        self._free = np.zeros(size + 1, np.int64)
        self._free_at = np.zeros(size, np.int64)
        self._tables: dict[str, Any] = {}
        self.list_free()

    def settle_in(self, tables: Mapping[str, Any]) -> None:
        """Take note of the society's tables; agents that begin with a place stand on it.

        Raises:
            ValueRefusedError: two stand on one patch.
        """
        self._tables = dict(tables)
        for table in tables.values():
            beginning = table._placed_by
            for place, slot in enumerate(table.slots.tolist() if beginning else ()):
                new = self.place_of(table.columns["x"].item(slot), table.columns["y"].item(slot))
                who = self._number_of(table, slot)
                if not moved(self._taken, self._free, self._free_at, new, new, who):
                    raise ValueRefusedError(
                        f"{beginning.what}, {beginning.row(place)}: found an agent on "
                        f"{self.row_class(self, new)!r}, where {self._who(self._taken.item(new))} "
                        "stands; expected a patch of its own"
                    )

    @property
    def knows_agents(self) -> bool:
        """Whether the tables are made, and agents move from now on."""
        return bool(self._tables)

    def holding(self) -> dict[str, NDArray[Any]]:
        """Return the arrays that compiled code reaches, by the columns of their addresses."""
        return {
            "world_taken": self._taken, "world_free": self._free, "world_free_at": self._free_at
        }  # fmt: skip

    def list_free(self) -> None:
        """List the free patches anew, in their order."""
        empty = np.flatnonzero(self._taken < 0)
        self._free[0] = len(empty)
        self._free[1 : len(empty) + 1] = empty
        self._free_at[empty] = np.arange(1, len(empty) + 1)

    def snapshot(self) -> dict[str, NDArray[Any]]:
        """Return copies of the arrays that a checkpoint keeps."""
        return super().snapshot() | {"taken": self._taken.copy()}

    def misfit(self, state: Mapping[str, Any]) -> str | None:
        """Say what is wrong with arrays that are offered as a state, or None."""
        found = super().misfit(state)
        if found is None:
            there = state["taken"][state["taken"] != NOBODY]
            if len(there) and (there.min() < 0 or len(np.unique(there)) < len(there)):
                found = "world.taken holds agents that stand on no patch, or on two"
        return found

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take the arrays of a checkpoint."""
        super().restore(state)
        self._taken[:] = state["taken"]
        self.list_free()

    # What rules and users ask and do --------------------------------------------------------------

    @property
    def free_count(self) -> int:
        """How many patches are free."""
        return self._free.item(0)

    def is_free(self, x: float, y: float) -> bool:
        """Say whether there is a patch at a point, and nobody stands on it."""
        if not is_inside(self, x, y):
            return False
        return self._taken.item(self.place_of(x, y)) < 0

    def one_free(self, rng: Any) -> PatchRow:
        """Return a free patch, drawn at random.

        Raises:
            ValueError: there is none.
        """
        if not self._free[0]:
            raise ValueRefusedError(NONE_FREE)
        place = self._free.item(1 + int(rng.integers(0, self._free.item(0))))
        return self.row_class(self, place)

    def move_to(self, agent: Any, x: float, y: float) -> None:
        """Put an agent on a patch that is free, or that it stands on; nothing is done else.

        Raises:
            ValueRefusedError: another stands there, or the world has no patch there.
        """
        table, slot = agent._table, agent._slot
        x, y = (
            self.kept(axis, value, _called(table, slot)) for axis, value in (("x", x), ("y", y))
        )
        columns = table.columns
        if table.alive[slot]:
            who = self._number_of(table, slot)
            old = self.place_of(columns["x"].item(slot), columns["y"].item(slot))
            new = self.place_of(x, y)
            if not moved(self._taken, self._free, self._free_at, old, new, who):
                other = self._who(self._taken.item(new))
                raise ValueRefusedError(
                    f"{_called(table, slot)} onto {self.row_class(self, new)!r}, where {other} "
                    "stands; ask world.is_free(x, y) before"
                )
        columns["x"][slot] = x
        columns["y"][slot] = y

    forward = forward
    walk_to = walk_to

    # Agents ---------------------------------------------------------------------------------------

    def leave(self, table: Any, slot: int) -> None:
        """Free the patch of an agent that dies."""
        old = self.place_of(table.columns["x"].item(slot), table.columns["y"].item(slot))
        freed(self._taken, self._free, self._free_at, old, self._number_of(table, slot))

    def standing_nowhere(self) -> tuple[str, int] | None:
        """Return the population and identity of a living agent that was never placed, or None."""
        living = sum(int(one.counters[bookkeeping.ALIVE]) for one in self._tables.values())
        if len(self._taken) - self.free_count == living:
            return None
        for name, table in self._tables.items():
            for slot in table.slots.tolist():
                place = self.place_of(table.columns["x"].item(slot), table.columns["y"].item(slot))
                if self._taken[place] != self._number_of(table, slot):
                    return name, table.columns["_id"].item(slot)
        return None

    def placed(self, table: Any, slots: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return those of some agents of a table that have been placed."""
        names = list(self._tables)
        numbers = slots * len(names) + names.index(table.shape.name)
        return slots[np.isin(numbers, self._taken)]

    def _number_of(self, table: Any, slot: int) -> int:
        names = list(self._tables)
        return slot * len(names) + names.index(table.shape.name)

    def _who(self, number: int) -> str:
        slot, place = divmod(number, len(self._tables))
        return _called(list(self._tables.values())[place], slot)


def _called(table: Any, slot: int) -> str:
    return f"agent {table.columns['_id'].item(slot)} of {table.shape.name!r}"
