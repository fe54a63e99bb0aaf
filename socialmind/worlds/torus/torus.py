"""The torus of a model: its declaration."""

from __future__ import annotations

from typing import Any

from socialmind.errors import ModelError
from socialmind.fields import Field, class_fields, place_of_field
from socialmind.worlds.torus.geometry import COMMANDS
from socialmind.worlds.torus.patches import TAKEN_NAMES, Grid


class Patch:
    """The base of annotated classes that declare the fields of a patch.

    >>> class Land(Patch):
    ...     taken: bool = False
    """


class Torus:
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

    def __get__(self, model: Any, owner: type) -> Any:
        return self if model is None else model.grid

    @property
    def fields(self) -> dict[str, Field]:
        """The fields of its patches."""
        return class_fields(self.patch)
