"""The schedule of a model: which rules run in a tick, for whom and in what order."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from coglogo_py.border.errors import shown
from socialmind.errors import ModelError, called_at
from socialmind.language.shape import PhaseShape
from socialmind.society.population import Population

Rule = Callable[..., Any]


class PhaseDeclaration:
    """One entry of a model's schedule; `each` and `once` make them."""

    def __init__(self, rule: Rule, population: Population | None, shuffled: bool) -> None:
        self.rule = rule
        self.population = population
        self.shuffled = shuffled

    @property
    def shape(self) -> PhaseShape:
        """The phase, with its population by name."""
        name = None if self.population is None else self.population.name
        return PhaseShape(self.rule, name, self.shuffled)

    def __str__(self) -> str:
        if self.population is None:
            return f"once: {self.rule.__name__}"
        order = "random order" if self.shuffled else "order of birth"
        return f"each of {self.population.name}, {order}: {self.rule.__name__}"


def each(population: Population, rule: Rule, *, shuffled: bool = True) -> PhaseDeclaration:
    """Declare a phase in which each agent of a population follows a rule.

    Args:
        population: the population, as declared in the same class.
        rule: a plain function `rule(agent, model, rng)`; it may leave out `model` and `rng`.
        shuffled: a fresh random order each tick (NetLogo's), or the order of birth.
    """
    if not isinstance(population, Population):
        raise ModelError(
            f"each({shown(population)}, …)",
            "a population of the class",
            "write each(humans, rule)",
            *called_at(),
        )
    _check_rule(rule, "each(…)")
    return PhaseDeclaration(rule, population, shuffled)


def once(rule: Rule) -> PhaseDeclaration:
    """Declare a phase in which a rule runs once a tick.

    Args:
        rule: a plain function `rule(model, rng)`; it may leave out `rng`.
    """
    _check_rule(rule, "once(…)")
    return PhaseDeclaration(rule, None, False)


def _check_rule(rule: Any, written: str) -> None:
    """Refuse what is no function: a name within a class hides that of a rule outside.

    Raises:
        ModelError: so it is.
    """
    if callable(rule):
        return
    kind = type(rule)
    what = f"a {kind.__name__.lower()}" if hasattr(kind, "__set_name__") else shown(rule)
    raise ModelError(
        f"{what} as a rule in {written}",
        "a plain function",
        "write it with `def` at the top of the file, and call nothing of the class like it",
        *called_at(),
    )
