"""The methods by name, behind one call."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

from socialmind.errors import SocialmindError, nearest
from socialmind.experiments.calibration.methods.abc_smc import Abc
from socialmind.experiments.calibration.methods.cma import Cma
from socialmind.experiments.calibration.methods.contract import Method
from socialmind.experiments.calibration.methods.latin import Latin
from socialmind.experiments.calibration.methods.tpe import Tpe

METHODS: dict[str, type[Method]] = {"cmaes": Cma, "tpe": Tpe, "lhs": Latin, "abc": Abc}


def method_called(name: str) -> type[Method]:
    """Return a method by its name.

    Raises:
        SocialmindError: there is none of that name.
    """
    if name not in METHODS:
        raise SocialmindError(f"no method called {name!r}; {nearest(name, METHODS)}")
    return METHODS[name]


def libraries(name: str) -> dict[str, str]:
    """Return the version of what a method stands on, by its name."""
    library = METHODS[name].library
    try:
        return {library: version(library)}
    except PackageNotFoundError:
        return {}
