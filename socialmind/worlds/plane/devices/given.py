"""The numbers that devices and bodies are made with: checked where a modeller writes them."""

from __future__ import annotations

import math
from typing import Any

from coglogo_py.border.errors import shown
from coglogo_py.border.numbers import is_number, is_whole
from socialmind.errors import ModelError, called_at


def whole(maker: str, least: int, **given: Any) -> None:
    """Refuse an argument that is no whole number, or too small.

    Args:
        maker: the name of what is called.
        least: the smallest value.
        given: the arguments, by name.

    Raises:
        ModelError: with the modeller's line.
    """
    for name, value in given.items():
        if not (is_whole(value) and value >= least):
            raise _wrong(maker, name, value, f"a whole number, {least} or more")


def numbers(maker: str, above: float = -math.inf, least: float = -math.inf, **given: Any) -> None:
    """Refuse an argument that is neither a number in its range nor the name of a parameter.

    Args:
        maker: the name of what is called.
        above: what it must be more than.
        least: the smallest value.
        given: the arguments, by name.

    Raises:
        ModelError: with the modeller's line.
    """
    bounds = [f", above {above:g}"] if above > -math.inf else []
    bounds += [f", {least:g} or more"] if least > -math.inf else []
    for name, value in given.items():
        if isinstance(value, str):
            continue
        if not (is_number(value) and value > above and value >= least):
            expected = f"a number{''.join(bounds)}"
            raise _wrong(maker, name, value, f"{expected}, or the name of a parameter of the model")


def counts(maker: str, least: int, **given: Any) -> None:
    """Refuse an argument that is neither a whole number, as `whole`, nor the name of a parameter.

    Raises:
        ModelError: with the modeller's line.
    """
    whole(maker, least, **{name: one for name, one in given.items() if not isinstance(one, str)})


def _wrong(maker: str, name: str, value: Any, expected: str) -> ModelError:
    return ModelError(f"{name}={shown(value)} of {maker}()", expected, None, *called_at())
