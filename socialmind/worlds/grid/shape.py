"""What rules know of a world of patches, and what stands for it in compiled code."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from socialmind.compiling.layout import dtype_text, row_dtype
from socialmind.compiling.lowering import PLACES, SPACE
from socialmind.fields import Field
from socialmind.language.shape import WorldShape, WorldText
from socialmind.worlds.grid import fields as steps
from socialmind.worlds.grid import one_per_patch, ways
from socialmind.worlds.grid.geometry import COMMANDS, LOOKING
from socialmind.worlds.grid.patches import PatchForm

_BEFORE = """from socialmind.worlds.grid import patches_near as _near

_patch_index = _inner(_near.patch_index)
_patches_in_radius = _inner(_near.patches_in_radius)
PATCH = DTYPE


@_inner
def _patches(_model):
    return carray(_as_pointer(_model._patches), (WIDTH * HEIGHT,), PATCH)"""

_AROUND = """_count_around = _near.count_around
_nth_around = _near.nth_around


@_inner
def _some_patch(rng, count):
    if count == 0:
        raise ValueError("one_of() where there is no patch")
    return _rng_integers(rng, 0, count)"""

_AROUND_ASKER = """@_inner
def _patches_count_ASKER(_model, who, steps, four):
    return _count_around(PLACE, steps, four, SPACE)


@_inner
def _patches_nth_ASKER(_model, who, steps, four, number):
    return _nth_around(number, PLACE, steps, four, SPACE)


@_inner
def _patches_one_ASKER(_model, who, steps, four, rng):
    number = _some_patch(rng, _patches_count_ASKER(_model, who, steps, four))
    return _patches_nth_ASKER(_model, who, steps, four, number)


@_inner
def _patches_within_ASKER(_model, who, radius):
    count = 0
    for place in _patches_in_radius(PLACE, radius, SPACE):
        count += 1
    return count


@_inner
def _patches_one_within_ASKER(_model, who, radius, rng):
    left = _some_patch(rng, _patches_within_ASKER(_model, who, radius))
    for place in _patches_in_radius(PLACE, radius, SPACE):
        if left == 0:
            return place
        left -= 1
    return -1"""


class GridShape(WorldShape):
    """A world of patches as rules know it.

    Args:
        patch: the fields of a patch.
        numbers: how compiled code finds where the world is.
        alone: the populations of which a patch has room for one agent; None where there is room
            for any number.
    """

    def __init__(
        self,
        patch: dict[str, Field],
        numbers: Mapping[str, str],
        alone: tuple[str, ...] | None,
    ) -> None:
        self.patch: dict[str, Field] = patch
        self.numbers = dict(numbers)
        self.alone = alone
        own = [text.removeprefix("_model._") for text in numbers.values() if _is_column(text)]
        self.columns = (*dict.fromkeys(own), "patches")
        low_x, low_y, width, height, wraps_x, wraps_y = (self.numbers[name] for name in SPACE)
        ends = f"({low_x} - 0.5)", f"({low_y} - 0.5)", f"float({width})", f"float({height})"
        self.extent = (*ends, wraps_x, wraps_y, "1")
        self.commands = COMMANDS
        self.calls = {**steps.CALLS, **ways.CALLS}
        if alone is not None:
            self.numbers |= one_per_patch.NUMBERS
            self.columns += one_per_patch.COLUMNS
            self.commands = LOOKING | one_per_patch.MOVING
            self.calls = {**self.calls, **one_per_patch.CALLS}

    @cached_property
    def form(self) -> PatchForm:
        """What the patches of all its worlds have in common."""
        return PatchForm(self.patch)

    def kept_within(self, population: str, field: str) -> tuple[str, ...]:
        """Return what brings a place back over the border, or refuses one beyond a wall."""
        if field not in PLACES:
            return ()
        keep = "_brought_back" if self.numbers[f"wraps_{field}"] == "1" else "_within_walls"
        side = "width" if field == "x" else "height"
        return keep, self.numbers[f"low_{field}"], self.numbers[side]

    def instead_of_setting(self, population: str, field: str) -> str | None:
        """Return how to move where a patch has room for one: in one step."""
        return one_per_patch.INSTEAD if self.alone is not None and field in PLACES else None

    def taken_by(self, population: str) -> str:
        """Return how compiled code tells a population's agents by the patches that they take."""
        if self.alone is None:
            return ""
        space = ", ".join(self.numbers[name] for name in SPACE)
        return f"{len(self.alone)}, {self.alone.index(population)}, {space}"

    def leaving(self, population: str) -> str:
        """Return the line by which an agent that dies leaves its patch."""
        return f"_world_left_{population}(_model, agent)" if self.alone is not None else ""

    def text(self, program: Any) -> WorldText:
        """Return how compiled rules reach patches."""
        fills = {
            "WIDTH": self.numbers["width"],
            "HEIGHT": self.numbers["height"],
            "DTYPE": dtype_text(row_dtype(self.patch, None)),  # last: it holds users' names
        }
        before = [_filled(_BEFORE, fills)]
        if program.patches_sought:
            before.append(self._around_text())
        before.append(steps.text(program.world_calls, self.patch, self.numbers))
        space = ", ".join(self.numbers[name] for name in SPACE)
        before.append(ways.text(program.world_calls, space))
        if self.alone is None:
            return WorldText("\n\n\n".join(filter(None, before)))
        kept = {}
        for axis in PLACES:
            keep, low, side = self.kept_within("", axis)
            kept[f"KEEP_{axis.upper()}"] = f"{keep}({axis}, {low}, {side})"
        before.append(one_per_patch.text(self.alone, {"SPACE": space, **kept}, program.indexed))
        return WorldText("\n\n\n".join(filter(None, before)), "", one_per_patch.TICK)

    def _around_text(self) -> str:
        """Return how compiled rules find the patches around agents and patches."""
        space = ", ".join(self.numbers[name] for name in SPACE)
        height, low_x, low_y = (self.numbers[name] for name in ("height", "low_x", "low_y"))
        patch = f"float(who // {height} + {low_x}), float(who % {height} + {low_y})"
        parts = [_AROUND]
        for asker, place in (("agent", "who.x, who.y"), ("patch", patch)):
            parts.append(_filled(_AROUND_ASKER, {"ASKER": asker, "PLACE": place, "SPACE": space}))
        return "\n\n\n".join(parts)


def _is_column(text: str) -> bool:
    return text.removeprefix("_model.").isidentifier()


def _filled(text: str, fills: Mapping[str, str]) -> str:
    for mark, fill in fills.items():
        text = text.replace(mark, fill)
    return text
