"""The torus of a model: its declaration."""

from __future__ import annotations

from typing import Any

from socialmind.agents.running import Running
from socialmind.errors import ModelError
from socialmind.fields import class_fields, place_of_field
from socialmind.language.shape import WorldShape
from socialmind.worlds.contract import Ground, Place, World
from socialmind.worlds.torus.geometry import COMMANDS
from socialmind.worlds.torus.ground import TorusGround
from socialmind.worlds.torus.patches import TAKEN_NAMES, Grid
from socialmind.worlds.torus.shape import TorusShape


class Patch:
    """The base of annotated classes that declare the fields of a patch.

    >>> class Land(Patch):
    ...     taken: bool = False
    """


class Torus(World):
    """The declaration of a square torus of patches, as the attribute `world` of a model.

    Args:
        size: patches along a side, 1 or more: a number, or the name of a parameter.
        patch: the annotated class of its patches, which inherits from `Patch`.
    """

    def __init__(self, size: int | str = 33, patch: type = Patch) -> None:
        self.size = size
        self.patch = patch

    def check(self) -> None:
        """Refuse patches of a wrong class, and names that are taken.

        Raises:
            ModelError: so it is.
        """
        if not (isinstance(self.patch, type) and issubclass(self.patch, Patch)):
            raise ModelError(
                f"{self.patch!r} as the patches of the world",
                "a class that inherits from socialmind.Patch",
                "write class Land(Patch): …",
            )
        for name in class_fields(self.patch):
            if name in TAKEN_NAMES or hasattr(Grid, name) or name in COMMANDS:
                raise ModelError(
                    f"a field called {name!r}",
                    "a name that patches and the world do not use",
                    None,
                    *place_of_field(self.patch, name),
                )

    def shape(self, model: Any, place: Place) -> WorldShape:
        """Return what rules know of the torus: its patches, its size, and how to move on it."""
        super().shape(model, place)
        return TorusShape(class_fields(self.patch))

    def ground(self, society: Running, size: int | None) -> Ground:
        """Return the torus of a running society, with its patches."""
        return TorusGround(society, size or 1)
