"""What rules know of a torus, and what stands for it in compiled code."""

from __future__ import annotations

from functools import cached_property
from typing import Any

from socialmind.compiling.layout import dtype_text, row_dtype
from socialmind.compiling.lowering import PLACES
from socialmind.fields import Field
from socialmind.language.shape import WorldShape, WorldText
from socialmind.worlds.torus.geometry import COMMANDS
from socialmind.worlds.torus.patches import PatchForm

_BEFORE = """from socialmind.worlds.torus import geometry as _torus

_patch_index = _inner(_torus.patch_index)
_patches_in_radius = _inner(_torus.patches_in_radius)
PATCH = DTYPE


@_inner
def _patches(_model):
    size = _model._world_size
    return carray(_as_pointer(_model._patches), (size * size,), PATCH)"""


class TorusShape(WorldShape):
    """A torus as rules know it.

    Args:
        patch: the fields of a patch.
    """

    numbers = ("size", "low", "high")
    commands = COMMANDS
    columns = ("world_size", "world_low", "world_high", "patches")

    def __init__(self, patch: dict[str, Field]) -> None:
        self.patch: dict[str, Field] = patch

    @cached_property
    def form(self) -> PatchForm:
        """What the patches of all its worlds have in common."""
        return PatchForm(self.patch)

    def kept_within(self, population: str, field: str) -> tuple[str, ...]:
        """Return what brings a place back over the border."""
        if field in PLACES:
            return "_brought_back", "_model._world_low", "_model._world_size"
        return ()

    def text(self, program: Any) -> WorldText:
        """Return how compiled rules reach patches."""
        return WorldText(before=_BEFORE.replace("DTYPE", dtype_text(row_dtype(self.patch, None))))
